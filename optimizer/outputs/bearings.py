"""Main-bearing loads without and with counterweights, and the bending moment inside the shaft."""

from collections.abc import Iterator, Sequence

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.angles import turned
from optimizer.mechanics.shaft_curves import ShaftCurves
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
    planes = scene.stations
    curves = scene.shaft_curves
    count = len(machine.bearings)
    # every bearing's, and the largest of all bending moments
    circles = [
        floor.circle for floor in floors(curves.curves, FLOOR_TOLERANCE, None, separate_groups(count, planes.size))
    ]
    sets = _sets(unbalance)
    peaks = of_shaft_sets(scene, curves, sets)
    loads, *fitted = _loads(scene, curves.first(count), peaks, circles, sets)
    before, *others = peaks
    after = others[0] if others else None
    shown = peaks[-1]
    worst = int(np.argmax(shown.lower[count:]))
    return MainBearings(
        angle_deg=scene.angles,
        shaft=scene.request.fidelity.shaft,
        bearings=tuple(
            MainBearing(
                name=bearing.name,
                position_m=bearing.position_m,
                before=loads[k],
                after=fitted[0][k] if fitted else None,
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
    peaks: Sequence[Bracket],
    circles: Sequence[Circle],
    sets: Sequence[Complex | None],
) -> list[tuple[BearingLoad, ...]]:
    """Loads of the bearings of one machine, by their curves and peaks, with sets of counterweights (webs,) kg m or
    without."""
    bearings, square, turn = scene.machine.bearings, scene.omega_squared, np.deg2rad(scene.angle_deg)
    offset = np.array([curves.offsets(unbalance) for unbalance in sets])
    samples = _samples(scene) + offset[..., None] * turned(scene.layout.sense, turn) * square
    centre = (np.array([circle.centre for circle in circles[: len(bearings)]]) + offset) * square
    rms = np.sqrt(curves.curves.variance + np.abs(curves.curves.mean + offset) ** 2) * square
    figures = samples.real.tolist(), samples.imag.tolist(), rms.tolist(), centre.tolist()
    return [_of_set(bearings, circles, square, peak, *own) for peak, *own in zip(peaks, *figures, strict=True)]


def _of_set(
    bearings: Sequence[Bearing],
    circles: Sequence[Circle],
    square: float,
    peak: Bracket,
    along_x: Sequence[Sequence[float]],
    along_y: Sequence[Sequence[float]],
    rms: Sequence[float],
    centre: Sequence[complex],
) -> tuple[BearingLoad, ...]:
    """Loads of the bearings with one set of counterweights, from what is known of all sets."""
    angles = np.rad2deg(peak.angle[: len(bearings)]).tolist()
    return tuple(
        BearingLoad(
            force_x_N=x,
            force_y_N=y,
            peak_N=float(peak.lower[k]),
            peak_bracket_N=bracket(peak, k),
            peak_angle_deg=angle,
            specific_load_Pa=_over_area(float(peak.lower[k]), bearings[k]),
            rms_N=of_rms,
            floor_N=float(circles[k].radius * square),
            circle_x_N=middle.real,
            circle_y_N=middle.imag,
        )
        for k, (x, y, angle, of_rms, middle) in enumerate(zip(along_x, along_y, angles, rms, centre, strict=True))
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
