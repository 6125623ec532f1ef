"""All assignments of a class, set by set of its parts: enumeration, and what must not change anything."""

from itertools import permutations
from typing import Any

import numpy as np
import pytest

from optimizer.studies.matching.bound import best_plane
from optimizer.studies.matching.match import match
from optimizer.studies.matching.problem import Problem, stated
from optimizer.studies.matching.row_halves import exhausted
from schemas.match.request import MatchRequest
from tests.studies.matching.cases import machine, mirrored, parts

#: cranks in some order: a moment is left of equal masses; three axes: nothing cancels
SCATTERED = [0.0, 225.0, 90.0, 45.0, 180.0, 315.0, 135.0, 270.0]
THREE_AXES = [30.0, 90.0, 150.0, 30.0, 90.0, 150.0, 30.0, 90.0]


def match_request(cranks: list[float], axes: list[float], goal: dict[str, Any], seed: int = 1) -> MatchRequest:
    count = len(cranks)
    return MatchRequest.model_validate(
        {
            "machine": machine(cranks, axes),
            "parts": parts(seed, count),
            "objective": goal,
            "accuracy": {"relative_gap": 1e-9},
        }
    )


def problem_of(request: MatchRequest) -> Problem:
    return stated(request, request.machine, np.zeros(0), np.zeros(0))


def never() -> bool:
    return False


@pytest.mark.parametrize(
    "goal",
    [{}, {"combine": "max"}, {"moment_weight": 0}, {"direction_weights": {"x": 0.0, "y": 1.0}}, {"force_weight": 0.1}],
)
@pytest.mark.parametrize(
    ("cranks", "axes"),
    [
        (mirrored(8), [90.0] * 8),
        (SCATTERED, [90.0] * 8),
        (SCATTERED, THREE_AXES),
        (SCATTERED[:5], [90.0] * 5),
        (SCATTERED[:3], THREE_AXES[:3]),
    ],
)
def test_it_is_the_best_of_all_orders(cranks: list[float], axes: list[float], goal: dict[str, Any]) -> None:
    """Independent: every order of the parts; begun from one that a hundredth of them, or a few, are better than."""
    problem = problem_of(match_request(cranks, axes, goal))
    orders = problem.input_order[np.array(list(permutations(range(len(cranks)))))]
    values = np.sort(problem.peaks.at(problem.vectors(orders)))
    for rank in (len(values) // 100, 20):
        level = float(values[min(rank, len(values) - 1)])
        cut = best_plane(problem, problem.peaks, level, 0.0)
        optimum = exhausted(problem, cut, level, 0.0, never)
        assert optimum.lower_bound <= values[0] + problem.rounding
        if optimum.complete:
            assert optimum.value == pytest.approx(values[0], abs=problem.rounding)
        if optimum.mass is not None:
            assert sorted(optimum.mass) == sorted(problem.input_order)
            assert float(problem.peaks.at(problem.vectors(optimum.mass))) == pytest.approx(optimum.value, rel=1e-9)
    # the windows of so few better ones are narrow enough to look at all
    assert optimum.complete


@pytest.mark.parametrize("heavier_kg", [0.0, 0.1])
@pytest.mark.parametrize("equal", [1, 3])
@pytest.mark.parametrize("rows", [7, 8])
def test_a_machine_the_same_from_both_ends_is_looked_at_once(heavier_kg: float, equal: int, rows: int) -> None:
    """Independent: every order of the parts, some of the same weight, on rows of which the first may be heavier."""
    cranks = mirrored(8) if rows == 8 else [0.0, 120.0, 240.0, 50.0, 240.0, 120.0, 0.0]
    body = {"machine": machine(cranks, [90.0] * rows), "parts": parts(5, rows)}
    body["machine"]["throws"][0]["rows"][0]["reciprocating_mass_kg"] += heavier_kg
    body["parts"][0]["masses_kg"][:equal] = [41.0] * equal
    problem = problem_of(MatchRequest.model_validate(body))
    values = problem.peaks.at(problem.vectors(np.array(list(permutations(problem.input_order)))))
    part = float(np.partition(values, 20 * equal)[20 * equal])
    optimum = exhausted(problem, best_plane(problem, problem.peaks, part, 0.0), part, 0.0, never)
    assert optimum.complete
    assert optimum.mass is not None
    assert optimum.value == pytest.approx(np.min(values), abs=problem.rounding)
    assert optimum.lower_bound <= np.min(values) + problem.rounding


def test_ten_rows_of_each_kind_are_proven() -> None:
    """Metamorphic: what a random assignment comes to is no less than the answer, nor than the bound."""
    request = match_request([36.0 * k for k in (0, 5, 3, 8, 1, 6, 4, 9, 2, 7)], [90.0] * 10, {})
    answer = match(request)
    assert (answer.status, answer.certificate.method) == ("optimal", "exhaustion")
    problem = problem_of(request)
    chance = np.random.default_rng(0)
    some = np.array([chance.permutation(problem.input_order) for _ in range(100_000)])
    omega_squared = (request.machine.speed_rpm * np.pi / 30.0) ** 2
    least = float(np.min(problem.peaks.at(problem.vectors(some)))) * omega_squared
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= answer.certificate.objective <= least


def test_sixteen_rows_with_cranks_in_some_order_are_proven() -> None:
    """Regression: 1e-4 was not reached by the bound by sorting alone; listed the other way round nothing changes."""
    cranks = [float(angle) for angle in np.random.default_rng(0).permutation(16) * 22.5]
    request = match_request(cranks, [90.0] * 16, {}, seed=16)
    part = request.parts[0]
    second = part.model_copy(update={"names": part.names[::-1], "masses_kg": part.masses_kg[::-1]})
    answer, turned = match(request), match(request.model_copy(update={"parts": (second,)}))
    assert answer.status == turned.status == "optimal"
    assert answer.certificate.method == "exhaustion"
    assert answer.certificate.objective == turned.certificate.objective
    assert answer.assignments == turned.assignments


def test_rows_whose_equal_masses_balance_are_proven() -> None:
    """Metamorphic: the bound by sorting is nothing; listed and counted from the other end nothing changes."""
    body = {
        "machine": machine(mirrored(12), [90.0] * 12),
        "parts": parts(16, 12),
        "accuracy": {"relative_gap": 1e-6, "time_limit_s": 30},
    }
    answer = match(MatchRequest.model_validate(body))
    body["machine"]["throws"][0]["rows"][0]["reciprocating_mass_kg"] += 1e-7
    assert match(MatchRequest.model_validate(body)).certificate.objective == pytest.approx(
        answer.certificate.objective, rel=1e-3
    )
    assert (answer.status, answer.certificate.method) == ("optimal", "exhaustion")


def test_the_time_ends_it_and_is_said() -> None:
    """Sixteen rows whose equal masses balance: the bound is nothing, and all sets would have to be looked at."""
    request = match_request(mirrored(16), [90.0] * 16, {})
    answer = match(request.model_copy(update={"accuracy": request.accuracy.model_copy(update={"time_limit_s": 0.05})}))
    assert answer.status == "inaccurate"
    assert "accuracy.time_limit_s" in answer.status_reason
    assert answer.certificate.lower_bound == pytest.approx(0.0, abs=1e-6)
    assert answer.certificate.relative_gap == pytest.approx(
        answer.certificate.objective / answer.certificate.yardstick, rel=1e-6
    )


def test_that_exchanges_ended_it_is_said() -> None:
    """Two classes of ten rows whose equal masses balance: all pairs of their orders are too many to compare."""
    request = match_request(mirrored(10), [90.0] * 10, {})
    more = request.parts[0].model_copy(update={"kind": "b", "masses_kg": request.parts[0].masses_kg[::-1]})
    answer = match(request.model_copy(update={"parts": (request.parts[0], more)}))
    assert (answer.status, answer.certificate.method) == ("inaccurate", "sorting")
    assert "No exchange" in answer.status_reason
    assert answer.certificate.objective < 1e-2 * answer.certificate.objective_as_listed


def test_equal_parts_and_parts_without_mass() -> None:
    """Analytic: of nine rows all around, parts that weigh the same or nothing leave what the parts that differ do."""
    body = {
        "machine": machine([40.0 * k for k in range(9)], [90.0] * 9),
        "parts": [{"class": "a", "names": [str(k) for k in range(9)], "masses_kg": [2.0] * 8 + [0.0]}],
        "objective": {"moment_weight": 0},
        "accuracy": {"relative_gap": 1e-9},
    }
    answer = match(MatchRequest.model_validate(body))
    # all but one of nine equal vectors that cancel: one is left
    assert answer.residual.after.force.peak_N == pytest.approx(2.0 * 0.12 * 50.0**2, rel=1e-9)
    assert answer.status == "optimal"


def test_classes_of_a_part_or_two_beside_a_large_one() -> None:
    """Metamorphic: what a random assignment comes to is no less; of a class of two the second half has no places."""
    rows = [{"throw": k, "row": 0} for k in range(15)]
    body: dict[str, Any] = {"machine": machine([24.0 * (7 * k % 15) for k in range(15)], [90.0] * 15), "parts": []}
    for name, some in (("a", rows[:1]), ("b", rows[1:3]), ("c", rows[3:])):
        masses = [40.0 + 0.013 * k * k for k in range(len(some))]
        names = [str(k) for k in range(len(some))]
        body["parts"].append({"class": name, "names": names, "masses_kg": masses, "rows": some})
    request = MatchRequest.model_validate(body | {"accuracy": {"time_limit_s": 30}})
    answer, problem = match(request), problem_of(request)
    chance = np.random.default_rng(0)
    some_of = [
        np.array([chance.permutation(problem.input_order[part]) for _ in range(20_000)]) for part in problem.slices
    ]
    omega_squared = (request.machine.speed_rpm * np.pi / 30.0) ** 2
    least = float(np.min(problem.peaks.at(problem.vectors(np.concatenate(some_of, axis=1))))) * omega_squared
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= answer.certificate.objective <= least
