"""How inner loops are compiled: once for an installation, dividing as numpy does.

Most of a kernel's time to compile is spent on what surrounds it: an entry from Python and one from C, counts of
references to every array that is handed on. So entries and inner functions are told apart. What is called with numbers
that are written out is compiled for each of them; numpy's integers are of one type.
"""

from numba import njit
from numba.np import linalg


def _without_linear_algebra() -> None:
    """Load numba's arithmetic of arrays now, as if scipy.linalg were not there.

    No kernel calls it, and to see whether it is there numba loads it: a third of a second of every process.
    """

    def absent() -> None:
        raise ImportError

    present, linalg.ensure_blas = linalg.ensure_blas, absent
    try:
        import numba.np.arraymath  # noqa: F401
    finally:
        linalg.ensure_blas = present


_without_linear_algebra()

#: an entry; a lane that fails may divide by zero; that it failed is seen by its infinities
kernel = njit(cache=True, error_model="numpy", no_cfunc_wrapper=True)
#: an entry that makes no arrays
in_place = njit(cache=True, error_model="numpy", no_cfunc_wrapper=True, _nrt=False)
#: what only kernels call, which makes no arrays and hands out none
inner = njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=False)
#: for what stands in the innermost loops
inlined = njit(error_model="numpy", inline="always")
