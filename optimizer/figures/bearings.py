"""Main-bearing loads without and with counterweights, and the bending moment inside the shaft."""

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.figures.dynamics import Samples
from optimizer.mechanics.bearings import bending_moment, continuous_beam, simple_spans
from schemas.dynamics import BearingLoad, BendingMoment, MainBearing, MainBearings
from schemas.machine import ReciprocatingMachine
from schemas.requests import Fidelity


def main_bearings(samples: Samples, fidelity: Fidelity, unbalance: Complex | None) -> MainBearings:
    """Loads of the main bearings of one machine.

    Parameters
    ----------
    unbalance : (K,) kg m, the counterweights; None where there are none to show (infeasible).
    """
    machine, layout = samples.machine, samples.layout
    assert isinstance(machine, ReciprocatingMachine)  # no other has bearings
    places = np.array([bearing.position_m for bearing in machine.bearings])
    planes, loads = samples.results["shaft_loads"]
    spread = simple_spans if fidelity.shaft == "simple_spans" else continuous_beam

    def carried(planes: Real, loads: Complex) -> tuple[Complex, Real]:
        reactions = spread(places, planes, loads)
        moments = bending_moment(places, reactions, planes, loads, stations)
        return reactions, np.max(np.abs(moments), axis=-1)

    everything = np.concatenate([planes, layout.webs.position])
    stations = np.unique(np.concatenate([places, everything]))
    before, bent_before = carried(planes, loads)
    after, bent_after = None, None
    if unbalance is not None:
        turn = np.exp(1j * layout.sense * np.deg2rad(samples.angle_deg))
        iron = (unbalance * layout.omega**2)[:, None] * turn
        after, bent_after = carried(everything, np.concatenate([loads, iron]))
    return MainBearings(
        angle_deg=samples.angles,
        shaft=fidelity.shaft,
        bearings=tuple(
            MainBearing(
                name=bearing.name,
                position_m=bearing.position_m,
                before=_load(before[k], samples.angle_deg),
                after=None if after is None else _load(after[k], samples.angle_deg),
            )
            for k, bearing in enumerate(machine.bearings)
        ),
        bending=BendingMoment(
            position_m=tuple(stations.tolist()),
            before_Nm=tuple(bent_before.tolist()),
            after_Nm=None if bent_after is None else tuple(bent_after.tolist()),
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
