"""Which pointers and values a sweep takes, and which field is named where it does not."""

from typing import Any

import pytest

from schemas.base.target import BadPointer, find_target
from schemas.sweep.request import SweepRequest
from service.common.validation import InvalidRequest, check, pointer
from tests.studies.sweep.single import example, numeric_paths, sweep

SPEED = {"path": "/machine/speed_rpm", "values": [400, 500]}
FORCE = {"path": "/objective/force_ceiling_N", "values": [4000]}


def refused(body: dict[str, Any]) -> dict[str, str]:
    with pytest.raises(InvalidRequest) as caught:
        check(SweepRequest, body)
    return {pointer(problem.path): problem.message for problem in caught.value.problems}


def body(*axes: dict[str, Any], **rest: Any) -> dict[str, Any]:
    return {"base": example("2d12"), "axes": list(axes), **rest}


def single_axis(path: str, *values: Any) -> dict[str, Any]:
    return body({"path": path, "values": list(values)})


@pytest.mark.parametrize(
    "path",
    [
        "/machine/speed_rpm",
        "/machine/throws/1/rows/0/connecting_rod/length_m",
        "/machine/webs/3/max_mass_kg",
        "/machine/max_total_mass_kg",
        "/machine/reference_plane_m",
        "/machine/bearings/0/position_m",
        "/machine/friction/mechanical_efficiency",
        "/objective/force_weight",
        "/objective/moment_weight",
        "/objective/direction_weights/x",
        "/objective/moment_ceiling_Nm",
    ],
)
def test_numeric_fields_are_found(path: str) -> None:
    request = check(SweepRequest, single_axis(path, 1.0))
    assert pointer(request.targets[0].path) == path


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("machine/speed_rpm", "from the root"),
        ("", "from the root"),
        ("/machine/speed~2rpm", "escapes"),
        ("/machine/speed~", "escapes"),
        ("/machine/speed", "no field of this name"),
        ("/machine", "no number"),
        ("/machine/kind", "no number"),
        ("/machine/name", "no number"),
        ("/machine/webs", "no number"),
        ("/machine/webs/4/max_mass_kg", "4 item"),
        ("/machine/webs/-/max_mass_kg", "4 item"),
        ("/machine/webs/00/max_mass_kg", "4 item"),
        ("/machine/webs/0/sector/half_angle_deg", "null in the base"),
        ("/machine/speed_rpm/0", "no other fields"),
        ("/objective/least_mass", "no number"),
        ("/objective/combine", "no number"),
        ("/accuracy/relative_gap", "only fields of"),
        ("/angles/step_deg", "only fields of"),
    ],
)
def test_other_pointers_are_refused_at_the_path(path: str, text: str) -> None:
    problems = refused(single_axis(path, 1.0))
    assert list(problems) == ["/axes/0/path"]
    assert text in problems["/axes/0/path"]


@pytest.mark.parametrize(
    ("path", "value", "text"),
    [
        ("/machine/speed_rpm", "5 kg", "unit must be one of"),
        ("/machine/speed_rpm", "fast", "number in rpm"),
        ("/machine/speed_rpm", None, "may not be null"),
        ("/machine/speed_rpm", True, "must be a number"),
        ("/machine/speed_rpm", [1], "must be a number"),
        ("/machine/speed_rpm", float("nan"), "finite"),
        ("/machine/speed_rpm", float("inf"), "finite"),
        ("/machine/speed_rpm", 10**400, "finite"),
        ("/machine/speed_rpm", "1e999 rpm", "finite"),
        ("/objective/force_weight", "1 N", "must be a number"),
        ("/objective/direction_weights/x", None, "may not be null"),
    ],
)
def test_values_that_no_such_field_takes_are_refused(path: str, value: Any, text: str) -> None:
    problems = refused(single_axis(path, 1.0, value))
    assert list(problems) == ["/axes/0/values/1"]
    assert text in problems["/axes/0/values/1"]


def test_text_with_a_unit_stands_for_its_number() -> None:
    request = sweep(example("2d12"), {"path": "/machine/throws/0/crank_radius_m", "values": ["140 mm", 0.15]})
    target = request.targets[0]
    assert [target.number(radius) for radius in request.axes[0].values or ()] == [0.14, 0.15]


@pytest.mark.parametrize(
    ("second", "text"),
    [
        ("/machine/rotation_torque_Nm/torque_Nm/0", "already"),
        ("/machine/rotation_torque_Nm", "holds this one or lies in it"),
    ],
)
def test_axes_that_vary_the_same_are_refused(second: str, text: str) -> None:
    base = {"machine": example("scroll-three-pins")["machine"]}
    base["machine"]["rotation_torque_Nm"] = {"angle_deg": [0, 180], "torque_Nm": [10, 12]}
    first = {"path": "/machine/rotation_torque_Nm/torque_Nm/0", "values": [1.0]}
    problems = refused({"base": base, "axes": [first, {"path": second, "values": [2.0]}]})
    assert list(problems) == ["/axes/1/path"]
    assert text in problems["/axes/1/path"]


@pytest.mark.parametrize(
    ("fields", "where"),
    [
        (body(), "/axes"),
        (body({"path": SPEED["path"]}), "/axes/0/start"),
        (body({**SPEED, "start": 3}), "/axes/0/start"),
        (body({"path": SPEED["path"], "start": 1, "stop": 2}), "/axes/0/count"),
        (body({"path": SPEED["path"], "start": 1, "stop": 2, "count": 0}), "/axes/0/count"),
        (body({"path": SPEED["path"], "start": -1, "stop": 2, "count": 3, "spacing": "log"}), "/axes/0/start"),
        (body({"path": SPEED["path"], "start": 1, "stop": "2 kg", "count": 3}), "/axes/0/stop"),
        (body(SPEED, FORCE, design="paired"), "/axes/1/values"),
        (body(SPEED, samples=5), "/samples"),
        (body(SPEED, design="latin_hypercube"), "/samples"),
        (body(SPEED, design="latin_hypercube", samples=10_000_001), "/samples"),
        (body(SPEED, seed=-1), "/seed"),
        (
            body({"path": SPEED["path"], "start": 1, "stop": 2, "count": 10_000_000}, FORCE | {"values": [1, 2]}),
            "/axes",
        ),
        (body(SPEED, columns=["speed"]), "/columns/0"),
        (body(SPEED, top={"by": "status"}), "/top/by"),
        (body(SPEED, pareto=["force_peak_N", "nothing"]), "/pareto/1"),
        (body(SPEED, pareto=["force_peak_N"]), "/pareto"),
        (body(SPEED, pareto=["force_peak_N", "force_peak_N"]), "/pareto"),
        (body(SPEED, task="rate"), "/task"),
        ({"base": {**example("2d12"), "outputs": ["hodograph"]}, "axes": [SPEED]}, "/base/outputs/0"),
        (
            {"base": {"machine": {**example("2d12")["machine"], "speed_rpm": 0}}, "axes": [SPEED]},
            "/base/machine/speed_rpm",
        ),
        ({"base": {**example("2d12"), "counterweights": []}, "axes": [SPEED]}, "/base/counterweights"),
        ({"task": "analyze", "base": {**example("2d12"), "objective": {}}, "axes": [SPEED]}, "/base/objective"),
    ],
)
def test_what_is_wrong_is_named(fields: dict[str, Any], where: str) -> None:
    assert where in refused(fields)


def test_escapes_are_those_of_rfc_6901() -> None:
    # ~01 is ~1, not /; no field has such a name, so the message shows how the pointer was read
    assert refused(single_axis("/machine/a~01b", 1.0)) == {"/axes/0/path": "/machine has no field of this name"}
    assert pointer(("a/b", "c~d", 0)) == "/a~1b/c~0d/0"


def test_a_request_survives_its_own_json() -> None:
    request = sweep(example("2d12"), SPEED, FORCE)
    again = SweepRequest.model_validate_json(request.model_dump_json())
    assert again == request
    assert again.targets == request.targets


def test_targets_carry_the_range_of_the_field() -> None:
    request = sweep(example("2d12"), SPEED)
    target = find_target(request.base, "/machine/throws/0/rows/0/cylinder/compression_exponent")
    assert (target.lowest, target.above, target.highest, target.below) == (1.0, True, 10.0, False)
    messages = [rule.message for rule in target.rules(1.0)]
    assert messages == ["must be greater than 1", "must be at most 10"]
    broken = [[bool(rule.broken) for rule in target.rules(number)] for number in (1.0, 1.1, 10.0, 10.1, float("nan"))]
    assert broken == [[True, False], [False, False], [False, False], [False, True], [False, False]]


def test_counts() -> None:
    assert sweep(example("2d12"), SPEED, FORCE | {"values": [1, 2, 3]}).total == 6
    assert sweep(example("2d12"), SPEED, FORCE | {"values": [1, 2]}, design="paired").total == 2
    assert sweep(example("2d12"), SPEED, FORCE, design="latin_hypercube", samples=77).total == 77


def every_pointer(node: Any, path: str = "") -> list[str]:
    """Pointers to everything in a JSON body, whatever it is."""
    paths = [path]
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for name, item in items:
        paths += every_pointer(item, f"{path}/{name}")
    return paths


@pytest.mark.parametrize("name", ["2d12", "v60", "scroll-oldham", "scroll-three-pins"])
def test_every_pointer_leads_to_a_number_or_is_refused(name: str) -> None:
    request = sweep(example(name), SPEED)
    body = request.base.model_dump(mode="json")
    numbers = set(numeric_paths(request))
    for path in every_pointer(body):
        try:
            target = find_target(request.base, path)
        except BadPointer:
            assert path not in numbers
        else:
            assert pointer(target.path) == path
            number = target.number(1)
            assert number == 1.0


@pytest.mark.parametrize(
    ("path", "text", "number"),
    [
        ("/machine/max_total_mass_kg", "0.5 t", 500.0),
        ("/machine/reference_plane_m", "-10 mm", -0.01),
        ("/objective/force_ceiling_N", "2 kN", 2000.0),
        ("/machine/throws/0/rows/0/cylinder/suction_pressure_Pa", "2.86 bar", 286000.0),
    ],
)
def test_fields_that_may_be_null_take_units_too(path: str, text: str, number: float) -> None:
    target = find_target(sweep(example("2d12"), SPEED).base, path)
    assert target.nullable
    assert target.number(text) == number
    assert target.number(None) is None
