"""Inner loops of the mechanics, compiled."""
