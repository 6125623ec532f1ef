"""Motion of the rows: derivatives, limits, own angles, harmonics."""

import mpmath
import numpy as np
import pytest

from optimizer.mechanics.kernel.chamber_values import angle_at
from optimizer.mechanics.kinematics import motion, own_angle
from optimizer.mechanics.layout import Layout, layout
from optimizer.mechanics.slider_crank import acceleration_harmonic, acceleration_harmonic_order_2
from optimizer.numerics.arrays import Real
from tests.builders import OMEGA, RADIUS, machine, random_machine, row, stack, throw

THETA = np.deg2rad(np.arange(0.0, 360.0, 7.0))
RATIOS = [0.0, 1e-6, 0.2, 1.0 / 3.0, 0.9, 0.999]


def single_row(rod_ratio: float, axis: float = 0.0, crank: float = 0.0, rotation: str = "ccw") -> Layout:
    length = None if rod_ratio == 0.0 else RADIUS / rod_ratio
    return layout(machine(throw(crank, row(axis, length_m=length)), rotation=rotation))


def _pin(rod_ratio: float, phi: mpmath.mpf) -> mpmath.mpf:
    """Travel from the outer dead centre, from the triangle of crank and rod."""
    if rod_ratio == 0.0:
        return RADIUS * (1 - mpmath.cos(phi))
    length = mpmath.mpf(RADIUS) / mpmath.mpf(rod_ratio)
    reach = RADIUS * mpmath.cos(phi) + mpmath.sqrt(length**2 - (RADIUS * mpmath.sin(phi)) ** 2)
    return RADIUS + length - reach


@pytest.mark.parametrize("rod_ratio", RATIOS)
def test_velocity_and_acceleration_are_derivatives_of_the_travel(rod_ratio: float) -> None:
    actual_motion = motion(single_row(rod_ratio), THETA)
    with mpmath.workdps(60):
        travel = [_pin(rod_ratio, mpmath.mpf(t)) for t in THETA]  # independent
        rates = [[mpmath.diff(lambda p: _pin(rod_ratio, p), mpmath.mpf(t), n) for t in THETA] for n in (1, 2)]
    for got, expected, unit in (
        (actual_motion.displacement, travel, 1.0),
        (actual_motion.velocity, rates[0], OMEGA),
        (actual_motion.acceleration, rates[1], OMEGA**2),
    ):
        expected = unit * np.array(expected, dtype=float)
        np.testing.assert_allclose(got[0], expected, rtol=1e-10, atol=1e-13 * np.abs(expected).max())


def test_order_2_are_derivatives_of_its_own_travel() -> None:
    arrays = single_row(0.3)
    step = 1e-3
    stencil = np.array([-3, -2, -1, 0, 1, 2, 3])
    first = np.array([-1, 9, -45, 0, 45, -9, 1]) / 60.0
    second = np.array([2, -27, 270, -490, 270, -27, 2]) / 180.0
    travel = np.stack([motion(arrays, THETA + k * step, False).displacement[0] for k in stencil])
    actual_motion = motion(arrays, THETA, False)
    # independent: differences of sixth order
    np.testing.assert_allclose(actual_motion.velocity[0], OMEGA * first @ travel / step, atol=1e-11 * OMEGA)
    np.testing.assert_allclose(
        actual_motion.acceleration[0], OMEGA**2 * second @ travel / step**2, atol=1e-8 * OMEGA**2
    )


def test_infinite_rod_is_a_sine() -> None:
    travel = motion(single_row(0.0), THETA)
    # analytic
    np.testing.assert_allclose(travel.displacement[0], RADIUS * (1.0 - np.cos(THETA)), atol=1e-16)
    np.testing.assert_allclose(travel.velocity[0], RADIUS * OMEGA * np.sin(THETA), rtol=1e-13)
    np.testing.assert_allclose(travel.acceleration[0], RADIUS * OMEGA**2 * np.cos(THETA), rtol=1e-13)
    np.testing.assert_array_equal(travel.rod_angle_sine, 0.0)
    np.testing.assert_array_equal(travel.rod_angle_cosine, 1.0)


@pytest.mark.parametrize("rod_ratio", [0.2, 0.999])
@pytest.mark.parametrize("exact", [True, False])
def test_dead_centres(rod_ratio: float, exact: bool) -> None:
    travel = motion(single_row(rod_ratio), np.array([0.0, np.pi]), exact)
    # analytic: both forms agree with the crank at its dead centres
    np.testing.assert_allclose(travel.displacement[0], [0.0, 2.0 * RADIUS], atol=1e-15)
    np.testing.assert_allclose(travel.velocity[0], 0.0, atol=1e-12)
    unit = RADIUS * OMEGA**2
    np.testing.assert_allclose(travel.acceleration[0], [unit * (1 + rod_ratio), -unit * (1 - rod_ratio)], rtol=1e-12)


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
@pytest.mark.parametrize(("axis", "crank"), [(0.0, 0.0), (90.0, 30.0), (-50.0, 200.0), (400.0, -700.0)])
def test_own_angle_counts_from_the_own_dead_centre_in_the_sense_of_rotation(
    rotation: str, axis: float, crank: float
) -> None:
    arrays = single_row(0.25, axis, crank, rotation)
    sense = 1.0 if rotation == "ccw" else -1.0
    phi = own_angle(arrays, THETA)[0]
    expected = THETA + sense * np.deg2rad(crank - axis)  # analytic: the contract
    np.testing.assert_allclose(np.exp(1j * phi), np.exp(1j * expected), atol=1e-12)
    # independent: the outer dead centre is where the crank, as it turns, points along the axis
    at_axis = THETA[0] + np.mod(sense * np.deg2rad(axis - crank), 2.0 * np.pi)
    outer = motion(arrays, np.array([at_axis]))
    assert outer.displacement[0, 0] == pytest.approx(0.0, abs=1e-15)
    shortly_after = motion(arrays, np.array([at_axis + 0.1]))
    assert shortly_after.velocity[0, 0] > 0.0
    assert 0.0 < np.mod(shortly_after.crank_angle[0, 0], 2.0 * np.pi) < np.pi


@pytest.mark.parametrize("seed", range(6))
def test_pin_and_piston_stay_a_rod_apart(seed: int) -> None:
    arrays = layout(random_machine(np.random.default_rng(seed)))
    rows, travel = arrays.reciprocating, motion(arrays, THETA)
    radius, length = rows.crank_radius[:, None], (rows.crank_radius / rows.rod_ratio)[:, None]
    # independent: where crank pin and crosshead are in the drawing
    pin = radius * rows.crank_direction[:, None] * np.exp(1j * arrays.sense * THETA)
    crosshead = rows.axis[:, None] * (radius + length - travel.displacement)
    np.testing.assert_allclose(np.abs(crosshead - pin), np.broadcast_to(length, pin.shape), rtol=1e-12)
    obliquity = -arrays.sense * np.imag((crosshead - pin) / rows.axis[:, None]) / length
    np.testing.assert_allclose(travel.rod_angle_sine, obliquity, atol=1e-12)


@pytest.mark.parametrize("exact", [True, False])
@pytest.mark.parametrize("rod_ratio", RATIOS)
def test_angle_at_inverts_the_travel(rod_ratio: float, exact: bool) -> None:
    phi = np.linspace(0.02, np.pi - 0.02, 400)
    moving = motion(single_row(rod_ratio), phi, exact)

    def angle(travel: float, left: float) -> float:
        return float(angle_at.py_func(travel, left, RADIUS, rod_ratio, 1.0 - rod_ratio, exact))

    phases = [angle(travel, 2.0 * RADIUS - travel) for travel in moving.displacement[0].tolist()]
    np.testing.assert_allclose(phases, phi, atol=1e-12)  # analytic
    # a hair beyond a dead centre is at it
    assert (angle(-1e-17, 2.0 * RADIUS), angle(2.0 * RADIUS, -1e-17)) == (0.0, np.pi)


@pytest.mark.parametrize(("rod_ratio", "highest"), [(0.0, 2), (0.2, 12), (0.4, 20), (0.7, 60)])
def test_orders_add_up_to_the_acceleration(rod_ratio: float, highest: int) -> None:
    actual = motion(single_row(rod_ratio), THETA).acceleration[0] / (RADIUS * OMEGA**2)
    orders = [1, *range(2, highest + 1, 2)]
    expected = sum(acceleration_harmonic(k, np.asarray(rod_ratio)) * np.cos(k * THETA) for k in orders)
    np.testing.assert_allclose(actual, expected, atol=1e-10)  # independent: closed forms, order by order


def test_order_2_adds_up_to_its_acceleration() -> None:
    actual = motion(single_row(0.3), THETA, False).acceleration[0] / (RADIUS * OMEGA**2)
    expected = sum(acceleration_harmonic_order_2(k, np.asarray(0.3)) * np.cos(k * THETA) for k in (1, 2, 4))
    np.testing.assert_allclose(actual, expected, atol=1e-13)


@pytest.mark.parametrize("exact", [True, False])
def test_a_batch_is_the_loop(exact: bool) -> None:
    rng = np.random.default_rng(5)
    layouts = []
    while len(layouts) < 4:
        arrangement = layout(random_machine(rng, "v"))
        if arrangement.reciprocating.mass.size == 4:
            layouts.append(arrangement)
    angles = rng.uniform(0.0, 7.0, (4, 9))
    batch = motion(stack(layouts), angles, exact)
    shared = motion(stack(layouts), angles[0], exact)

    def same(got: Real, expected: Real) -> None:
        np.testing.assert_allclose(got, expected, rtol=1e-14, atol=1e-14 * np.abs(expected).max())

    for k, single_layout in enumerate(layouts):
        alone = motion(single_layout, angles[k], exact)
        for name in vars(alone):
            same(getattr(batch, name)[k], getattr(alone, name))
        same(shared.acceleration[k], motion(single_layout, angles[0], exact).acceleration)
        same(batch.tangential_factor[k], alone.tangential_factor)
        same(batch.radial_factor[k], alone.radial_factor)


@pytest.mark.parametrize("rod_ratio", [*RATIOS, 1.0 - 1e-7])
def test_what_remains_to_the_inner_dead_centre(rod_ratio: float) -> None:
    away = np.array([1e-9, 1e-5, 1e-2, 1.0, 1.6, 3.0])
    travel = motion(single_row(rod_ratio), np.pi - away)
    assert travel.remaining is not None
    np.testing.assert_allclose(travel.remaining[0], 2.0 * RADIUS - travel.displacement[0], atol=1e-15 * RADIUS * 8)
    with mpmath.workdps(60):
        # independent: the stroke less the travel at 60 digits
        expected = [float(_pin(rod_ratio, mpmath.pi) - _pin(rod_ratio, mpmath.mpf(t))) for t in np.pi - away]
    tolerance = 1e-12 if rod_ratio < 0.9999 else 1e-8  # the rod ratio alone has 1 - lam to 1e-9 only
    assert np.abs(travel.remaining[0, 1:]) == pytest.approx(np.abs(expected[1:]), rel=max(tolerance, 1e-10))


def test_the_quotient_keeps_what_rounding_takes_off() -> None:
    arrangement = layout(machine(throw(0.0, row(0.0, length_m=0.10000001), radius_m=0.1)))
    # analytic: (l - r) / l, the difference exact
    assert arrangement.reciprocating.rod_margin[0] == pytest.approx((0.10000001 - 0.1) / 0.10000001, rel=1e-15)
