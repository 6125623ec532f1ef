"""No dust, and limits to the last digit; analytic unless said otherwise."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.numerics.arrays import Complex
from optimizer.program.limits import Limits
from optimizer.program.methods.rounding import snap_to_limits
from optimizer.program.points import points_at
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.solution import ConeSolution
from optimizer.program.statement import Statement
from optimizer.responses.response import Phasors, Response
from tests.program.cases import COMBINATIONS, optimum, random_statement, stacked


def in_planes(places: list[float], max_mass: float = 10.0, half_angle: float | None = None) -> Statement:
    """Force and couple of webs at a radius of 1 m, unit unbalances without counterweights at 0 degrees."""
    webs, free = len(places), half_angle is None
    angle = np.radians(90.0 if half_angle is None else half_angle)
    limits = Limits(
        radius=np.ones(webs),
        max_mass=np.full(webs, max_mass),
        free=np.full(webs, free),
        centre=np.full(webs, 1.0 if free else -1.0, complex),
        half_angle_cos=np.full(webs, np.cos(angle)),
        half_angle_sin=np.full(webs, np.sin(angle)),
        max_total_mass=np.asarray(np.inf),
    )
    force = Response("force", "N", Phasors(np.array(5.0 + 0j), np.array(0j)), np.ones(webs))
    moment = Response("moment", "N m", Phasors(np.array(1.0 + 0j), np.array(0j)), np.array(places))
    peaks = [weighted_peak(force, 1.0), weighted_peak(moment, 1.0)]
    return statement(combined(peaks, "sum"), [], limits)


def once(program: Statement, u: Complex, target: float | None = None, mass_bound: float | None = None) -> Complex:
    alone = program.alone()
    points = points_at(alone, u[None].astype(complex))
    most = points.objective if target is None else np.array([target])
    return snap_to_limits(alone, points, most, None if mass_bound is None else np.array([mass_bound])).unbalance[0]


def test_dust_goes_and_the_others_make_up_for_it() -> None:
    """Force and couple of 1e-6 at 0.3 m, by two webs at -1 and 1 m: shares (1 -+ 0.3)/2 of it."""
    program = in_planes([-1.0, 1.0, 0.3])
    variant = once(program, np.array([-2.0, -2.5, 1e-6j]))
    assert variant[2] == 0.0
    np.testing.assert_allclose(variant[:2], [-2.0 + 0.35e-6j, -2.5 + 0.65e-6j], rtol=0, atol=1e-15)


def test_a_mass_next_to_its_limit_is_the_limit() -> None:
    program = in_planes([-1.0, 1.0, 0.3], max_mass=2.0)
    variant = once(program, np.array([-1.0, -2.0 * (1 - 1e-7), -1.5]))
    assert variant[1] == -2.0
    assert program.objective(variant) == pytest.approx(
        program.objective(np.array([-1.0, -2.0 * (1 - 1e-7), -1.5])), abs=1e-15
    )


def test_an_angle_next_to_the_edge_is_the_edge() -> None:
    edge = -np.exp(1j * np.radians(30.0))
    program = in_planes([-1.0, 1.0, 0.3], half_angle=30.0)
    variant = once(program, np.array([-1.0, 2.0 * edge * np.exp(-1e-9j), -1.5]))
    assert abs(np.imag(variant[1] / edge)) <= 1e-15
    assert abs(variant[1]) == pytest.approx(2.0, abs=1e-8)


def test_what_the_objective_needs_stays() -> None:
    """Two webs at limits: nothing makes up for the third, small as it is, and the objective has no room."""
    program = in_planes([-1.0, 1.0, 0.3], max_mass=2.0)
    u = np.array([-2.0, -2.0, -1e-6 + 0j])
    np.testing.assert_array_equal(once(program, u), u)
    # with room for it, it goes
    np.testing.assert_array_equal(once(program, u, target=float(program.objective(u)) + 1e-5), [-2.0, -2.0, 0.0])


def test_nothing_gets_heavier_than_its_bound_allows() -> None:
    program = in_planes([0.0, 0.0], max_mass=2.0)
    u = np.array([-2.0 * (1 - 1e-5), -1.0 + 0j])
    # one response of two rows that are alike for both webs: what one takes over the other gives, at the same mass
    np.testing.assert_allclose(once(program, u, mass_bound=2.99998), [-2.0, -1.0 + 2e-5], atol=1e-15)
    only = in_planes([0.0], max_mass=2.0)
    values = np.array([-2.0 * (1 - 0.9e-5) + 0j])
    assert once(only, values, mass_bound=2.0 * (1 - 1.1e-5)) == values
    assert once(only, values, mass_bound=2.0 * (1 - 0.9e-5)) == pytest.approx(-2.0, abs=1e-15)


@given(st.integers(0, 10**6), st.sampled_from(COMBINATIONS))
def test_answers_stay_optima(seed: int, kind: tuple[Any, ...]) -> None:
    """Limits, objective and mass as they are proven, whatever was settled."""
    program = random_statement(seed, *kind)
    solution = optimum(program, 1e-6, True)
    assert isinstance(solution, ConeSolution)
    assert np.all(np.abs(solution.unbalance) <= program.limits.reach * (1 + 1e-15))
    assert solution.gap <= 1e-6 * float(program.at_rest) * (1 + 1e-6)
    assert solution.mass - solution.mass_lower_bound <= 1e-4 * solution.mass
    again = once(program, solution.unbalance, solution.mass_target, solution.mass_lower_bound)
    assert program.objective(again) <= solution.mass_target + program.rounding(again)


@given(st.lists(st.integers(0, 10**6), min_size=2, max_size=5, unique=True))
def test_none_knows_its_neighbours(seeds: list[int]) -> None:
    """Points in a batch, some of which have nothing to settle, as they are alone, to the last bit."""
    programs = [random_statement(seed, "sum", (1.0, 1.0), True, False, False, webs=5) for seed in seeds]
    many, rng = stacked(programs), np.random.default_rng(seeds)
    u = many.limits.into(many.limits.reach * rng.choice([1e-9, 0.3, 0.5, 1.0], (len(seeds), 5)) * np.exp(2j))
    together = snap_to_limits(many, points_at(many, u), 1.1 * many.objective(u), None).unbalance
    for n, program in enumerate(programs):
        np.testing.assert_array_equal(once(program, u[n], 1.1 * float(program.objective(u[n]))), together[n])


def test_a_ceiling_is_not_traded_for_dust() -> None:
    """The only web that keeps the ceiling is full, so what little keeps it too stays."""
    program = in_planes([0.0, 0.0], max_mass=2.0)
    u = np.array([-2.0, -1e-6 + 0j])
    force = Response("force", "N", Phasors(np.array(5.0 + 0j), np.array(0j)), np.ones(2))
    limited = statement(combined([weighted_peak(force, 1.0)], "sum"), [(force, 3.0 - 1e-6)], replace(program.limits))
    np.testing.assert_array_equal(once(limited, u, target=10.0), u)
    np.testing.assert_array_equal(once(replace(limited, ceilings=program.ceilings), u, target=10.0), [-2.0, 0.0])
