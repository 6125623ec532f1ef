"""Figures and statements of seed 003 on the pins, and where its formula ends."""

import numpy as np
import pytest

from optimizer.pins.loads import degrees_of_freedom, even_pin_loads, levers
from tests.scroll.patterns import CHECKS, TABLE, TORQUE, even, even_pins, loads


@pytest.mark.parametrize("name", ["003-Qmax-n4", "003-Qmax-n6"])
def test_loads_published(name: str) -> None:
    inputs, expected = CHECKS[name]["inputs"], CHECKS[name]["expected"]
    answer = even(inputs["n"], rotation_torque_Nm=inputs["T_R"], pin_circle_radius_m=inputs["R"])
    assert answer.peak_N == pytest.approx(expected["Q_max"], rel=1e-12)
    document = loads(answer)
    np.testing.assert_allclose(document[50], expected["Q_at_50deg"], rtol=0, atol=1e-8)
    assert np.sum(document[50]) == pytest.approx(expected["force_sum_at_50deg"], abs=1e-8)
    moment = np.sum(document * levers(even_pins(inputs["n"], inputs["R"]).place, np.arange(360.0)), axis=-1)
    np.testing.assert_allclose(moment[[0, 50, 137]], expected["moment_at_0_50_137deg"], rtol=1e-12)


@pytest.mark.parametrize("name", ["003-Qmax-n4", "003-Qmax-n6"])
def test_energy_over_a_pitch_published(name: str) -> None:
    """Equation (2): the work of one pin over a turn is that of the torque over 2 pi / n, and so of all over a pitch."""
    inputs, expected = CHECKS[name]["inputs"], CHECKS[name]["expected"]
    pitch = 360.0 / inputs["n"]
    angle = pitch * (np.arange(64) + 0.5) / 64
    load = even_pin_loads(np.asarray(inputs["T_R"]), np.asarray(inputs["R"]), inputs["n"], angle)
    work = np.mean(np.sum(load * levers(even_pins(inputs["n"], inputs["R"]).place, angle), axis=-1)) * np.deg2rad(pitch)
    assert work == pytest.approx(expected["energy_2pi_over_n"], rel=1e-12)
    assert inputs["T_R"] * np.deg2rad(pitch) == pytest.approx(expected["W_F"], rel=1e-12)


@pytest.mark.parametrize("name", ["003-unbalanced-n1", "003-unbalanced-n2"])
def test_one_pin_and_two_do_not_hold_the_scroll_published(name: str) -> None:
    """Erratum E003-4; the rest is analytic: 2 T sin^2 misses T by at most T, and vanishes at 0 and 180 degrees."""
    inputs, expected = CHECKS[name]["inputs"], CHECKS[name]["expected"]
    answer = even(inputs["n"], rotation_torque_Nm=inputs["T_R"], pin_circle_radius_m=inputs["R"])
    document = loads(answer)
    moment = np.sum(document * levers(even_pins(inputs["n"], inputs["R"]).place, np.arange(360.0)), axis=-1)
    np.testing.assert_allclose(moment[[0, 45, 90]], expected["moment_at_0_45_90deg"], rtol=1e-12)
    np.testing.assert_allclose(moment, 24.0 * np.sin(np.deg2rad(np.arange(360.0))) ** 2, atol=1e-12)
    assert np.sum(document[90]) == pytest.approx(expected["force_sum_at_90deg"], abs=1e-9)
    assert not answer.equilibrium.holds
    assert answer.equilibrium.reason
    assert answer.equilibrium.max_moment_error_Nm == pytest.approx(12.0, rel=1e-12)
    assert answer.equilibrium.max_net_force_N == pytest.approx(400.0 if inputs["n"] == 1 else 0.0, abs=1e-9)
    assert answer.dead_points_deg == (0.0, 180.0)
    assert [warning.code for warning in answer.warnings] == ["too_few_pins"]


def test_degrees_of_freedom_published() -> None:
    check = CHECKS["003-dof"]
    for count, case, freedom in zip((1, 3), check["inputs"]["cases"], check["expected"]["F"], strict=True):
        mechanism = even(count).mechanism
        links, lower, higher, repeated, local = case
        assert (mechanism.moving_links, mechanism.lower_pairs, mechanism.higher_pairs) == (links, lower, higher)
        assert (mechanism.virtual_constraints, mechanism.local_freedoms) == (repeated, local)
        assert mechanism.degrees_of_freedom == freedom


@pytest.mark.parametrize("count", [1, 2, 3, 4, 7, 1000])
def test_one_freedom_whatever_the_number_of_pins_analytic(count: int) -> None:
    assert degrees_of_freedom(count) == (count + 2, 2 * count + 2, count - 1, 1)


@pytest.mark.parametrize("torque", [TORQUE, -TORQUE, TABLE])
@pytest.mark.parametrize("count", [3, 4, 5, 6, 12, 101])
def test_three_pins_and_more_hold_the_scroll_at_every_instant_analytic(count: int, torque: object) -> None:
    answer = even(count, rotation_torque_Nm=torque, angles={"step_deg": 0.5})
    document, used = loads(answer), np.array(answer.rotation_torque_Nm)
    moment = np.sum(document * levers(even_pins(count).place, np.array(answer.angle_deg)), axis=-1)
    np.testing.assert_allclose(moment, used, rtol=1e-12)
    np.testing.assert_allclose(np.sum(document, axis=-1), 0.0, atol=1e-12 * np.max(np.abs(document)))
    assert answer.equilibrium.holds
    assert answer.equilibrium.reason is None
    assert answer.dead_points_deg == ()
    assert answer.warnings == ()


@pytest.mark.parametrize("count", [3, 4, 5])
def test_statements_on_the_course_of_the_loads_published(count: int) -> None:
    """Half a turn each in tension and compression; peaks half a turn apart; neighbours a pitch apart; half the force
    of mechanisms that bear for half a turn."""
    answer = even(count)
    document = loads(answer)
    shift = 360 // count
    for i, pin in enumerate(answer.pins):
        np.testing.assert_allclose(np.roll(document[:, 0], i * shift), document[:, i], atol=1e-10)
        np.testing.assert_allclose(np.roll(document[:, i], 180), -document[:, i], atol=1e-10)
        assert pin.phase_deg == pytest.approx(i * shift)
        assert pin.peak_angle_deg == pytest.approx((i * shift + 90.0) % 180.0)
        assert pin.compression_from_deg == pin.tension_to_deg == pytest.approx(i * shift)
        assert pin.compression_to_deg == pin.tension_from_deg == pytest.approx((i * shift + 180.0) % 360.0)
        middle = (i * shift + np.arange(1, 180)) % 360
        assert np.all(document[middle, i] > 0.0)
        assert np.all(document[(middle + 180) % 360, i] < 0.0)
        assert pin.peak_N == pytest.approx(2.0 * TORQUE / (count * 0.06), rel=1e-14)
    assert answer.half_turn_mechanism_peak_N == pytest.approx(2.0 * (answer.peak_N or 0.0), rel=1e-14)


def test_a_torque_the_other_way_swaps_tension_and_compression_analytic() -> None:
    there, back = even(3), even(3, rotation_torque_Nm=-TORQUE)
    np.testing.assert_array_equal(loads(there), -loads(back))
    assert [p.compression_from_deg for p in there.pins] == pytest.approx([p.tension_from_deg for p in back.pins])
    assert back.half_turn_mechanism_peak_N == there.half_turn_mechanism_peak_N
