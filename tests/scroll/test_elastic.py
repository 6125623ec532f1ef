"""Any pattern of pins: the elastic distribution, its limits, its dead points and its peaks."""

from typing import Any

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.numerics.arrays import Real
from optimizer.pins.loads import (
    LoadShapes,
    PeriodicTable,
    Pins,
    dead_points,
    elastic_loads,
    even_pin_loads,
    levers,
    peaks,
)
from tests.night import part
from tests.scroll.patterns import TABLE, TORQUE, ask, even, even_pins, loads, pins_at, random_pins, seeds

TURN = np.arange(360.0)
UNEVEN: dict[str, Any] = {"angles_deg": [0, 75, 140, 265], "radius_m": [0.05, 0.06, 0.045, 0.07]}


def assert_in_equilibrium(load: Real, torque: Any, pins: Pins, angle_deg: Real, tolerance: float = 1e-12) -> None:
    size = np.sum(np.abs(load), axis=-1)
    radius = np.max(np.abs(pins.place), axis=-1)
    moment = np.sum(load * levers(pins.place, angle_deg), axis=-1)
    assert np.all(np.abs(moment - torque) <= tolerance * size * radius)
    assert np.all(np.abs(np.sum(load, axis=-1)) <= tolerance * size)


@pytest.mark.parametrize("count", [3, 4, 5, 6, 17])
def test_even_patterns_return_the_formula_analytic(count: int) -> None:
    forces = elastic_loads(np.full(360, TORQUE), even_pins(count), TURN)
    expected = even_pin_loads(np.asarray(TORQUE), np.asarray(0.06), count, TURN)
    np.testing.assert_allclose(forces, expected, rtol=0, atol=1e-12 * np.max(expected))
    answer = ask(pins=pins_at(360.0 * np.arange(count) / count))
    np.testing.assert_allclose(loads(answer), expected, rtol=0, atol=1e-12 * np.max(expected))
    assert answer.peak_N == pytest.approx(even(count).peak_N, rel=1e-12)


@given(seed=seeds, count=st.integers(3, 9), torque=st.floats(-1e6, 1e6).filter(lambda x: abs(x) > 1e-6))
def test_moment_and_net_force_balance_at_every_instant_analytic(seed: int, count: int, torque: float) -> None:
    pins = random_pins(np.random.default_rng(seed), count)
    assert_in_equilibrium(elastic_loads(np.full(360, torque), pins, TURN), torque, pins, TURN)


@given(seed=seeds, count=st.integers(3, 7))
def test_least_strain_energy_independent(seed: int, count: int) -> None:
    """The same quadratic program by a general solver, in N, mm and stiffness over the largest."""
    rng = np.random.default_rng(seed)
    pins, angle = random_pins(rng, count), rng.uniform(0.0, 360.0)
    lever = 1e3 * levers(pins.place, np.asarray(angle))
    load = cp.Variable(count)
    energy = cp.sum(cp.multiply(0.5 * np.max(pins.stiffness) / pins.stiffness, cp.square(load)))
    problem = cp.Problem(cp.Minimize(energy), [lever @ load == 1e3 * TORQUE, cp.sum(load) == 0])
    problem.solve(solver=cp.CLARABEL)
    forces = elastic_loads(np.asarray(TORQUE), pins, np.asarray(angle))
    np.testing.assert_allclose(forces, load.value, rtol=0, atol=1e-6 * np.max(np.abs(forces)))


@pytest.mark.parametrize("stiffness", [1e9, 1e13, 1e17])
def test_three_infinitely_stiff_pins_carry_all_analytic(stiffness: float) -> None:
    angles = [0, 50, 120, 200, 240, 330]
    stiff = [0, 2, 4]
    values = [stiffness if i in stiff else 1e4 for i in range(6)]
    document = loads(ask(pins=pins_at(angles, stiffness_N_per_m=values)))
    alone = loads(ask(pins=pins_at([angles[i] for i in stiff])))
    limit = 10.0 * 1e4 / stiffness * np.max(np.abs(alone))
    np.testing.assert_allclose(document[:, stiff], alone, rtol=0, atol=limit + 1e-10)
    assert np.max(np.abs(np.delete(document, stiff, axis=1))) <= limit


def test_only_the_ratio_of_the_stiffnesses_counts_analytic() -> None:
    default = ask(pins=pins_at(**UNEVEN))
    for stiffness in (1e-6, 3e7, 1e18):
        same = ask(pins=pins_at(**UNEVEN, stiffness_N_per_m=stiffness))
        np.testing.assert_allclose(loads(same), loads(default), rtol=1e-12, atol=1e-10)


@pytest.mark.parametrize(("turned", "dead"), [(0.0, (0.0, 180.0)), (33.0, (33.0, 213.0)), (-45.0, (135.0, 315.0))])
def test_pins_on_one_line_through_the_centre_have_dead_points_analytic(turned: float, dead: tuple[float, ...]) -> None:
    pins = pins_at([turned, turned + 180.0, turned], radius_m=[0.06, 0.05, 0.03])
    answer = ask(pins=pins)
    assert answer.dead_points_deg == pytest.approx(dead, abs=1e-9)
    assert not answer.equilibrium.holds
    assert "line" in (answer.equilibrium.reason or "")
    assert answer.equilibrium.max_moment_error_Nm == TORQUE
    assert answer.peak_N is None
    assert all(pin.peak_N is None and pin.peak_angle_deg is None for pin in answer.pins)
    assert [warning.code for warning in answer.warnings] == ["dead_points"]
    stuck = [angle for angle, load in zip(answer.angle_deg, answer.pins[0].load_N, strict=True) if load is None]
    assert stuck == pytest.approx(dead)
    assert np.nanmax(np.abs(loads(answer))) < 1e5
    rest = [i for i in range(360) if i not in dead]
    places = Pins(np.array([p["radius_m"] * np.exp(1j * np.deg2rad(p["angle_deg"])) for p in pins]), np.ones(3))
    assert_in_equilibrium(loads(answer)[rest], TORQUE, places, TURN[rest])


def test_a_line_beside_the_centre_has_dead_points_too_analytic() -> None:
    """Without a net force the moment does not depend on the centre. Pins on x = 0.02 m: the eccentric along y."""
    places = 0.02 + 1j * np.array([-0.05, 0.01, 0.06])
    np.testing.assert_allclose(dead_points(places), [90.0, 270.0], rtol=0, atol=1e-9)
    pins = pins_at(np.rad2deg(np.angle(places)).tolist(), radius_m=np.abs(places).tolist())
    assert ask(pins=pins).dead_points_deg == pytest.approx((90.0, 270.0), abs=1e-9)


def test_a_dead_point_between_the_samples_is_found_analytic() -> None:
    answer = ask(pins=pins_at([12.3456, 192.3456]), angles={"step_deg": 120})
    assert answer.dead_points_deg == pytest.approx((12.3456, 192.3456), abs=1e-9)
    assert not answer.equilibrium.holds
    assert not np.any(np.isnan(loads(answer)))


def test_two_opposite_pins_carry_a_couple_analytic() -> None:
    """Q = T / (2 R sin): the exact equilibrium, where the seed's formula has only the mean."""
    answer = ask(pins=pins_at([0, 180]))
    inside = np.arange(1, 180)
    expected = TORQUE / (2 * 0.06 * np.sin(np.deg2rad(inside)))
    np.testing.assert_allclose(loads(answer)[inside, 0], expected, rtol=1e-12)
    assert [warning.code for warning in answer.warnings] == ["too_few_pins"]


def test_one_given_pin_has_the_formula_about_its_own_angle_analytic() -> None:
    answer = ask(pins=pins_at([30.0]))
    np.testing.assert_allclose(loads(answer)[:, 0], 400.0 * np.sin(np.deg2rad(TURN - 30.0)), atol=1e-10)
    assert answer.dead_points_deg == (30.0, 210.0)
    assert answer.equilibrium.max_net_force_N == pytest.approx(400.0)
    assert answer.equilibrium.max_moment_error_Nm == pytest.approx(TORQUE)
    assert answer.peak_N == pytest.approx(400.0)
    assert answer.pins[0].peak_angle_deg == pytest.approx(120.0)


def test_no_torque_needs_no_loads_analytic() -> None:
    for pins in (pins_at([0, 180]), pins_at([0, 90, 200])):
        answer = ask(pins=pins, rotation_torque_Nm=0)
        assert not np.any(loads(answer))
        assert answer.peak_N == 0.0
        assert answer.equilibrium.holds
        assert answer.pins[0].compression_from_deg is None


@pytest.mark.parametrize("torque", part(2, [TORQUE, -3.0, TABLE, {"angle_deg": [10, 200], "torque_Nm": [-5, 20]}]))
@pytest.mark.parametrize("pins", [pins_at(**UNEVEN), pins_at([0, 4, 181], radius_m=[0.05, 0.06, 0.05]), None])
def test_peaks_are_those_of_a_fine_grid_independent(torque: Any, pins: Any) -> None:
    """The largest of 36000 samples; near a peak the load is flat, at an entry of the table it is sampled itself."""
    body = {"pins": pins} if pins else {"pin_count": 3, "pin_circle_radius_m": 0.06}
    coarse = ask(rotation_torque_Nm=torque, angles={"step_deg": 120}, **body)
    fine = ask(rotation_torque_Nm=torque, angles={"step_deg": 0.01}, **body)
    sampled = np.max(np.abs(loads(fine)), axis=0)
    for pin, same, largest in zip(coarse.pins, fine.pins, sampled, strict=True):
        assert (pin.peak_N, pin.peak_angle_deg) == (same.peak_N, same.peak_angle_deg)
        assert largest <= pin.peak_N * (1 + 1e-12)
        assert largest == pytest.approx(pin.peak_N, rel=1e-5)
    assert coarse.peak_N == max(pin.peak_N for pin in coarse.pins)


def test_a_sharp_peak_is_not_missed_analytic() -> None:
    """Isosceles and almost on a line, half-width b, offset h of the third pin.

    At theta = 0 the first two levers are equal, so the third carries T over its distance and they half of it each.
    """
    half, offset = 0.05, 2e-6
    pins = Pins(np.array([-half + 0j, half, 1j * offset]), np.ones(3))
    values, where = peaks(LoadShapes.elastic(pins), PeriodicTable(np.zeros(1), np.array([TORQUE])))
    assert values[2] == pytest.approx(TORQUE / offset, rel=1e-9)
    assert where[2] == pytest.approx(0.0, abs=1e-9)
    assert np.all(values[:2] > 0.5 * values[2])


@pytest.mark.parametrize("angles", [[0, 180, 90], [0, 100, 250], [17.3, 111.1, 250.7]])
def test_peaks_of_very_unequal_stiffnesses_grow_with_the_root_of_their_ratio_analytic(angles: list[float]) -> None:
    """Near the dead point of two stiff pins the third bears; x / (s^2 + x^2) is largest at x = s."""
    answers = [ask(pins=pins_at(angles, stiffness_N_per_m=[ratio, ratio, 1.0])) for ratio in (1e12, 1e14, 1e16)]
    sizes = np.array([answer.peak_N for answer in answers], dtype=float)
    np.testing.assert_allclose(sizes[1:] / sizes[:-1], 10.0, rtol=1e-4)
    assert all(answer.equilibrium.holds for answer in answers)


def test_peaks_of_a_table_between_its_entries_analytic() -> None:
    """d/dtheta ((A + B theta) sin theta) = 0 has its root where tan theta = -(A / B + theta)."""
    answer = ask(pins=pins_at([0, 120, 240]), rotation_torque_Nm={"angle_deg": [0, 359], "torque_Nm": [1, 360]})
    angle = np.deg2rad(answer.pins[0].peak_angle_deg or 0.0)
    assert 250.0 < np.rad2deg(angle) < 300.0
    assert np.tan(angle) == pytest.approx(-(np.deg2rad(1.0) + angle), rel=1e-9)


def test_a_million_pairs_of_angle_and_design_in_one_call_analytic() -> None:
    angle, designs = np.arange(0.0, 360.0, 0.36), 1000
    pins = random_pins(np.random.default_rng(4), 6, designs, 1)
    torque = np.linspace(1.0, 30.0, designs)[:, None]
    forces = elastic_loads(np.broadcast_to(torque, (designs, 1000)), pins, np.broadcast_to(angle, (designs, 1000)))
    assert forces.shape == (designs, 1000, 6)
    assert_in_equilibrium(forces, torque, pins, angle)
    for design in (0, 417, 999):
        actual_pins = Pins(pins.place[design, 0], pins.stiffness[design, 0])
        expected = elastic_loads(np.full(1000, torque[design, 0]), actual_pins, angle)
        np.testing.assert_array_equal(forces[design], expected)
    formula = even_pin_loads(torque, np.full((designs, 1), 0.06), 6, angle)
    assert formula.shape == (designs, 1000, 6)
