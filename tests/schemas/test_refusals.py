"""What a request must not hold: everything that could reach the arithmetic as something else than it looks."""

import copy
import json
from typing import Any

import pytest
from pydantic import ValidationError

from schemas.machine.scroll_machine import ScrollMachine
from schemas.request.requests import AnalyzeRequest, OptimizeRequest

BODY: dict[str, Any] = {
    "machine": {
        "kind": "reciprocating",
        "name": "test",
        "speed_rpm": 500,
        "rotation": "ccw",
        "reference_plane_m": 0.1,
        "max_total_mass_kg": 100,
        "throws": [
            {
                "name": "1",
                "position_m": 0,
                "crank_radius_m": 0.14,
                "crank_angle_deg": 0,
                "rotating_mass_kg": 5,
                "rows": [
                    {
                        "name": "I",
                        "axis_deg": 0,
                        "offset_m": 0.01,
                        "reciprocating_mass_kg": 100,
                        "connecting_rod": {"length_m": 0.7, "mass_kg": 20, "reciprocating_share": 0.3},
                        "cylinder": {
                            "bore_m": 0.7,
                            "piston_rod_diameter_m": 0.1,
                            "suction_pressure_Pa": 1e5,
                            "discharge_pressure_Pa": 3e5,
                            "ambient_pressure_Pa": 1e5,
                            "relative_clearance": 0.1,
                            "expansion_exponent": 1.4,
                            "compression_exponent": 1.4,
                            "head": {"relative_clearance": 0.2},
                        },
                    }
                ],
            }
        ],
        "webs": [
            {
                "name": "a",
                "position_m": 0.2,
                "counterweight_radius_m": 0.2,
                "max_mass_kg": 50,
                "sector": {"centre_deg": 180, "half_angle_deg": 60},
            }
        ],
    },
    "objective": {
        "combine": "sum",
        "force_weight": 1,
        "moment_weight": 2,
        "direction_weights": {"x": 1, "y": 2},
        "force_ceiling_N": 1e6,
        "moment_ceiling_Nm": 1e6,
        "force_ceiling_x_N": 1e6,
        "moment_ceiling_y_Nm": 1e6,
        "least_mass": True,
    },
    "accuracy": {"relative_gap": 1e-6},
    "outputs": ["residual"],
    "angles": {"step_deg": 1},
    "fidelity": {"kinematics": "exact"},
}


def leaves(value: Any, path: tuple[str | int, ...] = ()) -> list[tuple[tuple[str | int, ...], Any]]:
    """Every value in a body with the way to it."""
    if isinstance(value, dict | list):
        inner = value.items() if isinstance(value, dict) else enumerate(value)
        return [leaf for key, value in inner for leaf in leaves(value, (*path, key))]
    return [(path, value)]


def changed(path: tuple[str | int, ...], value: Any) -> dict[str, Any]:
    body = copy.deepcopy(BODY)
    inner: Any = body
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = value
    return body


NUMBERS = [path for path, value in leaves(BODY) if isinstance(value, int | float) and not isinstance(value, bool)]
IDS = ["/".join(map(str, path)) for path in NUMBERS]


def test_the_body_itself_is_valid() -> None:
    OptimizeRequest.model_validate(BODY)
    OptimizeRequest.model_validate_json(json.dumps(BODY))


@pytest.mark.parametrize("path", NUMBERS, ids=IDS)
@pytest.mark.parametrize("value", ["true", "false", '"1"', "[]", "{}", "NaN", "Infinity", "-Infinity", "1e999", '""'])
def test_no_number_can_be(path: tuple[str | int, ...], value: str) -> None:
    text = json.dumps(changed(path, "@")).replace('"@"', value)
    with pytest.raises(ValidationError) as caught:
        OptimizeRequest.model_validate_json(text)
    for error in caught.value.errors():
        assert [key for key in error["loc"] if key in path or isinstance(key, int)][: len(path)] == list(path)


@pytest.mark.parametrize("step", [5e-324, 1e-310, 7.0])
def test_no_step_of_angles_is_too_small_to_be_counted(step: float) -> None:
    body = copy.deepcopy(BODY)
    body["machine"]["catalogue"] = {"angle_step_deg": step}
    with pytest.raises(ValidationError, match="360 degrees must be a whole number of steps"):
        OptimizeRequest.model_validate(body)


@pytest.mark.parametrize("path", NUMBERS, ids=IDS)
@pytest.mark.parametrize("value", [10**400, -(10**400), 1e300, -1e300, 5e31])
def test_no_number_can_be_so_large_that_the_arithmetic_overflows(path: tuple[str | int, ...], value: float) -> None:
    if path[-1] == "max_mass_kg" and 0 < value <= 1e300:
        # a limit is never multiplied before it is clipped: any number means that there is none
        OptimizeRequest.model_validate(changed(path, value))
        return
    with pytest.raises(ValidationError):
        OptimizeRequest.model_validate(changed(path, value))


@pytest.mark.parametrize(
    "path",
    sorted({path[:-1] for path, _ in leaves(BODY) if isinstance(path[-1], str)}, key=str),
    ids=lambda path: "/".join(map(str, path)) or "body",
)
def test_unknown_fields_are_refused_everywhere(path: tuple[str | int, ...]) -> None:
    with pytest.raises(ValidationError) as caught:
        OptimizeRequest.model_validate(changed((*path, "unknown"), 1))
    assert [(e["type"], e["loc"][-1]) for e in caught.value.errors()] == [("extra_forbidden", "unknown")]


POSITIVE = {"speed_rpm", "crank_radius_m", "length_m", "bore_m", "counterweight_radius_m", "half_angle_deg", "step_deg"}
POSITIVE |= {"relative_gap", "expansion_exponent", "compression_exponent", "relative_clearance"}
POSITIVE |= {"suction_pressure_Pa", "discharge_pressure_Pa"}
SIGNED = {"reference_plane_m", "position_m", "offset_m", "crank_angle_deg", "axis_deg", "centre_deg"}


@pytest.mark.parametrize("path", NUMBERS, ids=IDS)
def test_signs(path: tuple[str | int, ...]) -> None:
    name = path[-1]
    negative, zero = changed(path, -0.001), changed(path, 0)
    if name in SIGNED:
        OptimizeRequest.model_validate(negative)
    else:
        with pytest.raises(ValidationError):
            OptimizeRequest.model_validate(negative)
    if name in POSITIVE:
        with pytest.raises(ValidationError):
            OptimizeRequest.model_validate(zero)
    else:
        OptimizeRequest.model_validate(zero)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("machine", "kind"), "rotary"),
        (("machine", "rotation"), "CCW"),
        (("machine", "throws"), []),
        (("machine", "throws"), {}),
        (("machine", "name"), ""),
        (("machine", "name"), "a\nb"),
        (("machine", "webs", 0, "name"), "x" * 65),
        (("machine", "webs", 0, "name"), 1),
        (("machine", "webs", 0, "sector", "half_angle_deg"), 90.001),
        (("machine", "throws", 0, "rows", 0, "connecting_rod", "reciprocating_share"), 1.001),
        (("objective", "combine"), "least"),
        (("objective", "least_mass"), 1),
        (("objective", "least_mass"), "true"),
        (("outputs",), ["nothing"]),
        (("outputs",), "residual"),
        (("accuracy", "relative_gap"), 1e-13),
        (("fidelity", "kinematics"), "order_3"),
    ],
    ids=str,
)
def test_values_out_of_range(path: tuple[str | int, ...], value: Any) -> None:
    with pytest.raises(ValidationError):
        OptimizeRequest.model_validate(changed(path, value))


@pytest.mark.parametrize("count", [0, -1, True, 2.5, 3.0, "3", None, 1001])
def test_the_number_of_pins_is_a_whole_number(count: Any) -> None:
    pins = {"type": "crank_pins", "count": count, "pin_circle_radius_m": 0.05, "position_m": 0}
    body = {"kind": "scroll", "speed_rpm": 3000, "orbit_radius_m": 0.005, "orbiting_mass_kg": 1}
    with pytest.raises(ValidationError) as caught:
        ScrollMachine.model_validate({**body, "orbiting_position_m": 0, "anti_rotation": pins})
    assert [e["loc"] for e in caught.value.errors()] == [("anti_rotation", "crank_pins", "count")]


def test_required_fields_are_asked_for() -> None:
    with pytest.raises(ValidationError) as caught:
        OptimizeRequest.model_validate({"machine": {"kind": "reciprocating", "throws": [{}]}})
    missing = {".".join(map(str, e["loc"][2:])) for e in caught.value.errors() if e["type"] == "missing"}
    assert missing == {"speed_rpm", "throws.0.position_m", "throws.0.crank_radius_m", "throws.0.crank_angle_deg"}


def test_models_are_frozen() -> None:
    request = OptimizeRequest.model_validate(BODY)
    for model, name in ((request, "outputs"), (request.machine, "speed_rpm"), (request.objective, "combine")):
        with pytest.raises(ValidationError, match="frozen"):
            setattr(model, name, getattr(model, name))


def test_a_request_is_written_as_it_was_read() -> None:
    request = OptimizeRequest.model_validate(BODY)
    assert OptimizeRequest.model_validate_json(request.model_dump_json()) == request


def test_errors_do_not_repeat_the_input() -> None:
    with pytest.raises(ValidationError) as caught:
        AnalyzeRequest.model_validate(changed(("machine", "speed_rpm"), "secret rpm"))
    assert "secret" not in str(caught.value)
