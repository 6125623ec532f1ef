"""Co- and counter-rotating phasors of one order as an answer holds them."""

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
    """Phasors (n, 2, 2) of wrenches, as :func:`vectors_of`, with what every figure of them is made of."""

    vectors: Complex
    size: Real  # N, N m
    phase: Real  # rad

    @classmethod
    def of(cls, vectors: Complex) -> "Polar":
        """Sizes and phases of phasors (n, 2, 2)."""
        return cls(vectors, np.abs(vectors), np.arctan2(vectors.imag, vectors.real))

    def first(self, count: int) -> "Polar":
        """Those of the first of the wrenches."""
        return Polar(self.vectors[:count], self.size[:count], self.phase[:count])


def vectors_of(wrenches: Sequence[Wrench]) -> Complex:
    """Phasors (n, 2, 2) of wrenches: of force [N] and moment [N m] that which turns with the shaft and the other."""
    vectors = [vector for wrench in wrenches for pair in wrench for vector in (pair.co, pair.counter)]
    return np.array(vectors, dtype=complex).reshape(-1, 2, 2)


def orders_of(numbers: Sequence[int], polar: Polar) -> list[dict[str, Any]]:
    """Fields of orders (:class:`schemas.answer.outputs.Order`) of force [N] and moment [N m] of one machine.

    Parameters
    ----------
    polar : of the wrenches of these orders.
    """
    vectors, size, _ = polar
    phase = np.where(vectors == 0, 0.0, np.rad2deg(polar.phase))
    parts = zip(vectors.tolist(), phase.tolist(), (size[..., 0] + size[..., 1]).tolist(), strict=True)
    return [
        {"order": number}
        | {
            name: {
                "co_rotating": _phasor(co, of_co, of_phasor),
                "counter_rotating": _phasor(counter, of_counter, of_phasor),
                of_peak: peak,
            }
            for (name, of_phasor, of_peak), (co, counter), (of_co, of_counter), peak in zip(
                _FIELDS, *of_order, strict=True
            )
        }
        for number, of_order in zip(numbers, parts, strict=True)
    ]


def _phasor(vector: complex, phase_deg: float, fields: tuple[str, str, str, str]) -> dict[str, float]:
    real, imag, magnitude, phase = fields
    return {real: vector.real, imag: vector.imag, magnitude: abs(vector), phase: phase_deg}
