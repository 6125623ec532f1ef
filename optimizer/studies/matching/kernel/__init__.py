"""Inner loops of matching, compiled."""
