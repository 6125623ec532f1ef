"""Co- and counter-rotating phasors of one order as an answer holds them."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from optimizer.mechanics.inertia import Wrench


def orders_of(wrenches: Sequence[tuple[int, Wrench]]) -> list[dict[str, Any]]:
    """Fields of orders (:class:`schemas.outputs.Order`) of force [N] and moment [N m] of one machine."""
    pairs = [[(pair.co, pair.counter) for pair in wrench] for _, wrench in wrenches]
    vectors = np.array(pairs, dtype=complex).reshape(len(pairs), 2, 2)
    phase = np.where(vectors == 0, 0.0, np.rad2deg(np.angle(vectors)))
    size = np.abs(vectors)
    parts = zip(vectors.tolist(), phase.tolist(), (size[..., 0] + size[..., 1]).tolist(), strict=True)
    return [
        {
            "order": number,
            **{
                name: {
                    "co_rotating": _phasor(co, of_co, unit),
                    "counter_rotating": _phasor(counter, of_counter, unit),
                    f"peak_{unit}": peak,
                }
                for (name, unit), (co, counter), (of_co, of_counter), peak in zip(
                    (("force", "N"), ("moment", "Nm")), *each, strict=True
                )
            },
        }
        for (number, _), each in zip(wrenches, parts, strict=True)
    ]


def _phasor(vector: complex, phase_deg: float, unit: str) -> dict[str, float]:
    return {
        f"real_{unit}": vector.real,
        f"imag_{unit}": vector.imag,
        f"magnitude_{unit}": abs(vector),
        "phase_deg": phase_deg,
    }
