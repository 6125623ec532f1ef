"""Balance rates: whose webs are whose, and which share of a crank they balance."""

import numpy as np
import pytest

from optimizer.mechanics import crank_of_web
from optimizer.mechanics.balance_rate import balance_rates, customary, web_shares
from tests.builders import inline, machine, web


def test_a_published_crank() -> None:
    # published: INNIO Jenbacher V16, two counterweights of 17.15 kg at 136.4 mm on every throw
    rotating = 8.66190878660935 * 0.06 + 2 * 14.45 * 0.0173 + 2 * 11.33 * 0.06
    opposed = np.full(2, -17.15 * 0.1364 + 0j)
    rate = balance_rates(np.array([rotating + 0j]), np.ones((1, 2)), opposed)
    assert rate.real == pytest.approx(1.966355829, rel=1e-9)
    assert rate.imag == pytest.approx(0.0, abs=1e-15)


def test_a_web_belongs_to_the_nearest_throw_and_half_to_each_at_a_tie() -> None:
    # analytic
    shares = web_shares(np.array([0.0, 1.0, 2.0]), np.array([-5.0, 0.4, 0.5, 2.0, 1.5]))
    expected = [[1, 1, 0.5, 0, 0], [0, 0, 0.5, 0, 0.5], [0, 0, 0, 1, 0.5]]
    assert shares.tolist() == expected


def test_a_web_belongs_to_the_throw_that_it_names() -> None:
    # analytic
    places = np.array([0.0, 1.0, 2.0]), np.array([-5.0, 0.4, 0.5, 2.0, 1.5])
    shares = web_shares(*places, np.array([2.0, np.nan, 1.0, np.nan, np.nan]))
    assert shares.tolist() == [[0, 1, 0, 0, 0], [0, 0, 1, 0, 0.5], [1, 0, 0, 1, 0.5]]


def test_the_customary_crank_has_a_rate_of_one_and_the_sideways_part_is_across() -> None:
    # analytic
    rotating = np.array([2.0, 3.0]) * np.exp(1j * np.array([0.7, 2.9]))
    shares = web_shares(np.array([0.0, 1.0]), np.array([-0.1, 0.1, 0.9, 1.1]))
    alike = customary(rotating, shares)
    assert balance_rates(rotating, shares, alike) == pytest.approx([1.0, 1.0])
    assert alike[0] == alike[1]
    across = balance_rates(rotating, shares, 1j * alike)
    assert across.real == pytest.approx([0.0, 0.0], abs=1e-15)
    assert across.imag == pytest.approx([1.0, 1.0])
    assert np.isnan(balance_rates(np.zeros(1, complex), np.ones((1, 1)), np.ones(1, complex))[0])
    assert customary(rotating, np.zeros((2, 0))).shape == (0,)


def test_next_to_nothing_has_no_rate() -> None:
    """Analytic: there is nothing to balance; a quotient would not be finite."""
    rates = balance_rates(np.array([0.0, 2.8e-314, 1e-200]), np.ones((3, 1)) / 3.0, np.array([-3e-200 + 0j]))
    assert np.isnan(rates[:2]).all()
    assert rates[2] == pytest.approx(1.0)


def test_machines_that_differ_in_a_place_have_webs_of_their_own() -> None:
    """Analytic: what is kept of one machine is not that of another."""
    throws = inline([0, 180], [0.3, -0.3])
    for place, own, shares in ((0.25, 0, [1, 0]), (-0.25, 1, [0, 1]), (0.0, None, [0.5, 0.5])):
        design = machine(*throws, webs=[web("a", place)])
        assert crank_of_web.own_throws(design) == (own,)
        assert crank_of_web.shares(design)[:, 0].tolist() == shares
