"""Many designs of one shape as they stand, as columns."""

from typing import Any

import numpy as np

from optimizer.arrays import Complex
from optimizer.figures.counterweights import unbalance
from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.layout import layout as layout_of
from optimizer.mechanics.layout import stacked
from optimizer.sweep.optimized import first_order_peaks
from schemas.requests import AnalyzeRequest


def analyzed(request: AnalyzeRequest, count: int) -> tuple[dict[str, Any], Complex]:
    """Residual peaks and total mass, and the unbalance of the counterweights (count, webs) kg m."""
    layout = layout_of(request.machine)
    given = {counterweight.web: counterweight for counterweight in request.counterweights}
    fitted = [given.get(web.name) for web in request.machine.webs]
    mass = np.broadcast_to(stacked([one.mass_kg if one else 0.0 for one in fitted]), (count, len(fitted)))
    angle = np.mod(stacked([one.angle_deg if one else 0.0 for one in fitted]), 360.0)
    u = unbalance(mass, angle, layout.webs.radius)
    columns: dict[str, Any] = {
        "status": np.full(count, "analyzed"),
        "message": np.full(count, ""),
        "total_mass_kg": np.sum(mass, axis=-1),
    }
    if "residual" in request.outputs:
        columns |= first_order_peaks(layout, rotating(layout).plus(reciprocating(layout, 1)), u)
    return columns, u
