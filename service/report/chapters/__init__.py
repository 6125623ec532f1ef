"""The chapters of the report, a file for those that belong together."""
