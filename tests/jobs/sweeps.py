"""Sweeps to post."""

from typing import Any

MACHINE: dict[str, Any] = {
    "kind": "reciprocating",
    "speed_rpm": 500,
    "throws": [
        {
            "position_m": 0.0,
            "crank_radius_m": 0.1,
            "crank_angle_deg": 0,
            "rotating_mass_kg": 10,
            "rows": [{"axis_deg": 0, "reciprocating_mass_kg": 20}],
        }
    ],
    "webs": [{"name": "=1+1", "position_m": 0.1, "counterweight_radius_m": 0.2, "max_mass_kg": 30}],
}
MASS, SPEED = "/machine/throws/0/rows/0/reciprocating_mass_kg", "/machine/speed_rpm"


def analyses(first: int = 20, second: int = 20, **more: Any) -> dict[str, Any]:
    """A grid of analyses, which are quick; at speed 0 a design is invalid."""
    axes = [
        {"path": MASS, "start": 10, "stop": 30, "count": first},
        {"path": SPEED, "start": -1, "stop": 600, "count": second},
    ]
    return {"task": "analyze", "base": {"machine": MACHINE}, "axes": axes, **more}


def optimisations(count: int = 6, **more: Any) -> dict[str, Any]:
    axes = [{"path": MASS, "start": 10, "stop": 30, "count": count}]
    return {"base": {"machine": MACHINE}, "axes": axes, **more}
