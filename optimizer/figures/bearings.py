"""Main-bearing loads without and with counterweights, and the bending moment inside the shaft."""

from typing import NamedTuple

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.figures.output import Columns, Output, largest
from optimizer.mechanics.angles import turned
from optimizer.mechanics.bearings import bending_moment, continuous_beam, simple_spans
from optimizer.mechanics.layout import stacked
from optimizer.scene import Prepared
from schemas.dynamics import BearingLoad, BendingMoment, MainBearing, MainBearings
from schemas.machine import ReciprocatingMachine


class _Carried(NamedTuple):
    """What the shaft carries to its bearings."""

    places: Real  # (..., B) m
    planes: Real  # (..., L) m
    loads: Complex  # (..., L, T) N
    reactions: Complex  # (..., B, T) N

    def bent(self, stations: Real) -> Real:
        """Largest bending moment over the turn at stations (..., S) m: (..., S) N m."""
        return largest(bending_moment(self.places, self.reactions, self.planes, self.loads, stations), 1)


def _carried(scene: Prepared, unbalance: Complex | None) -> _Carried:
    """Bearing loads of rows, rotating masses and counterweights (..., webs) kg m, if given."""
    machine, layout = scene.machine, scene.layout
    assert isinstance(machine, ReciprocatingMachine)  # no other has bearings
    planes, loads = scene.results["shaft_loads"]
    if unbalance is not None:
        turn = turned(layout.sense, np.deg2rad(scene.angle_deg))
        iron = (unbalance * layout.omega[..., None] ** 2)[..., None] * turn[..., None, :]
        planes, loads = np.concatenate([planes, layout.webs.position], axis=-1), np.concatenate([loads, iron], axis=-2)
    model = simple_spans if scene.request.fidelity.shaft == "simple_spans" else continuous_beam
    places = stacked([bearing.position_m for bearing in machine.bearings])
    return _Carried(places, planes, loads, model(places, planes, loads))


def main_bearings(scene: Prepared, unbalance: Complex | None) -> MainBearings:
    """Loads of the main bearings of one machine, and the bending moments of its shaft."""
    machine = scene.machine
    assert isinstance(machine, ReciprocatingMachine)  # no other has bearings
    before, after = _carried(scene, None), None if unbalance is None else _carried(scene, unbalance)
    stations = np.unique(np.concatenate([before.places, before.planes, scene.layout.webs.position]))
    return MainBearings(
        angle_deg=scene.angles,
        shaft=scene.request.fidelity.shaft,
        bearings=tuple(
            MainBearing(
                name=bearing.name,
                position_m=bearing.position_m,
                before=_load(before.reactions[k], scene.angle_deg),
                after=None if after is None else _load(after.reactions[k], scene.angle_deg),
            )
            for k, bearing in enumerate(machine.bearings)
        ),
        bending=BendingMoment(
            position_m=tuple(stations.tolist()),
            before_Nm=tuple(before.bent(stations).tolist()),
            after_Nm=None if after is None else tuple(after.bent(stations).tolist()),
        ),
    )


def _load(force: Complex, angle_deg: Real) -> BearingLoad:
    worst = int(np.argmax(np.abs(force)))
    return BearingLoad(
        force_x_N=tuple(force.real.tolist()),
        force_y_N=tuple(force.imag.tolist()),
        peak_N=float(np.abs(force[worst])),
        peak_angle_deg=float(angle_deg[worst]),
    )


def _columns(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    return {"peak_bearing_load_N": largest(_carried(scene, unbalance).reactions)}


MAIN_BEARINGS = Output(
    "main_bearings",
    "main-bearing loads and bending of the shaft",
    ("shaft_loads",),
    main_bearings,
    Columns(_columns, sampled=True),
)
