"""Parts on rows beside balance shafts: known weights on them, or chosen together with the parts."""

import json
from typing import Any

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.optimize import optimize
from schemas.match.answer import MatchAnswer
from schemas.match.request import MatchRequest
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.common.validation import InvalidRequest, check
from tests.night import part
from tests.studies.matching.cases import every, machine, matched, parts
from tests.verification.checking import broken

GOALS: list[dict[str, Any]] = [
    {"moment_weight": 2.0},
    {"moment_weight": 0.5, "combine": "max"},
    {"moment_weight": 1.0, "direction_weights": {"x": 1.0, "y": 0.3}},
]


def geared(ratio: int, most: float = 12.0, webs: tuple[float, ...] = (-0.2, 0.2), **more: Any) -> dict[str, Any]:
    """Three rows, webs on the crankshaft and a shaft with two places."""
    design: dict[str, Any] = machine([0.0, 120.0, 250.0], [90.0, 80.0, 100.0], webs, most)
    places = [
        {"name": f"s{k}", "position_m": z, "counterweight_radius_m": 0.08, "max_mass_kg": most, **more}
        for k, z in enumerate((-0.25, 0.15))
    ]
    design["balance_shafts"] = [{"name": "back", "speed_ratio": ratio, "webs": places}]
    return design


def of_rows(design: dict[str, Any], row_masses: list[float]) -> dict[str, Any]:
    throws = [
        throw | {"rows": [throw["rows"][0] | {"reciprocating_mass_kg": mass}]}
        for throw, mass in zip(design["throws"], row_masses, strict=True)
    ]
    return design | {"throws": throws}


def sound(body: dict[str, Any]) -> MatchAnswer:
    """The answer, no claim of which the independent checker breaks."""
    answer = matched(body)
    assert not broken(body, json.loads(answer.model_dump_json(by_alias=True)))
    return answer


def weighted(first: Any, goal: dict[str, Any]) -> float:
    """The weighted peaks of a first order, with weights along the axes where they are the same."""
    peaks = np.array([first.force.peak_N, goal["moment_weight"] * first.moment.peak_Nm])
    return float(np.max(peaks) if goal.get("combine") == "max" else np.sum(peaks))


@pytest.mark.parametrize("ratio", [-1, 1, 2])
@pytest.mark.parametrize("goal", GOALS[:2])
def test_beside_known_weights_it_is_the_best_of_all(ratio: int, goal: dict[str, Any]) -> None:
    # independent: every assignment, analyzed as a machine of its own
    payload, classes = geared(ratio), parts(5, 3, scatter=0.2)
    weights = [
        {"web": "w0", "mass_kg": 6.0, "angle_deg": 200.0},
        {"web": "s0", "mass_kg": 8.0, "angle_deg": 70.0},
        {"web": "s1", "mass_kg": 3.0, "angle_deg": 290.0},
    ]
    body = {"machine": payload, "parts": classes, "objective": goal, "counterweights": weights}
    answer = sound(body | {"accuracy": {"relative_gap": 1e-9}})
    values = []
    for row_masses in every(classes, 3).tolist():
        alone = analyze(
            AnalyzeRequest.model_validate({"machine": of_rows(payload, row_masses), "counterweights": weights})
        )
        assert alone.residual is not None
        values.append(weighted(alone.residual.after, goal))
    assert answer.status == "optimal"
    assert answer.certificate.objective == pytest.approx(min(values), rel=1e-9)
    assert answer.certificate.objective_as_listed == pytest.approx(values[0], rel=1e-9)
    assert [counterweight.mass_kg for counterweight in answer.balance_shafts[0].counterweights] == [8.0, 3.0]
    assert answer.balance_shafts_mass_kg == 11.0


STOCK = {"catalogue": {"masses_kg": [4.0, 9.0], "angle_step_deg": 60}}


@pytest.mark.parametrize("ratio", part(2, [-1, 1]))
@pytest.mark.parametrize("goal", part(2, GOALS))
@pytest.mark.parametrize(
    ("more", "of_shaft"),
    part(
        2, [({}, {}), (STOCK, {}), ({}, {"min_fitted_mass_kg": 7.0}), (STOCK, {"min_fitted_mass_kg": 7.0})], rows=True
    ),
)
def test_with_chosen_ones_it_is_the_best_of_all(
    ratio: int, goal: dict[str, Any], more: dict[str, Any], of_shaft: dict[str, Any]
) -> None:
    # independent of the search: every assignment, optimised as a machine of its own
    payload, classes = geared(ratio, **of_shaft) | more, parts(7, 3, scatter=0.2)
    body = {"machine": payload, "parts": classes, "objective": goal, "choose_counterweights": True}
    answer = sound(body | {"accuracy": {"relative_gap": 1e-3, "time_limit_s": 20}})
    alone = []
    for row_masses in every(classes, 3).tolist():
        single = {"machine": of_rows(payload, row_masses), "objective": goal, "accuracy": {"relative_gap": 1e-4}}
        proof = optimize(OptimizeRequest.model_validate(single)).certificate
        assert proof is not None
        alone.append((proof.lower_bound or 0.0, proof.objective))
    size = answer.certificate.yardstick
    assert answer.status == "optimal"
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= min(objective for _, objective in alone) + 1e-6 * size
    assert answer.certificate.objective <= min(objective for _, objective in alone) + 1.1e-3 * size
    assert answer.certificate.objective >= min(bound for bound, _ in alone) - 1e-6 * size
    fitted = answer.balance_shafts[0].counterweights
    assert all(
        counterweight.mass_kg == 0 or counterweight.mass_kg >= of_shaft.get("min_fitted_mass_kg", 0.0)
        for counterweight in fitted
    )


def test_a_lanchester_shaft_takes_what_turns_backwards_whatever_the_part() -> None:
    # analytic: one row of 12 kg and a part of 40 kg at 0.12 m; half of both turns backwards, which the shaft takes
    design = machine([0.0], [0.0], (0.0,), 100.0)
    place = {"name": "s", "position_m": 0.0, "counterweight_radius_m": 0.06, "max_mass_kg": 100.0}
    design["balance_shafts"] = [{"name": "back", "speed_ratio": -1, "webs": [place]}]
    body = {"machine": design, "parts": parts(1, 1, scatter=0.0), "choose_counterweights": True}
    answer = sound(body)
    assert answer.certificate.objective == pytest.approx(0.0, abs=3e-6 * answer.certificate.yardstick)
    assert answer.balance_shafts_mass_kg == pytest.approx(52.0, rel=1e-5)


@pytest.mark.parametrize(
    ("change", "path"),
    [
        ({"counterweights": [{"web": "t", "mass_kg": 1.0, "angle_deg": 0.0}]}, ("counterweights", 0, "web")),
        ({"choose_counterweights": True}, ("machine", "balance_shafts", 0, "webs", 1, "max_mass_kg")),
    ],
)
def test_what_is_wrong_is_named(change: dict[str, Any], path: tuple[object, ...]) -> None:
    body = geared(-1)
    body["balance_shafts"][0]["webs"][1]["max_mass_kg"] = None
    with pytest.raises(InvalidRequest) as refused:
        check(MatchRequest, {"machine": body, "parts": parts(1, 3)} | change)
    assert [problem.path for problem in refused.value.problems] == [path]
