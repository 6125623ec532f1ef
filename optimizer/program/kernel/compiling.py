"""How the kernels are compiled, as all inner loops are: :mod:`optimizer.compiling`."""

from optimizer.compiling import inlined, kernel

__all__ = ["inlined", "kernel"]
