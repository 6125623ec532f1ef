"""Closed forms of the classic layouts, broadcasting, and responses to counterweights."""

from typing import Any

import numpy as np
import pytest

from optimizer.mechanics.inertia import (
    counterweights,
    first_order_responses,
    reciprocating,
    reciprocating_forces,
    reciprocating_orders,
    rotating,
)
from optimizer.mechanics.layout import layout
from optimizer.mechanics.slider_crank import acceleration_harmonic, acceleration_harmonic_order_2
from optimizer.responses.response import Phasors
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.scroll_machine import CrankPins, OldhamRing, ScrollMachine
from tests.builders import RADIUS, inline, machine, opposed, random_machine, row, stack, throw, web
from tests.night import ALL

F0 = 10.0 * RADIUS  # kg m, one row of 10 kg
ROOT_HALF = np.sqrt(0.5)

FIRST_ORDER = [
    pytest.param([throw(0, row(0))], 0.5, 0.5, id="analytic-single"),
    pytest.param([throw(0, row(50), row(-50))], 1.0, np.cos(np.deg2rad(100)), id="analytic-v100"),
    pytest.param([throw(0, row(30), row(-30))], 1.0, 0.5, id="analytic-v60"),
    pytest.param([throw(0, row(45), row(-45))], 1.0, 0.0, id="analytic-v90"),
    pytest.param([throw(0, row(0, 12.0), row(-90, 7.0))], 0.95, 0.25, id="analytic-v90-unequal"),
    pytest.param([throw(0, row(60), row(0), row(-60))], 1.5, 0.0, id="analytic-w60"),
    pytest.param([throw(0, *[row(72.0 * i) for i in range(5)])], 2.5, 0.0, id="analytic-star-of-five"),
    pytest.param(opposed([0, 180], [0.3, -0.3]), 0.0, 0.0, id="analytic-opposed"),
    pytest.param(inline([0, 180], [0.3, -0.3]), 0.0, 0.0, id="analytic-two-rows-180"),
    pytest.param(inline([0, 90], [0.3, -0.3], 20.0), (1 + 1j) / 2, (1 - 1j) / 2 * np.exp(2j * np.deg2rad(20)),
                 id="analytic-two-rows-90"),
    pytest.param(opposed([0, 180, 90, 270], [1.3, 0.7, -0.7, -1.3]), 0.0, 0.0, id="analytic-m-type"),
    pytest.param(opposed([0, 180, 240, 60, 120, 300], [2.3, 1.7, 0.3, -0.3, -1.7, -2.3]), 0.0, 0.0,
                 id="analytic-six-columns"),
    pytest.param([throw(0, row(0), row(180))], 1.0, 1.0, id="analytic-opposed-on-one-pin"),
]  # fmt: skip


@pytest.mark.parametrize(("throws", "co", "counter"), FIRST_ORDER)
def test_first_order_force_of_layouts(throws: Any, co: complex, counter: complex) -> None:
    """A1 and B1 of the seeds' layouts, derived by hand, in units of m r."""
    force = reciprocating(layout(machine(*throws)), 1).force
    assert force.co == pytest.approx(co * F0, abs=1e-14)
    assert force.counter == pytest.approx(counter * F0, abs=1e-14)


SPAN = 0.6  # m, row spacing
COUPLES = [
    # first order and second order of the reciprocating masses, and rotating; in F0 a, lam F0 a, F0 a
    pytest.param(opposed([0, 180], [0.3, -0.3]), 1.0, 1.0, 1.0, id="analytic-opposed"),
    pytest.param(inline([0, 180], [0.3, -0.3]), 1.0, 0.0, 1.0, id="analytic-two-rows-180"),
    pytest.param(inline([0, 90], [0.3, -0.3]), ROOT_HALF, 1.0, ROOT_HALF, id="published-two-rows-90"),
    pytest.param(opposed([0, 180, 90, 270], [1.3, 0.7, -0.7, -1.3]), 2**0.5, 0.0, 2**0.5, id="analytic-m-type"),
    pytest.param(opposed([0, 180, 270, 90], [1.3, 0.7, -1.3, -0.7]), 2**0.5, 2.0, 2**0.5,
                 id="analytic-m-type-mirrored"),
    pytest.param(opposed([0, 180, 0, 180], [1.3, 0.7, -1.3, -0.7]), 0.0, 0.0, 0.0, id="analytic-two-pairs-mirrored"),
    pytest.param(opposed([0, 180, 240, 60, 120, 300], [2.3, 1.7, 0.3, -0.3, -1.7, -2.3]), 0.0, 0.0, 0.0,
                 id="published-six-columns"),
    pytest.param(opposed([0, 180, 60, 240, 120, 300], [2.3, 1.7, 0.3, -0.3, -1.7, -2.3]), 2.0, 0.0, 2.0,
                 id="analytic-six-columns-literal"),
    pytest.param(inline([0, 120, 240, 240, 120, 0], [1.5, 0.9, 0.3, -0.3, -0.9, -1.5]), 0.0, 0.0, 0.0,
                 id="published-inline-six"),
    pytest.param(inline([0, 120, 240], [0.6, 0.0, -0.6]), 3**0.5, 3**0.5, 3**0.5, id="analytic-inline-three"),
    pytest.param(inline([0, 180, 180, 0], [0.9, 0.3, -0.3, -0.9]), 0.0, 0.0, 0.0, id="published-inline-four"),
]  # fmt: skip


@pytest.mark.parametrize(("throws", "first", "second", "turning"), COUPLES)
def test_couples_of_layouts(throws: Any, first: float, second: float, turning: float) -> None:
    arrays = layout(machine(*throws))
    lam = 0.2
    assert reciprocating(arrays, 1).moment.peak == pytest.approx(first * F0 * SPAN, abs=1e-14)
    truncated = reciprocating(arrays, 2, acceleration_harmonic_order_2)
    assert truncated.moment.peak == pytest.approx(second * lam * F0 * SPAN, abs=1e-14)
    exact = float(acceleration_harmonic(2, np.asarray(lam)))
    assert reciprocating(arrays, 2).moment.peak == pytest.approx(second * exact * F0 * SPAN, abs=1e-14)
    assert rotating(arrays).moment.peak == pytest.approx(turning * F0 * SPAN, abs=1e-14)


@pytest.mark.parametrize("gamma", [0.0, 30.0, 45.0, 60.0, 75.0, 90.0, 120.0, 180.0])
def test_second_order_of_a_v_analytic(gamma: float) -> None:
    """Semi-axes 2 lam F0 |cos gamma cos(gamma/2)| on the bisector and 2 lam F0 sin gamma sin(gamma/2) across it."""
    arrays = layout(machine(throw(0, row(gamma / 2), row(-gamma / 2))))
    force = reciprocating(arrays, 2, acceleration_harmonic_order_2).force
    g = np.deg2rad(gamma)
    assert force.peak_along(np.asarray(1.0)) == pytest.approx(abs(0.4 * F0 * np.cos(g) * np.cos(g / 2)), abs=1e-14)
    assert force.peak_along(np.asarray(1j)) == pytest.approx(0.4 * F0 * np.sin(g) * np.sin(g / 2), abs=1e-14)


def test_balance_is_exactly_zero_not_nearly() -> None:
    cranks, planes = [0, 180, 240, 60, 120, 300], [2.3, 1.7, 0.3, -0.3, -1.7, -2.3]
    arrays = layout(machine(*opposed(cranks, planes)))
    for wrench in (rotating(arrays), reciprocating(arrays, 1), reciprocating(arrays, 2), reciprocating(arrays, 4)):
        for pair in wrench:
            assert pair.peak == 0.0


def test_a_batch_is_the_same_as_one_machine_at_a_time() -> None:
    rng = np.random.default_rng(11)
    count = 1000 if ALL else 200
    layouts = [layout(random_machine(rng, "cw")) for _ in range(5 * count)]
    shape = layouts[0].reciprocating.mass.shape
    alike = [arrangement for arrangement in layouts if arrangement.reciprocating.mass.shape == shape][:count]
    assert len(alike) == count
    batch = stack(alike)
    unbalance = rng.normal(size=(count, 3)) + 1j * rng.normal(size=(count, 3))
    for effect in (rotating, lambda x: reciprocating(x, 1), lambda x: reciprocating(x, 2)):
        together = effect(batch)
        for index, alike_layout in enumerate(alike):
            alone = effect(alike_layout)
            for pair, single in zip(together, alone, strict=True):
                assert pair.co[index] == pytest.approx(complex(single.co), rel=1e-13, abs=1e-13)
                assert pair.counter[index] == pytest.approx(complex(single.counter), rel=1e-13, abs=1e-13)
    together = counterweights(batch, unbalance)
    for index, single_layout in enumerate(alike):
        assert together.moment.co[index] == pytest.approx(
            complex(counterweights(single_layout, unbalance[index]).moment.co), rel=1e-12, abs=1e-13
        )


def test_a_short_arm_beside_a_long_span_keeps_its_digits_analytic() -> None:
    # a large mass next to the reference plane, next to nothing far away: the couple is 1 kg m times 1e-13 m
    far = throw(0, z=60.0, rotating_kg=1e-30)
    wrench = rotating(layout(machine(throw(0, z=1e-13, rotating_kg=1.0 / RADIUS), far, reference_plane_m=0.0)))
    assert wrench.moment.co == pytest.approx(1e-13, rel=1e-14)


def test_responses_are_what_the_counterweights_do() -> None:
    rng = np.random.default_rng(12)
    for style in ("v", "plane", "cw", "any"):
        arrays = layout(random_machine(rng, style))
        unbalance = rng.normal(size=3) + 1j * rng.normal(size=3)
        baseline = rotating(arrays).plus(reciprocating(arrays, 1))
        expected = baseline.plus(counterweights(arrays, unbalance))
        phasors: list[Phasors] = [r.to(unbalance) for r in first_order_responses(arrays, baseline)]
        for pair, harmonics in zip(phasors, expected, strict=True):
            assert pair.co == pytest.approx(complex(harmonics.co), abs=1e-11)
            assert pair.counter == complex(harmonics.counter)


def test_no_rod_is_needed_for_the_first_order() -> None:
    bare = ReciprocatingMachine.model_validate(
        {
            "kind": "reciprocating",
            "speed_rpm": 500,
            "throws": [
                {
                    "position_m": 0,
                    "crank_radius_m": RADIUS,
                    "crank_angle_deg": 0,
                    "rows": [{"axis_deg": 0, "reciprocating_mass_kg": 10}],
                }
            ],
        }
    )
    arrays = layout(bare)
    assert reciprocating(arrays, 1).force.peak == pytest.approx(F0)
    assert np.isnan(reciprocating(arrays, 2).force.peak)


def test_a_throw_without_rows_only_turns_analytic() -> None:
    arrays = layout(machine(throw(30, rotating_kg=8.0, z=0.2), throw(210, rotating_kg=8.0, z=-0.2)))
    assert rotating(arrays).force.peak == 0.0
    assert rotating(arrays).moment.co == pytest.approx(8 * RADIUS * 0.4 * np.exp(1j * np.pi / 6))
    assert reciprocating(arrays, 1).force.peak == 0.0


def _scroll(guide: OldhamRing | CrankPins) -> ScrollMachine:
    return ScrollMachine(
        kind="scroll",
        speed_rpm=3600,
        orbit_radius_m=0.005,
        orbiting_mass_kg=1.2,
        orbiting_position_m=0.05,
        anti_rotation=guide,
        webs=(web("main", 0.02),),
    )


def test_oldham_ring_slides_with_the_projection_of_the_orbit_analytic() -> None:
    """m e cos(theta) along its axis is half with and half against the shaft, whatever the axis; no second order."""
    arrays = layout(_scroll(OldhamRing(type="oldham", mass_kg=0.4, axis_deg=90.0, position_m=0.03)))
    force = reciprocating(arrays, 1).force
    assert force.co == pytest.approx(0.001)
    assert force.counter == pytest.approx(-0.001)
    assert force.peak_along(np.asarray(1.0)) == pytest.approx(0.0, abs=1e-18)
    assert reciprocating(arrays, 2).force.peak == 0.0
    assert rotating(arrays).force.co == pytest.approx(0.006)
    # moments are about the orbiting scroll, which the ring lies 20 mm behind
    assert reciprocating(arrays, 1).moment.co == pytest.approx(-0.02 * 0.001)


def test_crank_pins_turn_with_the_scroll_analytic() -> None:
    pins = CrankPins(type="crank_pins", count=3, pin_circle_radius_m=0.05, eccentric_mass_kg=0.02, position_m=0.03)
    arrays = layout(_scroll(pins))
    assert rotating(arrays).force.co == pytest.approx(0.005 * (1.2 + 0.06))
    assert rotating(arrays).moment.co == pytest.approx(0.005 * 0.06 * -0.02)
    assert reciprocating(arrays, 1).force.peak == 0.0


def test_of_two_designs_that_differ_in_a_place_alone_each_is_as_by_itself() -> None:
    """Two as many as phasors, and only one array has the leading axis."""
    design = random_machine(np.random.default_rng(5))
    first = design.throws[0]

    def moved(position: Any) -> ReciprocatingMachine:
        there = first.model_copy(update={"position_m": position})
        return design.model_copy(update={"throws": (there, *design.throws[1:]), "reference_plane_m": 0.1})

    plan = layout(moved(np.array([-1.0, 1.0])))
    for order in (1, 2):
        together = reciprocating(plan, order)
        for n, position in enumerate((-1.0, 1.0)):
            alone = reciprocating(layout(moved(position)), order)
            for pair, by_itself in zip(together, alone, strict=True):
                assert np.broadcast_to(pair.co, 2)[n] == by_itself.co
                assert np.broadcast_to(pair.counter, 2)[n] == by_itself.counter


@pytest.mark.parametrize("order", [1, 2, 4, 6])
@pytest.mark.parametrize("seed", range(3))
def test_phasors_of_a_row_turn_by_its_crank_and_its_axis(seed: int, order: int) -> None:
    """Analytic: halves of m r A_k at k d - (k - 1) g with the shaft, and at (k + 1) g - k d against it."""
    plan = layout(random_machine(np.random.default_rng(seed)))
    rows = plan.reciprocating
    phasors = reciprocating_forces(plan, order)
    crank, axis = np.angle(rows.crank_direction), np.angle(rows.axis)
    size = 0.5 * rows.mass * rows.crank_radius * acceleration_harmonic(order, rows.rod_ratio)
    np.testing.assert_allclose(phasors.co, size * np.exp(1j * (order * crank - (order - 1) * axis)), atol=1e-12)
    np.testing.assert_allclose(phasors.counter, size * np.exp(1j * ((order + 1) * axis - order * crank)), atol=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_orders_summed_together_are_those_of_each_alone_to_the_last_bit(seed: int) -> None:
    """Independent: an answer sums the first and the second at once."""
    plan = layout(random_machine(np.random.default_rng(seed)))
    for order, together in zip((1, 2), reciprocating_orders(plan, (1, 2)), strict=True):
        for pair, alone in zip(together, reciprocating(plan, order), strict=True):
            assert pair.co.tobytes() + pair.counter.tobytes() == alone.co.tobytes() + alone.counter.tobytes()
