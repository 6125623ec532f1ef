"""Numbers of counterweights and of part numbers in the checker: what is falsified is caught, or named.

Independent: the checker shares no code with what computed the answers.
"""

import copy
import json
from functools import cache
from typing import Any

import pytest

from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoRequest
from service.verification import checker
from tests.studies.pareto.test_counts import body
from tests.verification.checking import broken, is_broken
from tests.verification.falsified import at, numbers, replaced

_KINDS: dict[str, dict[str, Any]] = {
    "weights": {"counts": {"of": "weights"}},
    "part numbers in two scenarios": {
        "counts": {"of": "part_numbers"},
        "scenarios": [
            {"name": "slow", "changes": []},
            {"name": "fast", "changes": [{"path": "/machine/speed_rpm", "value": 600.0}]},
        ],
    },
    "mass": {"counts": {"of": "pieces", "least": "mass"}, "objective": {"force_ceiling_N": 8000.0}},
    "budgets": {"counts": {"of": "sizes"}, "total_mass_budgets_kg": [30.0, 60.0]},
}
#: what no multipliers prove: the search is not repeated
_NAMED = {"lower_bound", "status"}


@cache
def _text(name: str) -> tuple[str, str]:
    request = body(90.0, points=4, **_KINDS[name])
    request["accuracy"]["relative_gap"] = 1e-3
    return json.dumps(request), pareto(ParetoRequest.model_validate(request)).model_dump_json()


def _pair(name: str) -> tuple[Any, Any]:
    request, answer = _text(name)
    return json.loads(request), json.loads(answer)


@pytest.mark.parametrize("name", _KINDS)
def test_all_but_what_a_search_proves_is_held(name: str) -> None:
    request, answer = _pair(name)
    verdict = checker().verify(request, answer)
    assert not broken(request, answer)
    assert {where.rpartition("/")[2] for where in verdict["not_covered"]} <= _NAMED
    assert verdict["checked"] > 0.9 * verdict["leaves"]


@pytest.mark.parametrize("name", ["weights", "mass"])
def test_a_number_that_is_off_is_broken(name: str) -> None:
    """By a thousandth, in every point: a bound is caught where another point is below it."""
    request, answer = _pair(name)
    count = 0
    for path in numbers(answer):
        leaf, field = at(answer, path), path[-1]
        if path[0] != "counts" or not leaf or field in ("angle_deg", "angle_from_crank_deg", "nodes"):
            continue
        wrong = replaced(answer, path, leaf * 1.001 if isinstance(leaf, float) else leaf + 1)
        try:
            assert is_broken(request, wrong) or field == "at_most", path
        except checker().Unreadable:
            continue
        count += 1
    assert count > 20


def test_nobody_is_below_a_bound_and_nothing_is_infeasible_that_there_is() -> None:
    request, answer = _pair("weights")
    points = answer["counts"][0]["points"]
    wrong = copy.deepcopy(answer)
    # two counterweights have less than one: what is proven of one is as much as one has, and no more of two
    wrong["counts"][0]["points"][2]["lower_bound"] = points[1]["lower_bound"]
    assert any(claim.startswith("lower_bound") for claim in broken(request, wrong))
    wrong = copy.deepcopy(answer)
    last = wrong["counts"][0]["points"][-1]
    last.update(dict.fromkeys(("value", "lower_bound", "relative_gap", "weights", "part_numbers", "total_mass_kg")))
    last.update({"status": "infeasible", "force_peak_N": None, "moment_peak_Nm": None, "counterweights": []})
    assert any(claim.startswith("counts") for claim in broken(request, wrong))


def test_a_point_holds_no_more_than_its_number() -> None:
    request, answer = _pair("weights")
    points = answer["counts"][0]["points"]
    points[1] = {**points[2], "at_most": points[1]["at_most"]}
    assert any(claim.startswith("counts") for claim in broken(request, answer))
