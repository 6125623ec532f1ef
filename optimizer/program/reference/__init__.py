"""The reference solver: the cone program in a modelling layer, solved one at a time."""
