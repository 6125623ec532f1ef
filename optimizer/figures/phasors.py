"""Co- and counter-rotating phasors of one order as an answer holds them."""

import numpy as np

from optimizer.arrays import Complex
from optimizer.mechanics.inertia import Wrench
from schemas.outputs import ForceOrder, ForcePhasor, MomentOrder, MomentPhasor, Order


def order_of(number: int, wrench: Wrench) -> Order:
    """One order of force [N] and moment [N m] of one machine."""
    force, moment = wrench
    return Order(
        order=number,
        force=ForceOrder(
            co_rotating=ForcePhasor(**_phasor(force.co, "N")),
            counter_rotating=ForcePhasor(**_phasor(force.counter, "N")),
            peak_N=float(force.peak),
        ),
        moment=MomentOrder(
            co_rotating=MomentPhasor(**_phasor(moment.co, "Nm")),
            counter_rotating=MomentPhasor(**_phasor(moment.counter, "Nm")),
            peak_Nm=float(moment.peak),
        ),
    )


def _phasor(value: Complex, unit: str) -> dict[str, float]:
    vector = complex(value)
    return {
        f"real_{unit}": vector.real,
        f"imag_{unit}": vector.imag,
        f"magnitude_{unit}": abs(vector),
        "phase_deg": float(np.rad2deg(np.angle(vector))) if vector else 0.0,
    }
