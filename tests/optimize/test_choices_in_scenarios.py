"""Choices from what there is that are to suit several scenarios: what trying every set comes to."""

import copy
from typing import Any

import numpy as np
import pytest

from tests.night import at_night
from tests.optimize.test_grouped_choices import PAIRS, every_set
from tests.optimize.test_mirrored_groups import alike, grouped
from tests.optimize.test_web_groups import RADIUS, objective
from tests.verification.checking import optimized, sound_answer

FAST = {"name": "fast", "weight": 0.5, "changes": [{"path": "/machine/speed_rpm", "value": 420}]}
LADEN = {"name": "laden", "changes": [{"path": "/machine/throws/2/rotating_mass_kg", "value": 45}]}
AS_IT_IS = {"name": "as it is"}


def request_body(groups: list[list[str]], scenarios: list[dict[str, Any]], **goal: Any) -> dict[str, Any]:
    body = grouped(groups, False, objective=goal, scenarios=scenarios)
    body["machine"]["catalogue"] = {"masses_kg": [3.0, 6.0, 9.0], "angle_step_deg": 45.0}
    body["accuracy"] = {"relative_gap": 1e-9, "time_limit_s": 30}
    return body


def cases(body: dict[str, Any]) -> list[tuple[float, dict[str, Any]]]:
    """Weights and machines of all scenarios, by hand."""
    values = []
    for scenario in body["scenarios"]:
        case = {"machine": copy.deepcopy(body["machine"])}
        for change in scenario.get("changes", ()):
            *path, last = change["path"].split("/")[1:]
            place: Any = case
            for step in path:
                place = place[int(step)] if isinstance(place, list) else place[step]
            place[last] = change["value"]
        values.append((scenario.get("weight", 1.0), case))
    return values


def worst(body: dict[str, Any], u: np.ndarray) -> Any:
    """Independent: the largest weighted objective of all scenarios, of unbalances (..., 6) kg m."""
    return np.max([weight * objective(case, u) for weight, case in cases(body)], axis=0)


@pytest.mark.parametrize("scenarios", [[AS_IT_IS, LADEN], [FAST, LADEN], [FAST, LADEN, AS_IT_IS]])
def test_no_set_by_hand_is_better(scenarios: list[dict[str, Any]]) -> None:
    """Independent: all 15,625 sets, by sums over throws and webs."""
    body = request_body(PAIRS, scenarios)
    answer = sound_answer(body)
    alike(answer, PAIRS, False)
    _, u = every_set(body)
    best = float(np.min(worst(body, u)))
    assert answer.status == "optimal", answer.status_reason
    assert answer.status_reason.startswith("Proven optimal: of all sets")
    assert answer.certificate is not None
    assert answer.worst_case is not None
    assert answer.price_of_robustness is not None
    assert answer.certificate.objective == pytest.approx(best, rel=1e-9)
    assert answer.certificate.lower_bound == pytest.approx(best, rel=1e-9)
    assert answer.certificate.continuous_lower_bound is not None
    assert answer.certificate.continuous_lower_bound <= best
    assert answer.worst_case.objective == answer.certificate.objective
    # what the best set of the unchanged machine comes to in the worst case
    nominal = objective(body, u)
    assert answer.price_of_robustness.nominal_optimum == pytest.approx(float(np.min(nominal)), rel=1e-9)
    assert answer.price_of_robustness.nominal_optimum_worst_case is not None
    assert answer.price_of_robustness.nominal_optimum_worst_case >= best * (1 - 1e-9)


def test_by_a_tree(monkeypatch: pytest.MonkeyPatch) -> None:
    """Independent: the same where halves are given no room."""
    monkeypatch.setattr("optimizer.choices.discrete.search._SUMS", 1)
    monkeypatch.setattr("optimizer.choices.discrete.branch._SETS", 20)
    body = request_body(PAIRS, [FAST, LADEN])
    answer = optimized(body)
    _, u = every_set(body)
    assert answer.certificate is not None
    assert answer.certificate.method == "branch and bound"
    assert answer.certificate.objective == pytest.approx(float(np.min(worst(body, u))), rel=1e-9)
    assert answer.certificate.lower_bound == pytest.approx(answer.certificate.objective, rel=1e-9)


def test_ceilings_hold_in_each() -> None:
    """Independent: of the sets that keep the ceiling in every scenario the best; then ceilings that no set keeps."""
    two = [AS_IT_IS, LADEN]
    body = request_body(PAIRS, two)
    _, u = every_set(body)
    force = np.max([objective(case, u, moment_share=0.0) for _, case in cases(body)], axis=0)
    least = float(np.min(force))
    body = request_body(PAIRS, two, force_ceiling_N=1.1 * least, force_weight=0)
    mask = force <= 1.1 * least
    answer = optimized(body)
    assert answer.status == "optimal"
    assert answer.certificate is not None
    moment = np.max([objective(case, u) - objective(case, u, moment_share=0.0) for _, case in cases(body)], axis=0)
    assert answer.certificate.objective == pytest.approx(float(np.min(moment[mask])), rel=1e-9)
    for ceiling in (0.999 * least, 0.1 * least):
        none = optimized(request_body(PAIRS, two, force_ceiling_N=ceiling))
        assert none.status == "infeasible", ceiling
        assert none.infeasibility is not None
        assert none.infeasibility.conflict == ("force_ceiling_N",)
        assert none.infeasibility.closest.counterweights


@at_night
def test_at_least_so_heavy() -> None:
    """Independent: two webs, each of them fitted or not, in steps of half a kilogram and four degrees."""
    body = grouped([["0a", "1b"], ["1a", "2b"]], False, scenarios=[FAST, LADEN])
    del body["machine"]["web_groups"]
    body["machine"]["webs"] = [web for web in body["machine"]["webs"] if web["name"] in ("0a", "2b")]
    for web in body["machine"]["webs"]:
        web |= {"min_fitted_mass_kg": 24.0, "max_mass_kg": 30.0}
    body["accuracy"] = {"relative_gap": 1e-4, "time_limit_s": 30}
    answer = optimized(body)
    assert answer.status == "optimal"
    assert answer.certificate is not None
    assert all(counterweight.mass_kg == 0 or counterweight.mass_kg >= 24.0 for counterweight in answer.counterweights)
    sizes, angles = np.linspace(24.0, 30.0, 13), np.radians(np.arange(0.0, 360.0, 4.0))
    array = np.concatenate([[0j], (sizes[:, None] * np.exp(1j * angles)).ravel()]) * RADIUS
    values = worst(body, np.stack(np.meshgrid(array, array), axis=-1))
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= float(np.min(values))
    assert answer.certificate.objective <= float(np.min(values)) + 1e-4 * answer.certificate.yardstick
