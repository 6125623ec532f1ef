"""Main bearings in detail: specific loads, root mean squares, and what no counterweights can get below."""

from collections.abc import Iterator

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.shaft_curves import ShaftCurves, shaft_curves
from optimizer.mechanics.whole_turn import TurnCurves
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.output import Columns
from optimizer.outputs.peaks import FLOOR_TOLERANCE, of_shaft, separate_groups
from optimizer.responses.curve import floors
from schemas.answer.outputs import labels
from schemas.machine.drive import Bearing


def _specific(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    """Peaks over the area of the bearings that say how large they are."""
    sized = {k: area for k, bearing in enumerate(_bearings(scene)) if (area := _area(bearing)) is not None}
    peak = of_shaft(scene, _bearing_curves(scene), unbalance).lower
    return _named(scene, "specific_load_Pa", {k: peak[..., k] / area for k, area in sized.items()})


def _root_mean_square(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    result = _bearing_curves(scene)
    offset = result.offsets(unbalance).reshape(result.webs.shape[:-1])
    mean, variance = (
        np.array(each) for each in zip(*((one.mean, one.variance) for one in _alone(result)), strict=True)
    )
    rms = np.sqrt(variance + np.abs(mean + offset) ** 2) * scene.layout.omega[..., None] ** 2
    return _named(scene, "bearing_rms_N", dict(enumerate(np.moveaxis(rms, -1, 0))))


def _floors(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    """Smallest circles around the loads, and what the largest of all bending moments comes to at least."""
    count, square = len(_bearings(scene)), scene.layout.omega[..., None] ** 2
    result = scene.shaft_curves
    group = separate_groups(count, result.webs.shape[-2] - count)
    circles = [[each.circle for each in floors(one, FLOOR_TOLERANCE, None, group)] for one in _alone(result)]
    radius = np.array([[circle.radius for circle in one] for one in circles]) * square
    fixed = np.array([[circle.centre for circle in one[:count]] for one in circles])
    centre = (fixed + result.offsets(unbalance).reshape(result.webs.shape[:-1])[..., :count]) * square
    return {
        "bending_floor_Nm": np.max(radius[..., count:], axis=-1),
        **_named(scene, "bearing_floor_N", {k: radius[..., k] for k in range(count)}),
        **_named(scene, "bearing_circle_x_N", {k: centre[..., k].real for k in range(count)}),
        **_named(scene, "bearing_circle_y_N", {k: centre[..., k].imag for k in range(count)}),
    }


def _bearing_curves(scene: Prepared) -> ShaftCurves:
    return shaft_curves(scene.results["whole_turn"], scene.layout, scene.bearing_influence)


def _alone(shaft: ShaftCurves) -> Iterator[TurnCurves]:
    """The curves of each design by itself: parts of a quadrature and steps of a search are its own."""
    return (shaft.curves.of_design(k) for k in range(len(shaft.curves.weights)))


def _named(scene: Prepared, name: str, by_bearing: dict[int, Real]) -> dict[str, Real]:
    names = labels([bearing.name for bearing in _bearings(scene)])
    return {f"{name}.{names[k]}": values for k, values in by_bearing.items()}


def _area(bearing: Bearing) -> Real | None:
    if bearing.diameter_m is None or bearing.length_m is None:
        return None
    return np.asarray(bearing.diameter_m) * np.asarray(bearing.length_m)


def _bearings(scene: Prepared) -> tuple[Bearing, ...]:
    return scene.machine.bearings


BEARINGS = (
    Columns(_specific, needs=("whole_turn",), keys=("specific_load_Pa.",)),
    Columns(_root_mean_square, needs=("whole_turn",), keys=("bearing_rms_N.",), alone=True),
    Columns(
        _floors,
        needs=("whole_turn",),
        keys=("bending_floor_Nm", "bearing_floor_N.", "bearing_circle_x_N.", "bearing_circle_y_N."),
        alone=True,
    ),
)
