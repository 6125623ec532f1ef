"""How the kernels are compiled, as all inner loops are: :mod:`optimizer.numerics.compiling`."""

from optimizer.numerics.compiling import (
    folded,
    fused,
    fused_inlined,
    in_place,
    inlined,
    inner,
    inner_with_arrays,
    kernel,
)

__all__ = ["folded", "fused", "fused_inlined", "in_place", "inlined", "inner", "inner_with_arrays", "kernel"]
