"""Loops prove, evaluate and settle what arrays do, of programs of every kind (independent: ``in_arrays``)."""

from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from optimizer.numerics.arrays import Complex, mapped
from optimizer.program.certificate import Multipliers, mass_lower_bound, objective_lower_bound
from optimizer.program.methods.rounding import snap_to_limits
from optimizer.program.norms import Norms
from optimizer.program.points import points_at
from optimizer.program.statement import Statement
from tests.program import in_arrays
from tests.program.cases import random_point
from tests.program.test_alike import alike
from tests.program.test_leading_axes import WEBS, _multipliers, _program

#: real or complex, limits and terms of all kinds, webs that are alike
_ALIKE = (None, ((0, 0, 2, 2), (False, True, False, False)), ((3, 1, 3, 3), (False, False, True, False)))
KINDS = st.tuples(
    st.booleans(),
    st.sets(st.sampled_from(["sector", "budget", "ceiling", "group", "scatter", "scalar"])),
    st.sampled_from(_ALIKE),
)


def program(seed: int, kind: tuple[bool, set[str], Any]) -> Statement:
    turned, words, webs = kind
    statement, rng = _program(seed, ", ".join(sorted(words))), np.random.default_rng(seed)

    def moved(norms: Norms, share: float) -> Norms:
        off = np.exp(2j * np.pi * rng.random(norms.influence.shape)) if turned else 1.0
        return replace(norms, influence=norms.influence * off, scatter=share)

    share = 0.05 * ("scatter" in words)
    limits = statement.limits
    if webs is not None:
        leader = list(webs[0])
        carried = alike(*webs, seed)
        # what is alike has the same limits, sectors turned with it
        first = limits.centre[leader]
        centre = carried.turn * np.where(webs[1], np.conj(first), first)
        of_first = {name: getattr(limits, name)[leader] for name in ("radius", "max_mass", "free")}
        edge = {name: getattr(limits, name)[leader] for name in ("half_angle_cos", "half_angle_sin")}
        centre = np.where(of_first["free"], 1.0 + 0j, centre)
        limits = replace(limits, **of_first, **edge, centre=centre, alike=carried)
    ceilings = replace(statement.ceilings, norms=moved(statement.ceilings.norms, share))
    return replace(statement, norms=moved(statement.norms, 2 * share), ceilings=ceilings, limits=limits)


def _rest(statement: Statement, multipliers: Multipliers) -> float:
    """What a bound may be off by: a share of all that it is a sum of."""
    size = np.sum(np.abs(multipliers.term)) + np.sum(np.abs(multipliers.ceiling)) + np.sum(np.abs(multipliers.row))
    return float(
        (1.0 + np.max(statement.floor)) * size
        + np.sum(in_arrays.size_of_slopes(statement, multipliers) * statement.limits.reach)
    )


@given(seed=st.integers(0, 10**6), kind=KINDS)
def test_loops_prove_what_arrays_prove(seed: int, kind: Any) -> None:
    """To rounding, and never more."""
    statement, rng = program(seed, kind), np.random.default_rng(seed + 1)
    multipliers = _multipliers(seed, statement).times(np.asarray(rng.choice([0.1, 1.0, 30.0])))
    price = float(multipliers.admissible(statement).price(statement))
    assume(price > 1e-3)
    rest, target = _rest(statement, multipliers), float(rng.uniform(0.0, 3.0))
    bound, expected = objective_lower_bound(statement, multipliers), in_arrays.objective_bound(statement, multipliers)
    assert expected - 1e-13 * rest / price <= bound <= expected
    bound, expected = (
        mass_lower_bound(statement, multipliers, np.asarray(target)),
        in_arrays.mass_bound(statement, multipliers, target),
    )
    assert expected - 1e-13 * (rest + price * target) <= bound <= expected


@given(seed=st.integers(0, 10**6), kind=KINDS, power=st.floats(3.0, 9.0))
def test_webs_that_can_hardly_be_told_apart_are_summed_in_finer_numbers(seed: int, kind: Any, power: float) -> None:
    """Slopes that cancel, and limits that are far away: the bound is off by what the data are, and never above."""
    statement, rng = program(seed, kind), np.random.default_rng(seed + 1)
    near = statement.norms.influence[:, :1] * (1.0 + 10.0**-power * rng.normal(size=WEBS))
    variant = replace(
        statement,
        norms=replace(statement.norms, influence=near),
        limits=replace(statement.limits, max_mass=np.full(WEBS, 1e9), max_total_mass=np.asarray(np.inf)),
    )
    proof = _multipliers(seed, variant)
    # what the webs have in common is taken out of the terms
    common = np.conj(near[:, 0])
    row = np.full(variant.floor.size, 10.0)
    term = proof.term - np.conj(common) * (common @ proof.term) / np.sum(np.abs(common) ** 2)
    multipliers = replace(proof, row=row, term=term, ceiling=0.0 * proof.ceiling)
    rest = float(np.sum(in_arrays.size_of_slopes(variant, multipliers) * variant.limits.reach))
    bound, expected = objective_lower_bound(variant, multipliers), in_arrays.objective_bound(variant, multipliers)
    price = float(multipliers.admissible(variant).price(variant))
    assert expected - 1e-14 * rest / price - 1e-12 * (1.0 + abs(expected)) <= bound <= expected


@given(seed=st.integers(0, 10**6), kind=KINDS)
def test_loops_evaluate_what_arrays_do(seed: int, kind: Any) -> None:
    statement, rng = program(seed, kind), np.random.default_rng(seed)
    u = np.array([random_point(rng, statement.limits) for _ in range(3)])
    for point, second_point in zip(points_at(statement, u)[1:], in_arrays.points(statement, u), strict=True):
        np.testing.assert_allclose(point, second_point, rtol=1e-13, atol=1e-13)
    far = 3.0 * u + 0.1j
    np.testing.assert_allclose(
        statement.limits.into(far), in_arrays.into(statement.limits, far), rtol=1e-13, atol=1e-14
    )


@given(seed=st.integers(0, 10**6), kind=KINDS)
def test_loops_settle_what_arrays_settle(seed: int, kind: Any) -> None:
    statement, rng = program(seed, kind), np.random.default_rng(seed)
    limits = statement.limits
    first = np.arange(WEBS) if limits.alike is None else np.array(limits.alike.leader)
    # next to limits, next to nothing, and between; not at limits, where rounding would decide as well
    share = rng.choice([1e-9, 1e-7, 1e-5, 0.5, 1.0 - 1e-9, 1.0 - 1e-5], WEBS)[first]
    off = rng.choice([-1.0 + 1e-9, 0.2, 1.0 - 1e-5], WEBS)[first]
    across = off * np.arctan2(limits.half_angle_sin, limits.half_angle_cos)
    u: Complex = limits.into(share * limits.reach * limits.centre * np.exp(1j * across))
    expected = in_arrays.near_limits(statement, u, 1e-4, 1e-4)
    alone = statement.alone()
    free = replace(alone, ceilings=replace(alone.ceilings, cap=alone.ceilings.cap + 1e9))
    # whatever it comes to, it is taken
    points = snap_to_limits(free, points_at(free, u[None]), np.array([1e9]), np.array([1e9]))
    np.testing.assert_allclose(points.unbalance[0], expected, rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize(("turned", "webs"), tuple(product((False, True), _ALIKE)))
def test_programs_may_share_limits_and_proofs(turned: bool, webs: Any) -> None:
    """Property: programs of one set of limits, and one proof of many programs, as each alone, to the last bit."""
    statement = program(3, (turned, {"sector", "budget", "ceiling", "group", "scatter"}, webs))
    about = statement.about(np.array([random_point(np.random.default_rng(n), statement.limits) for n in range(3)]))
    proof, target = _multipliers(1, statement), np.asarray(2.0)
    bounds, masses = objective_lower_bound(about, proof), mass_lower_bound(about, proof, target)
    assert bounds.shape == masses.shape == (3,)
    for n in range(3):
        alone = replace(about, floor=about.floor[n], norms=mapped(about.norms, lambda array: array[n]))  # noqa: B023
        alone = replace(alone, ceilings=mapped(about.ceilings, lambda array: array[n]))  # noqa: B023
        assert bounds[n] == objective_lower_bound(alone, proof)
        assert masses[n] == mass_lower_bound(alone, proof, target)
