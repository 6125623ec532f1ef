"""What an answer says of counterweights that are all a little off."""

import itertools
from typing import Any

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from tests.optimize.machines import machine, random_machine, throw, web
from tests.optimize.whole_turn import ALONE, inline_six, request_of

ONE_DEGREE = np.deg2rad(1.0)


def answered(fields: dict[str, Any], **objective: Any) -> OptimizeAnswer:
    return optimize(OptimizeRequest.model_validate({"machine": fields, "objective": objective}))


def test_a_counterweight_opposite_its_crank() -> None:
    # analytic: 20 kg at 0.1 m and 10 rad/s are 200 N, balanced; off by a degree 2 sin(1/2 deg) of it remains
    design = machine([throw(0.0, 30.0, [], rotating=20.0)], [web("a", 0.0)], speed_rpm="10 rad/s")
    answer = answered(design, moment_weight=0.0)
    assert answer.sensitivity is not None
    # optima may differ by 1e-6 of 200 N
    assert answer.sensitivity.objective_rise_per_deg == pytest.approx(400.0 * np.sin(0.5 * ONE_DEGREE), abs=4e-4)
    assert answer.sensitivity.objective_rise_per_percent == pytest.approx(2.0, abs=4e-4)
    assert "fragile_optimum" not in [warning.code for warning in answer.warnings]


def test_large_counterweights_that_balance_one_another_are_fragile() -> None:
    # analytic: 1 kg m in the plane 1 is balanced by -101 kg m at 0.01 and 100 kg m at 0, each known to one per cent
    design = machine(
        [throw(1.0, 0.0, [], rotating=10.0)], [web("a", 0.0, 1e4), web("b", 0.01, 1e4)], speed_rpm="10 rad/s"
    )
    answer = answered(
        design | {"reference_plane_m": 1.0}, moment_weight=0.0, force_ceiling_N=1.0, moment_ceiling_Nm=1.0
    )
    assert answer.status == "optimal"
    assert answer.sensitivity is not None
    assert answer.sensitivity.objective_rise_per_percent == pytest.approx(201.0, rel=0.03)
    (warning,) = [caution for caution in answer.warnings if caution.code == "fragile_optimum"]
    assert "One degree" in warning.message


def test_a_bearing_that_carries_counterweights_alone() -> None:
    """Analytic: a bearing with one counterweight and nothing else has its load wherever that is turned to."""
    design = machine([throw(0.0, 30.0, [], rotating=20.0)], [web("a", 1.0)], speed_rpm="10 rad/s")
    bearings = [
        {"name": name, "position_m": at, "diameter_m": size, "length_m": size}
        for name, at, size in (("of the crank", 0.0, 1.0), ("of the counterweight", 1.0, 0.1))
    ]
    objective = {"force_weight": 0.0, "moment_weight": 0.0, "bearing_weight": 1.0, "bearing_measure": "specific"}
    answer = answered(design | {"bearings": bearings}, **objective, force_ceiling_N=50.0)
    # the crank has 200 N, of which the counterweight has to take 150, on 0.01 m2
    assert answer.certificate is not None
    assert answer.certificate.objective == pytest.approx(15_000.0)
    assert answer.sensitivity is not None
    assert answer.sensitivity.objective_rise_per_deg == pytest.approx(0.0, abs=1e-4)
    assert answer.sensitivity.objective_rise_per_percent == pytest.approx(150.0)


def test_without_counterweights_nothing_is_off() -> None:
    answer = answered(machine([throw(0.0, 30.0, [], rotating=20.0)], []))
    assert answer.sensitivity is not None
    assert (answer.sensitivity.objective_rise_per_deg, answer.sensitivity.objective_rise_per_percent) == (0.0, 0.0)


def test_an_infeasible_answer_has_no_sensitivity() -> None:
    answer = answered(machine([throw(0.0, 30.0, [], rotating=20.0)], []), force_ceiling_N=1.0)
    assert (answer.status, answer.sensitivity) == ("infeasible", None)


@pytest.mark.parametrize("deg", [0.0, 1.0])
@pytest.mark.parametrize("seed", range(6))
def test_no_errors_cost_more_of_the_larger_peak_and_some_cost_as_much(seed: int, deg: float) -> None:
    """Independent: every corner of the errors, analysed as a machine of its own; of angles corners come close."""
    design = random_machine(seed)
    objective = {"combine": "max", "force_weight": 1.0, "moment_weight": 0.7, "least_mass": False}
    answer = answered(design, **objective)
    assert answer.certificate is not None
    assert answer.sensitivity is not None
    rise = answer.sensitivity.objective_rise_per_deg if deg else answer.sensitivity.objective_rise_per_percent
    peaks_N = []
    for signs in itertools.product([-1.0, 1.0], repeat=len(answer.counterweights)):
        fitted = [
            {
                "web": counterweight.web,
                "mass_kg": counterweight.mass_kg * (1.0 if deg else 1.0 + 0.01 * sign),
                "angle_deg": counterweight.angle_deg + deg * sign,
            }
            for counterweight, sign in zip(answer.counterweights, signs, strict=True)
        ]
        off = analyze(AnalyzeRequest.model_validate({"machine": design, "counterweights": fitted})).residual
        assert off is not None
        assert off.after is not None
        peaks_N.append(max(off.after.force.peak_N, 0.7 * off.after.moment.peak_Nm))
    worst = max(peaks_N) - answer.certificate.objective
    scale = answer.certificate.objective
    assert worst <= rise + 1e-9 * scale
    assert rise == pytest.approx(worst, abs=1e-9 * scale, rel=0.02 if deg else 0.0)


def test_loads_over_the_turn_may_rise_by_no_more() -> None:
    """Independent: the peaks of the answer's own bearings, with random errors, by the analysis."""
    request = request_of(inline_six(), **ALONE, bearing_weight=1, least_mass=False)
    answer, rng = optimize(request), np.random.default_rng(0)
    assert answer.certificate is not None
    assert answer.sensitivity is not None
    body = request.model_dump(include={"machine", "angles", "fidelity"}) | {"outputs": ["main_bearings"]}
    for deg, share, rise in (
        (1.0, 0.0, answer.sensitivity.objective_rise_per_deg),
        (0.0, 0.01, answer.sensitivity.objective_rise_per_percent),
    ):
        peaks_N = []
        for _ in range(8):
            signs = rng.choice([-1.0, 1.0], len(answer.counterweights))
            fitted = [
                {
                    "web": counterweight.web,
                    "mass_kg": counterweight.mass_kg * (1 + share * sign),
                    "angle_deg": counterweight.angle_deg + deg * sign,
                }
                for counterweight, sign in zip(answer.counterweights, signs.tolist(), strict=True)
            ]
            main_bearings = analyze(AnalyzeRequest.model_validate(body | {"counterweights": fitted})).main_bearings
            assert main_bearings is not None
            peaks_N.append(max(bearing.after.peak_N for bearing in main_bearings.bearings))
        assert max(peaks_N) <= answer.certificate.objective + rise * (1 + 1e-9)
        assert max(peaks_N) >= answer.certificate.objective + 0.3 * rise
