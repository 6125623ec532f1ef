"""What accuracy costs in time: ladders of methods and settings on one machine."""
