"""The interior point once more, interpreted, in finer numbers: slow, for what double precision cannot settle.

The functions are those of :mod:`optimizer.program.kernel.interior_point` before compilation. First with numpy's
longdouble (64 bits of mantissa on x86; where it is no finer than double it gains nothing), then with
mpmath at 50 digits.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from types import FunctionType, SimpleNamespace
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Precision:
    """A kind of numbers to solve in."""

    name: str
    most_webs: int  # up to which the time is bearable
    finest: float  # gap at which the first stage ends
    mass: float  # the same of the second, relative to the mass
    numbers: Callable[[], SimpleNamespace]


def _new(make: Callable[..., Any], zero: Any, dtype: Any) -> Callable[..., Any]:
    def array(shape: Any, dtype: Any = dtype) -> Any:
        values = make(shape, dtype=dtype)
        return values + zero if dtype is object else values

    return array


def _long_double() -> SimpleNamespace:
    same = {name: getattr(np, name) for name in ("sqrt", "isfinite", "inf", "max", "int64")}
    new = {name: _new(getattr(np, name), None, np.longdouble) for name in ("zeros", "ones", "empty")}
    return SimpleNamespace(**new, **same)


def _fifty_digits() -> SimpleNamespace:
    from mpmath import MPContext

    context = MPContext()
    context.dps = 50
    zero = context.mpf(0)
    new = {name: _new(getattr(np, name), zero, object) for name in ("zeros", "ones")}
    return SimpleNamespace(
        **new, empty=new["zeros"], sqrt=context.sqrt, isfinite=context.isfinite, inf=np.inf, max=max, int64=np.int64
    )


EXTENDED = Precision("interior point, extended precision", 64, 1e-16, 1e-12, _long_double)
FIFTY_DIGITS = Precision("interior point, 50 digits", 16, 1e-24, 1e-14, _fifty_digits)
PRECISIONS = (EXTENDED, FIFTY_DIGITS)


def interpreted(numbers: SimpleNamespace) -> dict[str, Any]:
    """Everything of the interior point before compilation, by name, with other numbers in place of numpy."""
    from optimizer.program.kernel import cones, interior_point, lanes, newton, webs

    names = {name: value for part in (cones, lanes, webs, newton, interior_point) for name, value in vars(part).items()}
    space: dict[str, Any] = {**names, "np": numbers}
    for name, value in names.items():
        if hasattr(value, "py_func"):
            source = value.py_func
            space[name] = FunctionType(source.__code__, space, name, source.__defaults__)
    return space


@cache
def solve_in(precision: Precision) -> Callable[..., Any]:
    """:func:`optimizer.program.kernel.interior_point.solve` in other numbers; its arrays come back as they are."""
    space = interpreted(precision.numbers())
    solve, zeros = space["solve"], space["np"].zeros
    # the data in those numbers as well, or their products are rounded before anything is added to them
    return lambda data, *rest: solve(data._make(a if a.dtype == np.int64 else a + zeros(a.shape) for a in data), *rest)
