"""The roll moment on the frame, without and with balance shafts."""

from collections.abc import Iterator

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.roll import rolls
from optimizer.mechanics.whole_turn import TurnCurves
from optimizer.numerics.arrays import Complex, Real, side_by_side
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.peaks import TOLERANCE, Search, of_torque, peak_list, unsigned
from optimizer.responses.curve import peaks
from optimizer.responses.peak_table import PeakList
from optimizer.responses.piecewise_cubics import Bracket
from schemas.answer.roll import Roll, RollMoment

#: names of the peaks without and with balance shafts
_BARE, _FITTED = ("roll",), ("roll", "shafts")


def _figure(scene: Prepared, unbalance: Complex | None) -> Roll:
    angle, square = scene.angle_rad, scene.omega_squared
    bare = _samples(scene)
    before = after = _moment(scene, bare, peak_list(scene, _BARE, lambda: _bare(scene)))
    fitted = None if unbalance is None or scene.shafts is None else np.concatenate([unbalance, scene.shafts])
    if fitted is not None:
        # what turns with the crankshaft has no lever: of all counterweights only those of balance shafts count
        moment = bare + np.asarray(scene.roll.contribution(fitted, angle)).real * square
        at, value, lower, upper = peaks([scene.roll], fitted, TOLERANCE)
        scene.peaks.add({_FITTED: slice(None)}, Bracket(at, value, lower * square, upper * square))
        after = _moment(scene, moment, scene.peaks.plain(_FITTED))
    return Roll(angle_deg=scene.angles, before=before, after=None if unbalance is None else after)


def _samples(scene: Prepared) -> Real:
    """The moment without balance shafts (T,) N m: the torque of the rows, sampled already, without its mean."""
    whole: Real = scene.layout.sense * np.add.reduce(scene.results["torque"].rows, axis=-2)
    return whole + np.real(_curves(scene).constant).reshape(()) * scene.omega_squared


def _moment(scene: Prepared, samples: Real, peak: PeakList) -> RollMoment:
    return RollMoment(
        moment_Nm=samples,
        peak_Nm=peak.lower[0],
        peak_bracket_Nm=peak.bracket(),
        peak_angle_deg=peak.angle_deg[0] % scene.roll.period_deg,
    )


def _searches(scene: Prepared, _unbalance: Complex | None) -> Iterator[Search]:
    yield _bare(scene)


def _bare(scene: Prepared) -> Search:
    """The moment without balance shafts."""
    return Search(_BARE, _curves(scene), np.zeros(1, np.intp), unsigned(1), unsigned(1), scale=scene.omega_squared)


def _curves(scene: Prepared) -> TurnCurves:
    curves = scene.roll.curves
    assert isinstance(curves, TurnCurves)  # of the rows
    return curves


def _columns(scene: Prepared, fitted: Complex) -> dict[str, Real]:
    if scene.shafts is None:
        # friction of the shaft does not reach the frame
        mean = np.sum(scene.results["torque_integrals"].row_mean, axis=-1)
        return {"peak_roll_Nm": of_torque(scene, -mean)}
    designs = rolls(scene.results["whole_turn"], scene.layout)
    with_shafts = side_by_side(fitted, scene.shafts)
    peak: list[float] = [
        np.nan if np.isnan(own).any() else peaks([design], own, TOLERANCE).lower[0]
        for design, own in zip(designs, with_shafts, strict=True)
    ]
    return {"peak_roll_Nm": np.array(peak) * scene.layout.omega**2}


ROLL = Output(
    "roll",
    "roll moment on the frame, before and after",
    ("whole_turn", "torque"),
    _figure,
    Columns(_columns, needs=("torque_integrals", "whole_turn"), readings=("tangential",)),
    _searches,
)
