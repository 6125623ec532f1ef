"""A hard case: its name, why it is hard, and what it measures."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.hard_effects.exact import Number, mp

EPS = float(np.finfo(float).eps)
#: demanded of everything algebraic, relative to the natural size of the quantity
ALGEBRAIC = 1e-12


@dataclass(frozen=True)
class Finding:
    """Largest error of one quantity in one case, relative to its natural size."""

    quantity: str
    error: float
    demanded: float


@dataclass(frozen=True)
class Case:
    """A hard case of one subject."""

    subject: str
    name: str
    why: str
    measure: Callable[[], Iterable[Finding]]

    @property
    def id(self) -> str:
        return f"{self.subject}: {self.name}"

    def findings(self) -> Iterator[Finding]:
        yield from self.measure()


def error(got: Any, exact: Any, size: Number | None = None) -> float:
    """Largest |got - exact| over ``size``, or over the largest exact magnitude where no size is given.

    Not a number counts as infinite; a natural size of 0 asks for exactly 0.
    """
    values = np.atleast_1d(np.asarray(got)).ravel().tolist()
    entries = list(exact) if isinstance(exact, list | tuple) else [exact]
    assert len(values) == len(entries), (len(values), len(entries))
    if size is None:
        size = max(abs(number) for number in entries)
    off = max((abs(mp.mpmathify(v) - w) for v, w in zip(values, entries, strict=True)), default=mp.mpf(0))
    if not mp.isfinite(off):
        return float("inf")
    assert size >= 0
    if size == 0:
        return 0.0 if off == 0 else float("inf")
    return float(off / size)
