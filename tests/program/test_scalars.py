"""Quantities over the turn that are one number at every angle, and counterweights that turn as the curve sees them."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import objective_lower_bound
from optimizer.program.cuts.cut import EXACT, Quantity, Scatter
from optimizer.program.cuts.dominance import Group, Weighed
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict, over_turn
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.methods.implied_bounds import bounded
from optimizer.responses.curve import TurnResponse
from tests.program.cases import random_limits, random_point
from tests.program.turning import wide
from tests.responses.fourier import FourierCurves

#: 1 degree
ANGLES = np.deg2rad(np.arange(0.0, 360.0, 1.0))


def quantity(rng: np.random.Generator, turning: Real, scalar: bool, name: str) -> Quantity:
    """A curve of orders up to 4, and webs that answer out of line with themselves and turn."""
    orders = np.arange(-4.0, 5.0)
    coefficient = rng.normal(size=(9, 2)) @ [1, 1j]
    if scalar:
        coefficient = coefficient + np.conj(coefficient[::-1])
    influence = rng.normal(size=(turning.size, 2)) @ [1, 1j]
    curves = FourierCurves(orders, coefficient[None])
    return Quantity(TurnResponse(name, "N m", influence, curves, 0, turning, scalar))


def program(seed: int, beside: bool = True, binding: bool = True) -> Problem:
    """A scalar, and beside it a vector, of six webs."""
    rng = np.random.default_rng(seed)
    turning = rng.choice([-2.0, -1.0, 0.0, 1.0, 2.0], 6)
    every = [quantity(rng, turning, True, "roll"), quantity(rng, turning, False, "force")][: 1 + beside]
    limits = random_limits(rng, 6, bool(seed % 2), bool(seed // 2 % 2)) if binding else wide(6)
    groups = tuple(Group(weighed=(Weighed(q, 1.0 + q),)) for q in range(len(every)))
    return Problem(tuple(every), (Goal("all", groups),), (), (), limits)


def sampled(of: Quantity, u: Complex) -> float:
    """The peak at 360 angles, from the definition."""
    response = of.response
    turned = np.exp(1j * ANGLES[:, None] * response.turning) * response.influence
    values = response.at(ANGLES) + turned @ u
    return float(np.max(np.abs(values.real if response.scalar else values)))


@pytest.mark.parametrize("seed", range(3))
def test_the_optimum_of_a_scalar_is_that_of_a_linear_program(seed: int) -> None:
    """Independent: |Re d + Re(h u)| <= t at 360 angles and no limits that bind, by scipy's simplex."""
    problem = program(seed, beside=False, binding=False)
    best = over_turn(problem, 1e-6, False)
    assert isinstance(best, CertifiedOptimum)
    response = problem.quantities[0].response
    turned = np.exp(1j * ANGLES[:, None] * response.turning) * response.influence
    rows, constant = np.hstack([turned.real, -turned.imag]), response.at(ANGLES).real
    above = np.vstack([np.hstack([sign * rows, -np.ones((ANGLES.size, 1))]) for sign in (1.0, -1.0)])
    cost = np.append(np.zeros(12), 1.0)
    free = [(None, None)] * 12 + [(0.0, None)]
    expected = linprog(cost, A_ub=above, b_ub=np.concatenate([-constant, constant]), bounds=free).fun
    rest = float(problem.yardsticks[0])
    assert best.goals[-1].value - best.goals[-1].lower_bound <= 1e-6 * rest
    # angles between cost at most (h/2)^2/2 of the curvature of order 4
    assert expected - 1e-6 * rest <= best.goals[-1].value <= expected + 7e-4 * rest


@settings(max_examples=5, deadline=None)
@given(seed=st.integers(0, 10**6), least_mass=st.booleans())
def test_bounds_are_never_above_what_another_point_comes_to(seed: int, least_mass: bool) -> None:
    problem = program(seed)
    best = over_turn(problem, 1e-5, least_mass)
    assert isinstance(best, CertifiedOptimum)
    rng = np.random.default_rng(seed + 1)
    rest = float(problem.yardsticks[0])
    for scale in (0.0, 1e-3, 0.1, 1.0):
        point = random_point(rng, problem.limits)
        u = problem.limits.into(best.point.unbalance + scale * (point - best.point.unbalance))
        weighed = sum((1.0 + q) * sampled(problem_quantity, u) for q, problem_quantity in enumerate(problem.quantities))
        assert best.goals[-1].lower_bound <= weighed + 4e-3 * rest
        brackets = problem.values(u, 1e-9)
        assert best.goals[-1].lower_bound <= float(brackets.goals[0]) * (1.0 + 1e-12)
        assert weighed <= float(brackets.goals[0]) * (1.0 + 1e-9)
        assert float(brackets.goals[0]) <= weighed + 8e-3 * rest


@pytest.mark.parametrize("seed", range(2))
def test_a_ceiling_on_a_scalar_is_kept_and_proven(seed: int) -> None:
    """A little above the smallest peak it is kept, and costs no less than the bound; below it, it is out of reach."""
    free = over_turn(program(seed, beside=False), 1e-7, False)
    assert isinstance(free, CertifiedOptimum)
    least, problem = free.goals[-1], program(seed)
    goals = (Goal("force", (Group(weighed=(Weighed(1, 1.0),)),)),)
    optimum = over_turn(replace(problem, goals=goals, limited=((0, 1.2 * least.value),)), 1e-6, True)
    assert isinstance(optimum, CertifiedOptimum)
    assert sampled(problem.quantities[0], optimum.point.unbalance) <= 1.2 * least.value * (1.0 + 1e-9)
    assert optimum.goals[-1].value - optimum.goals[-1].lower_bound <= 1e-6 * float(problem.alone(0).yardsticks[0])
    below = over_turn(replace(problem, goals=goals, limited=((0, 0.999 * least.lower_bound),)), 1e-6, True)
    assert isinstance(below, Conflict)


def test_multipliers_that_are_not_real_prove_no_more() -> None:
    """Whatever is given as multipliers: of a scalar the real part counts."""
    rng = np.random.default_rng(4)
    problem = program(5, beside=False)
    posed = problem.outer(problem.first)
    best = over_turn(problem, 1e-6, False)
    assert isinstance(best, CertifiedOptimum)
    for _ in range(20):
        multipliers = replace(
            best.proof.multipliers, term=best.proof.multipliers.row * np.exp(2j * np.pi * rng.uniform())
        )
        if multipliers.term.size == posed.row.size:
            assert objective_lower_bound(posed, multipliers) <= best.goals[-1].value
        assert objective_lower_bound(best.proof.statement, multipliers) <= best.goals[-1].value


@pytest.mark.parametrize("scalar", [False, True])
@pytest.mark.parametrize("scatter", [EXACT, Scatter(0.1, 0.01)])
def test_a_peak_is_no_less_than_its_harmonics(scalar: bool, scatter: Scatter) -> None:
    rng = np.random.default_rng(8)
    turning = np.array([-2.0, -1.0, 0.0, 1.0, 2.0, 2.0])
    of = quantity(rng, turning, scalar, "any")
    cuts = of.harmonics(sampled(of, np.zeros(6, complex)) * 1.001)
    assert len(cuts) == 5
    for _ in range(20):
        u = (rng.normal(size=(6, 2)) @ [1, 1j]) * 10.0 ** rng.uniform(-1, 3)
        peak = sampled(of, u) * 1.001 + scatter.of(of.response.influence, u)
        assert max(cut.at(u, scatter) for cut in cuts) <= peak


@pytest.mark.parametrize("seed", range(2))
def test_webs_without_a_limit_reach_all_that_is_no_worse(seed: int) -> None:
    """One web for each speed, so that another unbalance is another curve: what is no larger has no more mass."""
    rng = np.random.default_rng(seed)
    turning = np.array([0.0, 1.0, -2.0, -1.0])
    # of a scalar c_n and conj(c_-n) are one
    every = (quantity(rng, turning, False, "force"), quantity(rng, turning[1:3], True, "roll"))
    of = every[seed % 2]
    webs = of.response.influence.size
    limits = replace(wide(webs), max_mass=np.full(webs, np.inf))
    problem = Problem((of,), (Goal("all", (Group(weighed=(Weighed(0, 1.0),)),)),), (), (), limits)
    rest = float(problem.yardsticks[0])
    reach = bounded(problem.outer(problem.telling), 2.0 * rest).limits.max_mass
    assert np.all(np.isfinite(reach))
    for _ in range(8):
        u = rng.normal(size=(webs, 2)) @ [1, 1j]
        low, high = 0.0, 1e3
        for _ in range(12):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if sampled(of, middle * u) <= 2.0 * rest else (low, middle)
        assert np.all(np.abs(low * u) / limits.radius <= reach)
