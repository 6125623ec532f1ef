"""Sets that counterweights are chosen from and that are not convex: one to a file, all searched in one way.

What is convex, discs and sectors, are the limits of a program (:mod:`optimizer.program.limits`).
"""
