"""Counterweights on the steps of a workshop, and what the steps cost."""
