"""Requests on the pins: tables, the gas force, and what is refused with the field that is wrong."""

from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.pins.loads import gas_torques
from schemas.scroll.pin_loads import MAX_PINS, PinLoadsAnswer, PinLoadsRequest
from tests.scroll.patterns import TABLE, TORQUE, ask, even, loads, pins_at

EVEN: dict[str, Any] = {"pin_count": 3, "pin_circle_radius_m": 0.05, "rotation_torque_Nm": 12.5}
PINS: dict[str, Any] = {"pins": pins_at([0, 120, 240]), "rotation_torque_Nm": 12.5}
GAS: dict[str, Any] = {"pin_count": 3, "pin_circle_radius_m": 0.05, "tangential_gas_force_N": 5000}


def table(angles: list[float], values: list[float]) -> dict[str, Any]:
    return {**EVEN, "rotation_torque_Nm": {"angle_deg": angles, "torque_Nm": values}}


def test_the_example_of_the_contract() -> None:
    request = PinLoadsRequest.model_validate({**EVEN, "angles": {"step_deg": 1}})
    answer = ask(**EVEN)
    assert request.count == 3
    assert answer.angle_deg == tuple(range(360))
    assert answer.peak_N == pytest.approx(2 * 12.5 / (3 * 0.05), rel=1e-14)
    assert answer.half_turn_mechanism_peak_N == pytest.approx(4 * 12.5 / (3 * 0.05), rel=1e-14)
    assert answer.orbiting_resistance_torque_Nm is None
    assert answer.contact is None
    assert [pin.index for pin in answer.pins] == [1, 2, 3]
    assert PinLoadsAnswer.model_validate_json(answer.model_dump_json()) == answer


def test_quantities_with_units() -> None:
    answer = ask(pin_count=3, pin_circle_radius_m="50 mm", rotation_torque_Nm="12500 N mm")
    assert answer == ask(**EVEN)


def test_a_table_is_linear_and_periodic_analytic() -> None:
    rotation_torque_Nm = np.array(even(3, rotation_torque_Nm=TABLE).rotation_torque_Nm)
    # from 260 degrees the torque goes back to that of 0 over 100 degrees
    assert rotation_torque_Nm[[0, 35, 70, 115, 260, 310]] == pytest.approx([12, 16, 20, 9, 15, 13.5])
    late = {"angle_deg": [90, 270], "torque_Nm": [1, 3]}
    actual_rotation_torque_Nm = np.array(even(3, rotation_torque_Nm=late).rotation_torque_Nm)
    assert actual_rotation_torque_Nm[[0, 45, 90, 180, 270, 315]] == pytest.approx([2, 1.5, 1, 2, 3, 2.5])


def test_a_repeated_end_changes_nothing_analytic() -> None:
    closed = {"angle_deg": [*TABLE["angle_deg"], 360], "torque_Nm": [*TABLE["torque_Nm"], TABLE["torque_Nm"][0]]}
    assert even(3, rotation_torque_Nm=closed) == even(3, rotation_torque_Nm=TABLE)


def test_a_level_table_is_a_constant_analytic() -> None:
    level = even(4, rotation_torque_Nm={"angle_deg": [10, 200, 300], "torque_Nm": [TORQUE] * 3})
    np.testing.assert_allclose(loads(level), loads(even(4)), rtol=0, atol=1e-12)
    assert level.peak_N == pytest.approx(even(4).peak_N, rel=1e-14)


def test_a_torque_that_changes_its_sign_leaves_no_halves_analytic() -> None:
    answer = even(3, rotation_torque_Nm={"angle_deg": [0, 180], "torque_Nm": [-1, 3]})
    assert all(pin.compression_from_deg is None and pin.tension_to_deg is None for pin in answer.pins)
    assert answer.half_turn_mechanism_peak_N == pytest.approx(4 * 3 / (3 * 0.06))
    assert answer.equilibrium.holds


def test_gas_force_causes_the_torques_analytic() -> None:
    """The lever about the orbiting scroll is half the orbit radius, that of the motor the whole."""
    answer = ask(**GAS, rotation_torque_Nm=None, orbit_radius_m=0.005)
    assert answer.rotation_torque_Nm == (12.5,) * 360
    assert answer.orbiting_resistance_torque_Nm == (25.0,) * 360
    assert loads(answer) == pytest.approx(loads(ask(**EVEN)))
    force = {"angle_deg": [0, 90], "force_N": [1000, 3000]}
    answer = ask(**{**GAS, "tangential_gas_force_N": force}, rotation_torque_Nm=None, orbit_radius_m=0.004)
    assert answer.rotation_torque_Nm[45] == pytest.approx(4.0)
    assert (answer.orbiting_resistance_torque_Nm or ())[45] == pytest.approx(8.0)
    rotation, resistance = gas_torques(np.array([1.0, 2.0]), np.array([0.5, 0.25]))
    assert (rotation.tolist(), resistance.tolist()) == ([0.25, 0.25], [0.5, 0.5])


def without(body: dict[str, Any], name: str) -> dict[str, Any]:
    return {key: value for key, value in body.items() if key != name}


REFUSED = [
    pytest.param(
        table([0.0, 1e-309, 180.0], [1.0, 2.0, 3.0]), ("rotation_torque_Nm", "table", "angle_deg", 1), id="a jump"
    ),
    pytest.param(without(EVEN, "pin_count") | {"pin_circle_radius_m": None}, ("pin_count",), id="no pins"),
    pytest.param({**PINS, "pin_count": 3}, ("pin_count",), id="pins twice"),
    pytest.param({**PINS, "pin_circle_radius_m": 0.05}, ("pin_circle_radius_m",), id="a circle for given pins"),
    pytest.param(without(EVEN, "pin_circle_radius_m"), ("pin_circle_radius_m",), id="no radius"),
    pytest.param(without(EVEN, "rotation_torque_Nm"), ("rotation_torque_Nm",), id="no torque"),
    pytest.param({**GAS, "orbit_radius_m": 0.005, "rotation_torque_Nm": 1}, ("rotation_torque_Nm",), id="two torques"),
    pytest.param(GAS, ("orbit_radius_m",), id="no orbit"),
    pytest.param({**EVEN, "orbit_radius_m": 0.005}, ("orbit_radius_m",), id="an orbit for nothing"),
    pytest.param({**EVEN, "pin_count": MAX_PINS, "angles": {"step_deg": 0.1}}, ("angles", "step_deg"), id="too many"),
    pytest.param({**PINS, "pins": pins_at([0, 120, 480])}, ("pins", 2, "angle_deg"), id="coincident pins"),
    pytest.param(
        {**PINS, "pins": pins_at([0, 120, 240], stiffness_N_per_m=[None, 1e7, 1e7])},
        ("pins", 0, "stiffness_N_per_m"),
        id="a stiffness is missing",
    ),
    pytest.param(
        {**PINS, "pins": pins_at([0], clearance_m=1e-5)}, ("pins", 0, "stiffness_N_per_m"), id="play without any"
    ),
    pytest.param(
        {**PINS, "pins": pins_at([0], eccentricity_error_m=-1e-5)},
        ("pins", 0, "stiffness_N_per_m"),
        id="an error without any",
    ),
    pytest.param(table([0, 90, 90], [1, 2, 3]), ("rotation_torque_Nm", "table", "angle_deg", 2), id="does not rise"),
    pytest.param(table([0, 180, 90], [1, 2, 3]), ("rotation_torque_Nm", "table", "angle_deg", 2), id="falls"),
    pytest.param(table([0, 90], [1, 2, 3]), ("rotation_torque_Nm", "table", "torque_Nm"), id="unequal lengths"),
    pytest.param(
        table([0, 90, 360], [1, 2, 3]), ("rotation_torque_Nm", "table", "torque_Nm", 2), id="not closed at 360"
    ),
    pytest.param(
        table([10, 90, 360], [1, 2, 1]), ("rotation_torque_Nm", "table", "angle_deg", 2), id="ends at 360, begins later"
    ),
    pytest.param(table([0, 360], [1, 1]), ("rotation_torque_Nm", "table", "angle_deg"), id="one value twice"),
    pytest.param(
        {**GAS, "orbit_radius_m": 0.005, "tangential_gas_force_N": {"angle_deg": [0, 9, 3], "force_N": [1, 2, 3]}},
        ("tangential_gas_force_N", "table", "angle_deg", 2),
        id="a force that does not rise",
    ),
]


@pytest.mark.parametrize(("body", "path"), REFUSED)
def test_the_field_is_named(body: dict[str, Any], path: tuple[str | int, ...]) -> None:
    with pytest.raises(ValidationError) as caught:
        PinLoadsRequest.model_validate(body)
    values = [
        (*error["loc"], *problem.path)
        for error in caught.value.errors()
        for problem in error.get("ctx", {}).get("problems", ())
    ]
    assert values == [path]


@pytest.mark.parametrize(
    ("body", "place"),
    [
        pytest.param({**EVEN, "pin_count": 0}, "pin_count", id="0 pins"),
        pytest.param({**EVEN, "pin_count": -3}, "pin_count", id="fewer than 0"),
        pytest.param({**EVEN, "pin_count": 2.5}, "pin_count", id="half a pin"),
        pytest.param({**EVEN, "pin_count": 10**9}, "pin_count", id="very many pins"),
        pytest.param({**EVEN, "pin_circle_radius_m": 0}, "pin_circle_radius_m", id="radius 0"),
        pytest.param({**PINS, "pins": []}, "pins", id="empty"),
        pytest.param({**PINS, "pins": pins_at([0, 120, 240], radius_m=0)}, "radius_m", id="pins at the centre"),
        pytest.param({**PINS, "pins": pins_at([0], stiffness_N_per_m=-1)}, "stiffness_N_per_m", id="stiffness < 0"),
        pytest.param({**PINS, "pins": pins_at([0], stiffness_N_per_m=0)}, "stiffness_N_per_m", id="no stiffness"),
        pytest.param({**PINS, "pins": pins_at([0], clearance_m=-1e-6)}, "clearance_m", id="clearance < 0"),
        pytest.param(table([0, 400], [1, 2]), "angle_deg", id="beyond a turn"),
        pytest.param(table([-1, 90], [1, 2]), "angle_deg", id="before the turn"),
        pytest.param(table([0], [1]), "angle_deg", id="one entry"),
        pytest.param(table([], []), "angle_deg", id="no entries"),
        pytest.param(table([0, 90], [1, float("nan")]), "torque_Nm", id="not a number"),
        pytest.param({**EVEN, "rotation_torque_Nm": 1e300}, "rotation_torque_Nm", id="overflow"),
        pytest.param({**EVEN, "rotation_torque_Nm": [1, 2]}, "rotation_torque_Nm", id="a list"),
        pytest.param({**EVEN, "rotation_torque_Nm": True}, "rotation_torque_Nm", id="a truth"),
        pytest.param({**EVEN, "angles": {"step_deg": 7}}, "angles", id="step"),
        pytest.param({**EVEN, "pin_circle_radius": 1}, "pin_circle_radius", id="unknown field"),
    ],
)
def test_out_of_range(body: dict[str, Any], place: str) -> None:
    with pytest.raises(ValidationError) as caught:
        PinLoadsRequest.model_validate(body)
    assert all(place in error["loc"] for error in caught.value.errors())


@pytest.mark.parametrize("radius", [1e-6, 1e6])
@pytest.mark.parametrize("torque", [1e-300, 1e18, -1e18])
def test_nothing_overflows_at_the_ends_of_the_ranges(radius: float, torque: float) -> None:
    for pattern in (
        {"pin_count": 5, "pin_circle_radius_m": radius},
        {"pins": pins_at([0, 100, 200], radius_m=radius)},
        {"pins": pins_at([0, 100, 200], radius_m=[radius, 1.0, radius])},
    ):
        answer = ask(**pattern, rotation_torque_Nm=torque)
        assert np.all(np.isfinite(loads(answer)))
        assert answer.equilibrium.holds
        assert answer.peak_N is not None
        assert np.max(np.abs(loads(answer))) <= answer.peak_N * (1 + 1e-9)
