"""How inner loops are compiled: once for an installation, dividing as numpy does.

Most of a kernel's time to compile is spent on what surrounds it. That is an entry from Python and one from C, and
counts of references to every array that is handed on. So entries and inner functions differ. What is called with
numbers that are written out is compiled for each of them; numpy's integers are of one type.
"""

from collections.abc import Callable
from typing import Any

from numba import config, njit

from optimizer.numerics.loading import MachineCode

# the third level takes 7 % more of the compiler's time; curves of sweeps are faster by 1 % with it, nothing else is
config.OPT = type(config.OPT)(2)
# vectors of 512 bits stay off: answers take as long with them, and sweeps at most 3 % less. Numba looks at processor
# features once, when the first function of any package is declared. Who imports OpenMDAO before this module would then
# compile every kernel once more


def _cached(**options: bool) -> Callable[[Any], Any]:
    compiled = njit(error_model="numpy", no_cfunc_wrapper=True, **options)

    def decorate(function: Any) -> Any:
        dispatcher = compiled(function)
        dispatcher._cache = MachineCode(function)  # noqa: SLF001 - numba has no option for it
        return dispatcher

    return decorate


#: an entry; a lane that fails may divide by zero; that it failed is seen by its infinities
kernel = _cached()
#: an entry that makes no arrays
in_place = _cached(_nrt=False)
#: what only kernels call, which makes no arrays and hands out none
inner = njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=False)
#: what takes programs of many arrays: to hand them on takes longer than what is done with them
folded = njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=False, forceinline=True)
#: what only kernels call, which makes arrays or hands them out
inner_with_arrays = njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)
#: for what stands in the innermost loops
inlined = njit(error_model="numpy", inline="always")
#: the same where a product and a sum may be rounded once, as one instruction. It is for loops over a number of lanes
#: that the compiler knows: no rest is left that would be rounded otherwise
fused = njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=False, fastmath={"contract"})
fused_inlined = njit(
    error_model="numpy",
    forceinline=True,
    no_cpython_wrapper=True,
    no_cfunc_wrapper=True,
    _nrt=False,
    fastmath={"contract"},
)
