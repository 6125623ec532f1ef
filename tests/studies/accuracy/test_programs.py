"""The programs of the ladder against analytic errors, and against the reference solver."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.program.certificate import objective_lower_bound
from optimizer.program.kernel.finer_numbers import PRECISIONS
from optimizer.program.reference.assembled import NoPoint
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.solution import ConeSolution
from optimizer.responses.response import Phasors, Response
from optimizer.studies.accuracy.methods import (
    ANGLES,
    GAPS,
    POSITIONS,
    SIDES,
    TOLERANCES,
    LadderProgram,
    Method,
    MethodResult,
    _lighter,
    methods,
)
from optimizer.studies.accuracy.rivals import matrices
from optimizer.studies.accuracy.rivals.polygonal import polygonal
from optimizer.studies.accuracy.rivals.sampled import OverTheTurn, half_turn, sampled
from tests.night import part
from tests.program.cases import COMBINATIONS, optimum
from tests.studies.accuracy.problems import free_limits, random_task, single


def reference(task: LadderProgram) -> ConeSolution:
    solution = optimum(task.statement, 1e-9, False)
    assert isinstance(solution, ConeSolution)
    return solution


def rest(task: LadderProgram) -> float:
    return float(task.statement.objective(np.zeros(task.statement.limits.radius.shape, complex)))


def solved(outcome: matrices.RivalPoint | NoPoint) -> matrices.RivalPoint:
    assert isinstance(outcome, matrices.RivalPoint), outcome
    return outcome


@pytest.mark.parametrize("angles", ANGLES)
def test_the_worst_grid_misses_a_peak_by_its_half_step(angles: int) -> None:
    """Analytic: with equal phasors |F| = 2 |cos(theta - a)|, and a grid half a step beside the peak sees cos(pi/n)."""
    task = single(1.0, 1.0, 0.0 + 1e-9)
    claim = solved(sampled(task.statement, task.turn, angles, 0.5, 5.0)).claimed
    assert claim == pytest.approx(2.0 * np.cos(np.pi / angles), abs=1e-7)


@given(st.sampled_from(ANGLES), st.sampled_from(POSITIONS), st.floats(0.0, 6.3), st.floats(0.0, 2.0))
def test_a_sampled_peak_lies_between_cos_and_one_of_the_true_one(
    angles: int, position: float, phase: float, counter: float
) -> None:
    """Analytic: no grid of n angles is further than pi/n from a peak, and none sees more than it."""
    grid = half_turn(angles, position)
    assert grid.size == angles // 2
    peak = np.max(np.abs(np.exp(1j * grid) + counter * np.exp(1j * phase) * np.exp(-1j * grid)))
    assert np.cos(np.pi / angles) * (1.0 + counter) - 1e-12 <= peak <= 1.0 + counter + 1e-12


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("angles", [6, 12, 72])
def test_sampled_programs_bracket_the_optimum(seed: int, angles: int) -> None:
    """Analytic: P_n <= P* <= P(u_n) <= P_n / cos(pi/n), without ceilings."""
    task = random_task(seed, "sum", (1.0, 0.3), True, True, False)
    best = reference(task)
    point = solved(sampled(task.statement, task.turn, angles, 0.25, 5.0))
    reached = float(task.statement.objective(point.unbalance))
    slack = 1e-6 * rest(task)
    assert point.claimed is not None
    assert point.claimed <= best.objective + slack
    assert best.lower_bound <= reached + slack
    assert reached * np.cos(np.pi / angles) <= point.claimed + slack


@pytest.mark.parametrize("sides", SIDES)
def test_a_polygon_on_edge_falls_short_by_its_sagitta(sides: int) -> None:
    """Analytic: where sides face the optimum, all of the side at cos(pi/N) is optimal, middle to corner."""
    task = single(2.0, 0.0, 1.0)
    point = solved(polygonal(task.statement, sides, 0.5, 5.0))
    reached = float(task.statement.objective(point.unbalance))
    corner = 2.0 - np.exp(1j * np.pi / sides)
    assert 2.0 - np.cos(np.pi / sides) - 1e-7 <= reached <= abs(corner) + 1e-7
    # a corner that faces the optimum reaches all of the circle
    assert task.statement.objective(solved(polygonal(task.statement, sides, 0.0, 5.0)).unbalance) == pytest.approx(
        1.0, abs=1e-7
    )


@pytest.mark.parametrize("seed", [0, 6, 7])  # limits bind, so that polygons matter
def test_polygons_converge_with_the_square_of_their_sides(seed: int) -> None:
    """Analytic: twice the sides, a quarter of the bound on the error (5/N^2)."""
    task = random_task(seed, "sum", (1.0, 1.0), False, True, False)
    bound = reference(task).lower_bound
    gaps = []
    for sides in SIDES:
        point = solved(polygonal(task.statement, sides, 0.3, 5.0))
        proven = float(objective_lower_bound(task.statement, point.multipliers))
        gaps.append((float(task.statement.objective(point.unbalance)) - proven) / rest(task))
        error = (float(task.statement.objective(point.unbalance)) - bound) / rest(task)
        assert -1e-9 <= error <= gaps[-1] + 1e-12
    order = np.polyfit(np.log(SIDES), np.log(gaps), 1)[0]
    assert order == pytest.approx(-2.0, abs=0.35)


@pytest.mark.parametrize("sides", [4, 16, 256])
@pytest.mark.parametrize("seed", range(8))
def test_points_of_polygons_keep_limits_and_ceilings(sides: int, seed: int) -> None:
    """The polygons lie within the discs: what is feasible for the linear program is feasible."""
    task = random_task(seed, "sum", (1.0, 1.0), True, True, True)
    point = polygonal(task.statement, sides, 0.25, 5.0)
    if isinstance(point, NoPoint):
        assert sides == 4  # a square of the ceilings may hold no point where the circle does
        return
    limits, size = task.statement.limits, np.abs(point.unbalance)
    assert np.all(size <= limits.radius * limits.max_mass * (1.0 + 1e-12))
    assert task.statement.mass(point.unbalance) <= limits.max_total_mass * (1.0 + 1e-12)
    assert np.max(task.statement.ceilings.excess(point.unbalance)) <= 1e-9


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("seed", range(4))
def test_the_exact_program_is_within_its_tolerance(tolerance: float, seed: int) -> None:
    """Independent: the reference solver with its certificate; errors stay below some times the tolerance."""
    task = random_task(seed, "max", (1.0, 0.3), True, True, False)
    best = reference(task)
    point = solved(matrices.exact(task.statement, tolerance, 5.0))
    error = (float(task.statement.objective(point.unbalance)) - best.lower_bound) / rest(task)
    assert -1e-12 <= error <= 20.0 * tolerance + 1e-9


@pytest.mark.parametrize("case", part(2, range(0, len(COMBINATIONS), 3)))
def test_no_bound_of_any_method_is_above_what_another_reached(case: int) -> None:
    """Property: own multipliers prove bounds, whatever limits, ceilings and weights there are."""
    task = random_task(case, *COMBINATIONS[case])
    best = reference(task)
    assert best.keeps_ceilings
    chosen = [
        single_method
        for single_method in methods()
        if single_method.setting.split()[0] in ("6", "72", "4", "32") or "1e-06" in single_method.setting
    ]
    assert len(chosen) == 9
    answered = 0
    for method in chosen:
        outcome = method.prepare()(task, method.positions[-1], 5.0)
        if isinstance(outcome, str):
            assert method.setting == "4 sides", (method, outcome)
            continue
        answered += 1
        assert outcome.prove() <= best.objective + 1e-9 * rest(task), method
        assert good(task, outcome, best.lower_bound), method
    assert answered >= 8


def good(task: LadderProgram, outcome: MethodResult, bound: float) -> bool:
    """Whether a point is no better than the bound, or breaks a ceiling."""
    reached = float(task.statement.objective(outcome.unbalance))
    excess = float(np.max(task.statement.ceilings.excess(outcome.unbalance), initial=-np.inf))
    return reached >= bound - 1e-12 * abs(bound) or excess > 0.0


def test_a_program_that_cannot_keep_its_ceilings_says_so() -> None:
    """A ceiling below the floor, against the proof of the reference solver."""
    task = random_task(5, "sum", (1.0, 1.0), False, False, True)
    ceilings = replace(task.statement.ceilings, cap=np.full(2, -0.1))
    turn = replace(
        task.turn,
        ceilings=tuple((response, 0.1 * abs(response.response.baseline.counter)) for response, _ in task.turn.ceilings),
    )
    hopeless = replace(task.statement, ceilings=ceilings)
    assert optimum(hopeless, 1e-9, False).conflict is not None
    for outcome in (
        polygonal(hopeless, 32, 0.0, 5.0),
        matrices.exact(hopeless, 1e-8, 5.0),
        sampled(hopeless, turn, 72, 0.0, 5.0),
    ):
        assert isinstance(outcome, NoPoint)
        assert outcome.reason == "no counterweights keep the ceilings of this program"


def test_a_limit_of_time_is_kept() -> None:
    """A solver without time finds nothing, and says so."""
    task = random_task(1, "sum", (1.0, 1.0), True, True, False)
    for outcome in (
        sampled(task.statement, task.turn, 720, 0.0, 1e-9),
        polygonal(task.statement, 256, 0.0, 1e-9),
        matrices.exact(task.statement, 1e-8, 1e-9),
    ):
        assert isinstance(outcome, NoPoint)
        assert "not solved within" in outcome.reason


def test_methods_are_told_apart() -> None:
    listed = [(method.name, method.setting) for method in methods()]
    interior = 2 * len(GAPS) + len(PRECISIONS)
    assert len(listed) == len(set(listed)) == len(GAPS) + interior + 2 * len(TOLERANCES) + len(ANGLES) + len(SIDES)
    assert all(isinstance(method, Method) for method in methods())


@pytest.mark.parametrize("case", range(0, len(COMBINATIONS), 7))
def test_the_first_of_a_batch_is_the_program_itself(case: int) -> None:
    """Property: the point and the bound are those of the program alone, and the others are other programs."""
    task = random_task(case, *COMBINATIONS[case])
    alone, batch = (
        next(method for method in methods() if (method.name, method.setting) == (name, "relative gap 1e-06")).prepare()(
            task, 0.0, 5.0
        )
        for name in ("interior_point", "interior_point_batch")
    )
    assert isinstance(alone, MethodResult)
    assert isinstance(batch, MethodResult)
    assert np.allclose(batch.unbalance, alone.unbalance, rtol=1e-9, atol=1e-12)
    assert batch.prove() == pytest.approx(alone.prove(), rel=1e-12)
    share = np.array([1.0, 0.9])
    lighter = _lighter(task.statement, share)
    half = np.full(task.statement.limits.radius.size, 0.01 + 0.02j)
    # analytic: a machine with a share of the masses, at that share of the unbalance
    objective = task.statement.objective(half)
    assert lighter.objective(share[:, None] * half) == pytest.approx(share * objective, rel=1e-13)
    np.testing.assert_allclose(
        lighter.ceilings.excess(share[:, None] * half), [task.statement.ceilings.excess(half)] * 2, rtol=1e-9
    )


def test_finer_numbers_are_not_tried_on_many_webs() -> None:
    for method in methods():
        if method.name == "interior_point_interpreted":
            limits = free_limits([1.0] * 65)
            force = Response("force", "N", Phasors(np.asarray(1.0 + 0j), np.asarray(0j)), np.ones(65))
            task = LadderProgram(
                statement(combined([weighted_peak(force, 1.0)], "sum"), [], limits), OverTheTurn((), "sum", ())
            )
            assert "too large: 65 webs" in str(method.prepare()(task, 0.0, 5.0))
