"""A machine as arrays: the plane of its couples, and quotients that keep what rounding takes off."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.mechanics.layout import layout, quotient
from tests.builders import machine, row, throw


@pytest.mark.parametrize("planes", [(0.0, 0.1, 0.5), (0.5, 0.1, 0.0), (-0.3, 0.8, 0.2)])
def test_couples_are_about_the_middle_of_the_outermost_throws(planes: tuple[float, ...]) -> None:
    """Analytic: whatever throws are in between, and in whichever order they come."""
    arrays = layout(machine(*(throw(120.0 * n, row(90.0), z=z) for n, z in enumerate(planes))))
    assert float(arrays.reference_plane) == pytest.approx(0.25, abs=1e-16)
    assert arrays.central


def test_couples_are_about_the_plane_that_is_given() -> None:
    arrays = layout(machine(throw(0.0, z=0.0), throw(90.0, z=1.0), reference_plane_m=-0.2))
    assert (float(arrays.reference_plane), float(arrays.centre_plane)) == (-0.2, 0.5)
    assert not arrays.central


SIZES = st.floats(1e-6, 1e6)


@given(SIZES, SIZES)
def test_a_quotient_and_its_rounding_have_the_digits_of_two_doubles(numerator: float, denominator: float) -> None:
    """Independent: fractions."""
    ratio, rest = quotient(np.asarray(numerator), np.asarray(denominator))
    exact = Fraction(numerator) / Fraction(denominator)
    assert abs(Fraction(float(ratio)) + Fraction(float(rest)) - exact) <= exact * Fraction(2) ** -104
