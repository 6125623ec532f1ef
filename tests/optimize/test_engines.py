"""Counterweights of engines with indicated pressures, optimal over both turns of their cycle."""

import json
from typing import Any

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.numerics.arrays import Complex
from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.documents.examples import load

ALONE = {"force_weight": 0, "moment_weight": 0, "bearing_weight": 1}


def machine(**changes: Any) -> dict[str, Any]:
    design: dict[str, Any] = json.loads(load("inline-four-engine"))["machine"]
    return design | changes


def best(fields: dict[str, Any], **objective: Any) -> OptimizeAnswer:
    return optimize(OptimizeRequest.model_validate({"machine": fields, "objective": ALONE | objective}))


def sampled(fields: dict[str, Any], optimum: OptimizeAnswer, step_deg: float) -> Complex:
    """Loads of the main bearings (bearings, T) with the counterweights of an answer."""
    fitted = [
        {"web": counterweight.web, "mass_kg": counterweight.mass_kg, "angle_deg": counterweight.angle_deg}
        for counterweight in optimum.counterweights
    ]
    body = {"machine": fields, "outputs": ["main_bearings"], "counterweights": fitted, "angles": {"step_deg": step_deg}}
    answer = analyze(AnalyzeRequest.model_validate(body)).main_bearings
    assert answer is not None
    loads = [bearing.after for bearing in answer.bearings]
    return np.array([np.array(load.force_x_N) + 1j * np.array(load.force_y_N) for load in loads if load])


def test_bearings_of_an_in_line_four_reach_the_largest_floor() -> None:
    answer = best(machine())
    assert answer.status == "optimal"
    assert answer.main_bearings is not None
    assert answer.certificate is not None
    assert answer.certificate.lower_bound is not None
    floors = [bearing.before.floor_N for bearing in answer.main_bearings.bearings]
    # analytic: counterweights at every bearing and no limit that binds, so the optimum is the largest floor
    assert answer.certificate.objective == pytest.approx(max(floors), rel=2e-6)
    assert answer.certificate.lower_bound <= max(floors) * (1.0 + 1e-7)
    # independent: brute force over both turns
    loads = np.abs(sampled(machine(), answer, 0.5))
    assert loads.shape == (5, 1440)
    assert np.max(loads) <= answer.certificate.objective * (1.0 + 1e-9)
    assert np.max(loads) == pytest.approx(answer.certificate.objective, rel=1e-2)


def test_root_mean_squares_are_those_of_both_turns() -> None:
    design = machine(friction=None)
    answer = best(design, bearing_measure="rms")
    assert answer.certificate is not None
    # independent: means of samples
    rms = np.sqrt(np.mean(np.abs(sampled(design, answer, 0.5)) ** 2, axis=-1))
    assert np.max(rms) == pytest.approx(answer.certificate.objective, rel=1e-4)


def test_a_cut_may_stand_in_the_second_turn() -> None:
    """The cylinder whose bearing is loaded most fires a turn later, and so does the cut that proves it."""
    design = machine()
    # one cylinder alone fires harder than the others
    pressure = design["throws"][1]["rows"][0]["cylinder"]["pressure"]
    pressure["head"]["pressure_Pa"] = [1.5 * pressure_Pa for pressure_Pa in pressure["head"]["pressure_Pa"]]
    angles, objectives = [], []
    for later in (0.0, 360.0):
        for row in (throw["rows"][0] for throw in design["throws"]):
            actual_pressure = row["cylinder"]["pressure"]
            actual_pressure["dead_centre_deg"] = (actual_pressure["dead_centre_deg"] + later) % 720.0
        answer = best(design)
        assert answer.certificate is not None
        assert answer.certificate.multipliers is not None
        assert answer.certificate.multipliers.objective is not None
        terms = answer.certificate.multipliers.objective.terms
        angles += [term.angle_deg for term in terms if term.angle_deg is not None]
        objectives.append(answer.certificate.objective)
    # analytic: a turn later all is the same but for the turn
    assert objectives[1] == pytest.approx(objectives[0], rel=3e-6)
    assert any(angle < 360.0 for angle in angles)
    assert any(angle > 360.0 for angle in angles)
