"""Co- and counter-rotating phasors of one order as an answer holds them."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from optimizer.mechanics.inertia import Wrench
from optimizer.numerics.arrays import Complex, Real

#: of an order: its vectors, what their phasors are told by, and their peak
_FIELDS = tuple(
    (name, (f"real_{unit}", f"imag_{unit}", f"magnitude_{unit}", "phase_deg"), f"peak_{unit}")
    for name, unit in (("force", "N"), ("moment", "Nm"))
)


class Polar(NamedTuple):
    """A pair of phasors of a force [N] or a moment [N m], with what every figure of them is made of."""

    co: complex
    counter: complex
    sizes: Sequence[float]  # of both
    phases: Sequence[float]  # of both, rad

    @classmethod
    def of(cls, vectors: Complex) -> "list[list[Polar]]":
        """Force and moment of each of n wrenches, of phasors (n, 2, 2) as :func:`vectors_of`."""
        parts = zip(vectors.tolist(), np.abs(vectors).tolist(), _phases(vectors).tolist(), strict=True)
        return [
            [cls(co, counter, sizes, phases) for (co, counter), sizes, phases in zip(*of_wrench, strict=True)]
            for of_wrench in parts
        ]


def _phases(vectors: Complex) -> Real:
    return np.arctan2(vectors.imag, vectors.real)


def vectors_of(wrenches: Sequence[Wrench]) -> Complex:
    """Phasors (n, 2, 2) of wrenches: of force [N] and moment [N m] that which turns with the shaft and the other."""
    vectors = [vector for wrench in wrenches for pair in wrench for vector in (pair.co, pair.counter)]
    return np.array(vectors, dtype=complex).reshape(-1, 2, 2)


def orders_of(numbers: Sequence[int], polars: Sequence[Sequence[Polar]]) -> list[dict[str, Any]]:
    """Fields of orders (:class:`schemas.answer.outputs.Order`) of force [N] and moment [N m] of one machine.

    Parameters
    ----------
    polars : of the wrenches of these orders.
    """
    return [
        {"order": number}
        | {
            name: _order(polar, of_phasor, of_peak)
            for (name, of_phasor, of_peak), polar in zip(_FIELDS, both, strict=True)
        }
        for number, both in zip(numbers, polars, strict=True)
    ]


def _order(polar: Polar, of_phasor: tuple[str, str, str, str], of_peak: str) -> dict[str, Any]:
    of_co, of_counter = polar.phases
    return {
        "co_rotating": _phasor(polar.co, of_co, of_phasor),
        "counter_rotating": _phasor(polar.counter, of_counter, of_phasor),
        of_peak: polar.sizes[0] + polar.sizes[1],
    }


def _phasor(vector: complex, phase: float, fields: tuple[str, str, str, str]) -> dict[str, float]:
    real, imag, magnitude, phase_deg = fields
    return {
        real: vector.real,
        imag: vector.imag,
        magnitude: abs(vector),
        phase_deg: math.degrees(phase) if vector else 0.0,
    }
