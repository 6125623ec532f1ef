"""Machine to arrays: pure numpy functions that broadcast over leading axes.

Complex numbers stand for vectors across the shaft, x + jy. Frame, angles and signs: docs/mathematics.md.
"""
