"""How the kernels are compiled: once for an installation, dividing as numpy does."""

import numpy as np
from numba import njit

#: a lane that fails may divide by zero; that it failed is seen by its infinities
kernel = njit(cache=True, error_model="numpy")
#: for what stands in the innermost loops
inlined = njit(cache=True, error_model="numpy", inline="always")


def plain(array: np.ndarray) -> np.ndarray:
    """The same numbers in the usual order in memory, free to be written to.

    For any other order, and for what is read-only, a kernel would be compiled once more.
    """
    return np.array(array, order="C")
