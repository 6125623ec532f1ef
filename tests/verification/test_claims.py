"""Every kind of answer holds, every falsified one is caught, and nothing that is sent raises.

Independent: the checker shares no code with what computed the answers.
"""

import json
from itertools import islice
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.verification import checker
from tests.night import by_day, part
from tests.pairs.asking import body_of
from tests.verification.answers import pair
from tests.verification.anything import JSON, judged, paths, replaced
from tests.verification.checking import ALL, broken, is_broken, optimized, verdict
from tests.verification.kinds import SINGLE
from tests.verification.tampering import beyond_limits, tampered


@pytest.fixture(scope="module", params=SINGLE)
def case(request: pytest.FixtureRequest) -> tuple[dict[str, Any], dict[str, Any]]:
    body = SINGLE[request.param]
    return body, json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())


def test_every_kind_of_answer_is_held(case: tuple[dict[str, Any], dict[str, Any]]) -> None:
    body, answer = case
    assert not broken(body, answer)
    assert verdict(body, answer) == "held"


def test_the_kinds_are_what_they_say() -> None:
    statuses = {name: optimize(OptimizeRequest.model_validate(body)).status for name, body in SINGLE.items()}
    assert {name for name, status in statuses.items() if status == "infeasible"} == {
        name for name in SINGLE if name.startswith("infeasible")
    }


def test_what_is_falsified_is_caught(case: tuple[dict[str, Any], dict[str, Any]]) -> None:
    body, answer = case
    # by day a sixth, of the next kind another; at night and under mutants all
    start, step = (0, 1) if ALL else ([*SINGLE.values()].index(body) % 6, 6)
    for name, wrong in islice(tampered(answer), start, None, step):
        assert is_broken(body, wrong), name
    for name, tighter in islice(beyond_limits(body, answer), start, None, step):
        assert is_broken(tighter, answer), name


@pytest.mark.parametrize("most", [None, 0, 1])
def test_what_is_fixed_is_no_choice_from_a_catalogue(most: int | None) -> None:
    """Analytic: a weight that was there before is of no catalogue, and none of the counterweights that are counted."""
    body = json.loads(json.dumps(SINGLE["sum"]))
    machine = body["machine"]
    machine["webs"][0]["fixed"] = {"mass_kg": 0.123, "angle_deg": 170.0}
    machine["catalogue"] = {"masses_kg": [1.0, 2.0], "angle_step_deg": 30.0, "max_part_numbers": 1}
    machine["max_counterweights"] = most
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    assert answer["counterweights"][0]["mass_kg"] == 0.123
    assert not broken(body, answer)


@pytest.mark.parametrize("goal", part(2, [{}, {"bending_weight": 2.0}]))
def test_the_usual_gap_of_a_least_mass_is_wide(goal: dict[str, float]) -> None:
    """The gap that is asked for does not hang on whether a search was needed."""
    body = body_of("twin", ["least fitted", "least mass false"])
    assert body is not None
    body.setdefault("objective", {}).update(goal)
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    proof = answer["certificate"]
    proof["relative_gap"] = 5e-4
    proof["lower_bound"] = proof["objective"] - 5e-4 * proof["yardstick"]
    proof["gap"] = 5e-4 * proof["yardstick"]
    answer["status"] = "optimal"
    assert not [claim for claim in broken(body, answer) if claim.startswith("status")]


def test_multipliers_that_are_too_long_prove_no_more() -> None:
    """Analytic: |y| <= lambda is made to hold, so a bound never rises by longer multipliers."""
    body = SINGLE["sum"]
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    for term in answer["certificate"]["multipliers"]["objective"]["terms"]:
        term["x"] *= 1000
        term["y"] *= 1000
    answer["certificate"]["lower_bound"] = answer["certificate"]["objective"]
    assert any(claim.startswith("lower_bound") for claim in broken(body, answer))


def test_a_hair_of_mass_is_told_to_what_counts() -> None:
    """Analytic: 1e-5 of the 10 kg that would cancel as many, of which a ten millionth is too much."""
    body = SINGLE["a hair of mass"]
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    certificate = answer["certificate"]
    assert answer["total_mass_kg"] == pytest.approx(1e-6, rel=0.02)
    assert certificate["mass_yardstick_kg"] == pytest.approx(1e-4, rel=1e-12)
    certificate["mass_yardstick_kg"] *= 1 + 1e-6
    assert any(claim.startswith("yardstick") for claim in broken(body, answer))


@pytest.mark.parametrize(("span", "mass"), [(1e-249, 0.5), (1e-235, 0.5), (1e-251, 1.0)])
def test_a_span_is_told_from_none_as_the_service_tells_it(span: float, mass: float) -> None:
    """Analytic: one web, so far from the throw that force and moment over the span fall and rise alike."""
    machine = {
        "kind": "reciprocating",
        "speed_rpm": 9.549296585513721,
        "throws": [{"position_m": 0, "crank_radius_m": 1, "crank_angle_deg": 0, "rotating_mass_kg": 1, "rows": []}],
        "webs": [{"name": "a", "position_m": span, "counterweight_radius_m": 1, "max_mass_kg": 1}],
    }
    body = {"machine": machine, "objective": {"combine": "max"}}
    answer = optimized(body)
    # the moment of u at the span, weighed by 1/span, is u; the force is 1 - u
    assert answer.total_mass_kg == pytest.approx(mass, rel=1e-5)


def test_what_missing_limits_imply_need_not_be_believed() -> None:
    """Analytic: webs of any mass that force and moment of the multipliers do nothing to gain nothing."""
    body = SINGLE["no limits"]
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    certificate = answer["certificate"]
    for mass in (1e-300, 1e300):
        certificate["implied_max_mass_kg"] = dict.fromkeys(certificate["implied_max_mass_kg"], mass)
        assert verdict(body, answer) == "held"
    certificate["lower_bound"] *= 1 + 1e-6
    assert any(claim.startswith("lower_bound") for claim in broken(body, answer))


def test_a_budget_beyond_any_need_beside_plates_costs_nothing() -> None:
    """Regression: what rounding leaves of the worth of a web without a limit was the price of all of the budget."""
    envelope = {"shape": "sector", "outer_radius_m": 0.2, "thickness_m": 0.01, "density_kg_m3": 7800}
    machine = {
        "kind": "reciprocating",
        "speed_rpm": 1000,
        "throws": [{"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 10, "rotating_mass_kg": 50}],
        "webs": [
            {"name": "free", "position_m": -0.1, "counterweight_radius_m": 0.2, "max_mass_kg": None},
            {"name": "plate", "position_m": 0.13, "envelope": {**envelope, "inner_radius_m": 0.05}},
        ],
        "max_total_mass_kg": 1e14,
    }
    body = {"machine": machine, "objective": {"moment_weight": 3.7}}
    answer = json.loads(optimized(body).model_dump_json())
    assert answer["status"] == "optimal"
    answer["certificate"]["mass_lower_bound_kg"] *= 1 + 1e-9
    assert any(claim.startswith("mass_lower_bound") for claim in broken(body, answer))


def test_what_the_checker_does_not_know_is_not_covered() -> None:
    body = SINGLE["sum"]
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    more = {**body, "scenarios": [{"name": "hot", "changes": []}]}
    judgement = checker().verify(more, answer)
    assert judgement["verdict"] == "not covered"
    assert "lower_bound" not in [claim["claim"] for claim in judgement["claims"]]
    more = {**body, "savings": [{"name": "hot"}]}
    where = {"claim": "request", "verdict": "not covered", "margin": None, "where": "/request/savings"}
    assert where in checker().verify(more, answer)["claims"]


def test_requests_with_every_field_and_over_the_whole_turn() -> None:
    """All that has its default changes nothing; objectives over the turn are other programs."""
    body = SINGLE["sum"]
    query = OptimizeRequest.model_validate(body)
    answer = json.loads(optimize(query).model_dump_json())
    assert verdict(json.loads(query.model_dump_json()), answer) == "held"
    for name, value in {"orders": "all", "bearing_weight": 1.0, "bending_ceiling_Nm": 0.0}.items():
        judgement = checker().verify({**body, "objective": {name: value}}, answer)
        assert judgement["verdict"] != "held"
        assert "objective" not in [claim["claim"] for claim in judgement["claims"] if claim["verdict"] == "held"]


_ANSWER = json.loads(optimize(OptimizeRequest.model_validate(SINGLE["ceilings"])).model_dump_json())

_PAIR = {"request": SINGLE["ceilings"], "answer": _ANSWER}
_PLACES = [path for path in paths(_PAIR) if path]


@by_day(8)
@given(st.lists(st.tuples(st.sampled_from(_PLACES), JSON), min_size=1, max_size=3))
def test_nothing_that_is_sent_raises(changes: list[tuple[tuple[str | int, ...], Any]]) -> None:
    """Any JSON in any place of request and answer is judged, or refused by name."""
    variant: Any = _PAIR
    for path, value in changes:
        variant = replaced(variant, path, value)
    judged(variant["request"], variant["answer"])


@given(JSON, JSON)
def test_anything_at_all_is_judged_or_refused(request: Any, answer: Any) -> None:
    judged(request, answer)


def test_what_rounding_of_the_limits_hides_is_no_fault() -> None:
    """Regression: beside 1e27 N m that the limits allow a smallest moment of 1e-5 N m has a bound of 0."""
    machine = {
        "kind": "scroll",
        "orbit_radius_m": 1e8,
        "orbiting_mass_kg": 1e12,
        "orbiting_position_m": 0.0,
        "anti_rotation": {
            "type": "crank_pins",
            "count": 6,
            "eccentric_mass_kg": 3e-11,
            "position_m": -1e-13,
            "pin_circle_radius_m": 1.0,
        },
        "speed_rpm": 7e5,
        "webs": [
            {
                "name": "0",
                "position_m": 1e7,
                "counterweight_radius_m": 0.27,
                "max_mass_kg": 1e300,
                "sector": {"centre_deg": 120.0, "half_angle_deg": 1e-9},
            }
        ],
        "max_total_mass_kg": 2e11,
    }

    body = {"machine": machine, "objective": {"force_ceiling_N": 0.0}}
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    assert answer["infeasibility"]["smallest_moment_Nm"] > 0
    judgement = checker().verify(body, answer)
    assert not broken(body, answer)
    moment, bound = (answer["infeasibility"][f"smallest_moment_{name}"] for name in ("Nm", "lower_bound_Nm"))
    hidden = bound < (1.0 - 1e-9) * moment
    assert hidden == any(
        claim["claim"] == "smallest_moment" and claim["margin"] is None for claim in judgement["claims"]
    )
    # of the force, which is no rounding, nothing is let go
    answer["infeasibility"]["smallest_force_N"] *= 1.001
    assert any(claim.startswith("smallest_force") for claim in broken(body, answer))


@pytest.mark.parametrize(
    ("field", "step", "verdict"),
    [("angle_step_deg", 22.5, "held"), ("angle_step_deg", 90, "broken"), ("angle_step_deg", 40, "broken"),
     ("mass_step_kg", 1.5, "held"), ("mass_step_kg", 6.0, "broken"), ("mass_step_kg", 2.999, "broken")],
)  # fmt: skip
def test_what_is_chosen_is_on_the_steps_of_a_catalogue(field: str, step: float, verdict: str) -> None:
    """Analytic: 6 and 9 kg at multiples of 45 degrees from their cranks are on steps of 3 and 1.5 kg, 45 and 22.5."""
    request, answer = pair("catalogue")
    assert checker().verify(request, answer)["not_covered"] == ["/answer/certificate/lower_bound"]
    request["machine"]["catalogue"][field] = step
    claims = {claim["claim"]: claim["verdict"] for claim in checker().verify(request, answer)["claims"]}
    assert claims["catalogue"] == verdict
