"""Co- and counter-rotating phasors of one order as an answer holds them."""

from collections.abc import Iterable, Sequence
from itertools import chain
from math import degrees
from typing import Any, NamedTuple

import numpy as np

from optimizer.mechanics.inertia import Wrench
from optimizer.numerics.arrays import Complex
from optimizer.outputs.ellipses import PolarPair, polar_pairs


class _Names(NamedTuple):
    """Fields of the phasors of a force, or of a moment."""

    real: str
    imag: str
    magnitude: str
    peak: str


_OF_FORCE, _OF_MOMENT = (
    _Names(f"real_{unit}", f"imag_{unit}", f"magnitude_{unit}", f"peak_{unit}") for unit in ("N", "Nm")
)


class PlainWrench(NamedTuple):
    """Phasors of force and moment of one machine in plain numbers."""

    force: complex
    counter_force: complex
    moment: complex
    counter_moment: complex

    @classmethod
    def of(cls, wrench: Wrench, factor: float = 1.0) -> "PlainWrench":
        """Those of a wrench () without leading axes, times a factor."""
        force, moment = wrench
        return cls(
            complex(force.co) * factor,
            complex(force.counter) * factor,
            complex(moment.co) * factor,
            complex(moment.counter) * factor,
        )

    def plus(self, other: "PlainWrench") -> "PlainWrench":
        return PlainWrench._make([own + further for own, further in zip(self, other, strict=True)])


class PolarWrench(NamedTuple):
    """The same with magnitudes and phases."""

    force: PolarPair
    moment: PolarPair

    def order(self, number: int) -> dict[str, Any]:
        """Fields of :class:`schemas.answer.outputs.Order`, of an order with this number; force [N], moment [N m]."""
        return {"order": number, "force": _fields(_OF_FORCE, self.force), "moment": _fields(_OF_MOMENT, self.moment)}


def polar_wrenches(wrenches: Iterable[PlainWrench]) -> list[PolarWrench]:
    """Wrenches with magnitudes and phases, all at once."""
    pairs = polar_pairs(list(chain.from_iterable(wrenches)))
    return list(map(PolarWrench, pairs[::2], pairs[1::2]))


def vectors_of(wrenches: Sequence[Wrench]) -> Complex:
    """Phasors (n, 2, 2) of wrenches: of force [N] and moment [N m] that which turns with the shaft and the other."""
    vectors = [complex(vector) for wrench in wrenches for pair in wrench for vector in (pair.co, pair.counter)]
    return np.array(vectors, dtype=complex).reshape(-1, 2, 2)


def _fields(names: _Names, pair: PolarPair) -> dict[str, Any]:
    co, counter, co_size, counter_size, co_phase, counter_phase = pair
    real, imag, magnitude, peak = names
    # nothing has no direction
    return {
        "co_rotating": {
            real: co.real,
            imag: co.imag,
            magnitude: abs(co),
            "phase_deg": degrees(co_phase) if co else 0.0,
        },
        "counter_rotating": {
            real: counter.real,
            imag: counter.imag,
            magnitude: abs(counter),
            "phase_deg": degrees(counter_phase) if counter else 0.0,
        },
        peak: co_size + counter_size,
    }
