"""What numba's compiler works out again and again, worked out once: a seventh of its time.

Machine code stays the same to the byte. For every operator the compiler tries all that it may be, in order, and writes
out why it is not that, whether or not it had the same types before. It reports every lock that it takes, though nothing
listens. After every pass over a function it follows all variables through it, though the next pass reads none of that.
For every function that it does not find at once it loads all registries, though they have nothing new.
"""

from collections.abc import Callable, Iterable
from contextlib import nullcontext
from functools import cache
from types import ModuleType
from typing import Any

from llvmlite.binding import ffi
from numba.core import event, ir
from numba.core.base import BaseContext
from numba.core.cpu import CPUContext
from numba.core.postproc import PostProcessor, VariableLifetime
from numba.core.targetconfig import ConfigStack
from numba.core.transforms import canonicalize_cfg
from numba.core.types import Function
from numba.core.typing.context import BaseContext as TypingContext
from numba.core.typing.context import Context
from numba.core.typing.templates import _OverloadFunctionTemplate


def take_shortcuts() -> None:
    """From now on, in this process."""
    _keep_operators()
    _share_implementations()
    _keep_sizes()
    _name_modules()
    _silence_events()
    _postpone_lifetimes()
    _list_variables_by_type()
    _load_registries_once()


def _keep_operators() -> None:
    function: Any = Function
    resolve, memory = function.get_call_type, {}

    def get_call_type(self: Any, context: Any, args: tuple[Any, ...], kws: Any) -> Any:
        if kws:
            return resolve(self, context, args, kws)
        if (key := (self, args, _options())) not in memory:
            signature = resolve(self, context, args, kws)
            memory[key] = signature, self._impl_keys[signature.args]
        # of the same types with other options, it was another function since
        signature, self._impl_keys[signature.args] = memory[key]
        return signature

    function.get_call_type = get_call_type


def _options() -> tuple[str, ...]:
    """How what a function calls is compiled: what numba hands on of the caller's own options."""
    flags = ConfigStack.top_or_none()
    return (
        () if flags is None else (str(flags.nrt), str(flags.fastmath), str(flags.error_model), str(flags.forceinline))
    )


def _share_implementations() -> None:
    # numba compiles what makes an array or finds the larger number anew for entries and for inner functions
    build = _OverloadFunctionTemplate._build_impl  # noqa: SLF001

    def get_impl(self: Any, args: Any, kws: dict[str, Any]) -> Any:
        key = self.context, tuple(args), tuple(kws.items()), _options()
        return self._impl_cache[key] if key in self._impl_cache else build(self, key, args, kws)

    _OverloadFunctionTemplate._get_impl = get_impl  # noqa: SLF001


def _keep_sizes() -> None:
    # for each question it writes a module as text, and has it read
    BaseContext.get_abi_sizeof = cache(BaseContext.get_abi_sizeof)
    BaseContext.get_abi_alignment = cache(BaseContext.get_abi_alignment)


def _name_modules() -> None:
    resolve = TypingContext.resolve_value_type

    def resolve_value_type(self: Any, value: Any) -> Any:
        # it would try all else first
        return self._get_global_type(value) if isinstance(value, ModuleType) else resolve(self, value)

    TypingContext.resolve_value_type = resolve_value_type


def _silence_events() -> None:
    empty = nullcontext()
    event.start_event = event.end_event = lambda *_, **__: None
    event.trigger_event = event.install_timer = lambda *_, **__: empty
    ffi.lib._lock._cblist.clear()  # noqa: SLF001


def _postpone_lifetimes() -> None:
    eager = PostProcessor.run

    def run(self: Any, emit_dels: bool = False, extend_lifetimes: bool = False) -> None:
        function = self.func_ir
        if function.is_generator:
            eager(self, emit_dels, extend_lifetimes)
            return
        function.blocks = canonicalize_cfg(function.blocks)
        # until they are read
        function.variable_lifetime, function.generator_info = VariableLifetime(function.blocks), None
        if emit_dels:
            self._insert_var_dels(extend_lifetimes=extend_lifetimes)

    PostProcessor.run = run


def _list_variables_by_type() -> None:
    @cache
    def reader(kind: Any) -> Callable[[Any], list[Any]] | None:
        if issubclass(kind, ir.Var):
            return lambda variable: [variable]
        if issubclass(kind, ir.Inst):
            return lambda instruction: list(instruction.list_vars())
        if issubclass(kind, list | tuple):
            return variables
        if issubclass(kind, dict):
            return lambda mapping: variables(mapping.values())
        return None

    def variables(values: Iterable[Any]) -> list[Any]:
        total: list[Any] = []
        for value in values:
            if (read := reader(value.__class__)) is not None:
                total += read(value)
        return total

    ir.Inst._rec_list_vars = lambda _, value: variables((value,))  # noqa: SLF001


def _load_registries_once() -> None:
    # what a function adds stands in the registry of all targets, which is looked through as before
    for context in (CPUContext, Context):
        _once(context)


def _once(context: Any) -> None:
    load, contexts = context.load_additional_registries, set()

    def load_additional_registries(self: Any) -> None:
        if id(self) not in contexts:
            load(self)
            contexts.add(id(self))

    context.load_additional_registries = load_additional_registries
