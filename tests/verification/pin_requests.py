"""Patterns of scroll pins, and what the service answers to them."""

import json
from functools import cache
from typing import Any

from optimizer.pins.answer import pin_loads
from schemas.scroll.pin_loads import PinLoadsRequest
from tests.verification.test_curves import part

ANGLES = {"step_deg": 30.0}
RING = {"key_radius_m": 0.06, "mass_kg": 0.35, "axis_deg": 20.0, "friction_coefficient": 0.08}
LOSSES = {
    "speed_rpm": 3000.0,
    "pin_diameter_m": 0.008,
    "pin_friction_coefficient": 0.002,
    "oldham_ring": RING,
}
TABLE = {"angle_deg": [10, 120, 240], "torque_Nm": [12.0, 15.0, -3.0]}
FORCE = {"angle_deg": [0, 90, 360], "force_N": [1000.0, 1500.0, 1000.0]}
EVEN = {"pin_circle_radius_m": 0.05, "rotation_torque_Nm": 12.5, "angles": ANGLES}
PLACES = [(10.0, 0.05, 2e7), (130.0, 0.06, 1e7), (250.0, 0.045, 3e7), (300.0, 0.05, 2e7)]
PINS = [{"angle_deg": angle, "radius_m": radius, "stiffness_N_per_m": k} for angle, radius, k in PLACES]
LOOSE = [{**pin, "clearance_m": 1e-5, "eccentricity_error_m": 4e-6 * n} for n, pin in enumerate(PINS)]
LINE = [{"angle_deg": angle, "radius_m": 0.05} for angle in (30.0, 210.0)]
UNEVEN = {"pins": PINS, "rotation_torque_Nm": TABLE, "angles": ANGLES}
REQUESTS: dict[str, dict[str, Any]] = {
    **{f"{count} even": {**EVEN, "pin_count": count} for count in (1, 2, 3, 5)},
    "rigid": {**EVEN, "pin_count": 3, "drive_bearing": {"type": "rigid"}},
    "two, rigid": {**EVEN, "pin_count": 2, "drive_bearing": {"type": "rigid"}},
    "table": {**EVEN, "pin_count": 2, "rotation_torque_Nm": TABLE},
    "uneven": UNEVEN,
    "uneven, rigid": {**UNEVEN, "rotation_torque_Nm": -4.0, "drive_bearing": {"type": "rigid"}},
    "uneven, elastic": {**UNEVEN, "drive_bearing": {"type": "elastic", "stiffness_N_per_m": 5e7}},
    "on a line": {"pins": LINE, "rotation_torque_Nm": 4.0, "angles": ANGLES},
    "force, losses": {
        "pins": PINS,
        "tangential_gas_force_N": FORCE,
        "orbit_radius_m": 0.005,
        "comparison": LOSSES,
        "angles": ANGLES,
    },
}
WITH_CLEARANCE: dict[str, dict[str, Any]] = {
    "clearance": {**UNEVEN, "pins": LOOSE, "rotation_torque_Nm": 12.0},
    "clearance, rigid": {**UNEVEN, "pins": LOOSE, "drive_bearing": {"type": "rigid"}},
    "clearance, elastic": {
        **UNEVEN,
        "pins": LOOSE,
        "drive_bearing": {"type": "elastic", "stiffness_N_per_m": 5e7},
    },
    "an error at a dead point": {
        "pins": [{**pin, "stiffness_N_per_m": 2e7, "eccentricity_error_m": 4e-6 * n} for n, pin in enumerate(LINE)],
        "rotation_torque_Nm": {"angle_deg": [30, 120, 210, 300], "torque_Nm": [0.0, 2.0, 0.0, -2.0]},
        "angles": ANGLES,
    },
}
#: pins on a line, whose loads jump at dead points
JUMPS = "an error at a dead point"
#: of what has kinks
BETWEEN = {"peak_N", "peak_bracket_N", "peak_angle_deg"}


def answer_to(request: Any) -> Any:
    return json.loads(pin_loads(PinLoadsRequest.model_validate(request)).model_dump_json())


@cache
def _text(name: str) -> str:
    return json.dumps(answer_to((REQUESTS | WITH_CLEARANCE)[name]))


def pair(name: str) -> tuple[Any, Any]:
    return json.loads(json.dumps((REQUESTS | WITH_CLEARANCE)[name])), json.loads(_text(name))


def pins_of(request: dict[str, Any]) -> Any:
    return part("pins").Pins(part("numbers").Place(request, "request"))
