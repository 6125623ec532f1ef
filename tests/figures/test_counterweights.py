"""Masses and angles as they are printed keep the limits of their webs."""

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from optimizer.figures.counterweights import masses_and_angles, unbalance
from optimizer.limits import limits
from schemas.machine import ReciprocatingMachine
from tests.hard.cases.case import machine, throw, web

#: degrees: rounding of an angle up to 360 degrees
ANGLE = Fraction(1e-12)


def _off(angle: float, centre: float) -> Fraction:
    turn = Fraction(360)
    return abs((Fraction(angle) - Fraction(centre) + turn / 2) % turn - turn / 2)


@given(
    centre=st.floats(-1e6, 1e6),
    half=st.one_of(st.sampled_from([90.0, 89.999999, 0.001, 1e-9]), st.floats(1e-6, 90.0)),
    most=st.sampled_from([1e-12, 3.7, 1e15]),
    share=st.sampled_from([0.0, 1e-30, 0.3, 1.0, 1.0 + 1e-15]),
    off=st.floats(-2e-6, 2e-6),
    side=st.sampled_from([-1.0, 0.0, 1.0]),
)
def test_what_rounding_left_outside_is_printed_inside(
    centre: float, half: float, most: float, share: float, off: float, side: float
) -> None:
    """Independent: the printed doubles against the limits in fractions."""
    webs = [web("a", 0.1, most, 0.3, sector=(centre, half)), web("b", -0.1, most, 0.3)]
    data = ReciprocatingMachine.model_validate(machine([throw(0.0, 0.0, [], rotating=1.0)], webs))
    within = limits(data)
    angle = np.array([centre % 360.0 + side * half + off, 17.0])
    given = unbalance(np.full(2, share * most), angle, within.radius)
    mass, printed = masses_and_angles(data, given, within)
    assert np.all((mass >= 0) & (mass <= most))
    if mass[0] > 0:
        assert _off(printed[0], centre) <= Fraction(half) + ANGLE
    # next to where it was: across the edge by no more than it was outside
    again = unbalance(mass, printed, within.radius)
    assert np.all(np.abs(again - given) <= (abs(np.deg2rad(off)) + 1e-13) * np.abs(given))
    assert 0 <= printed[0] < 360
    # of many machines the same
    stacked = masses_and_angles(data, np.stack([given, given]), within)
    assert np.array_equal(stacked[0], [mass, mass])
    assert np.array_equal(stacked[1], [printed, printed])
