"""Programs over the turn by cuts: what they reach and what they prove."""

from collections.abc import Sequence
from dataclasses import replace

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import mass_lower_bound, objective_lower_bound
from optimizer.program.cuts.attempts import FREELY, WITHIN, Attempt
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict, over_turn
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.cuts.stage import Search
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.responses.curve import floor
from tests.night import part
from tests.program.cases import random_point
from tests.program.turning import bearings, force_and_moment, largest, quantities, wide
from tests.responses.fourier import FourierCurves

#: 0.1 degree
ANGLES = np.deg2rad(np.arange(0.0, 360.0, 0.1))


def optimum_of(program: Problem, gap: float = 1e-6, least_mass: bool = False) -> CertifiedOptimum:
    outcome = over_turn(program, gap, least_mass)
    assert isinstance(outcome, CertifiedOptimum)
    return outcome


def sampled(program: Problem, u: Complex) -> Real:
    """Peaks at 3,600 angles (quantities,)."""
    responses = [quantity.response for quantity in program.quantities]
    return np.array([np.max(np.abs(response.at(ANGLES) + response.offset(u))) for response in responses])


@pytest.mark.parametrize("seed", range(3))
def test_the_optimum_is_the_largest_floor_where_no_limit_binds(seed: int) -> None:
    """Analytic: with influences of full row rank every circle can be centred by itself, and none can be left."""
    program = bearings(seed, limits=wide(6))
    best = optimum_of(program)
    expected = max(floor(quantity.response, 1e-9).circle.radius for quantity in program.quantities)
    rest = float(program.yardsticks[0])
    assert best.goals[-1].value == pytest.approx(expected, abs=1e-6 * rest)
    assert best.goals[-1].lower_bound <= expected * (1 + 1e-9)
    assert best.goals[-1].value - best.goals[-1].lower_bound <= 1e-6 * rest


@pytest.mark.parametrize("beside", part(2, [False, True]))
@pytest.mark.parametrize("seed", range(4))
def test_the_bound_is_that_of_the_program_at_fine_angles(seed: int, beside: bool) -> None:
    """Independent: the same program at 720 angles in the modelling layer, a relaxation, by another formulation."""
    program = bearings(seed, count=3, webs=4, beside=beside)
    best = optimum_of(program)
    u, limits = cp.Variable(4, complex=True), program.limits
    angles = ANGLES[::5]
    peaks = [
        cp.max(cp.abs(quantity.response.at(angles) + quantity.response.influence @ u))
        for quantity in program.quantities
    ]
    objective = cp.max(cp.hstack(peaks))
    for peak in [peak for group in program.groups for row in group.rows for peak in row.peaks]:
        objective = objective + cp.abs(peak.norms.constant[0] + peak.norms.influence[0] @ u) + peak.floor
    turned = cp.multiply(np.conj(limits.centre), u)
    across = cp.multiply(limits.half_angle_cos, cp.abs(cp.imag(turned)))
    within = across - cp.multiply(limits.half_angle_sin, cp.real(turned)) <= np.where(limits.free, 1e3, 0.0)
    mass = cp.abs(u) / limits.radius
    rules = [mass <= limits.max_mass, within]
    if np.isfinite(limits.max_total_mass):
        rules.append(cp.sum(mass) <= limits.max_total_mass)
    expected = cp.Problem(cp.Minimize(objective), rules).solve(solver=cp.CLARABEL)
    rest = float(program.yardsticks[0])
    assert best.goals[-1].value - best.goals[-1].lower_bound <= 1e-6 * rest
    # the angles between cost at most (h/2)^2/2 of the curvature, 36 times the size of the largest order
    assert expected - 1e-6 * rest <= best.goals[-1].value <= expected + 5e-4 * rest


@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 10**6), beside=st.booleans(), rms=st.booleans())
def test_bounds_are_never_above_what_another_point_comes_to(seed: int, beside: bool, rms: bool) -> None:
    program = bearings(seed, count=3, webs=3, beside=beside, measure="rms" if rms else "peak")
    best = optimum_of(program, 1e-4, least_mass=True)
    assert best.proof is not None
    assert best.mass_proof is not None
    rng = np.random.default_rng(seed + 1)
    for _ in range(4):
        point = random_point(rng, program.limits)
        near = program.limits.into(best.point.unbalance + 0.05 * (point - best.point.unbalance))
        for u in (point, near):
            objective = float(program.values(u, 1e-9).goals[0])
            mass = float(np.sum(np.abs(u) / program.limits.radius))
            assert best.goals[-1].lower_bound <= objective * (1 + 1e-12)
            # of the mass: whatever target it is asked for
            multipliers, posed = best.mass_proof.multipliers, best.mass_proof.statement
            assert mass_lower_bound(posed, multipliers, np.asarray(objective)) <= mass * (1 + 1e-12)
    # the proof is a statement of today's kind
    assert float(objective_lower_bound(best.proof.statement, best.proof.multipliers)) == best.goals[-1].lower_bound


@pytest.mark.parametrize("seed", range(3))
def test_a_mass_is_proven_for_all_that_come_to_more_at_its_price(seed: int) -> None:
    best = optimum_of(bearings(seed, count=3, webs=3), 1e-4, least_mass=True)
    assert best.mass_proof is not None
    assert best.counting(0.5 * best.mass_target) is best
    mass_limit = best.mass_target * (1.0 + 1e-6)
    more = best.counting(mass_limit)
    assert more.mass_target == mass_limit
    assert more.mass_proof is not None
    assert more.mass_proof.bound <= best.mass_proof.bound
    # independent: by the same multipliers with the other target
    again = float(mass_lower_bound(best.mass_proof.statement, best.mass_proof.multipliers, np.asarray(mass_limit)))
    assert more.mass_proof.bound == pytest.approx(again, rel=1e-10)
    # that no mass is below 0 is proven by nothing, and counts those beyond any target as well
    ended = replace(best, mass_proof=None, timed_out=True).counting(mass_limit)
    assert (ended.mass_target, ended.mass_proof) == (mass_limit, None)


@pytest.mark.parametrize("seed", range(3))
def test_brute_force_never_beats_the_bracket(seed: int) -> None:
    program = bearings(seed)
    best = optimum_of(program)
    brute = float(np.max(sampled(program, best.point.unbalance)))
    assert brute <= best.goals[-1].value
    assert brute == pytest.approx(best.goals[-1].value, rel=1e-3)


@pytest.mark.parametrize("measure", ["peak", "rms"])
@pytest.mark.parametrize("seed", range(4))
def test_the_least_mass_is_proven(seed: int, measure: str) -> None:
    program = bearings(seed, measure=measure)
    heavy, light = optimum_of(program), optimum_of(program, least_mass=True)
    assert light.mass_proof is not None
    assert not any(optimum.timed_out for optimum in (heavy, light))
    assert light.point.mass <= heavy.point.mass * (1 + 1e-6)
    rest = float(program.yardsticks[0])
    assert light.point.values.goals[-1] - light.goals[-1].lower_bound <= 1e-6 * rest
    assert 0 <= light.point.mass - light.mass_proof.bound <= 1e-4 * light.point.mass


def test_the_root_mean_square_of_one_curve_is_centred() -> None:
    """Analytic: sqrt(V + |mean + u|^2) is smallest, sqrt(V), where u is minus the mean."""
    program = bearings(0, count=1, webs=1, measure="rms", limits=wide(1))
    quantity = program.quantities[0]
    best = optimum_of(program, 1e-9)
    assert best.goals[-1].value == pytest.approx(np.sqrt(quantity.response.variance), rel=1e-9)
    # independent: the mean square of samples
    series = quantity.response.at(ANGLES) + quantity.response.offset(best.point.unbalance)
    assert best.goals[-1].value == pytest.approx(np.sqrt(np.mean(np.abs(series) ** 2)), rel=1e-6)


class Uncertain(FourierCurves):
    """Curves whose mean squares are known to a hundredth of their size."""

    rms_error = np.array([0.01])


def test_what_a_root_mean_square_may_be_off_by_opens_the_gap() -> None:
    """Analytic: what is known to +-0.01 is proven no better than that, and never told smaller than it may be."""
    program = bearings(0, count=1, webs=1, measure="rms", limits=wide(1))
    (quantity,) = program.quantities
    curves = quantity.response.curves
    assert isinstance(curves, FourierCurves)
    response = replace(quantity.response, curves=Uncertain(curves.order, curves.coefficient))
    best = optimum_of(replace(program, quantities=(replace(quantity, response=response),)), 1e-9)
    least = np.sqrt(response.variance)
    assert best.goals[-1].value == pytest.approx(least + 0.01, rel=1e-9)
    assert best.goals[-1].lower_bound == pytest.approx(least - 0.01, rel=1e-9)


@pytest.mark.parametrize("seed", range(2))
def test_root_mean_squares_agree_with_the_modelling_layer(seed: int) -> None:
    """Independent: norms with a component that stays."""
    program = bearings(seed, count=3, webs=2, measure="rms", limits=wide(2))
    best = optimum_of(program)
    u = cp.Variable(2, complex=True)
    norms = [
        cp.norm(cp.hstack([q.spread, cp.abs(q.response.mean + q.response.influence @ u)])) for q in program.quantities
    ]
    expected = cp.Problem(cp.Minimize(cp.max(cp.hstack(norms)))).solve(solver=cp.CLARABEL)
    assert best.goals[-1].value == pytest.approx(expected, rel=1e-6)


def limited(program: Problem, factor: float) -> Problem:
    """Ceilings at a multiple of the smallest largest peak, and force and moment as the goal."""
    least = optimum_of(program).goals[-1].value
    rng = np.random.default_rng(1)
    goal = Goal("external", (force_and_moment(rng, program.limits.radius.size),))
    caps = tuple((q, factor * least) for q in range(len(program.quantities)))
    return replace(program, goals=(goal,), limited=caps)


@pytest.mark.parametrize("seed", range(3))
def test_ceilings_on_bearings_are_kept(seed: int) -> None:
    free = bearings(seed)
    program = limited(free, 1.1)
    best = optimum_of(program, least_mass=True)
    rest = float(program.yardsticks[0])
    assert best.point.values.excess <= CEILING_ROUNDING
    assert np.all(sampled(program, best.point.unbalance) <= [cap * (1 + 1e-12) for _, cap in program.limited])
    assert best.point.values.goals[-1] - best.goals[-1].lower_bound <= 1e-6 * rest
    assert best.mass_proof is not None
    assert 0 <= best.point.mass - best.mass_proof.bound <= 1e-4 * best.point.mass
    # looser ceilings never cost more
    assert optimum_of(limited(free, 2.0)).goals[-1].lower_bound <= best.goals[-1].value


def test_ceilings_below_the_floors_are_out_of_reach() -> None:
    program = bearings(0, limits=wide(6))
    least = max(floor(quantity.response, 1e-9).circle.radius for quantity in program.quantities)
    outcome = over_turn(replace(program, limited=((0, 0.5 * least), (1, 3.0 * least))), 1e-6, True)
    assert isinstance(outcome, Conflict)
    assert outcome.proof.bound > 0
    assert outcome.closest.values.excess >= outcome.proof.bound


def priorities(seed: int, allowance: float) -> tuple[Problem, CertifiedOptimum]:
    rng = np.random.default_rng(seed)
    every = quantities(rng, 3, 4)
    first = Goal("external", (force_and_moment(rng, 4),), allowance=allowance)
    program = Problem(every, (first, Goal("bearings", (largest(0, 3),))), (), (), wide(4, 5.0))
    return program, optimum_of(program, least_mass=True)


@pytest.mark.parametrize("seed", range(3))
def test_goals_are_met_in_their_order(seed: int) -> None:
    program, best = priorities(seed, 1e-3)
    external, carried = best.goals
    alone = optimum_of(program.alone(0))
    assert external.value == pytest.approx(alone.goals[0].value, abs=1e-6 * float(program.yardsticks[0]))
    values = best.point.values.goals
    assert values[0] <= external.most
    assert external.most - external.lower_bound <= 1.001e-3 * program.yardsticks[0]
    assert values[1] - carried.lower_bound <= 1e-6 * program.yardsticks[1]
    # nothing that keeps the first goal is better, and what need not keep it is no worse
    assert optimum_of(program.alone(1)).goals[0].lower_bound <= carried.value
    _, easier = priorities(seed, 0.2)
    assert easier.goals[1].lower_bound <= carried.value
    assert best.mass_proof is not None
    assert 0 <= best.point.mass - best.mass_proof.bound <= 1e-4 * best.point.mass


def test_a_share_of_everything_makes_the_second_goal_the_only_one() -> None:
    program, best = priorities(0, 100.0)
    alone = optimum_of(program.alone(1))
    assert best.goals[1].value == pytest.approx(alone.goals[0].value, abs=2e-6 * float(program.yardsticks[1]))


@pytest.mark.parametrize(("ceiling", "attempts"), [(None, FREELY), (1e3, WITHIN)])
def test_a_solver_that_finds_nothing_is_asked_in_every_way_once(
    ceiling: float | None, attempts: Sequence[Attempt], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Then the point of rest is the answer, with what rest proves."""
    tried: list[Attempt] = []
    monkeypatch.setattr(Search, "_solved", lambda _self, _statement, attempt: tried.append(attempt))
    program = bearings(1)
    if ceiling is not None:
        program = program.changed(limited=tuple((q, ceiling) for q in range(len(program.quantities))))
    best = optimum_of(program)
    assert tuple(tried) == attempts
    assert not np.any(best.point.unbalance)
    assert 0.0 <= best.goals[-1].lower_bound < best.goals[-1].value
