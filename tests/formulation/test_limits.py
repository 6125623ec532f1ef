"""The limits that a machine states: sizes, which of them binds, where it is touched, what it costs (analytic)."""

from typing import Any

import numpy as np
import pytest

from optimizer.formulation.limits import (
    MACHINE_LIMITS,
    TOUCHED,
    WEB_LIMITS,
    largest_mass,
    limit_sizes,
    limits,
    sectors,
)
from optimizer.mechanics.envelope import Segment
from optimizer.mechanics.shapes import closed
from optimizer.program.sensitivity import ShadowPrices
from schemas.base.variation import with_fields
from schemas.machine.reciprocating import ReciprocatingMachine
from tests.optimize.machines import machine, row, throw, web

_PLATE = {
    "shape": "segment", "outer_radius_m": 0.2, "inner_radius_m": 0.05, "thickness_m": 0.04, "density_kg_m3": 7800.0,
    "max_half_angle_deg": 70.0,
}  # fmt: skip
_SEGMENT = Segment(0.05, 0.2, 0.04 * 7800.0, np.deg2rad(70.0))
_OMEGA = 660.0 * np.pi / 30.0
_FORCE = 2.0 * 0.15 * _OMEGA**2  # of 2 kg at 0.15 m and the overspeed


def limited(**more: Any) -> ReciprocatingMachine:
    """Every limit that there is; its plate has the radius of a first gram."""
    webs = [
        web("a", -0.4, 4.0, 0.12, sector={"centre_deg": 190.0, "half_angle_deg": 40.0}),
        web("b", 0.5, 3.0, 0.15, max_centrifugal_force_N=_FORCE),
        {"name": "plate", "position_m": 0.05, "envelope": _PLATE},
        {"name": "fixed", "position_m": 0.1, "counterweight_radius_m": 0.1,
         "fixed": {"mass_kg": 1.5, "angle_deg": 30.0}},
    ]  # fmt: skip
    body = machine([throw(0.0, 0.0, [row(90.0, 5.0)])], webs, overspeed_rpm=660.0, max_total_mass_kg=9.0, **more)
    polygon = closed(ReciprocatingMachine.model_validate(body))
    assert isinstance(polygon, ReciprocatingMachine)
    return polygon


def test_the_largest_mass_is_the_smallest_that_a_limit_allows() -> None:
    design = limited()
    radius = design.webs[2].radius_m
    plate = float(_SEGMENT.unbalance(_SEGMENT.most)) / radius
    assert largest_mass(design) == pytest.approx([4.0, 2.0, plate, 0.0], rel=1e-12)
    # without an overspeed the force is less
    slow = with_fields(design, {("overspeed_rpm",): None})
    assert largest_mass(slow)[1] == pytest.approx(2.0 * 1.1**2, rel=1e-12)
    # what a web is limited to by itself, and what cannot be multiplied is no limit
    for most, expected in ((1.0, 1.0), (1e31, 2.0), (None, 2.0)):
        assert largest_mass(with_fields(design, {("webs", 1, "max_mass_kg"): most}))[1] == pytest.approx(expected)
    free = with_fields(design, {("webs", 0, "max_mass_kg"): 1.01e30})
    assert largest_mass(free)[0] == np.inf
    assert largest_mass(with_fields(design, {("webs", 0, "max_mass_kg"): 0.99e30}))[0] == 0.99e30


def test_limits_are_told_in_their_own_units() -> None:
    sizes = {name: limit_size.size.tolist() for name, limit_size in limit_sizes(limited()).items()}
    assert list(sizes) == ["max_mass", "envelope", "max_centrifugal_force", "sector"]
    assert sizes["max_mass"][:2] == [4.0, 3.0]
    assert sizes["envelope"] == [np.inf, np.inf, pytest.approx(float(_SEGMENT.unbalance(_SEGMENT.most))), np.inf]
    assert sizes["max_centrifugal_force"] == [np.inf, _FORCE, np.inf, np.inf]
    assert sizes["sector"] == [40.0, np.inf, np.inf, np.inf]
    assert float(MACHINE_LIMITS["max_total_mass"].size(limited())) == 9.0
    units = [limit.unit for limit in (*WEB_LIMITS.values(), *MACHINE_LIMITS.values())]
    assert units == ["kg", "(kg m)", "N", "deg", "kg"]
    # what no web states is none
    plain = ReciprocatingMachine.model_validate(machine([throw(0.0, 0.0, [])], [web("a", 0.0, 4.0)]))
    assert list(limit_sizes(plain)) == ["max_mass"]
    assert float(MACHINE_LIMITS["max_total_mass"].size(plain)) == np.inf


def test_the_program_has_the_limits_of_the_machine() -> None:
    bounds = limits(limited())
    assert bounds.radius[:2].tolist() == [0.12, 0.15]
    assert bounds.free.tolist() == [False, True, True, True]
    centre = np.exp(1j * np.deg2rad([190.0, 0.0, 0.0, 0.0]))
    np.testing.assert_allclose(bounds.centre, centre, atol=1e-15)
    np.testing.assert_allclose(bounds.half_angle_cos, np.cos(np.deg2rad([40.0, 90.0, 90.0, 90.0])), atol=1e-15)
    np.testing.assert_allclose(bounds.half_angle_sin, np.sin(np.deg2rad([40.0, 90.0, 90.0, 90.0])), atol=1e-15)
    # what is fixed is spent already
    assert float(bounds.max_total_mass) == pytest.approx(7.5)
    assert bounds.alike is None
    wide = limits(limited(), (2, 3))
    assert wide.radius.shape == wide.max_mass.shape == wide.centre.shape == wide.free.shape == (2, 3, 4)
    assert wide.max_total_mass.shape == (2, 3)
    assert np.all(wide.half_angle_sin == bounds.half_angle_sin)
    free = limits(with_fields(limited(), {("webs", 0, "sector"): None}))
    assert np.all(free.centre == 1.0)
    assert np.all(free.half_angle_cos == 0.0)
    assert np.all(free.half_angle_sin == 1.0)


def test_columns_of_limits_have_a_leading_axis() -> None:
    many = with_fields(
        limited(), {("webs", 0, "max_mass_kg"): np.array([1.0, 2.0]), ("speed_rpm",): np.array([1.0, 2.0])}
    )
    assert largest_mass(many)[:, 0].tolist() == [1.0, 2.0]
    faster = with_fields(limited(), {("overspeed_rpm",): np.array([660.0, 1320.0])})
    assert largest_mass(faster)[:, 1] == pytest.approx([2.0, 0.5], rel=1e-12)


@pytest.mark.parametrize("near", [True, False])
def test_a_limit_is_touched_within_a_ten_thousandth_of_it(near: bool) -> None:
    design = limited()
    share = 1.0 - (0.9 if near else 1.1) * TOUCHED
    mass = share * np.array(
        [4.0, 3.0, float(largest_mass(design)[2]), 9.0 - 3.0 - 4.0 - float(largest_mass(design)[2])]
    )
    for angle in (190.0 + 40.0 * share, 190.0 - 40.0 * share, 190.0 + 40.0 * share - 720.0):
        at = np.array([angle, 0.0, 10.0, 30.0])
        touched = {
            name: limit_size.limit.touched(design, mass, at).tolist()
            for name, limit_size in limit_sizes(design).items()
        }
        assert touched["max_mass"][:2] == [near, near]
        assert touched["envelope"][2] == near
        assert touched["sector"] == [near, False, False, False]
    force = np.array([0.0, 2.0 * share, 0.0, 0.0])
    assert limit_sizes(design)["max_centrifugal_force"].limit.touched(design, force, force)[1] == near
    budget = MACHINE_LIMITS["max_total_mass"]
    assert bool(budget.touched(design, np.array([9.0 * share, 0.0, 0.0, 0.0]), np.zeros(4))) == near
    # without a mass there is no angle
    assert not np.any(limit_sizes(design)["sector"].limit.touched(design, np.zeros(4), np.full(4, 230.0)))


def test_prices_are_those_of_the_limit_that_binds_in_its_unit() -> None:
    design = limited()
    prices = ShadowPrices(np.array([8.0, 6.0, 5.0, 4.0]), np.array([9.0, 0.0, 0.0, 0.0]), np.asarray(3.0), np.zeros(0))
    sizes = limit_sizes(design)
    radius = design.webs[2].radius_m
    # of the second web the force binds, and not the mass; per newton so many times less
    assert sizes["max_mass"].limit.price(design, prices)[:2].tolist() == [8.0, 0.0]
    assert sizes["max_centrifugal_force"].limit.price(design, prices)[1] == pytest.approx(6.0 / (0.15 * _OMEGA**2))
    assert sizes["envelope"].limit.price(design, prices)[2] == pytest.approx(5.0 / radius)
    assert sizes["sector"].limit.price(design, prices)[0] == pytest.approx(9.0 * np.pi / 180.0)
    assert float(MACHINE_LIMITS["max_total_mass"].price(design, prices)) == 3.0


def test_webs_without_a_sector_are_free() -> None:
    free, centre, half = sectors(limited())
    assert (free.tolist(), centre.tolist(), half.tolist()) == (
        [False, True, True, True], [190.0, 0.0, 0.0, 0.0], [40.0, 90.0, 90.0, 90.0],
    )  # fmt: skip
