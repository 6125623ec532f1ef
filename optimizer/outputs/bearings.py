"""Main-bearing loads without and with counterweights, and the bending moment inside the shaft."""

from collections.abc import Iterator, Sequence

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.angles import turned
from optimizer.mechanics.shaft import bearing_places
from optimizer.mechanics.shaft_curves import ShaftCurves, stations
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.enclosing_circle import Circle
from optimizer.outputs.balance_rate import cranks
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.peaks import (
    FLOOR_TOLERANCE,
    Search,
    bracket,
    customary_search,
    of_shaft,
    of_shaft_sets,
    separate_groups,
    shaft_search,
)
from optimizer.responses.curve import floors
from optimizer.responses.piecewise_cubics import Bracket
from schemas.answer.dynamics import BearingLoad, BendingMoment, MainBearing, MainBearings
from schemas.answer.outputs import labels
from schemas.machine.drive import Bearing
from schemas.machine.reciprocating import ReciprocatingMachine


def main_bearings(scene: Prepared, unbalance: Complex | None) -> MainBearings:
    """Loads of the main bearings of one machine, and the bending moments of its shaft."""
    machine = scene.machine
    planes = stations(scene.layout, bearing_places(machine))
    curves = scene.shaft_curves
    count = len(machine.bearings)
    # every bearing's, and the largest of all bending moments
    circles = [
        floor.circle for floor in floors(curves.curves, FLOOR_TOLERANCE, None, separate_groups(count, planes.size))
    ]
    before, *fitted_too = of_shaft_sets(scene, curves, _sets(unbalance))
    after = fitted_too[0] if fitted_too else None
    alone = curves.first(count)
    samples = _samples(scene)
    loads = _loads(scene, alone, samples, before, circles, None)
    fitted = None if after is None else _loads(scene, alone, samples, after, circles, unbalance)
    shown = before if after is None else after
    worst = int(np.argmax(shown.lower[count:]))
    return MainBearings(
        angle_deg=scene.angles,
        shaft=scene.request.fidelity.shaft,
        bearings=tuple(
            MainBearing(
                name=bearing.name,
                position_m=bearing.position_m,
                before=loads[k],
                after=None if fitted is None else fitted[k],
            )
            for k, bearing in enumerate(machine.bearings)
        ),
        bending=BendingMoment(
            position_m=tuple(planes.tolist()),
            before_Nm=tuple(before.lower[count:].tolist()),
            after_Nm=None if after is None else tuple(after.lower[count:].tolist()),
            peak_Nm=float(shown.lower[count + worst]),
            peak_bracket_Nm=(float(shown.lower[count + worst]), float(np.max(shown.upper[count:]))),
            peak_position_m=float(planes[worst]),
            floor_Nm=max(circle.radius for circle in circles[count:]) * scene.omega_squared,
        ),
    )


def _sets(unbalance: Complex | None) -> list[Complex | None]:
    """Without counterweights, and with them where there are any to show."""
    return [None] if unbalance is None else [None, unbalance]


def _searches(scene: Prepared, unbalance: Complex | None) -> Iterator[Search]:
    yield shaft_search(scene.shaft_curves, _sets(unbalance))
    machine = scene.machine
    if unbalance is not None and isinstance(machine, ReciprocatingMachine) and machine.webs:
        # a warning compares with them
        yield customary_search(scene, cranks(machine).customary)


def _samples(scene: Prepared) -> Complex:
    """Loads of the bearings of one machine without counterweights (B, T) N."""
    _, loads = scene.results["shaft_loads"]
    # the webs come last
    samples: Complex = scene.bearing_influence[:, : len(loads)] @ loads
    return samples


def _loads(
    scene: Prepared,
    curves: ShaftCurves,
    bare: Complex,
    peak: Bracket,
    circles: Sequence[Circle],
    unbalance: Complex | None,
) -> tuple[BearingLoad, ...]:
    """Loads of the bearings of one machine, by their curves, without or with counterweights (webs,) kg m.

    Parameters
    ----------
    bare : (B, T) N, without counterweights.
    """
    machine = scene.machine
    bearings = machine.bearings
    square, turn = scene.omega_squared, np.deg2rad(scene.angle_deg)
    offset = curves.offsets(unbalance)
    samples = bare + offset[:, None] * turned(scene.layout.sense, turn) * square
    centre = (np.array([circle.centre for circle in circles[: len(bearings)]]) + offset) * square
    rms = np.sqrt(curves.curves.variance + np.abs(curves.curves.mean + offset) ** 2) * square
    figures = np.rad2deg(peak.angle[: len(bearings)]).tolist(), rms.tolist(), centre.tolist()
    return tuple(
        BearingLoad(
            force_x_N=load.real.tolist(),
            force_y_N=load.imag.tolist(),
            peak_N=float(peak.lower[k]),
            peak_bracket_N=bracket(peak, k),
            peak_angle_deg=angle,
            specific_load_Pa=_over_area(float(peak.lower[k]), bearings[k]),
            rms_N=of_rms,
            floor_N=float(circles[k].radius * square),
            circle_x_N=middle.real,
            circle_y_N=middle.imag,
        )
        for k, (load, angle, of_rms, middle) in enumerate(zip(samples, *figures, strict=True))
    )


def _over_area(load: float, bearing: Bearing) -> float | None:
    """Specific load, Pa; None where the machine does not say how large the bearing is."""
    if bearing.diameter_m is None or bearing.length_m is None:
        return None
    return load / (bearing.diameter_m * bearing.length_m)


def _columns(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    machine = scene.machine
    curves = scene.shaft_curves
    # the largest bending moment alone; the bearings one by one
    count = len(machine.bearings)
    peak = of_shaft(scene, curves, unbalance, separate_groups(count, curves.webs.shape[-2] - count)).lower
    names = labels([bearing.name for bearing in machine.bearings])
    return {
        "peak_bearing_load_N": np.max(peak[..., :count], axis=-1),
        "peak_bending_Nm": peak[..., count],
        **{f"bearing_peak_N.{name}": peak[..., k] for k, name in enumerate(names)},
    }


MAIN_BEARINGS = Output(
    "main_bearings",
    "main-bearing loads and bending of the shaft",
    ("shaft_loads", "whole_turn"),
    main_bearings,
    Columns(_columns, needs=("whole_turn",)),
    _searches,
)
