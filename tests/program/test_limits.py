import numpy as np
import pytest

from optimizer.mechanics.angles import direction
from optimizer.program.limits import Limits
from tests.program.cases import random_limits, random_point


@pytest.mark.parametrize("seed", range(40))
def test_points_are_brought_within_every_limit(seed: int) -> None:
    rng = np.random.default_rng(seed)
    limits = random_limits(rng, 6, sectors=True, budget=True)
    u = random_point(rng, limits)
    rotated = u * np.conj(limits.centre)
    mass = np.abs(u) / limits.radius
    assert np.all(mass <= limits.max_mass * (1 + 1e-15))
    assert mass.sum() <= limits.max_total_mass * (1 + 1e-15)
    outside = np.abs(rotated.imag) * limits.half_angle_cos - rotated.real * limits.half_angle_sin
    assert np.all(outside[~limits.free] <= 1e-15)
    np.testing.assert_allclose(limits.into(u), u, rtol=1e-14, atol=1e-16)


@pytest.mark.parametrize("half_angle", [1e-6, 1.0, 30.0, 89.999, 90.0])
def test_support_is_the_largest_projection_on_the_sector(half_angle: float) -> None:
    # independent: the sector's arc on a fine grid of angles
    edge = direction(half_angle)
    ones = np.ones(1)
    limits = Limits(ones, ones, np.array([False]), direction(np.array([25.0])), ones * edge.real, ones * edge.imag,
                    np.asarray(np.inf))  # fmt: skip
    arc = direction(25.0 + np.linspace(-half_angle, half_angle, 20001))
    for angle in np.linspace(0, 360, 73):
        g = 1.7 * direction(np.array([angle]))
        expected = np.max((np.conj(g) * arc).real)
        assert limits.support(g)[0] == pytest.approx(expected, abs=2e-8)


def test_support_without_a_sector_is_the_magnitude() -> None:
    ones = np.ones(1)
    limits = Limits(ones, ones, np.array([True]), ones + 0j, 0 * ones, ones, np.asarray(np.inf))
    assert limits.support(np.array([-3.0 - 4.0j]))[0] == 5.0  # analytic


@pytest.mark.parametrize("seed", range(20))
def test_a_budget_is_spent_in_falling_order_of_gain(seed: int) -> None:
    # independent: sorted by numpy, and what is left told from sums
    rng = np.random.default_rng(seed)
    webs, budget = int(rng.integers(1, 9)), float(rng.choice([0.3, 2.0, np.inf]))
    # of equal gains the first comes first
    gain, most = rng.integers(-1, 4, (3, webs)).astype(float), rng.random(webs)
    ones = np.ones(webs)
    masses, price = Limits(ones, most, ones > 0, ones + 0j, 0 * ones, ones, np.asarray(budget)).spent(gain)
    for n in range(3):
        left, ended = budget, 0.0
        for k in np.argsort(-gain[n], kind="stable"):
            assert masses[n, k] == pytest.approx(min(most[k], left), rel=1e-14, abs=1e-15)
            ended = max(ended, gain[n, k]) if most[k] > left else ended
            left = max(left - most[k], 0.0)
        assert price[n] == ended


def test_without_a_budget_every_web_carries_what_it_may() -> None:
    ones = np.ones(2)
    masses, price = Limits(
        ones, np.array([2.0, np.inf]), ones > 0, ones + 0j, 0 * ones, ones, np.asarray(np.inf)
    ).spent(ones)
    assert masses.tolist() == [2.0, np.inf]  # analytic
    assert price == 0.0
