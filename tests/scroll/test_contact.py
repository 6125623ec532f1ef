"""Pins with clearances and errors of eccentricity: which bear, by a convex program with a certificate."""

from typing import Any

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.numerics.arrays import Real
from optimizer.pins.contact import Contact, _gap, _Scaled, pin_contact
from optimizer.pins.loads import elastic_loads, levers
from tests.night import by_day, part
from tests.scroll.patterns import TABLE, TORQUE, ask, even_pins, loads, pins_at, random_pins, seeds

TURN = np.arange(360.0)
STIFFNESS = 2e7
MICRON = 1e-6


def random_case(seed: int, count: int, angles: int = 1) -> dict[str, Any]:
    """Strains, clearances and errors of the same size, some of them 0; angles at random."""
    rng = np.random.default_rng(seed)
    pins = random_pins(rng, count)
    size = 10.0 ** rng.uniform(-1.0, 1.5) * MICRON
    return {
        "lever": levers(pins.place, rng.uniform(0.0, 360.0, angles)),
        "torque": rng.uniform(-40.0, 40.0, angles),
        "stiffness": pins.stiffness,
        "clearance": size * rng.uniform(0.0, 1.0, count) * rng.integers(0, 2, count),
        "error": size * rng.uniform(-1.0, 1.0, count) * rng.integers(0, 2, count),
    }


def by_hand(case: dict[str, Any], contact: Contact) -> Real:
    """The law of the pins at the answer's turn and shift."""
    strain = case["lever"] * contact.rotation[..., None] + contact.shift[..., None] - case["error"]
    return case["stiffness"] * np.sign(strain) * np.maximum(np.abs(strain) - case["clearance"], 0.0)


@by_day(100, 300)
@given(seed=seeds, count=st.integers(2, 9))
def test_law_of_the_pins_and_equilibrium_analytic(seed: int, count: int) -> None:
    case = random_case(seed, count, angles=20)
    contact = pin_contact(**case)
    size = np.sum(np.abs(contact.load), axis=-1)
    reach = np.max(np.abs(case["lever"]))
    moment = np.sum(contact.load * case["lever"], axis=-1)
    assert np.all(np.abs(moment - case["torque"]) <= 1e-12 * size * reach)
    assert np.all(np.abs(np.sum(contact.load, axis=-1)) <= 1e-12 * size)
    assert np.all(contact.gap >= 0.0)
    largest = np.max(np.abs(contact.load), axis=-1)
    assert np.all(contact.error_bound <= 1e-8 * largest + 1e-8)
    np.testing.assert_allclose(by_hand(case, contact), contact.load, rtol=0, atol=1e-8 * np.max(largest) + 1e-8)


@given(seed=seeds, count=st.integers(3, 7))
def test_primal_and_dual_by_a_general_solver_independent(seed: int, count: int) -> None:
    """In N, mm and N/mm; the lever is 60 mm of the turn, so that all unknowns are of one size."""
    case = random_case(seed, count)
    stiffness, torque = case["stiffness"] / 1e3, float(case["torque"][0]) * 1e3
    lever, clearance, error = case["lever"][0] / 0.06, case["clearance"] * 1e3, case["error"] * 1e3
    turn, shift, load = cp.Variable(), cp.Variable(), cp.Variable(count)
    beyond = cp.pos(cp.abs(lever * turn + shift - error) - clearance)
    primal = cp.Problem(cp.Minimize(cp.sum(cp.multiply(0.5 * stiffness, cp.square(beyond))) - torque / 60 * turn))
    primal.solve(solver=cp.CLARABEL)
    terms = cp.multiply(0.5 / stiffness, cp.square(load)) + cp.multiply(clearance, cp.abs(load))
    dual = cp.Problem(cp.Maximize(-cp.sum(terms) - error @ load), [lever @ load == torque / 60, cp.sum(load) == 0])
    dual.solve(solver=cp.CLARABEL)
    contact = pin_contact(**case)
    scale = np.max(np.abs(contact.load[0]))
    assert primal.value == pytest.approx(dual.value, abs=1e-5 * abs(torque) * 1e-3)
    np.testing.assert_allclose(contact.load[0], load.value, rtol=0, atol=2e-4 * scale)
    energy = 0.5 * np.sum(by_hand(case, contact) ** 2 / case["stiffness"]) - case["torque"][0] * contact.rotation[0]
    assert energy * 1e3 <= primal.value + 1e-7 * abs(primal.value) + 1e-9


def test_the_certificate_sees_a_wrong_answer_analytic() -> None:
    """Closed form of the gap against its definition, P - D, for loads that are not the optimum."""
    case = random_case(5, 6, angles=50)
    k, c, error, torque, lever = (case[name] for name in ("stiffness", "clearance", "error", "torque", "lever"))
    contact = pin_contact(**case)
    turn, shift = 1.3 * contact.rotation, contact.shift + MICRON
    strain = lever * turn[:, None] + shift[:, None] - error
    energy = np.sum(0.5 * k * np.maximum(np.abs(strain) - c, 0.0) ** 2, axis=-1) - torque * turn
    dual = -np.sum(contact.load**2 / (2 * k) + c * np.abs(contact.load) + error * contact.load, axis=-1)
    rows = _Scaled(lever, *(np.broadcast_to(x, lever.shape) for x in (k, c, error)), torque)
    np.testing.assert_allclose(_gap(rows, turn, shift, contact.load), energy - dual, rtol=1e-6)
    assert np.all(energy - dual > 0.0)


@pytest.mark.parametrize("clearance", [1e-9, 1e-12, 1e-16])
def test_clearance_to_zero_returns_the_elastic_answer_analytic(clearance: float) -> None:
    pins = {"angles_deg": [0, 75, 140, 265], "radius_m": [0.05, 0.06, 0.045, 0.07]}
    elastic = ask(pins=pins_at(**pins))
    near = ask(pins=pins_at(**pins, stiffness_N_per_m=STIFFNESS, clearance_m=clearance))
    # at most what the clearances take off the strains of all pins
    limit = 8.0 * STIFFNESS * clearance + 1e-9
    np.testing.assert_allclose(loads(near), loads(elastic), rtol=0, atol=limit)
    assert near.peak_N == pytest.approx(elastic.peak_N, abs=limit + 1e-6)
    assert near.equilibrium.holds


def test_no_clearance_is_the_elastic_answer_analytic() -> None:
    pins = random_pins(np.random.default_rng(3), 6)
    none = np.zeros(6)
    contact = pin_contact(levers(pins.place, TURN), np.full(360, TORQUE), pins.stiffness, none, none)
    expected = elastic_loads(np.full(360, TORQUE), pins, TURN)
    np.testing.assert_allclose(contact.load, expected, rtol=0, atol=1e-11 * np.max(expected))


def test_pins_with_much_play_leave_the_torque_to_the_others_analytic() -> None:
    """Three stiff pins without play among six: they bear as if they were alone, and two of three carry at the least."""
    angles = [0, 50, 120, 200, 240, 330]
    play = [0.0, 1e-3] * 3
    answer = ask(pins=pins_at(angles, stiffness_N_per_m=STIFFNESS, clearance_m=play))
    alone = ask(pins=pins_at(angles[::2]))
    np.testing.assert_allclose(loads(answer)[:, ::2], loads(alone), rtol=0, atol=1e-9)
    assert not np.any(loads(answer)[:, 1::2])
    assert [any(pin.carries_load or ()) for pin in answer.pins] == [True, False] * 3
    assert answer.contact is not None
    assert (answer.contact.fewest_pins, answer.contact.most_pins) == (2, 3)


def test_two_opposite_pins_with_play_analytic() -> None:
    """Both bear at once: Q = T / (2 R sin), and the scroll turns by (c + |Q| / k) / (R |sin|)."""
    play, torque = 20 * MICRON, 12.0
    answer = ask(pins=pins_at([0, 180], stiffness_N_per_m=STIFFNESS, clearance_m=play))
    sine = np.sin(np.deg2rad(np.arange(1, 180)))
    load = torque / (2 * 0.06 * sine)
    np.testing.assert_allclose(loads(answer)[1:180, 0], load, rtol=1e-11)
    assert answer.contact is not None
    turn = np.array(answer.contact.scroll_rotation_deg[1:180], dtype=float)
    np.testing.assert_allclose(np.deg2rad(turn), (play + load / STIFFNESS) / (0.06 * sine), rtol=1e-9)


@pytest.mark.parametrize("count", [3, 4, 6])
def test_one_error_preloads_even_pins_analytic(count: int) -> None:
    """Without play the system is linear: the elastic loads and -k (1 - P) eps, P on levers and shift."""
    error = 5 * MICRON
    pins = pins_at(
        360.0 * np.arange(count) / count,
        stiffness_N_per_m=STIFFNESS,
        eccentricity_error_m=[error] + [0.0] * (count - 1),
    )
    document = loads(ask(pins=pins))
    sine = levers(even_pins(count, 1.0).place, TURN)
    own = np.eye(count)[0] - 1.0 / count - 2.0 / count * sine[:, :1] * sine
    expected = 2.0 * TORQUE / (count * 0.06) * sine - STIFFNESS * error * own
    np.testing.assert_allclose(document, expected, rtol=0, atol=1e-10)


def test_an_error_of_all_pins_is_one_of_the_shaft_analytic() -> None:
    pins = {"angles_deg": [0, 75, 140, 265], "stiffness_N_per_m": STIFFNESS}
    without = ask(pins=pins_at(**pins))
    shifted = ask(pins=pins_at(**pins, eccentricity_error_m=-40 * MICRON))
    np.testing.assert_allclose(loads(shifted), loads(without), rtol=0, atol=1e-9)


def test_the_other_way_round_analytic() -> None:
    pins = pins_at([0, 75, 140, 265], stiffness_N_per_m=STIFFNESS, clearance_m=[0.0, 3e-6, 1e-5, 2e-6])
    there, back = ask(pins=pins), ask(pins=pins, rotation_torque_Nm=-TORQUE)
    np.testing.assert_allclose(loads(back), -loads(there), rtol=0, atol=1e-9)
    assert [pin.carries_load for pin in there.pins] == [pin.carries_load for pin in back.pins]


@pytest.mark.parametrize("torque", [TORQUE, TABLE])
def test_peaks_do_not_depend_on_the_samples_independent(torque: Any) -> None:
    """Against ten samples a degree. Loads with play have kinks, so these come less near to the peak."""
    body = {
        "pins": pins_at(
            [0, 75, 140, 265],
            stiffness_N_per_m=STIFFNESS,
            clearance_m=[0.0, 3e-6, 1e-5, 2e-6],
            eccentricity_error_m=[4e-6, 0.0, 0.0, -2e-6],
        ),
        "rotation_torque_Nm": torque,
    }
    coarse, fine = ask(**body, angles={"step_deg": 120}), ask(**body, angles={"step_deg": 0.1})
    for pin, same, largest in zip(coarse.pins, fine.pins, np.max(np.abs(loads(fine)), axis=0), strict=True):
        assert (pin.peak_N, pin.peak_angle_deg) == (same.peak_N, same.peak_angle_deg)
        assert largest <= pin.peak_N * (1 + 1e-9)
        assert largest == pytest.approx(pin.peak_N, rel=5e-3)
    assert coarse.pins[0].compression_from_deg is None
    assert fine.equilibrium.holds
    assert fine.warnings == ()
    carried = np.array([pin.carries_load for pin in fine.pins])
    np.testing.assert_array_equal(carried, loads(fine).T != 0.0)
    assert fine.contact is not None
    assert fine.contact.load_error_bound_N < 1e-8


def test_dead_points_stay_analytic() -> None:
    """Play or not, equal levers hold no torque; nothing is reported there."""
    pins = pins_at([0, 180, 0], radius_m=[0.06, 0.05, 0.03], stiffness_N_per_m=STIFFNESS, clearance_m=1e-5)
    answer = ask(pins=pins)
    assert answer.dead_points_deg == (0.0, 180.0)
    assert answer.pins[0].load_N[0] is None
    assert answer.pins[0].load_N[180] is None
    assert answer.contact is not None
    assert answer.contact.scroll_rotation_deg[0] is None
    assert answer.peak_N is None
    assert not answer.equilibrium.holds


def test_leading_axes_analytic() -> None:
    pins = random_pins(np.random.default_rng(9), 5, 7, 1)
    lever = levers(pins.place, np.broadcast_to(TURN, (7, 360)))
    play = np.array([0.0, 1e-5, 2e-6, 0.0, 4e-6])
    contact = pin_contact(lever, np.full((7, 360), TORQUE), pins.stiffness, play, 0.0 * play)
    assert contact.load.shape == (7, 360, 5)
    assert contact.rotation.shape == contact.shift.shape == contact.gap.shape == contact.error_bound.shape == (7, 360)
    actual_contact = pin_contact(lever[3], np.full(360, TORQUE), pins.stiffness[3], play, 0.0 * play)
    np.testing.assert_array_equal(contact.load[3], actual_contact.load)


@pytest.mark.parametrize("stiffness", part(2, [1e-6, 1e3, 1e18]))
@pytest.mark.parametrize("play", [1e-15, 1e-6, 1.0])
@pytest.mark.parametrize("torque", [1e-18, 1.0, 1e18])
def test_extremes_are_in_equilibrium_or_say_so_analytic(stiffness: float, play: float, torque: float) -> None:
    """At 35 degrees the pins without play are at their dead point, so the others have to bear."""
    pins = pins_at([0, 100, 250, 300], stiffness_N_per_m=stiffness, clearance_m=[0.0, play, 0.0, play])
    answer = ask(pins=pins, rotation_torque_Nm=torque)
    assert np.all(np.isfinite(loads(answer)))
    lost = stiffness * play > 1e15 * torque
    assert answer.equilibrium.holds or lost
    assert answer.equilibrium.holds or "not_converged" in {warning.code for warning in answer.warnings}


CROSSING = {"angle_deg": [0.0, 90.0, 180.0, 270.0], "torque_Nm": [10.0, 0.0, -10.0, 0.0]}


@pytest.mark.parametrize("torque", [0.0, CROSSING])
def test_loads_that_are_nothing_are_certified_analytic(torque: Any) -> None:
    """Without a torque at an angle, pins with clearance carry nothing, to the digits of that clearance."""
    pins = pins_at([0, 120, 240], stiffness_N_per_m=STIFFNESS, clearance_m=[0.0, MICRON, 2.0 * MICRON])
    answer = ask(pins=pins, rotation_torque_Nm=torque)
    assert answer.contact is not None
    assert answer.contact.load_error_bound_N <= 1e-9
    np.testing.assert_allclose(loads(answer)[90], 0.0, atol=1e-9)
    assert answer.warnings == ()
