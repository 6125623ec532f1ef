"""Inner loops of searches among options, compiled once for an installation."""
