"""How inner loops are compiled: once for an installation, dividing as numpy does."""

from numba import njit

#: a lane that fails may divide by zero; that it failed is seen by its infinities
kernel = njit(cache=True, error_model="numpy")
#: for what stands in the innermost loops
inlined = njit(cache=True, error_model="numpy", inline="always")
