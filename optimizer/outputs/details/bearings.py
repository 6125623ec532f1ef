"""Main bearings in detail: specific loads, root mean squares, and what no counterweights can get below."""

from collections.abc import Iterator

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.shaft_curves import ShaftCurves, shaft_curves
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.numerics.arrays import Complex, Real, variant
from optimizer.outputs.output import Columns
from optimizer.outputs.peaks import FLOOR_TOLERANCE, of_shaft, separate_groups
from optimizer.responses.curve import floors
from optimizer.responses.piecewise_cubics import Index
from schemas.answer.outputs import labels
from schemas.machine.drive import Bearing

#: designs whose curves are looked at in one block, which bounds the memory
_AT_ONCE = 16


def _specific(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    """Peaks over the area of the bearings that say how large they are."""
    sized = {k: area for k, bearing in enumerate(_bearings(scene)) if (area := _area(bearing)) is not None}
    peak = of_shaft(scene, _bearing_curves(scene, scene.results["whole_turn"]), unbalance).lower
    return _bearing_columns(scene, "specific_load_Pa", {k: peak[..., k] / area for k, area in sized.items()})


def _root_mean_square(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    # what bounds quadratures bounds the pieces too
    result = _bearing_curves(scene, variant(scene.results["whole_turn"], squared=True))
    of_blocks = (result.curves.of_designs(block) for block in _blocks(result))
    mean, variance = (
        np.concatenate(values) for values in zip(*((curves.mean, curves.variance) for curves in of_blocks), strict=True)
    )
    rms = np.sqrt(variance + np.abs(mean + result.offsets(unbalance)) ** 2).reshape(result.webs.shape[:-1])
    square = scene.layout.omega[..., None] ** 2
    return _bearing_columns(scene, "bearing_rms_N", dict(enumerate(np.moveaxis(rms * square, -1, 0))))


def _floors(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    """Smallest circles around the loads, and what the largest of all bending moments comes to at least."""
    count, square = len(_bearings(scene)), scene.layout.omega[..., None] ** 2
    result = scene.shaft_curves
    shape = result.webs.shape[:-1]
    group = separate_groups(count, shape[-1] - count)
    centre, radius = np.empty(shape, complex), np.empty(shape)
    for designs in _alike(result):
        number = designs[:, None] * group.size + np.arange(group.size)
        together = np.arange(len(designs))[:, None] * (count + 1) + group
        circles = floors(result.curves, FLOOR_TOLERANCE, number.reshape(-1), together.reshape(-1))
        centre[designs], radius[designs] = circles.centre.reshape(number.shape), circles.radius.reshape(number.shape)
    radius *= square
    centre = (centre + result.offsets(unbalance).reshape(shape))[..., :count] * square
    return {
        "bending_floor_Nm": np.max(radius[..., count:], axis=-1),
        **_bearing_columns(scene, "bearing_floor_N", {k: radius[..., k] for k in range(count)}),
        **_bearing_columns(scene, "bearing_circle_x_N", {k: centre[..., k].real for k in range(count)}),
        **_bearing_columns(scene, "bearing_circle_y_N", {k: centre[..., k].imag for k in range(count)}),
    }


def _bearing_curves(scene: Prepared, turn: WholeTurn) -> ShaftCurves:
    return shaft_curves(turn, scene.layout, scene.bearing_influence)


def _blocks(shaft: ShaftCurves) -> Iterator[slice]:
    """Designs that are worked on together."""
    designs = len(shaft.curves.weights)
    return (slice(first, first + _AT_ONCE) for first in range(0, designs, _AT_ONCE))


def _alike(shaft: ShaftCurves) -> Iterator[Index]:
    """The same, of designs in which the same pieces of the turn have a width."""
    _, kind = np.unique(shaft.curves.whole.half > 0.0, axis=0, return_inverse=True)
    for number in range(int(np.max(kind)) + 1):
        designs = np.flatnonzero(kind == number)
        yield from (designs[block] for block in _blocks(shaft) if designs[block].size)


def _bearing_columns(scene: Prepared, name: str, by_bearing: dict[int, Real]) -> dict[str, Real]:
    names = labels([bearing.name for bearing in _bearings(scene)])
    return {f"{name}.{names[k]}": values for k, values in by_bearing.items()}


def _area(bearing: Bearing) -> Real | None:
    if bearing.diameter_m is None or bearing.length_m is None:
        return None
    return np.asarray(bearing.diameter_m) * np.asarray(bearing.length_m)


def _bearings(scene: Prepared) -> tuple[Bearing, ...]:
    return scene.machine.bearings


BEARINGS = (
    Columns(_specific, needs=("whole_turn",), keys=("specific_load_Pa.",), readings=("on_shaft",)),
    Columns(_root_mean_square, needs=("whole_turn",), keys=("bearing_rms_N.",), alone=True),
    Columns(
        _floors,
        needs=("whole_turn",),
        keys=("bending_floor_Nm", "bearing_floor_N.", "bearing_circle_x_N.", "bearing_circle_y_N."),
        alone=True,
    ),
)
