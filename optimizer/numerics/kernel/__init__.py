"""Inner loops that any room above calls."""
