"""Sweeps: the request, its axes, the columns of its result, and what is answered about it."""
