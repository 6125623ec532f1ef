"""Ceilings that several cases cannot keep: what proves it is judged, and of which scenarios.

Independent: the checker shares no code with what computed the answers.
"""

import copy
import json
from collections.abc import Callable
from functools import cache
from typing import Any

import pytest

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from tests.night import part
from tests.optimize.machines import machine, row, throw, web
from tests.optimize.robust import crank, scenario
from tests.pairs.asking import body_of
from tests.verification.checking import broken, is_broken, verdict

Body = dict[str, Any]

_AS_IT_IS = scenario("as it is")
_TURNED = scenario("turned", throws__0__crank_angle_deg=60)
_HEAVY = scenario("heavy", throws__0__rotating_mass_kg=200)
_HEAVY_TURNED = scenario("both", throws__0__rotating_mass_kg=200, throws__0__crank_angle_deg=60)
_SMALL = crank(max_mass=20.0)


def _row(**tolerances: float) -> Body:
    """A ceiling below what turns against the shaft, which is half of a row's mass."""
    design = machine([throw(0.0, 0.0, [row(0.0, 10.0)])], [web("a", 0.0)], speed_rpm=600.0)
    cases = [scenario("slow", speed_rpm=300.0), scenario("fast")]
    return {"machine": design, "objective": {"force_ceiling_N": 1000.0}, "scenarios": cases, "tolerances": tolerances}


def _bearings() -> Body:
    body = body_of("twin", ("bearings alone",))
    assert body is not None
    cases = [scenario("slow", speed_rpm=0.5 * body["machine"]["speed_rpm"]), scenario("as it is")]
    return {**body, "objective": {**body["objective"], "bearing_ceiling_N": 1.0}, "scenarios": cases}


#: request, and the scenarios whose ceilings conflict
KINDS: dict[str, tuple[Callable[[], Body], set[str]]] = {
    "by itself": (lambda: _crank(_SMALL, 150.0, _AS_IT_IS, _HEAVY), {"heavy"}),
    "each by itself": (lambda: _crank(_SMALL, 150.0, _HEAVY, _AS_IT_IS, _HEAVY_TURNED), {"heavy", "both"}),
    # analytic: 90 N is less than the 100 N that both can have
    "with one another": (lambda: _crank(crank(), 90.0, _AS_IT_IS, _TURNED), {"as it is", "turned"}),
    "against the shaft": (_row, {"fast"}),
    "against the shaft, masses off": (lambda: _row(reciprocating_mass_relative=0.1), {"fast"}),
    "scatter": (lambda: _row(mass_relative=0.2, unbalance_kg_m=0.1), {"fast"}),
    "bearings": (_bearings, {"as it is"}),
}


def _crank(design: Body, ceiling: float, *cases: Body) -> Body:
    return {"machine": design, "objective": {"force_ceiling_N": ceiling}, "scenarios": list(cases)}


@cache
def _exchange(kind: str) -> tuple[Body, Body]:
    body = KINDS[kind][0]()
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    assert answer["status"] == "infeasible"
    return body, answer


@pytest.mark.parametrize("kind", KINDS)
def test_a_conflict_of_cases_is_held_with_the_scenarios_of_it(kind: str) -> None:
    body, answer = _exchange(kind)
    assert set(answer["infeasibility"]["scenarios"]) == KINDS[kind][1]
    assert not broken(body, answer)
    assert verdict(body, answer) == "held"


@pytest.mark.parametrize("kind", part(3, [*KINDS]))
def test_other_scenarios_are_broken(kind: str) -> None:
    """One less, one more, and one twice."""
    body, answer = _exchange(kind)
    names = answer["infeasibility"]["scenarios"]
    others = [case["name"] for case in body["scenarios"] if case["name"] not in names]
    for false in (names[1:], [*names, *(others or ["nobody"])], [*names, names[0]]):
        wrong = copy.deepcopy(answer)
        wrong["infeasibility"]["scenarios"] = false
        assert is_broken(body, wrong), false


@pytest.mark.parametrize("kind", part(3, [*KINDS]))
def test_multipliers_of_a_conflict_prove_nothing_of_ceilings_that_can_be_kept(kind: str) -> None:
    body, answer = _exchange(kind)
    (field,) = answer["infeasibility"]["conflict"]
    wide = copy.deepcopy(body)
    wide["objective"][field] = 1e9
    assert any(claim.startswith("conflict") for claim in broken(wide, answer))


def test_a_conflict_is_proven_as_far_as_it_reaches() -> None:
    """Analytic: two cranks 60 degrees apart leave 100 N, and no multipliers prove that 100.001 N cannot be kept."""
    for ceiling, is_out in ((99.999, False), (100.001, True)):
        body, answer = _exchange("with one another")
        limited = {**body, "objective": {"force_ceiling_N": ceiling}}
        assert any(claim.startswith("conflict ") for claim in broken(limited, answer)) == is_out


def test_of_what_turns_against_the_shaft_the_price_alone_proves_the_conflict() -> None:
    body, answer = _exchange("against the shaft")
    wrong = copy.deepcopy(answer)
    for entry in wrong["infeasibility"]["multipliers"]["conflict"]["rows"]:
        entry["value"] = 0.0
    assert is_broken(body, wrong)


def test_each_scenario_that_conflicts_by_itself_has_a_proof_of_its_own() -> None:
    body, answer = _exchange("each by itself")
    proofs = answer["infeasibility"]["multipliers"]["scenarios"]
    assert [entry["scenario"] for entry in proofs] == ["heavy", "both"]
    for false in (
        proofs[:1],
        [{**proofs[0], "conflict": proofs[1]["conflict"]}, proofs[1]],
        [{**proofs[0], "scenario": "as it is"}, proofs[1]],
        [{**proofs[0], "conflict": {**proofs[0]["conflict"], "ceilings": []}}, proofs[1]],
    ):
        wrong = copy.deepcopy(answer)
        wrong["infeasibility"]["multipliers"]["scenarios"] = false
        assert is_broken(body, wrong), false


def test_what_no_multipliers_prove_names_no_scenario() -> None:
    body, answer = _exchange("by itself")
    wrong = copy.deepcopy(answer)
    wrong["infeasibility"]["multipliers"]["conflict"] = None
    assert verdict(body, wrong) == "not covered"
