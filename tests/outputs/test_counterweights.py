"""Masses and angles as they are printed keep the limits of their webs."""

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from optimizer.formulation.counterweights import counterweights, masses_and_angles, unbalance
from optimizer.formulation.limits import limits
from schemas.answer.counterweights import Counterweight
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.scroll_machine import ScrollMachine
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
    actual_unbalance = unbalance(np.full(2, share * most), angle, within.radius)
    mass, printed = masses_and_angles(data, actual_unbalance, within)
    assert np.all((mass >= 0) & (mass <= most))
    if mass[0] > 0:
        assert _off(printed[0], centre) <= Fraction(half) + ANGLE
    # next to where it was: across the edge by no more than it was outside
    again = unbalance(mass, printed, within.radius)
    assert np.all(np.abs(again - actual_unbalance) <= (abs(np.deg2rad(off)) + 1e-13) * np.abs(actual_unbalance))
    assert 0 <= printed[0] < 360
    # of many machines the same
    stacked = masses_and_angles(data, np.stack([actual_unbalance, actual_unbalance]), within)
    assert np.array_equal(stacked[0], [mass, mass])
    assert np.array_equal(stacked[1], [printed, printed])


@pytest.mark.parametrize(
    ("off", "share"), [(0.0, 1.0), (40.0, 1.0), (50.0, np.cos(np.pi / 18)), (100.0, 0.5), (170.0, 0.0)]
)
def test_what_lies_outside_a_sector_is_brought_to_the_nearest_point_of_its_edge(off: float, share: float) -> None:
    """Analytic: the foot of the perpendicular on the edge, at 40 degrees from the middle; behind it nothing."""
    sector = {"centre_deg": 20.0, "half_angle_deg": 40.0}
    webs = [{**web("a", 0.1, 100.0, 0.1), "sector": sector}]
    data = ReciprocatingMachine.model_validate(
        {**machine([throw(0.0, 0.0, [], rotating=1.0)], webs), "speed_rpm": 60.0}
    )
    mass, angle = masses_and_angles(data, 0.3 * np.exp(1j * np.deg2rad([20.0 + off])), limits(data))
    assert mass == pytest.approx([3.0 * share], abs=1e-12)
    assert angle == pytest.approx([20.0 + min(off, 40.0) if share > 0 else 0.0], abs=1e-9)


def _fitted(own: int | None, **more: Any) -> tuple[Counterweight, ...]:
    """Webs at 0.1, 0.5, half-way, and 0.9 m along two throws at 0 and 1 m; 2 kg at 100 degrees on each but the last."""
    webs = [web(name, place, 5.0, 0.25) for name, place in zip("abcd", (0.1, 0.5, 0.9, 0.95), strict=True)]
    webs[0]["throw"] = own
    throws = [throw(0.0, 350.0, [], rotating=1.0), throw(1.0, 100.0, [], rotating=1.0)]
    data = ReciprocatingMachine.model_validate({**machine(throws, webs), "speed_rpm": 300.0, **more})
    return counterweights(data, np.array([2.0, 2.0, 2.0, 0.0]), np.array([100.0, 100.0, 100.0, 0.0]))


def test_counterweights_say_whose_they_are_and_stand_from_that_crank() -> None:
    # analytic
    nearest, named = _fitted(None), _fitted(1)
    assert [counterweight.throw for counterweight in nearest] == [0, None, 1, 1]
    assert [counterweight.angle_from_crank_deg for counterweight in nearest] == [110.0, None, 0.0, None]
    assert (named[0].throw, named[0].angle_from_crank_deg) == (1, 0.0)
    assert [(counterweight.position_m, counterweight.radius_m) for counterweight in nearest] == [
        (0.1, 0.25),
        (0.5, 0.25),
        (0.9, 0.25),
        (0.95, 0.25),
    ]


def test_what_holds_a_counterweight_counts_with_the_overspeed() -> None:
    # analytic: 2 kg at 0.25 m; 300 rpm are 10 pi/s
    assert _fitted(None)[0].centrifugal_force_N == pytest.approx(0.5 * (10.0 * np.pi) ** 2, rel=1e-14)
    assert _fitted(None)[3].centrifugal_force_N == 0.0
    fast = _fitted(None, overspeed_rpm=330.0)[0].centrifugal_force_N
    assert fast == pytest.approx(1.21 * 0.5 * (10.0 * np.pi) ** 2, rel=1e-14)


@pytest.mark.parametrize(
    ("changed", "path"),
    [({"overspeed_rpm": 299.0}, ("overspeed_rpm",)), ({"webs": [web("a", 0.1) | {"throw": 2}]}, ("webs", 0, "throw"))],
)
def test_what_no_machine_has_is_refused(changed: dict[str, Any], path: tuple[str | int, ...]) -> None:
    with pytest.raises(ValidationError) as refused:
        _fitted(None, **changed)
    (problem,) = refused.value.errors()[0]["ctx"]["problems"]
    assert problem.path == path


def test_a_scroll_has_no_throws() -> None:
    body = json.loads(Path("examples/scroll-oldham.json").read_text("utf-8"))["machine"]
    body["webs"][0]["throw"] = 0
    with pytest.raises(ValidationError, match="a scroll has no throws"):
        ScrollMachine.model_validate(body)
    del body["webs"][0]["throw"]
    data = ScrollMachine.model_validate(body)
    none = np.zeros(len(data.webs))
    assert {counterweight.throw for counterweight in counterweights(data, none, none)} == {None}
