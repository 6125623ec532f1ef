"""Boosts of cones in the plane, and what they are for: points that keep what they have to."""

import numpy as np
import pytest

from optimizer.program.reference.assembled import Assembly, dense
from optimizer.program.reference.boost import Boost, boosts


def test_a_boost_maps_the_cone_onto_itself() -> None:
    """Analytic: t^2 - |a|^2 stays, as does the sign of t; and the boost is symmetric."""
    rng = np.random.default_rng(0)
    vector = rng.normal(size=(50, 2))
    size = np.hypot(*vector.T) * (1.0 + 10.0 ** rng.uniform(-6, 1, 50))
    actual_boosts = boosts(size, vector)
    np.testing.assert_allclose(actual_boosts, np.swapaxes(actual_boosts, 1, 2), rtol=1e-14)
    values = rng.normal(size=(50, 3))
    image = np.einsum("nij,nj->ni", actual_boosts, values)
    form = np.array([1.0, -1.0, -1.0])
    # of numbers up to 50 squared times 3
    np.testing.assert_allclose(image**2 @ form, values**2 @ form, atol=1e-10)


def test_a_point_near_the_boundary_is_brought_to_the_middle() -> None:
    """Analytic: p = q, so nothing is left of the vector but what the cap of the boost leaves."""
    actual_boosts = boosts(np.array([1.0 + 1e-3]), np.array([[0.6, 0.8]]))
    image = actual_boosts[0] @ [1.0 + 1e-3, 0.6, 0.8]
    np.testing.assert_allclose(image[1:], 0.0, atol=1e-13)
    assert image[0] == pytest.approx(np.sqrt(2e-3 + 1e-6), rel=1e-12)
    np.testing.assert_array_equal(boosts(np.array([1.0]), np.zeros((1, 2)))[0], np.eye(3))


def test_other_rows_are_left_as_they_are() -> None:
    rows = np.array([5.0, 1.0, 0.6, 0.7, 2.0])
    boost = Boost.about(rows, np.array([1]))
    whole = boost.of(np.eye(5))
    plain = [0, 4]
    np.testing.assert_array_equal(whole[plain], np.eye(5)[plain])
    np.testing.assert_array_equal(whole[1:4, 1:4], boosts(rows[1:2], rows[None, 2:4])[0])
    np.testing.assert_allclose(boost.of(rows), whole @ rows, atol=1e-14)


def test_a_boosted_program_is_the_same_program() -> None:
    """Analytic: the largest x + y in the unit disc is sqrt 2, with a multiplier of that size along it."""
    program = Assembly(2)
    program.cones(np.ones(1), (), np.zeros(2), (dense(0, np.eye(2)),))
    cost = -np.ones(2)
    for about in (None, np.array([0.7071, 0.7071]), np.array([0.0, 1.0])):
        solution = program.solve(cost, 1e-10, 5.0, about)
        assert isinstance(solution, tuple)
        point, dual = solution
        # an objective known to 1e-10 fixes the point to its root
        np.testing.assert_allclose(point, np.sqrt(0.5), atol=1e-5)
        np.testing.assert_allclose(dual, [np.sqrt(2.0), -1.0, -1.0], atol=1e-5)
