"""How far webs without a limit have to be looked into."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.mechanics.angles import direction
from optimizer.numerics.arrays import Complex
from optimizer.program.limits import Limits
from optimizer.program.methods.implied_bounds import _masses_by_inverse, carrying_mass, within_reach
from optimizer.program.methods.semicontinuous_bounds import _subset_mass
from optimizer.program.reference.solver import _blended
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.solution import evaluated
from optimizer.responses.response import Phasors, Response
from tests.program.cases import SOLVER

#: of a web that is all but free: where a cone is held up by next to nothing
STEEP = 89.999999


def limits(webs: int, half_angle: float, max_mass: float = np.inf, radius: float = 0.25) -> Limits:
    edge, ones = direction(half_angle), np.ones(webs)
    return Limits(
        radius * ones, max_mass * ones, ones < 0, ones + 0j, edge.real * ones, edge.imag * ones, np.asarray(np.inf)
    )


@pytest.mark.parametrize("webs", [1, 2, 3])
@pytest.mark.parametrize("scale", [1.0, 1e-9])
def test_webs_that_are_told_by_what_they_change(webs: int, scale: float) -> None:
    """Analytic: each carries no more than its largest multiple that all responses allow."""
    rng = np.random.default_rng(webs)
    for _ in range(20):
        matrix = rng.normal(size=(3, webs)) * scale ** rng.uniform(0, 1, webs)
        masses: Complex = rng.normal(size=(2, webs)).T @ np.array([1, 1j])
        told = _masses_by_inverse(matrix, np.abs(matrix @ masses))
        assert np.all(np.abs(masses) <= told)
    assert np.all(np.isinf(_masses_by_inverse(rng.normal(size=(webs - 1, webs)), np.ones(webs - 1))))


def test_one_web_is_told_by_one_response() -> None:
    """Analytic: half a unit a kilogram, and one unit at most."""
    assert _masses_by_inverse(np.array([[0.5]]), np.array([1.0])) == pytest.approx([2.0], rel=1e-12)


def test_a_response_that_a_web_does_not_change_tells_nothing_of_it() -> None:
    """Analytic: 4 at most of the response of which a kilogram changes 2, and nothing of another one."""
    influence = np.array([[0.0, 1.0], [2.0, 3.0]])
    assert _subset_mass(influence, limits(2, STEEP), [0], np.array([0.0, 4.0]), np.zeros(2, bool)) == 2.0


def test_webs_that_cannot_be_told_apart_are_not() -> None:
    assert np.all(np.isinf(_masses_by_inverse(np.array([[1.0, 1.0], [2.0, 2.0]]), np.ones(2))))
    assert np.all(np.isinf(_masses_by_inverse(np.array([[1.0, 0.0], [2.0, 0.0]]), np.ones(2))))


def test_a_web_that_is_all_but_free_has_a_proven_reach() -> None:
    """Analytic: |10 + u| is at most 20 kg m, twice that of rest, so that |u| is at most 30 kg m."""
    force = Response("force", "N", Phasors(10.0 + 0j, 0j), np.ones(1))
    program = statement(combined([weighted_peak(force, 1.0)], "sum"), [], limits(1, STEEP))
    assert within_reach(program, SOLVER).limits.max_mass == pytest.approx([30.0 / 0.25], rel=1e-8)


@pytest.mark.parametrize("seed", range(5))
def test_two_webs_carry_what_two_responses_may_change(seed: int) -> None:
    """Analytic: Cramer's rule; the mass that is told is that of the changes which call for most."""
    rng = np.random.default_rng(seed)
    influence, most = rng.uniform(-1.0, 1.0, (2, 2)), rng.uniform(0.5, 3.0, 2)
    two, apart = limits(2, 90.0), np.zeros(2, bool)
    free = Limits(
        two.radius, two.max_mass, ~apart, two.centre, two.half_angle_cos, two.half_angle_sin, np.asarray(np.inf)
    )
    told = carrying_mass(influence, free, most, apart)
    inverse = np.abs(np.linalg.inv(influence))
    assert told == pytest.approx(np.sum(inverse @ most), rel=1e-9)
    changes = most[:, None] * np.exp(1j * rng.uniform(0.0, 2 * np.pi, (2, 200)))
    assert np.all(np.sum(np.abs(np.linalg.solve(influence, changes)), axis=0) <= told * (1 + 1e-12))
    # one response of two webs: the one that does most
    assert carrying_mass(influence[:1], free, most[:1], apart[:1]) == pytest.approx(
        most[0] / np.max(np.abs(influence[0]))
    )


def test_what_is_blended_stays_in_its_sector() -> None:
    """Far from both the step is rounded by more than the sector is wide; a bound then stood above the mass."""
    force = Response("force", "N", Phasors(10.0 + 0j, 0j), np.ones(1))
    within = limits(1, STEEP, 1e15)
    program = statement(combined([weighted_peak(force, 1.0)], "sum"), [], within)
    safe = evaluated(program, within.into(np.array([-1.0 + 5.4j])))
    far = within.into(1e14 * np.array([-1.0 - 5.0j]))
    for target in (12.0, 15.0, 40.0):
        found = _blended(program, far, safe, target)
        assert np.all(np.abs(within.into(found) - found) <= 4e-16 * np.abs(found))


@pytest.mark.parametrize("turn", [0.0, 100.0, 180.0, 260.0])
@pytest.mark.parametrize("half_angle", [30.0, 100.0])
def test_the_reach_of_webs_in_sectors_does_not_depend_on_where_these_point(turn: float, half_angle: float) -> None:
    """Analytic: what turns with everything else is the same; a web alone carries its response by itself."""
    influence, most, apart = np.array([[0.5, -1.5]]), np.array([3.0]), np.zeros(1, bool)
    straight = limits(2, half_angle)
    turned = replace(straight, centre=direction(turn) * straight.centre)
    told = carrying_mass(influence, turned, most, apart)
    assert told == pytest.approx(carrying_mass(influence, straight, most, apart), rel=1e-6)
    # the lighter web reaches what is to be carried, or the heavier one does
    assert 3.0 / 1.5 * (1 - 1e-9) <= told < np.inf


@pytest.mark.parametrize("ceiling", [12.0, 15.0])
def test_a_response_that_is_small_and_limited_is_one(ceiling: float) -> None:
    """Analytic: |10 + u| is at most its ceiling, so that |u| is at most 10 kg m more."""
    force = Response("force", "N", Phasors(np.asarray(10.0 + 0j), np.asarray(0j)), np.ones(1))
    free = replace(limits(1, 90.0), free=np.ones(1, bool))
    program = statement(combined([weighted_peak(force, 1.0)], "sum"), [(force, ceiling)], free)
    assert within_reach(program, SOLVER).limits.max_mass == pytest.approx([(10.0 + ceiling) / 0.25], rel=1e-6)
