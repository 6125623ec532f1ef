"""How the kernels are compiled, as all inner loops are: :mod:`optimizer.numerics.compiling`."""

from optimizer.numerics.compiling import in_place, inlined, inner, inner_with_arrays, kernel

__all__ = ["in_place", "inlined", "inner", "inner_with_arrays", "kernel"]
