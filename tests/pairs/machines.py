"""Small machines that features are put on, with what their ceilings are measured by."""

from collections.abc import Mapping
from copy import deepcopy
from functools import cache
from typing import Any

from optimizer.analyze import analyze
from schemas.request.requests import AnalyzeRequest

Request = dict[str, Any]

_GAS = {
    "bore_m": 0.2,
    "piston_rod_diameter_m": 0.04,
    "acting": "double",
    "suction_pressure_Pa": 1e5,
    "discharge_pressure_Pa": 4e5,
    "relative_clearance": 0.1,
    "expansion_exponent": 1.3,
    "compression_exponent": 1.3,
}


def _row(name: str, axis_deg: float, mass_kg: float) -> dict[str, Any]:
    rod = {"length_m": 0.4, "mass_kg": 6.0, "reciprocating_share": 0.35}
    return {"name": name, "axis_deg": axis_deg, "reciprocating_mass_kg": mass_kg, "connecting_rod": rod}


def _throw(name: str, at_m: float, angle_deg: float, *rows: dict[str, Any]) -> dict[str, Any]:
    return {
        "name": name,
        "position_m": at_m,
        "crank_radius_m": 0.08,
        "crank_angle_deg": angle_deg,
        "rotating_mass_kg": 5.0,
        "rows": list(rows),
    }


def _web(name: str, at_m: float) -> dict[str, Any]:
    return {"name": name, "position_m": at_m, "counterweight_radius_m": 0.15, "max_mass_kg": 12.0}


def _bearing(name: str, at_m: float) -> dict[str, Any]:
    return {"name": name, "position_m": at_m, "diameter_m": 0.09, "length_m": 0.05}


#: by which a force makes a moment that is worth limiting
_ARM_M = 0.02
#: two throws at a right angle, which leaves force and moment; two rows in a V on one throw; a scroll with a ring
BASES: Mapping[str, Request] = {
    "twin": {
        "machine": {
            "kind": "reciprocating",
            "speed_rpm": 900,
            "throws": [_throw("1", 0.1, 0, _row("I", 0, 18.0)), _throw("2", -0.1, 90, _row("II", 0, 15.0))],
            "webs": [_web("1a", 0.16), _web("1b", 0.05), _web("2a", -0.05), _web("2b", -0.16)],
            "bearings": [_bearing("A", 0.2), _bearing("B", -0.2)],
        }
    },
    "vee": {
        "machine": {
            "kind": "reciprocating",
            "speed_rpm": 1200,
            "throws": [_throw("1", 0.0, 30, _row("I", 45, 9.0), _row("II", 135, 11.0))],
            "webs": [_web("a", 0.07), _web("b", -0.07)],
            "bearings": [_bearing("A", 0.12), _bearing("B", -0.12)],
        }
    },
    "scroll": {
        "machine": {
            "kind": "scroll",
            "speed_rpm": 3000,
            "orbit_radius_m": 0.005,
            "orbiting_mass_kg": 1.2,
            "orbiting_position_m": 0.09,
            "anti_rotation": {"type": "oldham", "mass_kg": 0.3, "axis_deg": 60, "position_m": 0.06},
            "webs": [
                {"name": "main", "position_m": 0.05, "counterweight_radius_m": 0.022, "max_mass_kg": 1.5},
                {"name": "end", "position_m": -0.11, "counterweight_radius_m": 0.03, "max_mass_kg": 0.5},
            ],
        }
    },
}


def gas() -> dict[str, Any]:
    """Gas data of a cylinder."""
    return deepcopy(_GAS)


@cache
def at_rest(base: str) -> Mapping[str, float]:
    """Peaks without counterweights that ceilings are shares of, by their fields: N, Pa and N m."""
    machine = BASES[base]["machine"]
    turning = machine["kind"] == "reciprocating"
    outputs = ["residual", *(["main_bearings"] if turning else [])]
    answer = analyze(AnalyzeRequest.model_validate({"machine": machine, "outputs": outputs}))
    assert answer.residual is not None
    before = answer.residual.before
    # a machine without a moment gets one under its ceiling as its webs are loaded unequally
    least = _ARM_M * before.force.peak_N
    peaks = {"force_ceiling_N": before.force.peak_N, "moment_ceiling_Nm": max(before.moment.peak_Nm, least)}
    peaks |= {"force_ceiling_x_N": before.force.peak_x_N, "force_ceiling_y_N": before.force.peak_y_N}
    peaks |= {"moment_ceiling_x_Nm": max(before.moment.peak_x_Nm, least)}
    peaks |= {"moment_ceiling_y_Nm": max(before.moment.peak_y_Nm, least)}
    loads = answer.main_bearings
    bearing = max(support.before.peak_N for support in loads.bearings) if loads is not None else 1e3
    bending = max(loads.bending.before_Nm) if loads is not None else 1e2
    return peaks | {
        "bearing_ceiling_N": bearing,
        "specific_load_ceiling_Pa": bearing / (0.09 * 0.05),
        "bending_ceiling_Nm": bending,
    }
