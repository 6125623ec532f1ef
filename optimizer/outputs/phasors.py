"""Co- and counter-rotating phasors of one order as an answer holds them."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from optimizer.mechanics.inertia import Wrench
from optimizer.numerics.arrays import Complex, Real

#: what the phasors of a force [N] and of a moment [N m] are told by
_OF_FORCE, _OF_MOMENT = ((f"real_{unit}", f"imag_{unit}", f"magnitude_{unit}", "phase_deg") for unit in ("N", "Nm"))


class Polars(NamedTuple):
    """Phasors of n wrenches as :func:`vectors_of`, with what every figure of them is made of."""

    vectors: Complex  # (n, 2, 2) of force [N] and moment [N m] that which turns with the shaft, and the other
    sizes: Real  # (n, 2, 2) of these, as are the next
    phases: Real  # rad

    @classmethod
    def of(cls, vectors: Complex) -> "Polars":
        """Those of some phasors."""
        return cls(vectors, np.abs(vectors), np.arctan2(vectors.imag, vectors.real))

    def first(self, count: int) -> "Polars":
        """Those of the first wrenches."""
        return Polars(self.vectors[:count], self.sizes[:count], self.phases[:count])


def vectors_of(wrenches: Sequence[Wrench]) -> Complex:
    """Phasors (n, 2, 2) of wrenches: of force [N] and moment [N m] that which turns with the shaft and the other."""
    vectors = [vector for wrench in wrenches for pair in wrench for vector in (pair.co, pair.counter)]
    return np.array(vectors, dtype=complex).reshape(-1, 2, 2)


def orders_of(numbers: Sequence[int], polars: Polars) -> list[dict[str, Any]]:
    """Fields of orders (:class:`schemas.answer.outputs.Order`) of force [N] and moment [N m] of one machine.

    Parameters
    ----------
    polars : of the wrenches of these orders.
    """
    vectors, sizes, phases = polars
    figures = np.empty((*vectors.shape, 4))
    figures[..., 0], figures[..., 1] = vectors.real, vectors.imag
    figures[..., 2], figures[..., 3] = np.hypot(vectors.real, vectors.imag), np.rad2deg(phases)
    # nothing has no direction
    figures[..., 3][vectors == 0] = 0.0
    peaks = (sizes[..., 0] + sizes[..., 1]).tolist()
    return [
        {
            "order": number,
            "force": {
                "co_rotating": dict(zip(_OF_FORCE, force[0], strict=True)),
                "counter_rotating": dict(zip(_OF_FORCE, force[1], strict=True)),
                "peak_N": peak_force,
            },
            "moment": {
                "co_rotating": dict(zip(_OF_MOMENT, moment[0], strict=True)),
                "counter_rotating": dict(zip(_OF_MOMENT, moment[1], strict=True)),
                "peak_Nm": peak_moment,
            },
        }
        for number, (force, moment), (peak_force, peak_moment) in zip(numbers, figures.tolist(), peaks, strict=True)
    ]
