"""What any CAD lists of a shaft, and the crankshaft that it shows."""
