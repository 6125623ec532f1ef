"""Machine code that is kept from one process to the next, loaded without what only a compiler reads.

Beside its machine code a kernel is kept as what other kernels would be linked with. To read that takes longer than all
else, and hardly any process links. Nor is numba's own memory management compiled before anything is: a kernel has what
it calls of it in its machine code.
"""

from functools import cache
from typing import Any

from llvmlite.binding import add_symbol, parse_bitcode
from numba.core.caching import CompileResultCacheImpl, FunctionCache
from numba.core.codegen import JITCodeLibrary, JITCPUCodegen
from numba.core.runtime import _nrt_python


class Library(JITCodeLibrary):  # type: ignore[misc]
    """A function and all that it calls; of one that was kept, that is read when another is linked with it."""

    _unread: bytes | None = None

    @classmethod
    def _unserialize(cls, codegen: Any, state: tuple[str, str, tuple[bytes, bytes]]) -> Any:
        name, _, parts = state
        library = codegen.create_library(name)
        library.take(*parts)
        return library

    def take(self, machine_code: bytes, unread: bytes) -> None:
        """What was kept of it: what runs, and what others are linked with."""
        self.enable_object_caching()
        self._set_compiled_object(machine_code)
        self._finalize_final_module()
        self._unread = unread

    def _get_module_for_linking(self) -> Any:
        if self._unread is not None:
            self._shared_module, self._unread = parse_bitcode(self._unread), None
            self._codegen._engine._load_defined_symbols(self._shared_module)  # noqa: SLF001
        return super()._get_module_for_linking()

    def get_pointer_to_function(self, name: str) -> int:
        if self._unread is None:
            return int(super().get_pointer_to_function(name))
        # numba would look for the name in what is not read; of a name that there is not, this is none as well
        return int(self._codegen._engine.get_function_address(name))  # noqa: SLF001


class _Parts(CompileResultCacheImpl):  # type: ignore[misc]
    """What is kept of a kernel, without surroundings of functions in it that hold nothing.

    Each is kept by the name of its module, which would be imported with it: those of arrays take 15 ms.
    """

    def reduce(self, compiled: Any) -> tuple[Any, ...]:
        *parts, surroundings = super().reduce(compiled)
        return *parts, tuple(environment for environment in surroundings if environment.consts)


class MachineCode(FunctionCache):  # type: ignore[misc]
    """Loads machine code without all that numba would compile more with: a fifth of the command line's first answer."""

    _impl_class = _Parts

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        # numba's own loads every function that it knows, too
        _name_allocators()
        with self._guard_against_spurious_io_errors():
            try:
                return self._load_overload(sig, target_context)
            except (AttributeError, ImportError):
                # what another version has left names types that are no more: it is compiled anew
                self.flush()
        return None


@cache
def _name_allocators() -> None:
    """What machine code that makes arrays calls."""
    for name, address in _nrt_python.c_helpers.items():
        add_symbol(name if name.startswith("_") else f"NRT_{name}", address)


# numba has no option for it
JITCPUCodegen._library_class = Library  # noqa: SLF001
