"""Goals over the whole turn: what their cuts prove is held, what is falsified is caught, the rest is named.

Independent: the checker shares no code with what computed the answers.
"""

import copy
import json
from functools import cache
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.verification import checker
from tests.night import part
from tests.optimize.machines import machine, row, throw, web
from tests.optimize.shafts import shaft, single
from tests.verification.anything import JSON, judged, paths, replaced
from tests.verification.checking import broken, is_broken, sound_answer

_BEARINGS = [
    {"name": name, "position_m": place, "diameter_m": 0.05, "length_m": 0.03 + 0.01 * k}
    for k, (name, place) in enumerate((("B", 0.35), ("A", -0.1), ("C", 0.7)))
]
_WEBS = [
    web("a", -0.2, 30.0),
    web("b", 0.25, 8.0, sector={"centre_deg": 140.0, "half_angle_deg": 35.0}),
    web("c", 0.65, 30.0, 0.15),
]


_ENDS = (("A", -0.3), ("B", 0.3))


def _machine(webs: list[dict[str, Any]] = _WEBS, **more: Any) -> dict[str, Any]:
    rod = {"connecting_rod": {"length_m": 0.35, "mass_kg": 3.0}}
    throws = [
        throw(0.0, 0.0, [row(90.0, 10.0, **rod)], rotating=5.0),
        throw(0.2, 180.0, [row(60.0, 8.0, **rod), row(120.0, 9.0, offset_m=0.02, **rod)], rotating=4.0),
        throw(0.5, 75.0, [row(90.0, 12.0, connecting_rod={"length_m": None})], rotating=6.0),
    ]
    return machine(throws, webs, bearings=_BEARINGS, **more)


_KINDS: dict[str, dict[str, Any]] = {
    "bearings": {"machine": _machine(), "objective": {"bearing_weight": 1, "force_weight": 0, "moment_weight": 0}},
    "beside the first order": {
        "machine": _machine(rotation="cw", max_total_mass_kg=20.0, reference_plane_m=0.1),
        "objective": {"bearing_weight": 0.5, "bending_weight": 2.0, "direction_weights": {"x": 1, "y": 0.5}},
    },
    "the largest of all orders": {
        "machine": _machine(rotation="cw"),
        "objective": {"orders": "all", "combine": "max", "bearing_weight": 2, "bending_weight": 3.0},
    },
    "specific": {
        "machine": _machine(),
        "objective": {"orders": "all", "bearing_weight": 1e-3, "bearing_measure": "specific", "force_ceiling_N": 60000},
    },
    "along the axes": {
        "machine": _machine(rotation="cw"),
        "objective": {"orders": "all", "force_ceiling_x_N": 3800, "moment_ceiling_y_Nm": 730},
    },
    "mean squares": {
        "machine": _machine(rotation="cw"),
        "objective": {"bearing_weight": 2.0, "bearing_measure": "rms", "combine": "max"},
    },
    "no limits": {"machine": _machine([web("a", -0.2, None), web("c", 0.65, None)]), "objective": {"orders": "all"}},
}


@cache
def _answer_text(name: str) -> str:
    return optimize(OptimizeRequest.model_validate(_KINDS[name])).model_dump_json()


def _claims(body: dict[str, Any], answer: dict[str, Any]) -> dict[str, str]:
    return {claim["claim"]: claim["verdict"] for claim in checker().verify(body, answer)["claims"]}


def _changed(answer: dict[str, Any], factor: float, *path: str) -> dict[str, Any]:
    variant = copy.deepcopy(answer)
    place = variant
    for name in path[:-1]:
        place = place[name]
    place[path[-1]] *= factor
    return variant


@pytest.mark.parametrize("name", part(6, _KINDS))
def test_what_cuts_prove_is_held_and_what_is_falsified_is_caught(name: str) -> None:
    body, answer = _KINDS[name], json.loads(_answer_text(name))
    assert answer["status"] == "optimal"
    claims = _claims(body, answer)
    held = {"lower_bound", "mass_lower_bound", "cuts", "counterweights", "max_mass", "after", "gap", "status"}
    assert {claim for claim, verdict in claims.items() if verdict == "held"} >= held
    # no angle between the cuts is worse
    assert claims["objective"] == claims["before"] == "held"
    assert (claims.get("reach") == "not covered") == (name == "no limits")
    rise = 1.0 + 1e-6 + answer["certificate"]["gap"] / answer["certificate"]["objective"]
    wrong_by = {"lower_bound": [rise], "mass_lower_bound_kg": [1 + 1e-6], "objective": [1 - 1e-8, 1 + 1e-8]}
    for field, factor in ((field, factor) for field, factors in wrong_by.items() for factor in factors):
        assert is_broken(body, _changed(answer, factor, "certificate", field)), field
    heavier = copy.deepcopy(answer)
    for counterweight in heavier["counterweights"]:
        counterweight["mass_kg"] *= 1.01
    assert {claim for claim, verdict in _claims(body, heavier).items() if verdict == "broken"} >= {
        "total_mass",
        "after",
    }


def test_multipliers_that_are_too_long_prove_no_more() -> None:
    """Analytic: |y| <= lambda is made to hold."""
    body, answer = _KINDS["bearings"], json.loads(_answer_text("bearings"))
    for term in answer["certificate"]["multipliers"]["objective"]["terms"]:
        term["x"] *= 1000
        term["y"] *= 1000
    answer["certificate"]["lower_bound"] = 1.001 * answer["certificate"]["objective"]
    assert _claims(body, answer)["lower_bound"] == "broken"


@pytest.mark.parametrize("field", ["kinematics", "masses"])
def test_what_is_not_covered_is_named(field: str) -> None:
    body = copy.deepcopy(_KINDS["bearings"])
    where = {"masses": "/request/tolerances/reciprocating_mass_relative", "kinematics": "/request/fidelity/kinematics"}
    if field == "masses":
        body["tolerances"] = {"reciprocating_mass_relative": 0.01}
    else:
        body["fidelity"] = {"kinematics": "order_2"}
    answer = json.loads(_answer_text("bearings"))
    fields = {claim["claim"]: claim for claim in checker().verify(body, answer)["claims"]}
    assert (fields["request"]["verdict"], fields["request"]["where"]) == ("not covered", where[field])
    assert "lower_bound" not in fields


def test_an_answer_out_of_reach_is_proven() -> None:
    body = copy.deepcopy(_KINDS["bearings"])
    body["objective"]["bearing_ceiling_N"] = 1.0
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    assert answer["status"] == "infeasible"
    assert _claims(body, answer)["conflict"] == "held"
    assert not broken(body, answer)
    # within reach nothing is proven by the same multipliers
    body["objective"]["bearing_ceiling_N"] = 1e6
    assert _claims(body, answer)["conflict"] == "broken"


@settings(max_examples=12)
@given(data=st.data())
def test_nothing_that_is_sent_raises(data: st.DataObject) -> None:
    """Any JSON in any place of request and answer is judged, or refused by name."""
    name = "the largest of all orders"
    variant: Any = {"request": _KINDS[name], "answer": json.loads(_answer_text(name))}
    places = st.sampled_from([path for path in paths(variant) if path])
    for path, value in data.draw(st.lists(st.tuples(places, JSON), min_size=1, max_size=3)):
        variant = replaced(variant, path, value)
    judged(variant["request"], variant["answer"])


_NOWHERE = [("bearing:Z", 10.0), ("bending:far", 10.0), ("bending:inf", 1.0), ("roll", 10.0), ("force", None)]


@pytest.mark.parametrize(("response", "angle"), _NOWHERE)
def test_terms_of_what_there_is_not_prove_nothing(response: str, angle: float | None) -> None:
    body, answer = _KINDS["the largest of all orders"], json.loads(_answer_text("the largest of all orders"))
    term = answer["certificate"]["multipliers"]["objective"]["terms"][0]
    term["response"], term["angle_deg"] = response, angle
    assert "lower_bound" not in _claims(body, answer)
    nowhere = {**body, "machine": {**body["machine"], "bearings": []}}
    assert "lower_bound" not in _claims(nowhere, answer)


def test_a_moment_that_shafts_cancel_is_judged_by_what_they_add() -> None:
    """Regression: 1e-6 N m are left of 1400, and doubles were taken to tell them to 2e-8."""
    throws = [throw(0.0, 12.4, [row(6.8, 1.55, connecting_rod={"length_m": 0.222})], rotating=9.8)]
    body = machine(throws, [], balance_shafts=[shaft("s", -2, 0.435, 4.0), shaft("t", -2, 0.451, 4.0)])
    goal = {"orders": "all", "combine": "max", "force_weight": 1e-9, "moment_weight": 1.0}
    sound_answer({"machine": body, "objective": goal})


def test_roll_alone_has_no_worst_case_of_bearings() -> None:
    """Regression: a machine with bearings whose goal is the roll was to print the load of one."""
    body = single([shaft("s", -1, 0.1, 4.0, x_m=0.1)], bearings=[{"name": n, "position_m": z} for n, z in _ENDS])
    answer = sound_answer({"machine": body, "objective": {"roll_weight": 1.0}, "tolerances": {"unbalance_kg_m": 0.01}})
    assert answer.worst_case is not None
    assert answer.worst_case.bearing_peak_N is None


def test_a_load_that_counterweights_cancel_is_judged_by_what_they_add() -> None:
    """Regression: of a fixed weight that others balance 1e-9 N were left, and were told to doubles of themselves."""
    fixed = {"name": "f", "position_m": -0.05, "counterweight_radius_m": 0.3}
    webs = [fixed | {"fixed": {"mass_kg": 1.8, "angle_deg": 221.1}}, web("a", 0.05, 20.0), web("b", 0.15, 20.0)]
    rows = [row(0.0, 0.0, connecting_rod={"length_m": 0.4})]
    ends = [{"name": name, "position_m": place} for name, place in _ENDS]
    body = machine([throw(0.0, 90.0, rows, rotating=0.0)], webs, bearings=ends)
    sound_answer({"machine": body, "objective": {"bearing_weight": 1.0}, "outputs": ["main_bearings"]})
