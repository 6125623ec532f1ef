"""The first-order moment inside the shaft, without and with counterweights."""

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.internal_moment import internal_moment
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.output import Columns, Output
from schemas.answer.outputs import InternalMoment


def _peak(scene: Prepared, unbalance: Complex | None) -> Real:
    """Largest over the shaft and the turn (...), N m."""
    return np.asarray(internal_moment(scene.layout, unbalance) * scene.layout.omega**2)


def _figure(scene: Prepared, unbalance: Complex | None) -> InternalMoment:
    return InternalMoment(
        before_Nm=float(_peak(scene, None)), after_Nm=None if unbalance is None else float(_peak(scene, unbalance))
    )


INTERNAL_MOMENT = Output(
    "internal_moment",
    "largest first-order moment inside the shaft",
    (),
    _figure,
    Columns(lambda scene, unbalance: {"internal_moment_Nm": _peak(scene, unbalance)}),
)
