"""The smallest circle around points, against its proof and against brute force."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp
from scipy.optimize import minimize

from optimizer.numerics.enclosing_circle import smallest_circle


def test_one_point_two_points_and_an_obtuse_triangle() -> None:
    # analytic: a point is its own circle; two points and an obtuse triangle have that on the longest side
    assert smallest_circle(np.array([2.0 + 1.0j])).radius == 0.0
    assert smallest_circle(np.array([1.0, 1.0, 1.0])).radius == 0.0
    two = smallest_circle(np.array([-1.0, 3.0]))
    assert (two.centre, two.radius) == (1.0, 2.0)
    obtuse = smallest_circle(np.array([-1.0, 0.1j, 1.0]))
    assert (obtuse.radius, obtuse.support.size) == (1.0, 2)


def test_an_even_triangle_is_held_by_all_three() -> None:
    # analytic: circumradius 1, equal weights
    circle = smallest_circle(np.exp(2j * np.pi * np.arange(3) / 3) + 5.0)
    assert circle.radius == pytest.approx(1.0, rel=1e-14)
    assert circle.centre == pytest.approx(5.0)
    assert circle.weights == pytest.approx([1 / 3] * 3)


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 10**6), st.integers(1, 200), st.sampled_from(["cloud", "circle", "line", "grid", "twice"]))
def test_it_holds_all_points_and_its_own_hold_it(seed: int, count: int, kind: str) -> None:
    # analytic: lam >= 0 and sum lam (point - centre) = 0 prove that no smaller circle holds the points
    rng = np.random.default_rng(seed)
    points = rng.normal(size=count) + 1j * rng.normal(size=count)
    if kind == "circle":
        points /= np.abs(points)
    elif kind == "line":
        points = points.real * np.exp(0.3j)
    elif kind == "grid":
        points = np.round(points)
    elif kind == "twice":
        points = np.concatenate([points, points])
    points = points * 10.0 ** rng.uniform(-6, 6) + complex(rng.normal(), rng.normal())
    circle = smallest_circle(points)
    size = np.max(np.abs(points))
    on = points[circle.support] - circle.centre
    assert np.all(np.abs(points - circle.centre) <= circle.radius + 1e-13 * size)
    assert np.abs(on) == pytest.approx(np.full(on.size, circle.radius), abs=1e-12 * size)
    assert np.all(circle.weights >= 0)
    assert np.sum(circle.weights) == pytest.approx(1.0)
    assert abs(np.sum(circle.weights * on)) <= 1e-12 * size


def test_it_is_what_a_minimisation_finds() -> None:
    # independent: the farthest point, minimised over the centre by a general method
    rng = np.random.default_rng(7)
    points = rng.normal(size=30) + 1j * rng.normal(size=30)
    minimum = minimize(
        lambda at: float(np.max(np.abs(points - at[0] - 1j * at[1]))),
        [0.0, 0.0],
        method="Nelder-Mead",
        options={"xatol": 1e-10, "fatol": 1e-12, "maxiter": 4000},
    )
    assert smallest_circle(points).radius == pytest.approx(minimum.fun, rel=1e-7)


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from([1e-3, 1e-6, 1e-8, 1e-10]))
def test_points_that_all_but_coincide_are_held_by_no_more_than_their_circle(seed: int, apart: float) -> None:
    """Independent: in 60 digits. Of two points next to each other and one across the longest was 4e-8 too long."""
    rng = np.random.default_rng(seed)
    turn, offset = np.exp(1j * rng.uniform(0.0, 2 * np.pi)), complex(*rng.normal(size=2))
    points = np.array([1.0, np.exp(1j * apart), np.exp(1j * (np.pi + apart * rng.uniform(0.2, 0.8)))]) * turn + offset
    with mp.workdps(60):
        first, second, third = (mp.mpc(point) for point in points.tolist())
        sides = abs(second - third), abs(third - first), abs(first - second)
        squares = sorted(side**2 for side in sides)
        area = abs(mp.im(mp.conj(second - first) * (third - first))) / 2
        acute = squares[0] + squares[1] > squares[2]
        exact = mp.fprod(sides) / (4 * area) if acute and area > 0 else max(sides) / 2
        radius = mp.mpf(smallest_circle(points).radius)
        size = float(abs(offset)) + 1.0
        assert radius <= exact + 4e-16 * size
        assert radius >= exact * (1 - mp.mpf("1e-12"))
