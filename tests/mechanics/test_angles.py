"""Directions that are exact where they can be."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.mechanics.angles import angle_deg, direction


def test_quarter_turns_are_exact() -> None:
    angles = np.array([0.0, 90.0, 180.0, 270.0, 360.0, -90.0, -180.0, 450.0, 1e6 * 90.0])
    expected = np.array([1, 1j, -1, -1j, 1, -1j, -1, 1j, 1])
    assert np.array_equal(direction(angles), expected)


@pytest.mark.parametrize("turn", [0.0, 360.0, -360.0, 720.0, 360.0 * 1000])
def test_sixths_of_a_turn_have_a_cosine_of_exactly_a_half(turn: float) -> None:
    assert [float(direction(np.asarray(a + turn)).real) for a in (60.0, 120.0, 240.0, 300.0)] == [0.5, -0.5, -0.5, 0.5]
    assert [float(direction(np.asarray(a + turn)).imag) for a in (30.0, 150.0, 210.0, 330.0)] == [0.5, 0.5, -0.5, -0.5]


def test_eighths_of_a_turn_are_symmetric() -> None:
    vectors = direction(np.array([45.0, 135.0, 225.0, 315.0]))
    side = vectors[0].real
    assert side == np.sqrt(0.5)
    assert np.array_equal(vectors, side * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j]))


@pytest.mark.parametrize("count", [2, 3, 4, 6, 8, 12, 24])
@pytest.mark.parametrize("start", [0.0, 90.0, 30.0, 180.0, -270.0])
def test_even_stars_sum_to_exactly_zero(count: int, start: float) -> None:
    vectors = direction(start + 360.0 / count * np.arange(count))
    # compared in pairs or threes that cancel, so that the order of summation does not matter
    if count % 2 == 0:
        assert np.all(vectors[: count // 2] + vectors[count // 2 :] == 0)
    else:
        assert np.sum(vectors) == 0


@given(st.floats(-1e6, 1e6))
def test_independent(angle: float) -> None:
    """Against 50 digits, at the machine number that was given."""
    with mpmath.workdps(50):
        exact = complex(mpmath.expjpi(mpmath.mpf(angle) / 180))
    vector = complex(direction(np.asarray(angle)))
    # the remainder after whole turns is exact for positive angles; negative ones are lifted by one rounding
    assert abs(vector - exact) <= 4e-16 + (2e-15 if angle < 0 else 0.0)


@given(st.floats(-1e5, 1e5))
def test_opposite_and_perpendicular_stay_so(angle: float) -> None:
    whole = float(np.round(angle * 64) / 64)  # so that adding 90 is exact
    vector = direction(np.asarray(whole))
    assert direction(np.asarray(whole + 180.0)) == -vector
    assert direction(np.asarray(whole + 90.0)) == 1j * vector


@given(st.floats(0.0, 359.999))
def test_angle_of_a_direction_analytic(angle: float) -> None:
    deg = float(angle_deg(direction(np.asarray(angle))))
    assert 0.0 <= deg < 360.0
    assert abs((deg - angle + 180.0) % 360.0 - 180.0) < 1e-12


def test_angle_of_special_vectors() -> None:
    vectors = np.array([0, 1, 1j, -1, -1j, complex(1.0, -1e-300), complex(-1.0, -0.0)])
    assert np.array_equal(angle_deg(vectors), [0.0, 0.0, 90.0, 180.0, 270.0, 0.0, 180.0])
    assert np.array_equal(angle_deg(vectors[None])[0], [0.0, 0.0, 90.0, 180.0, 270.0, 0.0, 180.0])


_PARTS = st.sampled_from([0.0, -0.0, 1.0, -1.0, 5e-324, -1e-300]) | st.floats(-1e6, 1e6)


@given(st.lists(st.tuples(_PARTS, _PARTS), max_size=16))
def test_few_vectors_have_the_angles_of_many_to_the_last_bit(parts: list[tuple[float, float]]) -> None:
    """Independent: few are brought into a turn one by one, in plain numbers, many as an array."""
    vectors = np.array([complex(*part) for part in parts], complex)
    assert angle_deg(vectors).tobytes() == angle_deg(vectors[None])[0].tobytes()


@given(st.lists(st.floats(-1e6, 1e6) | st.sampled_from([30.0, 45.0, -45.0, 90.0, 150.0]), min_size=1, max_size=16))
def test_few_angles_have_the_directions_of_many_to_the_last_bit(angles: list[float]) -> None:
    """Independent: few are turned one by one, in plain numbers, many as an array."""
    many = direction(np.array([angles]))[0]
    assert direction(np.array(angles)).tobytes() == many.tobytes()
