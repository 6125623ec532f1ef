"""The roll moment on the frame, without and with balance shafts."""

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.roll import roll as roll_response
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.peaks import TOLERANCE, bracket, of_torque
from optimizer.responses.curve import TurnResponse, peaks
from schemas.answer.roll import Roll, RollMoment


def _figure(scene: Prepared, unbalance: Complex | None) -> Roll:
    response = roll_response(scene.results["whole_turn"], scene.layout)
    nothing = np.zeros(response.influence.shape, complex)
    after = None
    if unbalance is not None:
        fitted = nothing if scene.shafts is None else np.concatenate([unbalance, scene.shafts])
        after = _moment(scene, response, fitted)
    return Roll(angle_deg=scene.angles, before=_moment(scene, response, nothing), after=after)


def _moment(scene: Prepared, response: TurnResponse, unbalance: Complex) -> RollMoment:
    """With unbalances (K + S,) kg m on all shafts."""
    angle, square = np.deg2rad(scene.angle_deg), scene.omega_squared
    found = peaks([response], unbalance, TOLERANCE)
    moment: Real = np.real(response.at(angle) + response.added(unbalance, angle)) * square
    return RollMoment(
        moment_Nm=tuple(moment.tolist()),
        peak_Nm=float(found.lower[0]) * square,
        peak_bracket_Nm=bracket(found._replace(lower=found.lower * square, upper=found.upper * square), 0),
        peak_angle_deg=float(np.mod(np.rad2deg(found.angle[0]), response.period_deg)),
    )


def _columns(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    # friction of the shaft does not reach the frame
    mean = np.sum(scene.results["torque_integrals"].row_mean, axis=-1)
    return {"peak_roll_Nm": of_torque(scene, -mean).lower}


ROLL = Output(
    "roll",
    "roll moment on the frame, before and after",
    ("whole_turn",),
    _figure,
    Columns(_columns, needs=("torque_integrals", "whole_turn")),
)
