"""Parts of the search over the turn by themselves: problems, levels, proofs, and points that are moved inside."""

import time
from dataclasses import replace

import numpy as np
import pytest

from optimizer.program.certificate import objective_lower_bound
from optimizer.program.cuts.cut import Pool, Scatter
from optimizer.program.cuts.dominance import Group
from optimizer.program.cuts.proof import proofs, resting_proof, times, units
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.cuts.stage import Levels, Point, Search, _step
from optimizer.program.multipliers import resting_multipliers
from optimizer.program.rows import Row, weighted_peak
from optimizer.responses.response import Phasors, Response
from tests.program.cases import random_point
from tests.program.turning import bearings, force_and_moment, largest, quantities, wide

WEBS = 4


def _several(seed: int = 1) -> Problem:
    """Two goals: bearings in two cases, then force and moment beside a bearing; one bearing is limited."""
    rng = np.random.default_rng(seed)
    every = quantities(rng, 4, WEBS)
    first = Goal("bearings", (largest(0, 2), largest(2, 3, 2.0), largest(3, 4, 0.5)), cases=(0, 0, 1))
    last = Goal("external", (force_and_moment(rng, WEBS), largest(1, 2)))
    return Problem(every, (first, last), (), ((2, 1.7),), wide(WEBS))


def test_goals_are_sums_of_groups_or_the_largest_of_several() -> None:
    """Analytic: two cases of the first goal, one of the last."""
    program = _several()
    samples = program.samples
    assert program.goal_of.tolist() == [0, 0, 0, 1, 1]
    assert program.case_of.tolist() == [0, 0, 1, 2, 2]
    assert program.goal_of_case.tolist() == [0, 0, 1]
    assert program.of_goals(np.array([1.0, 2.0, 5.0, 7.0, 9.0])).tolist() == [5.0, 16.0]
    assert program.of_goals(np.array([3.0, 4.0, 5.0, 7.0, 9.0])).tolist() == [7.0, 16.0]
    alone = program.alone(1)
    assert [goal.name for goal in alone.goals] == ["external"]
    assert alone.samples is samples


@pytest.mark.parametrize("share", [0.0, 0.1])
def test_values_are_what_goals_and_ceilings_are(share: float) -> None:
    """Independent: peaks at many angles, and the definition of the goals."""
    program = replace(_several(), scatter=Scatter(share, 0.0))
    u = 0.3 * random_point(np.random.default_rng(2), program.limits) / 200.0
    turn = np.linspace(0.0, 2.0 * np.pi, 4001)
    peak = []
    for quantity in program.quantities:
        values = quantity.response.at(turn) + np.sum(quantity.response.influence * u)
        more = share * np.sum(np.abs(quantity.response.influence) * np.abs(u))
        peak.append(np.max(np.abs(values)) + more)
    (row,) = program.goals[1].groups[0].rows
    external = sum(
        float(maximum.floor + np.sum(np.abs(maximum.norms.at(u))) + share * np.sum(np.abs(maximum.norms.influence * u)))
        for maximum in row.peaks
    )
    expected = [max(max(peak[:2]) + 2.0 * peak[2], 0.5 * peak[3]), external + peak[1]]
    programs = program.values(u, 1e-9)
    assert programs.goals == pytest.approx(expected, rel=1e-5)
    size = max(1.7, program.at_rest.reached[2].upper)
    assert programs.over == pytest.approx([(peak[2] - 1.7) / size], abs=1e-5)
    assert programs.excess == programs.over[0]
    assert programs.over_budget == -1.0
    actual, places = program.sample_values(u, np.full(4, np.inf))
    assert np.all(actual.goals <= programs.goals * (1.0 + 1e-12))
    assert actual.goals == pytest.approx(expected, rel=1e-5)
    assert [len(place) for place in places] == [1] * 4
    # the statement of the cuts to begin with is no more than the truth
    posed = program.begun
    levels = posed.largest(posed.rows(posed.norms.sizes(u)))
    assert np.all(program.of_goals(levels) <= programs.goals * (1.0 + 1e-9))
    assert posed.ceilings.names == ("bearing 2",) * len(program.first[2])
    assert np.all(posed.ceilings.excess(u) <= programs.over[0] + 1e-9)


def test_the_smallest_excess_is_a_goal_of_its_own() -> None:
    program = _several()
    u = random_point(np.random.default_rng(3), program.limits) / 500.0
    excess = program.excess()
    assert excess.values(u, 1e-9).goals == pytest.approx([program.values(u, 1e-9).excess], abs=1e-7)
    assert excess.units.tolist() == [1.0]
    assert (excess.ceilings, excess.limited) == ((), ())
    scales = program.excess_scales([1, 1, 3, 1])
    assert scales.tolist() == [program.sizes[0]] * 3


@pytest.mark.parametrize(
    ("over", "under", "step"),
    [([-1.0, -2.0], [-3.0, -3.0], 0.0), ([1.0, -2.0], [-1.0, -3.0], 0.5), ([1.0, 3.0], [-1.0, -1.0], 0.75),
     ([1.0], [0.0], 1.0), ([1e300, 2.0], [1e300, 2.0], 1.0), ([0.0], [0.0], 0.0), ([], [], 0.0)],
)  # fmt: skip
def test_how_far_towards_what_is_inside_all_is_kept(over: list[float], under: list[float], step: float) -> None:
    assert _step(np.array(over), np.array(under)) == pytest.approx(step)


def _search(program: Problem, most: float, raised: bool = False) -> tuple[Search, Point]:
    """Of the last goal under a level of the first, from rest."""
    still = np.zeros(WEBS, complex)
    inside = Point(still, program.at_rest, 0.0)
    levels = Levels(np.array([1e-9]), np.array([most]), np.array([most]))
    return Search(
        program, Pool(program.first, program.scatter), levels, inside, raised, time.thread_time() + 60.0
    ), inside


def test_points_are_moved_inside_just_so_far() -> None:
    """Property: excesses are convex; what keeps all stays, and what does not ends at a level, or next to it."""
    program = replace(_several(), limited=())
    rest = float(program.at_rest.goals[0])
    search, inside = _search(program, 1.2 * rest)
    near, far = (size * random_point(np.random.default_rng(5), program.limits) for size in (1e-4, 0.02))
    point = search._evaluated(near, 1e-12)
    assert search._interior_step(point, inside) is point
    beyond = search._evaluated(far, 1e-12)
    assert np.any(search._excess(beyond.values) > 0.0)
    moved = search._interior_step(beyond, inside)
    assert np.all(search._excess(moved.values) <= 0.0)
    share = np.abs(moved.unbalance[0]) / np.abs(far[0])
    assert 0.0 < share < 1.0
    np.testing.assert_allclose(moved.unbalance, share * far, rtol=1e-9)
    # the goal is convex, so that it is no more than its chord says
    line = min(1.0, _step(search._excess(beyond.values), search._excess(inside.values)))
    assert share == pytest.approx(1.0 - line, rel=1e-6)
    assert moved.values.goals[0] <= 1.2 * rest * (1.0 + 1e-9)
    assert moved.mass == pytest.approx(program.mass(moved.unbalance))
    best = search._feasible(beyond)
    assert search.figure(best) <= search.figure(moved) * (1.0 + 1e-9)
    assert search.beyond is beyond
    assert search.near is None
    assert search.figure(best) == float(best.values.goals[-1])
    # what a point comes to at least, by convexity
    assert search._promise(point) == search.figure(point)
    promised = search.figure(beyond) + line * (search.figure(inside) - search.figure(beyond))
    assert search._promise(beyond) == pytest.approx(promised)
    position = search._feasible(point)
    assert search.near is point
    assert search.figure(position) <= search.figure(point)


def test_widths_and_gaps_that_are_wanted_are_shares_of_what_is_asked() -> None:
    """Analytic, in the units of the goals."""
    program = replace(_several(), limited=())
    search, inside = _search(program, 1e9)
    assert (search.of_mass, search.free) == (False, False)
    size = program.units
    allowance = 1e-9 / float(size[0])
    assert search._gap_limit(0.3, inside) == 0.3
    assert search._width(1e-9, np.inf) == pytest.approx(0.1 * min(allowance, 1e-9 / float(size[-1])))
    assert search._width(1e-12, 1.0) == pytest.approx(0.1 * min(allowance, 0.1 / float(size[-1])))
    search.price = np.array([2.0])
    search._spare(1e-10)
    assert search.margin == pytest.approx([max(1e-12 * float(size[0]), 0.1 * 1e-10 / 2.0)])
    search._spare(1e9)
    assert search.margin == pytest.approx([1e-9])
    assert not search._late()
    search.until = time.thread_time() - 1.0
    assert search._late()
    plain = bearings(1, webs=WEBS)
    levels, pool = Levels(*3 * [np.zeros(0)]), Pool(plain.first, plain.scatter)
    rest = Point(np.zeros(WEBS, complex), plain.at_rest, 0.0)
    free = Search(plain, pool, levels, rest, False, time.thread_time() + 60.0)
    assert free.free
    assert free._width(1.0, np.inf) == pytest.approx(min(0.1 * 1.0 / float(plain.units[-1]), 1e-4))


def test_a_level_matters_to_what_may_be_above_it() -> None:
    """Analytic: a quantity matters above what its group comes to, over its weight; a limited one above its ceiling."""
    program = _several()
    search, _ = _search(program, 1e9)
    u = random_point(np.random.default_rng(6), program.limits) / 300.0
    posed = program.begun
    level = posed.largest(posed.rows(posed.norms.sizes(u)))
    values = search._matters(posed, u)
    lowered = 1.7 + 2e-10 * program.sizes[0]
    assert values == pytest.approx([level[0], min(level[0], level[4]), min(level[1] / 2.0, lowered), level[2] / 0.5])


def test_a_proof_without_a_solver_is_the_best_of_every_case() -> None:
    """Independent: the bounds of the statement of each case of the last goal."""
    program = _several().alone(0)
    statement = program.begun
    proof = resting_proof(program, program.first, statement)
    bounds = []
    for case in (0, 1):
        alone = times(statement, (program.case_of == case).astype(float))
        bounds += [
            float(objective_lower_bound(alone, resting_multiplier)) for resting_multiplier in resting_multipliers(alone)
        ]
    assert proof.bound >= max(bounds) - 1e-12
    assert proof.bound <= float(program.at_rest.goals[0]) * (1.0 + 1e-9)
    assert proof.cuts == tuple(len(values) for values in program.first)
    assert objective_lower_bound(proof.statement, proof.multipliers) == pytest.approx(proof.bound, rel=1e-12)
    nearer = proof.within(replace(statement.limits, max_mass=np.zeros(WEBS)))
    assert np.all(nearer.statement.limits.max_mass == 0.0)
    assert objective_lower_bound(nearer.statement, nearer.multipliers) >= proof.bound


def test_groups_times_factors() -> None:
    program = _several()
    statement = program.begun
    factor = np.array([2.0, 3.0, 0.5, 1.0, 4.0])
    u = random_point(np.random.default_rng(7), program.limits) / 300.0
    before = statement.largest(statement.rows(statement.norms.sizes(u)))
    scaled = times(statement, factor)
    np.testing.assert_allclose(scaled.largest(scaled.rows(scaled.norms.sizes(u))), factor * before, rtol=1e-12)
    assert times(statement, np.ones(5)) is statement
    assert units(program.alone(0)).tolist() == [1.0]
    np.testing.assert_array_equal(units(program), program.units)


@pytest.mark.parametrize("seed", [3, 4])
def test_multipliers_of_several_goals_prove_what_is_below_both(seed: int) -> None:
    """Property: nothing whose first goal is below its level has a last goal below the bound."""
    program = replace(_several(seed), limited=())
    statement = times(program.begun, 1.0 / program.units[program.goal_of])
    rng = np.random.default_rng(seed)
    some = [0.02 * rng.random() * random_point(rng, program.limits) for _ in range(40)]
    goals = np.array([program.values(values, 1e-9).goals for values in some])
    level = float(np.median(goals[:, 0]))
    lowest = float(np.min(goals[goals[:, 0] <= level, 1]))
    dual, *_ = resting_multipliers(statement)
    _, rest = resting_multipliers(statement)
    bounds = [
        proof.bound
        for multipliers in (dual, rest)
        for proof in proofs(program, program.first, program.begun, some[0], multipliers, np.array([level]))
    ]
    assert bounds
    assert max(bounds) <= lowest * (1.0 + 1e-9)


@pytest.mark.parametrize(("most", "yardstick"), [(0.1, 0.02), (1e3, 1.0)])
def test_what_is_nothing_at_rest_is_measured_by_what_may_be_fitted(most: float, yardstick: float) -> None:
    """Analytic: 0.2 m times the largest mass, or the unbalance that brings the other response to nothing."""
    still = Response("still", "N", Phasors(np.asarray(0j), np.asarray(0j)), np.ones(1))
    limited = Response("limited", "N", Phasors(np.asarray(1.0 + 0j), np.asarray(0j)), np.ones(1))
    goal = Goal("all", (Group(rows=(Row("still", (weighted_peak(still, 1.0),)),)),))
    program = Problem((), (goal,), ((limited, 0.5),), (), wide(1))
    assert program.yardsticks_within(wide(1, most)) == pytest.approx([yardstick], rel=1e-12)
    assert program.yardsticks == pytest.approx([1.0], rel=1e-12)
