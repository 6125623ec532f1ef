"""The bound is true whatever the multipliers, and sharp for the right ones."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from optimizer.program.certificate import (
    Multipliers,
    affine_minorant,
    best_proof,
    mass_lower_bound,
    objective_lower_bound,
    spread,
)
from tests.program.cases import COMBINATIONS, random_point, random_statement, stacked


def _random_multipliers(rng: np.random.Generator, problem) -> Multipliers:
    terms, rows, ceilings = problem.row.size, problem.floor.size, len(problem.ceilings.names)
    wild = rng.choice([0.1, 1.0, 30.0])
    return Multipliers(
        term=wild * (rng.normal(size=(terms, 2)) @ [1, 1j]),
        row=rng.normal(size=rows) + 0.5,
        ceiling=wild * (rng.normal(size=(ceilings, 2)) @ [1, 1j]) if ceilings else np.zeros(0, complex),
    )


@given(seed=st.integers(0, 10**6), case=st.sampled_from(COMBINATIONS))
def test_bounds_never_exceed_the_value_of_an_admissible_point(seed: int, case: tuple) -> None:
    problem = random_statement(seed, *case)
    rng = np.random.default_rng(seed + 1)
    u = random_point(rng, problem.limits)
    if np.any(problem.ceilings.excess(u) > 0):
        return  # the bound speaks only of points that keep the ceilings
    for _ in range(5):
        multipliers = _random_multipliers(rng, problem)
        objective = float(problem.objective(u))
        assert objective_lower_bound(problem, multipliers) <= objective + 1e-12 * abs(objective)
        price = 10.0 ** rng.uniform(-3, 3)
        bound = mass_lower_bound(problem, multipliers.times(np.asarray(price)), np.asarray(objective))
        assert bound <= float(problem.mass(u)) * (1 + 1e-12)


@given(seed=st.integers(0, 10**6), case=st.sampled_from(COMBINATIONS))
def test_the_best_of_several_proofs_is_the_best_one_by_one(seed: int, case: tuple) -> None:
    problem, rng = random_statement(seed, *case), np.random.default_rng(seed + 1)
    multipliers = [_random_multipliers(rng, problem) for _ in range(4)]
    # what went wrong proves nothing, wherever it stands
    multipliers.insert(int(rng.integers(5)), multipliers[0].times(np.asarray(np.nan)))
    # independent: bound by bound
    single = [float(objective_lower_bound(problem, multiplier)) for multiplier in multipliers]
    bound, proof = best_proof(problem, multipliers)
    assert float(bound) == np.nanmax(single)
    assert objective_lower_bound(problem, proof) == bound


@pytest.mark.parametrize("budget", [False, True])
@pytest.mark.parametrize("seed", range(10))
def test_the_least_over_the_limits_is_the_knapsack(seed: int, budget: bool) -> None:
    # independent: the same linear program by HiGHS, over the mass of each web in its best direction
    rng = np.random.default_rng(seed)
    problem = random_statement(seed, "sum", (1.0, 0.3), True, budget, False, webs=5)
    multipliers = _random_multipliers(rng, problem)
    multipliers = replace(multipliers, row=np.abs(multipliers.row))
    constant, slope, _ = affine_minorant(problem, multipliers)
    limits = problem.limits
    lowest = -limits.radius * limits.support(-slope)
    constraint = {"A_ub": np.ones((1, 5)), "b_ub": [limits.max_total_mass]} if budget else {}
    expected = float(constant) + linprog(lowest, bounds=[(0, m) for m in limits.max_mass], **constraint).fun
    bound = objective_lower_bound(problem, multipliers)
    assert bound == pytest.approx(expected, rel=1e-12, abs=1e-12)
    assert bound <= expected + 1e-15 * abs(expected)


def test_bounds_broadcast_over_designs() -> None:
    """A block of designs gets the bounds that each gets by itself (needed by sweeps)."""
    problems = [random_statement(seed, "max", (1.0, 0.3), True, True, True, webs=4) for seed in range(6)]
    rng = np.random.default_rng(0)
    singles = [_random_multipliers(rng, problem) for problem in problems]
    block = stacked(problems)
    multipliers = Multipliers(*(np.stack([getattr(m, name) for m in singles]) for name in ("term", "row", "ceiling")))
    expected = [objective_lower_bound(p, m) for p, m in zip(problems, singles, strict=True)]
    np.testing.assert_allclose(objective_lower_bound(block, multipliers), expected, rtol=1e-14)
    target = np.full(6, 2.0)
    expected = [mass_lower_bound(p, m, np.asarray(2.0)) for p, m in zip(problems, singles, strict=True)]
    np.testing.assert_allclose(mass_lower_bound(block, multipliers, target), expected, rtol=1e-14)


def test_multipliers_of_zero_prove_nothing() -> None:
    problem = random_statement(0, "sum", (1.0, 1.0), False, False, False)
    zero = Multipliers(np.zeros(2, complex), np.zeros(1), np.zeros(0, complex))
    assert objective_lower_bound(problem, zero) == -np.inf
    assert mass_lower_bound(problem, zero, np.asarray(1.0)) == 0.0


@pytest.mark.parametrize(("term", "ceiling"), [(0.1, 0.0), (0.0, 0.2), (0.1, 0.2), (0.0, 0.0)])
def test_what_is_off_raises_a_bound_by_its_share_of_every_multiplier(term: float, ceiling: float) -> None:
    """Analytic: rows by their share of what a kilogram metre changes in their terms, ceilings by their multipliers."""
    problem = random_statement(2, "max", (1.0, 1.0), False, False, True, webs=3)
    norms = replace(problem.norms, scatter=term)
    limited = replace(problem.ceilings, norms=replace(problem.ceilings.norms, scatter=ceiling))
    multipliers = _random_multipliers(np.random.default_rng(1), problem)
    multipliers = replace(multipliers, row=np.abs(multipliers.row))
    rows = multipliers.row[problem.row][:, None] * np.abs(norms.influence)
    priced = np.abs(multipliers.ceiling)[:, None] * np.abs(limited.norms.influence)
    expected = term * rows.sum(axis=0) + ceiling * priced.sum(axis=0)
    actual_spread = np.asarray(spread(replace(problem, norms=norms, ceilings=limited), multipliers))
    assert np.all(actual_spread <= expected)
    np.testing.assert_allclose(np.broadcast_to(actual_spread, 3), expected, rtol=1e-13)


@pytest.mark.parametrize("factor", [2.0**-40, 2.0**40])
def test_a_bound_has_the_unit_of_its_objective(factor: float) -> None:
    """Property, to the last bit: also of webs that can hardly be told apart, whose limits are far away."""
    problem = random_statement(3, "sum", (1.0, 1.0), False, False, False, webs=2)
    near = problem.norms.influence[:, :1] * np.array([1.0, 1.0 + 1e-9])
    limits = replace(problem.limits, max_mass=np.array([1e12, 1e12]))
    problem = replace(problem, norms=replace(problem.norms, influence=near), limits=limits)
    # those with which neither web gains anything but by rounding
    term = np.conj(np.array([near[1, 0], -near[0, 0]])) if near.shape[0] == 2 else np.zeros(near.shape[0], complex)
    # complex, as all are: of real ones the loop would be compiled and kept once more
    term = (term / np.max(np.abs(term))).astype(complex)
    multipliers = Multipliers(term, np.ones(problem.floor.size), np.zeros(0, complex))
    bigger = replace(
        problem,
        norms=replace(problem.norms, constant=problem.norms.constant * factor, influence=near * factor),
        floor=problem.floor * factor,
    )
    assert objective_lower_bound(bigger, multipliers) == factor * objective_lower_bound(problem, multipliers)
