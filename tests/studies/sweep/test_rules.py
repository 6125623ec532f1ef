"""A rule is said once: a row of a sweep is invalid where the request of its design is refused, in the same words."""

import re
from typing import Any

import numpy as np
import pytest

from optimizer.errors import MissingInput
from optimizer.outputs.registry import require_inputs
from schemas.base.rules import Rule, first_of, largest
from schemas.base.target import find_target, pointer
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.common.validation import InvalidRequest, check
from tests import night
from tests.analyze.driven import random_driven
from tests.studies.sweep.single import numeric_paths, put, sweep, table

BORE = {"bore_m": 0.3, "piston_rod_diameter_m": 0.06}
STATE = {"suction_pressure_Pa": 2e5, "discharge_pressure_Pa": 6e5}


def full(seed: int) -> dict[str, Any]:
    """A reciprocating machine with every field that a rule is about."""
    machine = random_driven(seed, "v", throws=2)
    machine["max_total_mass_kg"] = 40.0
    machine["friction"] = {"mechanical_efficiency": 0.9, "reciprocating_share": 0.7}
    cylinder = machine["throws"][0]["rows"][0]["cylinder"]
    cylinder |= BORE | STATE | {"head": dict(STATE), "crank": {"suction_pressure_Pa": 3e5}}
    return machine


def scroll(**load: Any) -> dict[str, Any]:
    return {
        "kind": "scroll",
        "speed_rpm": 3000,
        "orbit_radius_m": 0.005,
        "orbiting_mass_kg": 1.0,
        "orbiting_position_m": 0.1,
        "anti_rotation": {"type": "crank_pins", "count": 3, "pin_circle_radius_m": 0.05, "position_m": 0.0},
        "webs": [{"name": "a", "position_m": 0.2, "counterweight_radius_m": 0.02, "max_mass_kg": 1.0}],
        **load,
    }


def table_of(name: str) -> dict[str, Any]:
    return {"angle_deg": [0.0, 90.0, 200.0, 360.0], name: [10.0, 12.0, 14.0, 10.0]}


FULL = {"machine": full(1), "outputs": ["gas", "torque", "flywheel", "main_bearings"]}
GOAL = {"machine": full(2), "objective": {"moment_weight": 1.0, "direction_weights": {"x": 0.5, "y": 0.5}}}
TORQUE = {"machine": scroll(rotation_torque_Nm=table_of("torque_Nm")), "outputs": ["pin_loads"]}
FORCE = {"machine": scroll(tangential_gas_force_N=table_of("force_N")), "outputs": ["residual", "pin_loads"]}
CONSTANT = {"machine": scroll(tangential_gas_force_N=900.0), "outputs": ["pin_loads"]}

#: task, base, the fields that vary, and what some design is told at least
CASES: dict[str, tuple[str, dict[str, Any], str, set[str]]] = {
    "machine": (
        "analyze",
        FULL,
        "/machine/throws",
        {
            "the connecting rod must be longer than the crank radius",
            "must not be below the suction pressure",
            "must be smaller than the bore",
            "with this clearance and pressure ratio the chamber never delivers; needed by output 'gas'",
            "gas forces need this field; needed by output 'gas'",
        },
    ),
    "one cylinder": (
        "analyze",
        {"machine": full(3)},
        "/machine/throws/0/rows/0/cylinder/.*pressure",
        {"must not be below the suction pressure", "must not be above the discharge pressure"},
    ),
    "bearings": ("analyze", FULL, "/machine/bearings", {"another bearing is in this plane"}),
    "drive": (
        "analyze",
        FULL,
        "/machine/(friction|flywheel)",
        {
            "give the efficiency, or friction forces and torque",
            "give either the irregularity or the inertia",
        },
    ),
    "weights": ("optimize", GOAL, "/objective/(force|moment)_weight$", {"one of the weights must be above 0"}),
    "directions": ("optimize", GOAL, "/objective/dir", {"only one of the two direction weights may be 0"}),
    "torque": (
        "analyze",
        TORQUE,
        "/machine/rotation_torque_Nm",
        {
            "the angles must rise, by 1e-09 at least",
            "360 ends the revolution only if the table begins at 0",
            "the value at 360 must be that at 0: the table is one revolution",
        },
    ),
    "force": ("analyze", FORCE, "/machine/(tangential|orbit)", {"the angles must rise, by 1e-09 at least"}),
    "constant": (
        "analyze",
        CONSTANT,
        "/machine/(tangential|orbit_)",
        {
            "must be between 1e-06 and 1e+06 for pin loads; needed by output 'pin_loads'",
            "pin loads need the torque or the tangential gas force; needed by output 'pin_loads'",
        },
    ),
}


def value_at(body: Any, path: str) -> Any:
    for part in path.split("/")[1:]:
        body = body[int(part)] if isinstance(body, tuple | list) else body[part]
    return body


def colliding_axes(rng: np.random.Generator, blank: SweepRequest, fields: str, count: int) -> list[dict[str, Any]]:
    """Axes over random fields, with values that break rules: those of fields alike, ends of ranges, 0, null."""
    body = blank.base.model_dump(mode="json")
    targets = {path: find_target(blank.base, path) for path in numeric_paths(blank) if re.match(fields, path)}
    axes = []
    for path in rng.choice(list(targets), min(len(targets), int(rng.integers(1, 6))), replace=False):
        target, held = targets[path], value_at(body, path)
        alike = [value_at(body, name) for name, single_target in targets.items() if single_target.unit == target.unit]
        ends = [end for end in (target.lowest, target.highest) if np.isfinite(end)]
        choices = [held, held, held * 1.1, -held, 0.0, 1e-9, *rng.choice(alike, 2), *ends]
        values: list[Any] = [float(value) for value in rng.choice(choices, count)]
        if target.nullable and rng.random() < 0.3:
            values[0] = None
        axes.append({"path": path, "values": [round(v) if target.integer and v is not None else v for v in values]})
    return axes


def refusal(request: SweepRequest, row: dict[str, Any]) -> list[str]:
    """What is said of the design alone, in the order in which it is said; nothing where it is a valid request."""
    body = request.base.model_dump(mode="json")
    for target in request.targets:
        value = row[pointer(target.path)]
        put(body, target.path, int(value) if target.integer and value is not None and value % 1 == 0 else value)
    try:
        scene = check(AnalyzeRequest if request.task == "analyze" else OptimizeRequest, body)
        require_inputs(scene.machine, scene.outputs)
    except (InvalidRequest, MissingInput) as error:
        return [f"{pointer(problem.path)}: {problem.message}" for problem in error.problems]
    return []


def out_of_range(request: SweepRequest, row: dict[str, Any]) -> bool:
    values = [(target, row[pointer(target.path)]) for target in request.targets]
    return any(rule.broken for target, value in values if value is not None for rule in target.rules(value))


@pytest.mark.parametrize("name", night.part(3, CASES))
def test_a_row_is_invalid_where_its_request_is_refused_and_says_the_same(name: str) -> None:
    # property: random sweeps whose values break rules between fields
    task, base, fields, expected = CASES[name]
    rng = np.random.default_rng(list(CASES).index(name))
    blank = sweep(base, {"path": "/machine/speed_rpm", "values": [1]}, task=task)
    parts = set[str]()
    for number in range(30):
        # twelve, and so many more as it takes to break every rule
        if number >= 12 and parts >= expected:
            break
        request = sweep(base, *colliding_axes(rng, blank, fields, 4), task=task, design="paired")
        for row in table(request).to_pylist():
            actual_refusal = refusal(request, row)
            assert (row["status"] == "invalid") == bool(actual_refusal), (row, actual_refusal)
            if actual_refusal and out_of_range(request, row):
                assert row["message"] in actual_refusal
            elif actual_refusal:
                assert row["message"] == actual_refusal[0]
                parts.add(row["message"].split(": ", 1)[1])
    assert parts >= expected


@pytest.mark.parametrize(
    ("broken", "values"),
    [
        # analytic
        ([False, True, True], [False, True, False]),
        ([True, False, True], [True, False, False]),
        ([False, False, False], [False, False, False]),
    ],
)
def test_only_the_first_of_rules_is_said_for_one_and_for_columns(broken: list[bool], values: list[bool]) -> None:
    rules = [Rule(wrong, (), "") for wrong in broken]
    assert [rule.broken for rule in first_of(rules)] == values
    # beside a design that breaks none
    columns = [Rule(np.array([wrong, False]), (), "") for wrong in broken]
    assert [rule.broken.tolist() for rule in first_of(columns)] == [[wrong, False] for wrong in values]


def test_the_largest_of_several_is_exact() -> None:
    # analytic
    pairs = [(1e300, 1e-300), (-0.1, -0.3), (0.1, 0.1), (0.0, -5e-324)]
    assert [largest([*pair]) for pair in pairs] == [max(pair) for pair in pairs]
    first, second = np.array(pairs).T
    assert largest([first, second]).tolist() == [max(pair) for pair in pairs]
    assert largest([first, 1.0, second]).tolist() == [max(*pair, 1.0) for pair in pairs]
