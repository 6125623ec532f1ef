"""Thermal design of the cylinders."""
