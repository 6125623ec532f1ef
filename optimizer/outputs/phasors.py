"""Co- and counter-rotating phasors of one order as an answer holds them."""

import math
from collections.abc import Iterable, Sequence
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
        return cls._make([complex(phasor) * factor for pair in wrench for phasor in (pair.co, pair.counter)])

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
    pairs = polar_pairs([vector for wrench in wrenches for vector in wrench])
    return [PolarWrench(*pair) for pair in zip(pairs[::2], pairs[1::2], strict=True)]


def vectors_of(wrenches: Sequence[Wrench]) -> Complex:
    """Phasors (n, 2, 2) of wrenches: of force [N] and moment [N m] that which turns with the shaft and the other."""
    vectors = [complex(vector) for wrench in wrenches for pair in wrench for vector in (pair.co, pair.counter)]
    return np.array(vectors, dtype=complex).reshape(-1, 2, 2)


def _fields(names: _Names, pair: PolarPair) -> dict[str, Any]:
    return {
        "co_rotating": _phasor(names, pair.co, pair.co_phase),
        "counter_rotating": _phasor(names, pair.counter, pair.counter_phase),
        names.peak: pair.co_size + pair.counter_size,
    }


def _phasor(names: _Names, vector: complex, phase_rad: float) -> dict[str, float]:
    return {
        names.real: vector.real,
        names.imag: vector.imag,
        names.magnitude: abs(vector),
        # nothing has no direction
        "phase_deg": math.degrees(phase_rad) if vector else 0.0,
    }
