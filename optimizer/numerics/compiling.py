"""How inner loops are compiled: once for an installation, dividing as numpy does.

Most of a kernel's time to compile is spent on what surrounds it: an entry from Python and one from C, counts of
references to every array that is handed on. So entries and inner functions are told apart. What is called with numbers
that are written out is compiled for each of them; numpy's integers are of one type.
"""

from collections.abc import Callable
from typing import Any

from numba import config, njit
from numba.core.caching import FunctionCache
from numba.core.runtime import rtsys

# the third level takes 7 % more of the compiler's time; curves of sweeps are faster by 1 % with it, nothing else is
config.OPT = type(config.OPT)(2)


class _MachineCode(FunctionCache):  # type: ignore[misc]
    """Loads machine code without all that numba would compile more with: a sixth of the command line's first answer."""

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        # what makes arrays; numba's own loads every function that it knows as well
        rtsys.initialize(target_context)
        with self._guard_against_spurious_io_errors():
            try:
                return self._load_overload(sig, target_context)
            except (AttributeError, ImportError):
                # what another version has left names types that are no more: it is compiled anew
                self.flush()
        return None


def _cached(**options: bool) -> Callable[[Any], Any]:
    compiled = njit(error_model="numpy", no_cfunc_wrapper=True, **options)

    def decorate(function: Any) -> Any:
        dispatcher = compiled(function)
        dispatcher._cache = _MachineCode(function)  # noqa: SLF001 - numba has no option for it
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
#: the same where a product and a sum may be rounded once, as one instruction: loops over a number of lanes that the
#: compiler knows, which leave no rest that would be rounded otherwise
fused = njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=False, fastmath={"contract"})
fused_inlined = njit(
    error_model="numpy",
    forceinline=True,
    no_cpython_wrapper=True,
    no_cfunc_wrapper=True,
    _nrt=False,
    fastmath={"contract"},
)
