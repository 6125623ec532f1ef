"""The door: REST service and command line around the optimiser."""
