"""Sweeps: the request, its axes, the columns of its result, and answers about its state."""
