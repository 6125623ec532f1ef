"""Counterweights that are at least so heavy, or not there."""

import copy
import itertools
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError
from scipy.optimize import minimize

from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.documents.examples import bodies
from tests.verification.checking import broken, optimized, verdict

RADIUS, OMEGA = 0.2, 500 * np.pi / 30


def twin(least: float, most: float = 40.0, **more: Any) -> dict[str, Any]:
    """One row between two webs: the whole of (12 + 100 / 2) 0.14 kg m is called for."""
    throw = {"position_m": 0, "crank_radius_m": 0.14, "crank_angle_deg": 0, "rotating_mass_kg": 12,
             "rows": [{"axis_deg": 0, "reciprocating_mass_kg": 100}]}  # fmt: skip
    webs = [
        {"name": name, "position_m": z, "counterweight_radius_m": RADIUS, "max_mass_kg": most,
         "min_fitted_mass_kg": least}
        for name, z in (("left", -0.1), ("right", 0.1))
    ]  # fmt: skip
    return {"machine": {"kind": "reciprocating", "speed_rpm": 500, "throws": [throw], "webs": webs}, **more}


def heavy_enough(answer: OptimizeAnswer, body: dict[str, Any]) -> bool:
    return all(
        counterweight.mass_kg == 0 or counterweight.mass_kg >= web["min_fitted_mass_kg"]
        for counterweight, web in zip(answer.counterweights, body["machine"]["webs"], strict=True)
        if web.get("min_fitted_mass_kg")
    )


def test_a_least_that_is_kept_anyway_changes_nothing() -> None:
    plain, least = twin(0.1), twin(0.1)
    for web in plain["machine"]["webs"]:
        del web["min_fitted_mass_kg"]
    answer, free = optimized(least), optimized(plain)
    assert [counterweight.mass_kg for counterweight in answer.counterweights] == [
        counterweight.mass_kg for counterweight in free.counterweights
    ]
    assert answer.certificate is not None
    assert answer.certificate.mass_lower_bound_kg is not None
    assert (answer.certificate.nodes, answer.certificate.continuous_lower_bound) == (None, None)


def test_two_that_are_each_too_heavy_lean_apart() -> None:
    # analytic: two of m at +-a from 180 degrees pull with 2 m R cos a, and their tangential parts are a couple;
    # without a weight of the moment they cancel (12 + 50) 0.14 kg m exactly, though each alone is too heavy
    body = twin(30.0, objective={"moment_weight": 0}, accuracy={"relative_gap": 1e-6})
    answer = optimized(body)
    assert answer.status == "optimal"
    assert heavy_enough(answer, body)
    assert answer.certificate is not None
    # what the counter-rotating 50 kg leave
    assert answer.certificate.objective == pytest.approx(50 * 0.14 * OMEGA**2, rel=2e-6)
    assert sorted(counterweight.mass_kg for counterweight in answer.counterweights) == pytest.approx(
        [30.0, 30.0], rel=1e-3
    )


def test_one_between_nothing_and_the_least() -> None:
    # analytic: one web in the plane of the throw, a unit of unbalance called for, 1.5 at least:
    # something leaves half a unit, nothing leaves one; from 2 on nothing is better
    for least, left in ((1.5, 0.5), (1.9, 0.9), (2.1, 1.0)):
        throw = {"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 30, "rotating_mass_kg": 10.0}
        web = {"name": "a", "position_m": 0, "counterweight_radius_m": 0.1, "max_mass_kg": 40,
               "min_fitted_mass_kg": 10 * least}  # fmt: skip
        machine = {"kind": "reciprocating", "speed_rpm": 500, "throws": [throw], "webs": [web]}
        answer = optimized({"machine": machine, "accuracy": {"relative_gap": 1e-6}})
        assert answer.status == "optimal"
        assert answer.certificate is not None
        assert answer.certificate.objective == pytest.approx(left * OMEGA**2, rel=2e-6)
        (counterweight,) = answer.counterweights
        assert counterweight.mass_kg == pytest.approx(10 * least if left < 1 else 0, rel=1e-6)
        # at its optimum the objective is flat in the angle: the asked gap leaves a twentieth of a degree open
        assert counterweight.angle_deg == pytest.approx(210.0 if left < 1 else 0, abs=2e-3)


def random_machine(seed: int, webs: int) -> dict[str, Any]:
    random = np.random.default_rng(seed)
    throws = [
        {"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": float(random.uniform(0, 360)),
         "rotating_mass_kg": float(random.uniform(2, 20)),
         "rows": [{"axis_deg": 90, "reciprocating_mass_kg": float(random.uniform(1, 10))}]}
        for z in (-0.3, 0.4)
    ]  # fmt: skip
    places = []
    for k in range(webs):
        most = float(random.uniform(2, 12))
        place = {"name": str(k), "position_m": float(random.uniform(-0.5, 0.5)), "counterweight_radius_m": RADIUS,
                 "max_mass_kg": most}  # fmt: skip
        if random.uniform() < 0.8:
            place["min_fitted_mass_kg"] = most * float(random.uniform(0.2, 1.0))
        if random.uniform() < 0.3:
            place["sector"] = {
                "centre_deg": float(random.uniform(0, 360)),
                "half_angle_deg": float(random.uniform(5, 90)),
            }
        places.append(place)
    return {"machine": {"kind": "reciprocating", "speed_rpm": 500, "throws": throws, "webs": places}}


def by_hand(body: dict[str, Any], u: np.ndarray) -> float:
    """Independent: peaks of force and moment of the first order, N, of unbalances (K,) kg m."""
    machine = body["machine"]
    force, couple, back, back_couple = 0j, 0j, 0j, 0j
    middle = 0.05
    for throw in machine["throws"]:
        crank = np.exp(1j * np.radians(throw["crank_angle_deg"]))
        half = 0.5 * throw["rows"][0]["reciprocating_mass_kg"]
        co = 0.1 * crank * (throw["rotating_mass_kg"] + half)
        counter = -0.1 * half * np.conj(crank)
        arm = throw["position_m"] - middle
        force, couple = force + co, couple + arm * co
        back, back_couple = back + counter, back_couple + arm * counter
    places = np.array([web["position_m"] for web in machine["webs"]])
    every = np.concatenate([places, [-0.3, 0.4]])
    force, couple = force + np.sum(u), couple + np.sum((places - middle) * u)
    span = np.ptp(every)
    return float(OMEGA**2 * (abs(force) + abs(back) + (abs(couple) + abs(back_couple)) / span))


def best_by_hand(body: dict[str, Any], seed: int) -> float:
    """Independent: the best of SLSQP from random starts, for every choice of the webs on which something is."""
    webs, random, best = body["machine"]["webs"], np.random.default_rng(seed), np.inf

    def unbalance(x: np.ndarray, fitted: tuple[bool, ...]) -> np.ndarray:
        return np.where(fitted, x[: len(webs)] * RADIUS * np.exp(1j * x[len(webs) :]), 0.0)

    for fitted in itertools.product((False, True), repeat=len(webs)):
        lightest = [web.get("min_fitted_mass_kg", 0.0) for web in webs]
        sides = [web.get("sector") for web in webs]
        middle = [np.radians(side["centre_deg"]) if side else None for side in sides]
        edges = [
            (centre - np.radians(side["half_angle_deg"]), centre + np.radians(side["half_angle_deg"]))
            if side and centre is not None
            else (-20.0, 20.0)
            for side, centre in zip(sides, middle, strict=True)
        ]
        bounds = [*zip(lightest, [web["max_mass_kg"] for web in webs], strict=True), *edges]
        for _ in range(4):
            start = [random.uniform(low, high) if high - low < 30 else random.uniform(-4, 4) for low, high in bounds]
            minimum = minimize(
                lambda x, fitted=fitted: by_hand(body, unbalance(x, fitted)) / 1e4, start, bounds=bounds, method="SLSQP"
            )
            best = min(best, by_hand(body, unbalance(np.clip(minimum.x, *np.array(bounds).T), fitted)))
    return best


@settings(max_examples=8)
@given(st.integers(0, 2**31 - 1), st.integers(1, 3))
def test_nothing_that_is_heavy_enough_is_better(seed: int, webs: int) -> None:
    body = {**random_machine(seed, webs), "accuracy": {"relative_gap": 1e-4, "time_limit_s": 30}}
    answer = optimized(body)
    proof = answer.certificate
    assert proof is not None
    assert proof.lower_bound is not None
    assert heavy_enough(answer, body)
    u = np.array([complex(counterweight.x_kg_m, counterweight.y_kg_m) for counterweight in answer.counterweights])
    assert proof.objective == pytest.approx(by_hand(body, u), rel=1e-9)
    best = best_by_hand(body, seed)
    assert proof.lower_bound <= best * (1 + 1e-9)
    # optimal to the asked gap, whatever the local searches have found
    assert answer.status == "optimal"
    assert proof.objective <= best + 1.01e-4 * (proof.yardstick or 0.0)


@pytest.mark.parametrize("least", [55.0, 59.9])
def test_the_machine_of_the_contract_with_a_least(least: float) -> None:
    body = bodies()["2d12"]
    for web in body["machine"]["webs"]:
        web["min_fitted_mass_kg"] = least
    answer = optimized(body)
    assert answer.status == "optimal"
    assert heavy_enough(answer, body)
    proof = answer.certificate
    assert proof is not None
    assert proof.continuous_lower_bound is not None
    assert proof.nodes
    # the continuous optimum is never beaten
    assert proof.continuous_lower_bound <= proof.objective
    assert verdict(body, answer.model_dump(mode="json")) == "not covered"


def test_a_budget_and_ceilings_hold() -> None:
    body = twin(30.0)
    body["machine"]["max_total_mass_kg"] = 55.0
    answer = optimized(body)
    assert answer.status == "optimal"
    # one alone, for two are heavier than the budget
    assert sorted(counterweight.mass_kg > 0 for counterweight in answer.counterweights) == [False, True]
    assert answer.certificate is not None
    free = optimized(twin(30.0))
    assert free.residual.after is not None
    assert free.certificate is not None
    tight = twin(30.0, objective={"moment_ceiling_Nm": 0.5 * free.residual.after.moment.peak_Nm})
    optimum = optimized(tight)
    assert optimum.residual.after is not None
    assert optimum.residual.after.moment.peak_Nm <= 0.5 * free.residual.after.moment.peak_Nm * (1 + 1e-9)


def test_ceilings_that_nothing_heavy_enough_keeps() -> None:
    # 30 kg or more of one, or two, leave more of the force than the ceiling; any masses would keep it
    throw = {"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 0, "rotating_mass_kg": 10.0}
    web = {"name": "a", "position_m": 0, "counterweight_radius_m": 0.1, "max_mass_kg": 40}
    body = {
        "machine": {"kind": "reciprocating", "speed_rpm": 500, "throws": [throw], "webs": [web]},
        "objective": {"force_ceiling_N": 0.4 * OMEGA**2},
    }
    assert optimized(copy.deepcopy(body)).status == "optimal"
    web["min_fitted_mass_kg"] = 15.0
    answer = optimized(body)
    assert answer.status == "infeasible"
    assert answer.infeasibility is not None
    assert "branch and bound" in answer.status_reason


def test_of_a_catalogue_what_is_too_light_is_left_out() -> None:
    body = twin(20.0)
    body["machine"]["catalogue"] = {"masses_kg": [5, 10, 21.7, 25], "angle_step_deg": 45}
    answer = optimized(body)
    assert {counterweight.mass_kg for counterweight in answer.counterweights} <= {0.0, 21.7, 25.0}


def test_the_checker_tells_a_weight_that_is_too_light() -> None:
    body = twin(30.0)
    answer = optimized(body).model_dump(mode="json")
    body["machine"]["webs"][0]["min_fitted_mass_kg"] = 39.0
    assert any("min_fitted_mass" in claim for claim in broken(body, answer))


def test_the_time_ends_a_search() -> None:
    body = {**random_machine(7, 3), "accuracy": {"relative_gap": 1e-12, "time_limit_s": 1e-3}}
    for web in body["machine"]["webs"]:
        web["min_fitted_mass_kg"] = 0.9 * web["max_mass_kg"]
    answer = optimized(body)
    assert answer.status in ("optimal", "inaccurate")
    assert answer.certificate is not None
    assert answer.certificate.lower_bound is not None
    if answer.status == "inaccurate":
        assert "time_limit_s" in answer.status_reason


@pytest.mark.parametrize(
    ("change", "path"),
    [
        ({"machine": {"webs": {"min_fitted_mass_kg": 41.0}}}, ("machine", "webs", 0, "min_fitted_mass_kg")),
        ({"machine": {"webs": {"min_fitted_mass_kg": 0.0}}}, ("machine", "webs", 0, "min_fitted_mass_kg")),
        (
            {"tolerances": {"angle_deg": 1}, "objective": {"moment_ceiling_Nm": 1e5}},
            ("tolerances", "angle_deg"),
        ),
    ],
)
def test_what_it_does_not_go_with_is_said(change: dict[str, Any], path: tuple[str | int, ...]) -> None:
    body = twin(30.0)
    for name, value in change.items():
        if name != "machine":
            body[name] = value
        elif "webs" in value:
            body["machine"]["webs"][0].update(value["webs"])
        else:
            body["machine"].update(value)
    with pytest.raises(ValidationError) as refused:
        OptimizeRequest.model_validate(body)
    assert path in _paths(refused.value)


def _paths(error: ValidationError) -> set[tuple[str | int, ...]]:
    names: set[tuple[str | int, ...]] = set()
    for single_error in error.errors():
        context = single_error.get("ctx", {})
        rest = [tuple(problem.path) for problem in context.get("problems", [])] or [()]
        place = tuple(part for part in single_error["loc"] if part != "reciprocating")
        names |= {(*place, *end) for end in rest}
    return names
