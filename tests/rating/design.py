"""The design of seed 004 as a request, the figures of seed_thermal.json, and a strategy of random requests."""

import copy
import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import strategies as st

from schemas.rating.request import RatingRequest

FIGURES = json.loads((Path(__file__).parent / "seed_thermal.json").read_text())

#: 2D12-90/2-20: what seed 004 is given, and the exponents, leaks and losses that it takes from tables and charts
SEED: dict[str, Any] = {
    "name": "2D12-90/2-20",
    "capacity_m3_per_min": 90,
    "suction_pressure_Pa": "0.3 MPa",
    "discharge_pressure_Pa": "2.1 MPa",
    "isentropic_exponent": 1.4,
    "relative_humidity": 1,
    "speed_rpm": 500,
    "stroke_m": "280 mm",
    "mechanical_efficiency": 0.94,
    "stages": [
        {
            "name": "I",
            "piston_rod_diameter_m": 0.11,
            "suction_temperature_K": 313,
            "relative_clearance": 0.1,
            "expansion_exponent": 1.25,
            "pressure_coefficient": 0.97,
            "temperature_coefficient": 0.96,
            "relative_leaks": {"valves": 0.04, "piston_rings": 0.014, "packing": 0.0016},
            "suction_pressure_loss": 0.036,
            "discharge_pressure_loss": 0.061,
        },
        {
            "name": "II",
            "piston_rod_diameter_m": 0.11,
            "suction_temperature_K": 313,
            "relative_clearance": 0.12,
            "expansion_exponent": 1.3,
            "pressure_coefficient": 0.99,
            "temperature_coefficient": 0.96,
            "relative_leaks": {"valves": 0.04, "piston_rings": 0.015, "packing": 0.0024},
            "suction_pressure_loss": 0.028,
            "discharge_pressure_loss": 0.045,
        },
    ],
}


def body(*changes: tuple[str, Any], **more: Any) -> dict[str, Any]:
    """The seed's request with changes, each a path such as "stages/0/bore_m" and a value."""
    variant = copy.deepcopy(SEED)
    for path, value in (*changes, *more.items()):
        inner: Any = variant
        *way, last = [int(step) if step.isdigit() else step for step in path.split("/")]
        for step in way:
            inner = inner[step]
        inner[last] = value
    return variant


def request(*changes: tuple[str, Any], **more: Any) -> RatingRequest:
    return RatingRequest.model_validate(body(*changes, **more))


def rods(diameter_m: float) -> list[tuple[str, Any]]:
    """The change of both piston rods."""
    return [(f"stages/{i}/piston_rod_diameter_m", diameter_m) for i in range(2)]


def figure(name: str) -> tuple[Any, Any, float]:
    """Inputs, expected figures and tolerance of a check of the seed."""
    value = next(check for check in FIGURES["checks"] if check["id"] == name)
    return value["inputs"], value["expected"], value["atol"]


def near(figure: Any, atol: float) -> Any:
    """Equal within an absolute tolerance alone."""
    return pytest.approx(figure, rel=0, abs=atol)


def _number(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False, allow_subnormal=False)


@st.composite
def requests(draw: st.DrawFn, **fixed: Any) -> RatingRequest:
    """Compressors that can be built: up to five stages of ratio up to 4, one to four cylinders each."""
    count = draw(st.integers(1, 5))
    p1 = draw(_number(5e4, 1e6))
    series = fixed.get("bore_series") or draw(st.sampled_from(["R20", "R40", "R80", "none"]))
    # rounded to R20 an area is off by an eighth, and that of the next stage the other way: of less nothing may be left
    ratio = draw(_number(1.2 if series == "none" else 1.4, 4.0))
    stages = [
        {
            "cylinders": draw(st.integers(1, 4)),
            "acting": draw(st.sampled_from(["double", "head", "crank"])),
            "piston_rod_diameter_m": draw(_number(0.0, 0.008)),
            "suction_temperature_K": draw(_number(280.0, 330.0)),
            "relative_clearance": draw(_number(0.02, 0.2)),
            "temperature_coefficient": draw(_number(0.9, 1.0)),
            "relative_leaks": {"valves": draw(_number(0.0, 0.05)), "packing": draw(_number(0.0, 0.01))},
            "side_flow_coefficient": draw(_number(0.5, 1.5)) if index else 1.0,
            "suction_pressure_loss": draw(_number(0.0, 0.05)),
            "discharge_pressure_loss": draw(_number(0.0, 0.05)),
        }
        for index in range(count)
    ]
    machine = {
        "capacity_m3_per_min": draw(_number(5.0, 100.0)),
        "suction_pressure_Pa": p1,
        "discharge_pressure_Pa": p1 * ratio**count,
        "isentropic_exponent": draw(_number(1.05, 1.67)),
        "relative_humidity": draw(_number(0.0, 1.0)),
        "speed_rpm": draw(_number(300.0, 600.0)),
        "stroke_m": draw(_number(0.1, 0.2)),
        "bore_series": series,
        "stages": stages,
    }
    return RatingRequest.model_validate({**machine, **fixed})
