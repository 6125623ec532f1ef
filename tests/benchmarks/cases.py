"""The machines that are timed, as request bodies."""

import json
from collections.abc import Callable
from pathlib import Path

EXAMPLES = Path(__file__).parents[2] / "examples"


def example(name: str) -> Callable[[], bytes]:
    return lambda: (EXAMPLES / f"{name}.json").read_bytes()


def eight_webs() -> bytes:
    """The 2D12 with eight places for counterweights, every kind of limit on."""
    body = json.loads((EXAMPLES / "2d12.json").read_bytes())
    body["machine"]["webs"] = [
        {"name": str(k), "position_m": -0.35 + 0.1 * k, "counterweight_radius_m": 0.25, "max_mass_kg": 40.0}
        for k in range(8)
    ]
    body.pop("objective", None)
    return json.dumps(body).encode()


def limited() -> bytes:
    body = json.loads(eight_webs())
    for k, web in enumerate(body["machine"]["webs"]):
        web["sector"] = {"centre_deg": 180.0 if k >= 4 else 0.0, "half_angle_deg": 60.0}
    body["machine"]["max_total_mass_kg"] = 120.0
    body["objective"] = {"combine": "max", "direction_weights": {"x": 1.0, "y": 2.0}, "force_ceiling_N": 9000.0}
    return json.dumps(body).encode()


def many_webs() -> bytes:
    body = json.loads(eight_webs())
    body["machine"]["webs"] = [
        {"name": str(k), "position_m": -0.5 + k / 199, "counterweight_radius_m": 0.25, "max_mass_kg": 2.0}
        for k in range(200)
    ]
    return json.dumps(body).encode()


CASES: dict[str, Callable[[], bytes]] = {
    "2D12, 4 webs": example("2d12"),
    "2D12, 8 webs": eight_webs,
    "2D12, 8 webs, every limit": limited,
    "V8, 8 webs": example("v8-cross-plane"),
    "2D12, 200 webs": many_webs,
}
