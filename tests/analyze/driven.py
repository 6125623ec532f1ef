"""Machines with everything that the dynamics need, as clients post them."""

from typing import Any

import numpy as np

from optimizer.analyze import analyze
from optimizer.mechanics.cylinders import chambers
from optimizer.mechanics.gas import Chambers
from optimizer.mechanics.layout import Layout, layout
from schemas.answer.answers import AnalyzeAnswer
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import AnalyzeRequest

#: between the axes of the rows on one throw, degrees
_AXES = {"single": [0.0], "v": [0.0, 70.0], "opposed": [0.0, 180.0], "w": [-60.0, 0.0, 60.0]}
STYLES = tuple(_AXES)


def random_cylinder(rng: np.random.Generator, acting: str | None = None) -> dict[str, Any]:
    """A cylinder that delivers on every side that acts; some have data of their own for one side."""
    bore, low = rng.uniform(0.1, 0.8), rng.uniform(5e4, 1e6)
    cylinder: dict[str, Any] = {
        "bore_m": bore,
        "piston_rod_diameter_m": rng.choice([0.0, 0.2 * bore]),
        "acting": acting or str(rng.choice(["double", "double", "head", "crank"])),
        "ambient_pressure_Pa": rng.uniform(0.0, 2e5),
        "suction_pressure_Pa": low,
        "discharge_pressure_Pa": low * rng.uniform(1.2, 4.0),
        "relative_clearance": rng.uniform(0.02, 0.2),
        "expansion_exponent": rng.uniform(1.05, 1.4),
        "compression_exponent": rng.uniform(1.05, 1.4),
    }
    if rng.random() < 0.5:
        side = str(rng.choice(["head", "crank"]))
        cylinder[side] = {"relative_clearance": rng.uniform(0.02, 0.2), "expansion_exponent": rng.uniform(1.05, 1.4)}
    return cylinder


def random_driven(seed: int, style: str = "v", *, throws: int | None = None, **rest: Any) -> dict[str, Any]:
    """A machine of unequal rows on up to three throws, with friction, flywheel, bearings and webs."""
    rng = np.random.default_rng([seed, STYLES.index(style)])
    cranks, count = [], 0
    for k in range(throws or rng.integers(1, 4)):
        radius, first = rng.uniform(0.03, 0.3), rng.uniform(-400.0, 400.0)
        rows = [
            {
                "axis_deg": first + axis,
                "offset_m": rng.uniform(-0.1, 0.1),
                "reciprocating_mass_kg": rng.uniform(1.0, 300.0),
                "connecting_rod": {"length_m": radius / rng.uniform(0.1, 0.5), "mass_kg": rng.uniform(0.0, 80.0)},
                "cylinder": random_cylinder(rng),
            }
            for axis in _AXES[style]
        ]
        count += len(rows)
        cranks.append(
            {
                "position_m": 0.6 * k + rng.uniform(-0.1, 0.1),
                "crank_radius_m": radius,
                "crank_angle_deg": rng.uniform(-400.0, 400.0),
                "rotating_mass_kg": rng.uniform(0.0, 50.0),
                "rows": rows,
            }
        )
    return {
        "kind": "reciprocating",
        "speed_rpm": rng.uniform(200.0, 1500.0),
        "rotation": str(rng.choice(["ccw", "cw"])),
        "throws": cranks,
        "friction": {"mechanical_efficiency": rng.uniform(0.8, 1.0), "reciprocating_share": rng.uniform(0.0, 1.0)},
        "flywheel": {"irregularity": 0.02},
        "bearings": [{"name": str(k), "position_m": -0.4 + 0.6 * k} for k in range(len(cranks) + 1)],
        "webs": [
            {"name": name, "position_m": z, "counterweight_radius_m": 0.2, "max_mass_kg": 50.0}
            for name, z in (("a", -0.2), ("b", 0.3))
        ],
        **rest,
    }


def arrays(body: dict[str, Any]) -> tuple[Layout, Chambers]:
    """Layout and chambers of a machine as it is posted."""
    machine = ReciprocatingMachine.model_validate(body)
    return layout(machine), chambers(machine)


def ask(body: dict[str, Any], *outputs: str, step_deg: float = 1.0, **rest: Any) -> AnalyzeAnswer:
    """Outputs of a machine as it is posted."""
    request = {"machine": body, "outputs": outputs, "angles": {"step_deg": step_deg}, **rest}
    return analyze(AnalyzeRequest.model_validate(request))
