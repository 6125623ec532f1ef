"""What each output costs: only the effects that it needs are simulated."""

import copy
import json
import statistics
import time
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from optimizer.analyze import analyze
from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.layout import Layout, layout
from optimizer.outputs.registry import OUTPUTS
from optimizer.pins.answer import pin_loads
from optimizer.pins.loads import even_pin_loads
from schemas.request.requests import AnalyzeRequest
from schemas.scroll.pin_loads import PinLoadsRequest
from tests.benchmarks.cases import EXAMPLES

RECIPROCATING = tuple(name for name in OUTPUTS if name != "pin_loads")
SCENES: dict[str, tuple[str, ...]] = {name: (name,) for name in RECIPROCATING} | {"everything": RECIPROCATING}


def two_rows() -> dict[str, Any]:
    return json.loads((EXAMPLES / "2d12.json").read_bytes())["machine"]


def sixteen_rows() -> dict[str, Any]:
    """Eight copies of the 2D12 on one shaft, turned against each other."""
    machine = two_rows()
    pair = machine["throws"]
    machine["throws"] = []
    for k in range(8):
        for throw in copy.deepcopy(pair):
            throw["name"] = f"{throw['name']}.{k}"
            throw["position_m"] += 0.9 * k
            throw["crank_angle_deg"] += 45.0 * k
            machine["throws"].append(throw)
    machine["friction"]["indicated_power_W"] *= 8
    machine["bearings"] = [{"name": str(k), "position_m": -0.4 + 0.9 * k} for k in range(9)]
    return machine


def without_gas(machine: dict[str, Any]) -> dict[str, Any]:
    bare = copy.deepcopy(machine)
    for throw in bare["throws"]:
        for row in throw["rows"]:
            row.pop("cylinder")
    return bare


def times_by_output(machine: dict[str, Any], repeats: int) -> dict[str, float]:
    """Median milliseconds of `analyze` by output; the outputs take turns."""
    requests = {
        name: AnalyzeRequest.model_validate({"machine": machine, "outputs": outputs})
        for name, outputs in SCENES.items()
    }
    return _medians({name: lambda request=request: analyze(request) for name, request in requests.items()}, repeats)


def residual_with_and_without_gas(machine: dict[str, Any], repeats: int) -> dict[str, float]:
    """Median milliseconds of the residual alone, with and without gas data in the request."""
    requests = {
        name: AnalyzeRequest.model_validate({"machine": body})
        for name, body in (("with gas data", machine), ("without", without_gas(machine)))
    }
    return _medians({name: lambda request=request: analyze(request) for name, request in requests.items()}, repeats)


def broadcasting(machines: int = 1000) -> tuple[float, float]:
    """Seconds for so many machines one by one, and in one call over a leading axis."""
    body = two_rows()
    request = AnalyzeRequest.model_validate({"machine": body})
    arrangement = layout(request.machine)
    block = stack([arrangement] * machines)
    angle = np.deg2rad(np.arange(0.0, 360.0, 10.0))

    def simulate(arrays: Layout) -> None:
        rotating(arrays)
        for order in (1, 2, 4, 6):
            reciprocating(arrays, order)
        motion(arrays, angle)

    start = time.perf_counter()
    for _ in range(machines):
        simulate(arrangement)
    middle = time.perf_counter()
    simulate(block)
    return middle - start, time.perf_counter() - middle


def scroll_pins(repeats: int) -> dict[str, float]:
    """Median milliseconds of the pin loads at 360 angles x 6 pins, and of a million (angle, design) pairs."""
    even = PinLoadsRequest.model_validate({"pin_count": 6, "pin_circle_radius_m": 0.05, "rotation_torque_Nm": 12.5})
    angle = np.linspace(0.0, 360.0, 1000, endpoint=False)
    torque = np.linspace(1.0, 2.0, 1000)[:, None]
    return _medians(
        {
            "360 angles x 6 pins, whole answer": lambda: pin_loads(even),
            "a million pairs x 6 pins, one call": lambda: even_pin_loads(torque, np.asarray(0.05), 6, angle),
        },
        repeats,
    )


def stack(parts: list[Any]) -> Any:
    """Dataclasses of arrays with a leading axis of designs."""
    first = parts[0]
    if is_dataclass(first) and not isinstance(first, type):
        return type(first)(*(stack([getattr(part, field.name) for part in parts]) for field in fields(first)))
    return np.stack(parts)


def _medians(calls: dict[str, Callable[[], Any]], repeats: int) -> dict[str, float]:
    taken: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(repeats + 1):
        for name, call in calls.items():
            start = time.perf_counter()
            call()
            taken[name].append((time.perf_counter() - start) * 1e3)
    return {name: statistics.median(times[1:]) for name, times in taken.items()}
