"""What can be said of a scroll, one feature at a time: of the machine, and of a request for the loads of its pins.

Both name torque, gas force and drive bearing alike, so that these features go on either.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from tests.pairs.machines import Request
from tests.pairs.subject import Subject

Feature = Callable[[Subject], None]

#: three evenly spaced pins under a torque
EVEN_PINS: Request = {"pin_count": 3, "pin_circle_radius_m": 0.06, "rotation_torque_Nm": 12.0}

_TORQUES = {"angle_deg": [0.0, 70.0, 115.0, 260.0], "torque_Nm": [12.0, 20.0, 9.0, 15.0]}
_SWINGING = {"angle_deg": [0.0, 90.0, 200.0], "torque_Nm": [14.0, -6.0, 3.0]}
_STEEP = {"angle_deg": [0.0, 180.0, 180.000001, 360.0], "torque_Nm": [5.0, 5.0, 25.0, 5.0]}
_FORCES = {"angle_deg": [10.0, 130.0, 250.0], "force_N": [4000.0, 5000.0, 4300.0]}
_CAUSES = ("rotation_torque_Nm", "tangential_gas_force_N")
_ALL_OUTPUTS = ["residual", "balance_rate", "hodograph", "orders", "foundation_loads", "stages"]
_RING_KEYS = {"key_radius_m": 0.06, "mass_kg": 0.35, "axis_deg": 30.0, "friction_coefficient": 0.08}


def _fields(subject: Subject, **fields: object) -> None:
    subject.scroll.update(fields)


def _cause(subject: Subject, **fields: object) -> None:
    """In place of what causes the loads so far."""
    for name in _CAUSES:
        subject.scroll.pop(name, None)
    subject.scroll.update(fields)
    if "tangential_gas_force_N" in fields:
        subject.scroll.setdefault("orbit_radius_m", 0.005)


def _machine(subject: Subject, **fields: object) -> None:
    subject.machine.update(fields)


def _guide(subject: Subject, **fields: object) -> None:
    subject.machine["anti_rotation"] = fields


def _crank_pins(subject: Subject, **fields: object) -> None:
    pins = {"count": 3, "pin_circle_radius_m": 0.05, "eccentric_mass_kg": 0.02, "position_m": 0.03}
    _guide(subject, type="crank_pins", **{**pins, **fields})


def _ring(subject: Subject, **fields: object) -> None:
    ring = {"mass_kg": 0.3, "axis_deg": 60.0, "position_m": 0.06}
    _guide(subject, type="oldham", **{**ring, **fields})


def _pin_loads(subject: Subject, **fields: object) -> None:
    """Of crank pins, under the torque that is given or one of its own."""
    if subject.machine["anti_rotation"]["type"] != "crank_pins":
        _crank_pins(subject, **fields)
    if not any(name in subject.machine for name in _CAUSES):
        subject.machine["rotation_torque_Nm"] = 12.0
    outputs = subject.body.setdefault("outputs", ["residual"])
    subject.body["outputs"] = [*outputs, *({"pin_loads"} - set(outputs))]


def _outputs(subject: Subject) -> None:
    outputs = subject.body.get("outputs", [])
    subject.body["outputs"] = [*_ALL_OUTPUTS, *(name for name in outputs if name not in _ALL_OUTPUTS)]


def _samples(subject: Subject, step_deg: float) -> None:
    subject.body["angles"] = {"step_deg": step_deg}


def _scenario(subject: Subject) -> None:
    """A heavier scroll on a wider orbit."""
    values = (("orbiting_mass_kg", 1.4), ("orbit_radius_m", 0.0055))
    changes = [{"path": f"/machine/{name}", "value": value} for name, value in values]
    subject.body["scenarios"] = [{"name": "as it is"}, {"name": "other", "weight": 1.2, "changes": changes}]


def _texts(subject: Subject) -> None:
    """Lengths in millimetres, and a speed with its unit."""
    subject.machine.update({"orbit_radius_m": "5 mm", "speed_rpm": f"{subject.machine['speed_rpm']} rpm"})


def _pattern(subject: Subject, angles_deg: Sequence[float] = ()) -> list[dict[str, Any]]:
    """The pins one by one: at these angles, or where they are."""
    body = subject.pins
    count = body.pop("pin_count", 0)
    radius = body.pop("pin_circle_radius_m", 0.06)
    if angles_deg or count:
        angles = angles_deg or [360.0 * number / count for number in range(count)]
        # what is said of pins stays with their numbers
        pins = body.get("pins", [])
        body["pins"] = [
            {**(pins[number % len(pins)] if pins else {"radius_m": radius}), "angle_deg": angle}
            for number, angle in enumerate(angles)
        ]
    places: list[dict[str, Any]] = body["pins"]
    return places


def _even(subject: Subject, count: int) -> None:
    subject.pins.pop("pins", None)
    subject.pins.update(pin_count=count, pin_circle_radius_m=0.06)


def _uneven(subject: Subject, angles_deg: Sequence[float]) -> None:
    _pattern(subject, angles_deg)


def _of_every_pin(subject: Subject, name: str, values: Sequence[float]) -> None:
    """A field of every pin, its values in turn; what has play or an error has a stiffness."""
    for number, pin in enumerate(_pattern(subject)):
        pin.setdefault("stiffness_N_per_m", 2e7)
        pin[name] = values[number % len(values)]


def _radii(subject: Subject) -> None:
    for number, pin in enumerate(_pattern(subject)):
        pin["radius_m"] = (0.05, 0.08, 0.03)[number % 3]


def _elastic(subject: Subject) -> None:
    """An elastic bearing beside pins with a stiffness; those of a machine have none."""
    if "machine" not in subject.body:
        _of_every_pin(subject, "stiffness_N_per_m", (2e7,))
    subject.scroll["drive_bearing"] = {"type": "elastic", "stiffness_N_per_m": 5e7}


def _comparison(subject: Subject, friction: float = 0.002, **ring: float) -> None:
    subject.pins.setdefault("orbit_radius_m", 0.005)
    subject.pins["comparison"] = {
        "speed_rpm": 3000.0,
        "pin_diameter_m": 0.008,
        "pin_friction_coefficient": friction,
        "oldham_ring": {**_RING_KEYS, **ring},
    }


#: on a scroll, and on a request for the loads of its pins
SHARED_FEATURES: Mapping[str, Feature] = {
    "torque": partial(_cause, rotation_torque_Nm=12.5),
    "torque backwards": partial(_cause, rotation_torque_Nm=-8.0),
    "torque of 0": partial(_cause, rotation_torque_Nm=0.0),
    "table of torque": partial(_cause, rotation_torque_Nm=_TORQUES),
    "torque of both signs": partial(_cause, rotation_torque_Nm=_SWINGING),
    "steep torque": partial(_cause, rotation_torque_Nm=_STEEP),
    "gas force": partial(_cause, tangential_gas_force_N=5000.0),
    "table of gas force": partial(_cause, tangential_gas_force_N=_FORCES),
    "torque and gas force": partial(_fields, rotation_torque_Nm=1.0, tangential_gas_force_N=1.0, orbit_radius_m=0.005),
    "rigid drive bearing": partial(_fields, drive_bearing={"type": "rigid"}),
    "elastic drive bearing": _elastic,
    "coarse samples": partial(_samples, step_deg=45.0),
    "fine samples": partial(_samples, step_deg=0.5),
}

#: on a scroll machine alone
SCROLL_FEATURES: Mapping[str, Feature] = {
    **SHARED_FEATURES,
    "crank pins": _crank_pins,
    "crank pins without mass": partial(_crank_pins, eccentric_mass_kg=0.0),
    "two heavy crank pins": partial(_crank_pins, count=2, eccentric_mass_kg=0.4),
    "many crank pins": partial(_crank_pins, count=60, eccentric_mass_kg=0.001),
    "ring along x": partial(_ring, axis_deg=0.0),
    "ring without mass": partial(_ring, mass_kg=0.0),
    "heavy ring far off": partial(_ring, mass_kg=3.0, position_m=-0.3),
    "no orbiting mass": partial(_machine, orbiting_mass_kg=0.0),
    "scroll over the end web": partial(_machine, orbiting_position_m=-0.11),
    "narrow orbit": partial(_machine, orbit_radius_m=1e-7),
    "pin loads": _pin_loads,
    "loads of one pin": partial(_pin_loads, count=1),
    "outputs of a scroll": _outputs,
    "scenario of the scroll": _scenario,
    "texts with units": _texts,
}

#: on a request for the loads of pins alone
PIN_FEATURES: Mapping[str, Feature] = {
    **SHARED_FEATURES,
    "one pin": partial(_even, count=1),
    "two pins": partial(_even, count=2),
    "four pins": partial(_even, count=4),
    "many pins": partial(_even, count=12),
    "uneven pins": partial(_uneven, angles_deg=(0.0, 110.0, 250.0)),
    "two pins at an angle": partial(_uneven, angles_deg=(20.0, 110.0)),
    "opposite pins": partial(_uneven, angles_deg=(0.0, 180.0)),
    "four pins on one side": partial(_uneven, angles_deg=(10.0, 40.0, 70.0, 100.0)),
    "unequal radii": _radii,
    "equal stiffness": partial(_of_every_pin, name="stiffness_N_per_m", values=(2e7,)),
    "unequal stiffness": partial(_of_every_pin, name="stiffness_N_per_m", values=(1e6, 5e7, 2e8)),
    "play": partial(_of_every_pin, name="clearance_m", values=(1e-5,)),
    "unequal play": partial(_of_every_pin, name="clearance_m", values=(0.0, 2e-5, 5e-6)),
    "large play": partial(_of_every_pin, name="clearance_m", values=(0.0, 0.01)),
    "errors of eccentricity": partial(_of_every_pin, name="eccentricity_error_m", values=(4e-6, -3e-6, 0.0)),
    "comparison": _comparison,
    "comparison without friction": partial(_comparison, friction=0.0, friction_coefficient=0.0),
    "comparison with a heavy ring": partial(_comparison, mass_kg=40.0),
}
