"""Operations of the interior point, counted: it runs interpreted, on numbers that count what is done to them."""

import operator
from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np

from optimizer.program.kernel import disc_matrix, disc_peaks, disc_starts, disc_webs, discs
from optimizer.program.kernel.finer_numbers import interpreted

Operate = Callable[[Any, Any], Any]


def _counting(operate: Operate) -> Callable[["Counted", Any], "Counted"]:
    def operation(counts: "Counted", second: Any) -> "Counted":
        if isinstance(second, np.ndarray):
            # numpy goes through the elements
            return NotImplemented
        Counted.done += 1
        return Counted(operate(counts.value, float(second)))

    return operation


def _swapped(operate: Operate) -> Operate:
    return lambda first, second: operate(second, first)


def _quotient(first: float, second: float) -> float:
    """As compiled: infinite or not a number where a float would raise."""
    return first / second if second else float(np.divide(first, second))


def _comparing(compare: Operate) -> Callable[["Counted", Any], bool]:
    return lambda counts, second: bool(compare(counts.value, float(second)))


class Counted:
    """A number that counts additions, multiplications, divisions and roots; of all numbers together."""

    done = 0

    def __init__(self, value: float) -> None:
        self.value = float(value)

    def __float__(self) -> float:
        return self.value

    __add__ = __radd__ = _counting(operator.add)
    __mul__ = __rmul__ = _counting(operator.mul)
    __sub__, __rsub__ = _counting(operator.sub), _counting(_swapped(operator.sub))
    __truediv__, __rtruediv__ = _counting(_quotient), _counting(_swapped(_quotient))
    __pow__ = _counting(operator.pow)
    __lt__, __le__ = _comparing(operator.lt), _comparing(operator.le)
    __gt__, __ge__ = _comparing(operator.gt), _comparing(operator.ge)

    def __neg__(self) -> "Counted":
        return Counted(-self.value)

    def __abs__(self) -> "Counted":
        return Counted(abs(self.value))

    def sqrt(self) -> "Counted":
        Counted.done += 1
        return Counted(float(np.sqrt(self.value)))


#: arrays of programs, before the other arguments
_FIELDS = len(disc_starts.Discs._fields)


def operations_per_program(calls: Sequence[tuple[Any, ...]]) -> tuple[float, float]:
    """Operations of both stages, and iterations, for each program.

    Parameters
    ----------
    calls : arguments of :func:`optimizer.program.kernel.discs.solve`.
    """
    parts = (disc_webs, disc_peaks, disc_matrix, disc_starts, discs)
    space, iterations = interpreted(_numbers(), Counted, parts=parts), 0
    # one lane, so that the rounds of the loop are the iterations of a program
    for name, place in (vars(disc_webs) | vars(disc_peaks)).items():
        if type(place) is int:
            space[name] = place // disc_webs.LANES
    eliminate = space["eliminate"]

    def counter(*arguments: Any) -> None:
        nonlocal iterations
        iterations += 1
        eliminate(*arguments)

    space["eliminate"] = counter
    Counted.done = programs = 0
    with np.errstate(all="ignore"):
        for arguments in calls:
            data, rest = disc_starts.Discs(*arguments[:_FIELDS]), arguments[_FIELDS:]
            space["solve"](*map(_counted, data), *rest)
            programs += len(data.constant)
    return Counted.done / programs, iterations / programs


def _counted(values: Any) -> Any:
    """The same array in numbers that count; whole numbers as they are."""
    return values if values.dtype == np.int64 else np.vectorize(Counted, otypes=[object])(values)


def _numbers() -> SimpleNamespace:
    """What the compiled functions use of numpy."""

    def zeros(shape: Any, dtype: Any = float) -> Any:
        return _counted(np.zeros(shape, dtype))

    return SimpleNamespace(
        zeros=zeros,
        empty=zeros,
        ones=lambda shape: _counted(np.ones(shape)),
        sqrt=lambda number: Counted(float(number)).sqrt(),
        isfinite=lambda number: bool(np.isfinite(float(number))),
        inf=np.inf,
        max=max,
        int64=np.int64,
    )
