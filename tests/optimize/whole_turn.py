"""Machines whose bearings, bending and higher orders are asked for, as request bodies."""

import json
from pathlib import Path
from typing import Any

from schemas.request.requests import OptimizeRequest

EXAMPLES = Path(__file__).parents[2] / "examples"
#: nothing but what is named counts
ALONE = {"force_weight": 0, "moment_weight": 0}


def inline_six() -> dict[str, Any]:
    """Seven bearings midway between the throws, two webs on each throw."""
    machine: dict[str, Any] = json.loads((EXAMPLES / "inline-six.json").read_bytes())["machine"]
    planes = sorted(throw["position_m"] for throw in machine["throws"])
    pitch = planes[1] - planes[0]
    machine["bearings"] = [
        {"name": str(k), "position_m": planes[0] + (k - 0.5) * pitch, "diameter_m": 0.06, "length_m": 0.02}
        for k in range(7)
    ]
    machine["webs"] = [
        {"name": f"{k}{side}", "position_m": z + off, "counterweight_radius_m": 0.06, "max_mass_kg": 5.0}
        for k, z in enumerate(planes)
        for side, off in (("a", -0.25 * pitch), ("b", 0.25 * pitch))
    ]
    return machine


def single_throw(rod_length_m: float | None = None) -> dict[str, Any]:
    """m r = 1 for the rotating and the reciprocating mass, two webs in the planes of two bearings, 1 rad/s."""
    rod = {"length_m": rod_length_m, "mass_kg": 0.0, "reciprocating_share": 0.3}
    row = {"axis_deg": 0, "reciprocating_mass_kg": 1.0, "connecting_rod": rod}
    throw = {"position_m": 0.0, "crank_radius_m": 1.0, "crank_angle_deg": 0, "rotating_mass_kg": 1.0, "rows": [row]}
    places = (("a", -0.5), ("b", 0.5))
    return {
        "kind": "reciprocating",
        "speed_rpm": 9.549296585513721,
        "throws": [throw],
        "webs": [
            {"name": name, "position_m": z, "counterweight_radius_m": 1.0, "max_mass_kg": 9.0} for name, z in places
        ],
        "bearings": [{"name": name, "position_m": z} for name, z in places],
    }


def request_of(machine: dict[str, Any], **objective: Any) -> OptimizeRequest:
    """A request with an objective; few samples, as no figure depends on them."""
    return OptimizeRequest.model_validate({"machine": machine, "objective": objective, "angles": {"step_deg": 30}})
