"""First-order force and moment in detail."""

import numpy as np

from optimizer.effects.inertia import FIRST_ORDER_EFFECTS
from optimizer.formulation.simulation import Prepared
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.output import Columns
from schemas.sweep.details import keys_of


def _columns(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    wrench = scene.first_order(unbalance)
    results: dict[str, Real] = {}
    for quantity, unit, pair in (("force", "N", wrench.force), ("moment", "Nm", wrench.moment)):
        results |= {
            f"{quantity}_minor_{unit}": pair.minor,
            f"{quantity}_peak_x_{unit}": pair.peak_along(np.asarray(1.0 + 0j)),
            f"{quantity}_peak_y_{unit}": pair.peak_along(np.asarray(1j)),
            f"{quantity}_co_rotating_{unit}": np.abs(pair.co),
            f"{quantity}_counter_rotating_{unit}": np.abs(pair.counter),
        }
    return results


FIRST_ORDER = (Columns(_columns, needs=FIRST_ORDER_EFFECTS, keys=keys_of("residual")),)
