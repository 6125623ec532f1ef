"""Fronts of named responses: every value of a point is evaluated, and what it contradicts is broken.

Independent: the checker shares no code with what computed the answers. Without multipliers no corner is proven.
"""

import copy
import json
from functools import cache
from typing import Any

import pytest

from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoRequest
from service.verification import checker
from tests.night import part
from tests.pairs.asking import body_of
from tests.verification.checking import broken, is_broken, verdict

_KINDS: dict[str, tuple[str, tuple[str, ...], tuple[str, ...]]] = {
    "loads and mass": ("twin", (), ("bearings", "mass")),
    "tolerances of cases": ("twin", ("tolerances of masses and angles", "scenario of masses"), ("force", "moment")),
    "unbalances that are off": ("vee", ("tolerance of unbalance",), ("force", "mass")),
    "balance shaft": ("twin", ("balance shaft backwards",), ("roll", "moment", "mass")),
    "choices": ("twin", ("masses of a catalogue",), ("moment", "mass")),
    "bending of all orders": ("vee", ("orders all",), ("force", "bending")),
    "fixed, objective": ("twin", ("fixed",), ("objective", "mass")),
    "specific": ("twin", ("bearing specific", "fixed"), ("bearings", "mass")),
}
#: what has no multipliers, and what mass all gaps are relative to
_WITHOUT_PROOF = {
    "/answer/trades/*/responses/*/smallest",
    "/answer/trades/*/responses/*/lower_bound",
    "/answer/trades/*/responses/*/yardstick",
    "/answer/trades/*/points/*/certificate/corner",
    "/answer/trades/*/points/*/certificate/mass_lower_bound_kg",
}


@cache
def _exchange(kind: str) -> tuple[dict[str, Any], dict[str, Any]]:
    base, features, responses = _KINDS[kind]
    body = body_of(base, features, 1.0)
    assert body is not None
    body |= {"points": 3, "responses": [*responses]}
    return body, json.loads(pareto(ParetoRequest.model_validate(body)).model_dump_json())


def _changed(answer: dict[str, Any], *path: str | int, factor: float) -> dict[str, Any]:
    wrong: Any = copy.deepcopy(answer)
    place = wrong["trades"][0]
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] *= factor
    return wrong  # type: ignore[no-any-return]


@pytest.mark.parametrize("kind", part(4, [*_KINDS]))
def test_all_but_proofs_is_looked_at(kind: str) -> None:
    body, answer = _exchange(kind)
    assert not broken(body, answer)
    module = checker()
    assert {*module.verify(body, answer, module.PLACES)["not_covered"]} <= _WITHOUT_PROOF
    assert verdict(body, answer) == "not covered"


@pytest.mark.parametrize("kind", part(4, [*_KINDS]))
def test_a_false_value_is_broken(kind: str) -> None:
    """Of every point and response by a thousandth."""
    body, answer = _exchange(kind)
    (front,) = answer["trades"]
    for n, point in enumerate(front["points"]):
        fields = ["values"] if point["nominal_values"] is None else ["values", "nominal_values"]
        for field in fields:
            for k, value in enumerate(point[field]):
                # less is what rounding leaves of nothing
                if value > 1e-6 * front["responses"][k]["yardstick"]:
                    assert is_broken(body, _changed(answer, "points", n, field, k, factor=1.001)), (field, n, k)
        assert is_broken(body, _changed(answer, "points", n, "force_peak_N", factor=0.999))
    for k, entry in enumerate(front["responses"]):
        if entry["without_counterweights"] > 0:
            assert is_broken(body, _changed(answer, "responses", k, "without_counterweights", factor=1.001))


@pytest.mark.parametrize("kind", part(4, [*_KINDS]))
def test_what_points_contradict_is_broken(kind: str) -> None:
    """A bound above a point, a corner above a point in every response, a gap that is another, the order of points."""
    body, answer = _exchange(kind)
    (front,) = answer["trades"]
    for k, entry in enumerate(front["responses"]):
        if entry["lower_bound"] > 1e-6 * entry["yardstick"]:
            assert is_broken(body, _changed(answer, "responses", k, "lower_bound", factor=1.1))
    for n, point in enumerate(front["points"]):
        wrong = copy.deepcopy(answer)
        proof = wrong["trades"][0]["points"][n]["certificate"]
        proof["corner"] = [1.01 * value + 1e-3 for value in point["values"]]
        proof["relative_gap"] = 0.0
        assert is_broken(body, wrong), n
        wrong = copy.deepcopy(answer)
        wrong["trades"][0]["points"][n]["certificate"]["relative_gap"] += 1e-4
        assert is_broken(body, wrong), n
        wrong = copy.deepcopy(answer)
        wrong["trades"][0]["points"][n]["beaten_by"] = 7
        assert is_broken(body, wrong), n
    if len(front["points"]) > 1 and len(front["responses"]) == 2:
        wrong = copy.deepcopy(answer)
        wrong["trades"][0]["points"].reverse()
        assert is_broken(body, wrong)
    wrong = copy.deepcopy(answer)
    wrong["trades"][0]["responses"].reverse()
    assert is_broken(body, wrong)


def test_fronts_of_each_budget_are_there() -> None:
    body, answer = _exchange("loads and mass")
    with pytest.raises(checker().Unreadable, match="one front for each budget"):
        verdict({**body, "total_mass_budgets_kg": [10.0, 20.0]}, answer)
    # another budget than that of the answer, and the heaviest point is above it
    assert is_broken({**body, "total_mass_budgets_kg": [10.0]}, answer)
