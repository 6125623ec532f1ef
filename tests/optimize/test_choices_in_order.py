"""Choices for goals one after the other, each keeping what was reached before it: what trying every set comes to."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from optimizer.choices.discrete import branch, search
from optimizer.choices.feasible_set import Choice, SearchResult
from optimizer.optimize import optimize
from optimizer.program.verdict import CONTRADICTED
from optimizer.solve import choice as certified_choice
from optimizer.solve.cutting_plane_rounds import in_rounds
from optimizer.solve.statuses import _NOTHING_FEASIBLE
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from tests.night import every, part
from tests.optimize.choices import (
    DEGREE,
    FAST,
    SLOW,
    Loads,
    certified,
    chosen,
    every_set,
    request_body,
    twin,
    two_webs,
)
from tests.optimize.test_catalogue import twin as catalogue_twin
from tests.studies.sweep.single import assert_row_is_the_single_answer, sweep, table
from tests.verification.checking import optimized
from tests.verification.every import unchecked

WEIGHTS = {"bearing_weight": 1, "force_weight": 0.5, "moment_weight": 2.0}


def in_order(*goals: str, allowance: float = 0.0, **more: Any) -> dict[str, Any]:
    first, *actual_goals = goals
    order = [{"goal": first, "allowance": allowance}, *({"goal": goal} for goal in actual_goals)]
    return {**WEIGHTS, "priorities": order, **more}


def by_hand(loads: Loads, u: np.ndarray, plane: float, goal: dict[str, Any]) -> dict[str, np.ndarray]:
    """What sets (sets, webs) come to by statics."""
    force, moment = loads.frame(u, plane)
    combined = np.maximum if goal.get("combine") == "max" else np.add
    return {
        "external": combined(0.5 * force, 2.0 * moment),
        "bearings": loads.peak(u),
    }


def assert_best(answer: OptimizeAnswer, first: np.ndarray, last: np.ndarray, allowed: float) -> None:
    """Independent: no set that keeps what the first goal leaves comes to less of the last one.

    Parameters
    ----------
    first, last : (sets,) what sets come to, angles between those that were looked at apart.
    allowed : what the first goal may come to.
    """
    proof = answer.certificate
    assert proof is not None
    (goal,) = proof.goals
    assert goal.value == pytest.approx(float(np.min(first)), rel=DEGREE)
    assert goal.lower_bound == pytest.approx(float(np.min(first)), rel=DEGREE)
    assert goal.limit == pytest.approx(allowed, rel=DEGREE)
    # those at the very limit may be on either side of it
    surely, perhaps = first <= goal.limit * (1 - DEGREE), first <= goal.limit * (1 + DEGREE)
    assert proof.objective <= float(np.min(last, where=surely, initial=np.inf)) * (1 + DEGREE)
    assert proof.objective >= float(np.min(last[perhaps])) * (1 - 1e-9)
    assert proof.lower_bound is not None
    assert proof.lower_bound == pytest.approx(proof.objective, rel=1e-5)
    assert proof.continuous_lower_bound is not None
    assert proof.continuous_lower_bound <= proof.lower_bound


@pytest.mark.parametrize("by_tree", part(2, [False, True]))
@pytest.mark.parametrize(
    "goal",
    every(
        2,
        [
            in_order("external", "bearings", "mass"),
            in_order("external", "bearings", allowance=0.1),
            in_order("external", "bearings", allowance=0.03, combine="max"),
            in_order("bearings", "external", allowance=0.02),
        ],
    ),
)
def test_no_set_by_hand_is_better(monkeypatch: pytest.MonkeyPatch, by_tree: bool, goal: dict[str, Any]) -> None:
    """Independent: all 2,401 sets at 360 angles by statics."""
    if by_tree:
        monkeypatch.setattr(search, "_SUMS", 0)
        monkeypatch.setattr(branch, "_SETS", 1)
    machine = twin()
    optimum, _ = certified(request_body(machine, **goal))
    loads, (_, u) = Loads(machine), every_set(machine)
    values, here = (by_hand(loads, choice, optimum.reference_plane_m, goal) for choice in (u, chosen(optimum)))
    names = [priority["goal"] for priority in goal["priorities"]]
    first, last = values[names[0]], values[names[1]]
    still = float(first[0])
    assert_best(optimum, first, last, float(np.min(first)) + goal["priorities"][0]["allowance"] * still)
    assert optimum.certificate is not None
    assert float(here[names[1]][0]) == pytest.approx(optimum.certificate.objective, rel=DEGREE)
    assert float(here[names[0]][0]) <= optimum.certificate.goals[0].limit * (1 + 1e-9)


def test_in_scenarios() -> None:
    """Independent: the worst of two speeds of either goal, by statics."""
    machine, goal = twin(), in_order("external", "bearings", allowance=0.05)
    optimum, _ = certified(request_body(machine, **goal) | {"scenarios": [FAST, SLOW]})
    _, u = every_set(machine)
    cases = ((1.0, Loads(machine)), (0.5, Loads(machine | {"speed_rpm": 1300})))
    by_hands = [by_hand(loads, u, optimum.reference_plane_m, goal) for _, loads in cases]
    first, last = (
        np.maximum(*(weight * of[name] for (weight, _), of in zip(cases, by_hands, strict=True)))
        for name in ("external", "bearings")
    )
    assert_best(optimum, first, last, float(np.min(first) + 0.05 * first[0]))
    assert optimum.price_of_robustness is not None


def test_under_a_ceiling() -> None:
    """Independent: of the sets that keep a ceiling on the moment the same."""
    machine, goal = twin(), in_order("bearings", "external", allowance=0.02)
    loads, (_, u) = Loads(machine), every_set(machine)
    _, moment = loads.frame(u, 0.0)
    ceiling = float(np.sort(moment)[300]) * (1 + 1e-6)
    machine["reference_plane_m"] = 0.0
    optimum, _ = certified(request_body(machine, **goal, moment_ceiling_Nm=ceiling))
    mask = moment <= ceiling
    values = by_hand(loads, u, 0.0, goal)
    allowed = float(np.min(values["bearings"][mask]) + 0.02 * values["bearings"][0])
    assert_best(optimum, values["bearings"][mask], values["external"][mask], allowed)


def test_least_masses() -> None:
    """Independent: both of two webs fitted, one or none, by a grid of masses and angles."""
    machine, goal = two_webs(), in_order("external", "bearings", allowance=0.02)
    optimum, proof = certified(request_body(machine, 1e-4, **goal))
    assert all(
        counterweight.mass_kg == 0.0 or counterweight.mass_kg >= 14.0 for counterweight in optimum.counterweights
    )
    loads, (level,) = Loads(machine), proof.goals
    plane = optimum.reference_plane_m
    still = float(by_hand(loads, np.zeros((1, 2)), plane, goal)["external"][0])

    def best(values: list[np.ndarray]) -> tuple[float, float, np.ndarray]:
        """The least of both goals, of the last under the limit, and where; sets are of all options of both webs."""
        sets = np.stack([unbalances.ravel() for unbalances in np.meshgrid(*values, indexing="ij")], axis=-1)
        force, moment = loads.frame(sets, plane)
        first = 0.5 * force + 2.0 * moment
        within = sets[first <= level.limit]
        last = by_hand(loads, within, plane, goal)["bearings"]
        place = np.argmin(last) if last.size else 0
        return float(np.min(first)), float(np.min(last, initial=np.inf)), within[place : place + 1].ravel()

    def about(at: complex, share: float, angles: int) -> np.ndarray:
        masses = np.clip(np.abs(at) / 0.12 + share * np.linspace(-2.0, 2.0, 5), 14.0, 16.0)
        turned = np.exp(1j * (np.angle(at) + share * np.linspace(-np.pi, np.pi, angles)))
        return np.asarray(0.12 * np.append(0.0, np.multiply.outer(masses, turned).ravel()))

    first, last, at = best([about(1.8, 1.0, 91)] * 2)
    for share in 0.1 * 0.7 ** np.arange(16):
        lower, closer, there = best([about(centre, share, 5) for centre in at])
        first = min(first, lower)
        if closer < last:
            last, at = closer, there
    # a grid is above what it is a grid of
    assert level.lower_bound is not None
    assert level.lower_bound <= first
    assert level.value <= first * (1 + 1e-4)
    assert level.limit == pytest.approx(level.lower_bound + 0.02 * still, rel=1e-6)
    assert 0.99 * last <= proof.objective <= last * (1 + 1e-4)


def test_rows_of_a_sweep() -> None:
    """Rows are the single answers (property)."""
    request = sweep(
        request_body(twin(), **in_order("external", "bearings")), {"path": "/machine/speed_rpm", "values": [900, 1100]}
    )
    rows = table(request).to_pylist()
    assert [assert_row_is_the_single_answer(request, row) for row in rows] == ["optimal"] * 2
    assert all(row["goal_value.external"] >= row["goal_lower_bound.external"] for row in rows)


def test_a_ceiling_that_no_set_keeps() -> None:
    """Independent: no set is below the least moment of all, though some masses are."""
    machine = twin()
    machine["reference_plane_m"] = 0.0
    _, moment = Loads(machine).frame(every_set(machine)[1], 0.0)
    goal = in_order("external", "bearings", moment_ceiling_Nm=float(np.min(moment)) * 0.999)
    answer = optimized(request_body(machine, **goal))
    assert answer.status == "infeasible"
    assert answer.status_reason.startswith("Proven infeasible: no set")
    assert answer.certificate is None


def test_the_time_ends_it_before_the_last_goal() -> None:
    machine = twin(catalogue={"mass_step_kg": 0.37, "angle_step_deg": 7.5})
    machine["webs"] = [{k: v for k, v in web.items() if k != "hole_angles_deg"} for web in machine["webs"]]
    body = request_body(machine, **in_order("bearings", "external", allowance=0.01))
    answer = optimized(body | {"accuracy": {"relative_gap": 1e-9, "time_limit_s": 0.2}})
    assert answer.status == "inaccurate"
    assert answer.certificate is not None
    (goal,) = answer.certificate.goals
    assert goal.lower_bound is not None
    assert goal.lower_bound <= goal.value <= goal.limit


def test_a_goal_below_its_bound_contradicts(monkeypatch: pytest.MonkeyPatch) -> None:
    def above(*arguments: Any) -> tuple[Choice, SearchResult]:
        picked, optimum = in_rounds(*arguments)
        # of the first goal only: that of the last is judged with the answer
        first = len(arguments[0].goals) == 1
        return picked, replace(optimum, lower_bound=2.0 * optimum.lower_bound) if first else optimum

    monkeypatch.setattr(certified_choice, "in_rounds", above)
    # the limit of the first goal is counted from the wrong bound
    answer = unchecked(optimize)(
        OptimizeRequest.model_validate(request_body(twin(), **in_order("bearings", "external")))
    )
    assert (answer.status, answer.status_reason) == ("inaccurate", CONTRADICTED)
    assert answer.certificate is not None
    assert [goal.lower_bound for goal in answer.certificate.goals] == [None]


def test_what_exceeds_the_ceilings_contradicts_no_bound_of_what_keeps_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """Regression: a search that the time ended before any choice kept the ceilings was called a fault."""

    def late(*arguments: Any) -> tuple[Choice, SearchResult]:
        picked, optimum = in_rounds(*arguments)
        nothing = picked._replace(mass=0 * picked.mass, angle=0 * picked.angle, unbalance=0 * picked.unbalance)
        # more than there is without counterweights
        return nothing, replace(optimum, feasible=False, lower_bound=2.0 * arguments[4], ended="time")

    monkeypatch.setattr(certified_choice, "in_rounds", late)
    body = {"machine": catalogue_twin(), "objective": {"force_ceiling_N": 20_000.0}}
    answer = unchecked(optimize)(OptimizeRequest.model_validate(body))
    assert (answer.status, answer.status_reason) == ("inaccurate", _NOTHING_FEASIBLE)
