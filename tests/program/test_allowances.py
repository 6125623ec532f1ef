"""What bounds give up, and what they are priced at, from multipliers that are put down by hand or by chance."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.mechanics.angles import direction
from optimizer.program.certificate import (
    Multipliers,
    affine_minorant,
    budget_price,
    ceiling_allowance,
    mass_bound_up_to,
    mass_lower_bound,
    nothing_proven,
    objective_lower_bound,
    tolerance_allowance,
)
from optimizer.program.limits import Limits
from tests.program.cases import random_point
from tests.program.test_leading_axes import KINDS, _multipliers, _program


def test_a_sector_opens_by_what_its_support_grows() -> None:
    """Independent: differences of the support over the half-angle, where no edge is passed."""
    ones, step = np.ones(1), 1e-6
    grown = 0
    for half in (10.0, 45.0, 80.0):
        for angle in range(0, 360, 7):
            g, supports = 1.7 * direction(np.array([float(angle)])), []
            for moved in (-step, 0.0, step):
                edge = np.exp(1j * (np.deg2rad(half) + moved)) * ones
                limits = Limits(ones, ones, ones < 0, direction(25.0) * ones, edge.real, edge.imag, np.asarray(np.inf))
                supports.append(float(limits.support(g)[0]))
                opening = float(limits.opening(g)[0]) if moved == 0.0 else 0.0
                if moved == 0.0:
                    derivative = opening
            low, high = (supports[1] - supports[0]) / step, (supports[2] - supports[1]) / step
            if abs(low - high) < 1e-4:
                assert derivative == pytest.approx(0.5 * (low + high), abs=1e-5)
                grown += derivative > 0.01
    assert grown > 20
    free = Limits(np.ones(2), np.ones(2), np.array([True, False]), np.ones(2) + 0j, np.zeros(2) + 0.8, np.ones(2) * 0.6,
                  np.asarray(np.inf))  # fmt: skip
    # analytic: at 60 degrees the edge at 36.87 degrees is left by 23.13
    derivative = free.opening(2.0 * direction(np.array([60.0, 60.0])))
    assert derivative == pytest.approx([0.0, 2.0 * np.sin(np.deg2rad(60.0 - np.rad2deg(np.arctan2(0.6, 0.8))))])


@pytest.mark.parametrize("kind", ["ceiling", "group, sector, budget, ceiling, scatter"])
def test_a_bound_falls_by_its_allowance_where_ceilings_are_exceeded(kind: str) -> None:
    """Independent: the bound under ceilings that are so much higher."""
    program = _program(3, kind)
    proof = _multipliers(3, program)
    size = program.ceilings.size
    excess = np.array([0.2, -0.3])
    higher = replace(program.ceilings, cap=program.ceilings.cap + np.maximum(excess, 0.0) * size)
    allowance = ceiling_allowance(program, proof, excess)
    assert allowance > 0.0
    bound = objective_lower_bound(program, proof)
    assert objective_lower_bound(replace(program, ceilings=higher), proof) == pytest.approx(
        bound - allowance, rel=1e-12
    )
    assert ceiling_allowance(program, proof, np.array([0.0, -1.0])) == 0.0
    assert ceiling_allowance(program, nothing_proven(program), excess) == 0.0
    # analytic: all that counts as keeping them exceeds them by their tolerance
    tolerance = np.sum(np.abs(proof.ceiling) * 1e-9 * size)
    assert tolerance_allowance(program, proof) == pytest.approx(tolerance, rel=1e-13)


@pytest.mark.parametrize("cost", [0.0, 1.0])
@pytest.mark.parametrize("seed", range(6))
def test_the_budget_has_the_price_at_which_webs_are_filled(seed: int, cost: float) -> None:
    """Analytic: with it, what all webs gain is as much as in falling order of their gain."""
    program = _program(seed, "sector, budget")
    proof = _multipliers(seed, program).times(np.asarray(20.0)).admissible(program)
    price = float(budget_price(program, proof, cost))
    limits = program.limits
    slope = np.sum(np.conj(program.norms.influence) * proof.term[:, None], axis=0)
    gain = limits.radius * limits.support(-slope) - cost
    masses, last = limits.spent(np.maximum(gain, 0.0))
    assert price == pytest.approx(float(last), rel=1e-9)
    priced = np.sum(limits.max_mass * np.maximum(gain - price, 0.0)) + price * limits.max_total_mass
    assert priced == pytest.approx(np.sum(masses * np.maximum(gain, 0.0)), rel=1e-9)
    free = replace(program, limits=replace(limits, max_total_mass=np.asarray(np.inf)))
    assert budget_price(free, proof, cost) == 0.0


@pytest.mark.parametrize("kind", KINDS)
def test_a_minorant_is_below_the_objective_of_all_that_keep_the_ceilings(kind: str) -> None:
    for seed in range(6):
        program = _program(seed, kind)
        proof = _multipliers(seed, program)
        constant, slope, rounding = affine_minorant(program, proof)
        above = []
        for n in range(20):
            u = 0.2 * n / 20 * random_point(np.random.default_rng(n), program.limits)
            if np.all(program.ceilings.excess(u) <= 1e-9):
                response = constant + np.sum((np.conj(slope) * u).real)
                # counterweights that scatter raise the objective by more
                above.append(program.objective(u) - response + np.sum(rounding * np.abs(u)))
        assert min(above, default=0.0) >= -1e-12
    nothing, _, _ = affine_minorant(program, nothing_proven(program))
    assert nothing == -np.inf


def test_a_minorant_without_sectors_and_budget_is_what_the_bound_is_made_of() -> None:
    """Analytic: it falls by the size of its slope on every web, as far as that reaches."""
    program = _program(1, "plain")
    proof = _multipliers(1, program)
    constant, slope, _ = affine_minorant(program, proof)
    bound = constant - np.sum(np.abs(slope) * program.limits.radius * program.limits.max_mass)
    assert objective_lower_bound(program, proof) == pytest.approx(bound, rel=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_a_bound_on_the_mass_is_its_minorant_at_a_target(kind: str) -> None:
    """Independent: the knapsack over masses by a sort; no price makes it less than nothing."""
    program = _program(6, kind)
    proof = _multipliers(6, program).times(np.asarray(5.0))
    target = program.at_rest
    bound = float(mass_lower_bound(program, proof, target))
    assert bound >= 0.0
    usable = proof.admissible(program)
    norms, ceilings, limits = program.norms, program.ceilings, program.limits
    fixed = np.sum(usable.row * program.floor) + np.sum((np.conj(usable.term) * norms.constant).real)
    slope = np.sum(np.conj(norms.influence) * usable.term[:, None], axis=0)
    fixed += np.sum(
        (np.conj(usable.ceiling) * ceilings.norms.constant).real - np.abs(usable.ceiling) * ceilings.tolerant_cap
    )
    slope = slope + np.sum(np.conj(ceilings.norms.influence) * usable.ceiling[:, None], axis=0)
    wide = norms.scatter * np.sum(usable.row[program.row][:, None] * np.abs(norms.influence), axis=0)
    gain = limits.radius * (limits.support(-slope) - wide) - 1.0
    left, gained = float(limits.max_total_mass), 0.0
    for k in np.argsort(-gain):
        mass = min(limits.max_mass[k], left)
        gained, left = gained + max(gain[k], 0.0) * mass, left - mass
    assert bound == pytest.approx(max(fixed - usable.price(program) * target - gained, 0.0), rel=1e-9, abs=1e-9)


def test_a_bound_on_the_mass_falls_with_what_is_allowed() -> None:
    """Analytic."""
    assert mass_bound_up_to(np.asarray(3.0), np.asarray(0.5), np.asarray(2.0)) == pytest.approx(2.0, rel=1e-13)
    assert mass_bound_up_to(np.asarray(3.0), np.asarray(0.5), np.asarray(2.0)) <= 2.0
    assert mass_bound_up_to(np.asarray(0.5), np.asarray(1.0), np.asarray(2.0)) == 0.0


@pytest.mark.parametrize("kind", KINDS)
def test_admissible_multipliers_are_what_they_have_to_be(kind: str) -> None:
    """Property: of one sum in every group, no term above its row; those that are so already stay."""
    program = _program(9, kind)
    usable = _multipliers(9, program).admissible(program)
    sums = [np.sum(usable.row[program.group == group]) for group in range(program.group[-1] + 1)]
    assert np.all(usable.row >= 0.0)
    assert sums == pytest.approx([sums[0]] * len(sums), rel=1e-14)
    assert usable.price(program) == pytest.approx(sums[0], rel=1e-14)
    assert np.all(np.abs(usable.term) <= usable.row[program.row] * (1.0 + 1e-14))
    if any(program.norms.scalar):
        assert np.all(usable.term[np.array(program.norms.scalar)].imag == 0.0)
    again = usable.admissible(program)
    for multiplier, second_multiplier in zip(vars(again).values(), vars(usable).values(), strict=True):
        np.testing.assert_allclose(multiplier, second_multiplier, rtol=1e-14)
    doubled = usable.times(np.asarray(2.0))
    assert doubled.price(program) == pytest.approx(2.0 * sums[0])


def test_the_smallest_multipliers_divide_nothing() -> None:
    """Analytic: a term below its row stays as it is, however small; no quotient overflows."""
    program = _program(9, "ceiling")
    proof = _multipliers(9, program)
    tiny = replace(proof, term=np.full(proof.term.shape, 1e-310 + 0j), row=np.ones(proof.row.shape))
    np.testing.assert_array_equal(tiny.admissible(program).term, tiny.term)


def test_multipliers_of_some_programs_are_put_in_the_place_of_others() -> None:
    programs = [_program(seed, "ceiling") for seed in range(3)]
    every = Multipliers(*(np.stack(parts) for parts in zip(
        *(vars(_multipliers(n, program)).values() for n, program in enumerate(programs)), strict=True)))  # fmt: skip
    variants = [np.copy(part) for part in vars(every).values()]
    every.put(np.array([0, 2]), every.subset(np.array([1, 1])))
    for part, before in zip(vars(every).values(), variants, strict=True):
        np.testing.assert_array_equal(part, before[[1, 1, 1]])
