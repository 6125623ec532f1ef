"""Loops bring proofs into units and tell what a program is the size of as arrays do (independent), of every kind."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.program.certificate import normalised
from optimizer.program.misplacement import worst_by_angle, worst_by_mass, worst_objectives
from optimizer.program.verdict import mass_resolution
from optimizer.solve.proof import physical
from tests.program.cases import random_point
from tests.program.test_leading_axes import _multipliers
from tests.program.test_loops import KINDS, program

SEEDS = st.integers(0, 10_000)
SQUARE = 7.0  # of omega


@given(SEEDS, KINDS)
def test_printed_multipliers_are_admissible_and_of_price_1(seed: int, kind: tuple[bool, set[str], None]) -> None:
    statement = program(seed, kind)
    printed = physical(statement, _multipliers(seed, statement), "objective", SQUARE)
    usable, scale = normalised(statement, _multipliers(seed, statement))
    assert scale
    assert np.all(np.abs(printed.term) <= printed.row[statement.row])
    for name in ("term", "row", "ceiling"):
        assert getattr(printed, name) == pytest.approx(getattr(usable, name), rel=1e-12, abs=1e-14)


@given(SEEDS, KINDS)
def test_multipliers_of_a_mass_are_per_newton(seed: int, kind: tuple[bool, set[str], None]) -> None:
    statement, per_newton = program(seed, kind), np.asarray(1.0 / SQUARE)
    multipliers = _multipliers(seed, statement)
    printed, usable = (
        physical(statement, multipliers, "mass", SQUARE),
        multipliers.admissible(statement).times(per_newton),
    )
    for name in ("term", "row", "ceiling"):
        assert getattr(printed, name) == pytest.approx(getattr(usable, name), rel=1e-12, abs=1e-14)


@given(SEEDS, KINDS)
def test_reach_and_resolution_are_those_of_arrays(seed: int, kind: tuple[bool, set[str], None]) -> None:
    statement = program(seed, kind)
    does = np.abs(statement.every_influence)
    assert float(statement.single_reach) == pytest.approx(
        np.max(np.abs(statement.every_constant) / np.max(does, axis=-1))
    )
    # a row and a ceiling, in kilograms at the web where one does most
    radius = np.where(statement.limits.most > 0, statement.limits.radius, 0.0)
    of_rows = statement.membership @ (np.abs(statement.norms.influence) * radius)
    of_ceilings = np.abs(statement.ceilings.norms.influence) * radius
    sizes = np.append(np.full(len(of_rows), 3.0), statement.ceilings.size)
    least = np.min(sizes / np.max(np.concatenate([of_rows, of_ceilings]), axis=-1))
    assert float(mass_resolution(statement, np.array([3.0]))) == pytest.approx(1e-5 * least)


@given(SEEDS, KINDS)
def test_worst_objectives_are_those_of_the_worst_terms(seed: int, kind: tuple[bool, set[str], None]) -> None:
    statement = program(seed, kind)
    u = random_point(np.random.default_rng(seed), statement.limits)
    as_it_is, by_angle, by_mass = worst_objectives(statement, u, 0.1, 0.2)
    assert float(as_it_is) == pytest.approx(float(statement.objective_of(np.abs(statement.norms.at(u)))), rel=1e-12)
    assert float(by_mass) == pytest.approx(
        float(statement.objective_of(worst_by_mass(statement.norms, u, 0.2))), rel=1e-12
    )
    if not any(statement.norms.scalar):
        terms = worst_by_angle(statement.norms, u, 0.1)
        assert float(by_angle) == pytest.approx(float(statement.objective_of(terms)), rel=1e-12)
