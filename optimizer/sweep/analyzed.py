"""Many designs of one shape as they stand, as columns."""

from typing import Any

import numpy as np

from optimizer.arrays import Complex
from optimizer.figures.counterweights import as_given, unbalance
from optimizer.mechanics.layout import stacked
from schemas.requests import AnalyzeRequest


def analyzed(request: AnalyzeRequest, count: int) -> tuple[dict[str, Any], Complex]:
    """Total mass, and the unbalance of the counterweights (count, webs) kg m."""
    mass, angle = as_given(request)
    radius = stacked([web.counterweight_radius_m for web in request.machine.webs])
    shape = (count, radius.shape[-1])
    columns: dict[str, Any] = {
        "status": np.full(count, "analyzed"),
        "message": np.full(count, ""),
        "total_mass_kg": np.broadcast_to(np.sum(mass, axis=-1), count),
    }
    return columns, np.broadcast_to(unbalance(mass, angle, radius), shape)
