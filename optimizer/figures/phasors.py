"""Co- and counter-rotating phasors of one order as an answer holds them."""

import numpy as np

from optimizer.mechanics.inertia import Wrench
from schemas.outputs import Order


def order_of(number: int, wrench: Wrench) -> Order:
    """One order of force [N] and moment [N m] of one machine."""
    vectors = np.array([(pair.co, pair.counter) for pair in wrench])
    phase = np.where(vectors == 0, 0.0, np.rad2deg(np.angle(vectors))).tolist()
    # one validation of the whole takes a third of the time of one of each
    return Order.model_validate(
        {
            "order": number,
            **{
                name: {
                    "co_rotating": _phasor(co, of_co, unit),
                    "counter_rotating": _phasor(counter, of_counter, unit),
                    f"peak_{unit}": peak,
                }
                for (name, unit), (co, counter), (of_co, of_counter), peak in zip(
                    (("force", "N"), ("moment", "Nm")),
                    vectors.tolist(),
                    phase,
                    (float(pair.peak) for pair in wrench),
                    strict=True,
                )
            },
        }
    )


def _phasor(vector: complex, phase_deg: float, unit: str) -> dict[str, float]:
    return {
        f"real_{unit}": vector.real,
        f"imag_{unit}": vector.imag,
        f"magnitude_{unit}": abs(vector),
        "phase_deg": phase_deg,
    }
