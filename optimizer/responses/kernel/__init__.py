"""Inner loops of what stands between mechanics and program, compiled."""
