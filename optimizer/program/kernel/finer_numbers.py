"""The interior point once more, interpreted, in finer numbers: slow, for what double precision cannot settle.

The functions are those of :mod:`optimizer.program.kernel.interior_point` before compilation, with 50 decimal
digits, or, for more webs, numpy's longdouble (64 bits of mantissa on x86; where it is no finer than double it gains
nothing).
"""

import time
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from contextvars import ContextVar
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal, localcontext
from functools import cache
from types import FunctionType, ModuleType, SimpleNamespace
from typing import Any

import numpy as np

from optimizer.numerics.records import record


@record(frozen=True)
class Precision:
    """A kind of numbers to solve in."""

    name: str
    most_webs: int  # up to which the time is bearable
    finest: float  # gap at which the first stage ends
    mass: float  # the same of the second, relative to the mass
    number: Callable[[float], Any]
    dtype: Any
    sqrt: Callable[[Any], Any]
    isfinite: Callable[[Any], bool]
    arithmetic: Callable[[], AbstractContextManager[object]]  # in which they are reckoned with

    def array(self, values: Any) -> Any:
        """The same numbers in this precision, exactly."""
        flat = [self.number(value) for value in np.ravel(values).tolist()]
        return np.array(flat, dtype=self.dtype).reshape(np.shape(values))

    def numpy(self) -> SimpleNamespace:
        """What the compiled functions use of numpy."""

        def filled(value: float) -> Callable[..., Any]:
            number = self.number(value)
            return lambda shape, dtype=self.dtype: np.full(shape, number if dtype == self.dtype else value, dtype=dtype)

        return SimpleNamespace(
            zeros=filled(0.0),
            ones=filled(1.0),
            empty=filled(0.0),
            sqrt=self.sqrt,
            isfinite=self.isfinite,
            inf=self.number(np.inf),
            max=max,
            int64=np.int64,
        )


#: nothing is trapped: what is undefined becomes a NaN, which ends the search, as in compiled numbers
_FIFTY = Context(prec=50, Emin=MIN_EMIN, Emax=MAX_EMAX, traps=[])
EXTENDED = Precision(
    "interior point, extended precision",
    64,
    1e-16,
    1e-12,
    np.longdouble,
    np.longdouble,
    np.sqrt,
    np.isfinite,
    nullcontext,
)
FIFTY_DIGITS = Precision(
    "interior point, 50 digits",
    16,
    1e-24,
    1e-14,
    Decimal,
    object,
    Decimal.sqrt,
    Decimal.is_finite,
    lambda: localcontext(_FIFTY),
)
PRECISIONS = (EXTENDED, FIFTY_DIGITS)


def finest(webs: int) -> Precision | None:
    """The finest numbers in which the time is bearable; None where there are none, or no webs.

    Coarser ones are not tried before: interpreted, they take half as long, and what they settle finer ones do.
    """
    return next((precision for precision in reversed(PRECISIONS) if 0 < webs <= precision.most_webs), None)


def interpreted(
    numpy: SimpleNamespace, number: Callable[[float], Any] = float, parts: Sequence[ModuleType] = ()
) -> dict[str, Any]:
    """Everything of an interior point before compilation, by name, with other numbers in place of doubles.

    Parameters
    ----------
    numpy : what stands in for it.
    number : what a literal becomes: decimals refuse to be mixed with doubles.
    parts : modules of kernels; () is the interior point for any limits.
    """
    from optimizer.program.kernel import cones, interior_point, lanes, newton, starts, webs

    parts = parts or (cones, lanes, webs, newton, starts, interior_point)
    names = {name: value for part in parts for name, value in vars(part).items()}
    modules = {part.__name__ for part in parts}
    space: dict[str, Any] = {name: _literal(value, number) for name, value in names.items()}
    space["np"] = numpy
    for name, value in names.items():
        source = getattr(value, "py_func", value)
        if isinstance(source, FunctionType) and source.__module__ in modules:
            code = source.__code__.replace(co_consts=_literal(source.__code__.co_consts, number))
            space[name] = FunctionType(code, space, name, source.__defaults__)
    return space


def _literal(value: Any, number: Callable[[float], Any]) -> Any:
    if type(value) is tuple:
        return tuple(_literal(part, number) for part in value)
    return number(value) if type(value) is float else value


class OutOfTime(Exception):
    """The time limit was over before finer numbers came to an end."""


#: time.thread_time() at which the search of this thread ends
_UNTIL: ContextVar[float] = ContextVar("until", default=np.inf)


def _watched(function: Callable[..., None]) -> Callable[..., None]:
    """A function of every step, that ends the search where time is up: a step may take half a second."""

    def step(*arguments: Any) -> None:
        if time.thread_time() >= _UNTIL.get():
            raise OutOfTime
        function(*arguments)

    return step


@cache
def solve_in(precision: Precision) -> Callable[..., Any]:
    """:func:`optimizer.program.kernel.interior_point.solve` in other numbers; its arrays come back as doubles.

    Before its arguments stands the time.thread_time() after which it raises :class:`OutOfTime`.
    """
    space = interpreted(precision.numpy(), precision.number)
    space["residuals"] = _watched(space["residuals"])
    solve = space["solve"]

    def solved(until: float, data: Any, least_mass: bool, *rest: Any) -> Any:
        own = _UNTIL.set(until)
        try:
            with precision.arithmetic():
                # the data in those numbers as well, or their products are rounded before anything is added to them
                data = data._make(a if a.dtype == np.int64 else precision.array(a) for a in data)
                solution = solve(data, least_mass, *(precision.array(array) for array in rest))
        finally:
            _UNTIL.reset(own)
        return tuple(np.asarray(values, dtype=float) for values in solution)

    return solved
