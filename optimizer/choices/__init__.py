"""Sets of counterweights that are not convex: one to a file, all with the same search.

Convex sets, discs and sectors, are the limits of a program (:mod:`optimizer.program.limits`).
"""
