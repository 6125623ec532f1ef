"""In-line engines with indicated pressures, as clients post them; the pressures are synthetic."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from optimizer.numerics.arrays import Real

AMBIENT = 1e5
COMPRESSION, LAM = 12.0, 0.3
RADIUS = 0.05


def four_stroke(angle_deg: Real, peak_pa: float = 9e6) -> Real:
    """Pressure over 720 degrees from the dead centre of firing: expansion, exhaust, intake, compression."""
    turned = np.deg2rad(angle_deg)
    travel = 1.0 - np.cos(turned) + (1.0 - np.sqrt(1.0 - (LAM * np.sin(turned)) ** 2)) / LAM
    clear = 2.0 / (COMPRESSION - 1.0)
    burnt = peak_pa * ((1.2 * clear) / (travel + 1.2 * clear)) ** 1.28
    compressed = AMBIENT * ((2.0 + clear) / (travel + clear)) ** 1.35
    # from the end of the compression to the line of the expansion in 15 degrees
    rising = compressed + (burnt - compressed) * np.clip(angle_deg / 15.0, 0.0, 1.0)
    open_ = np.where(angle_deg < 360.0, 1.15 * AMBIENT, 0.9 * AMBIENT)
    indices = np.where(angle_deg < 140.0, rising, np.where(angle_deg < 540.0, open_, compressed))
    indices[-1] = indices[0]
    return indices


def trace(step_deg: float = 10.0, turns: int = 2, **rest: Any) -> dict[str, Any]:
    """A trace at equal steps, closed."""
    angle = np.arange(0.0, 360.0 * turns + 0.5 * step_deg, step_deg)
    pressure = four_stroke(angle) if turns == 2 else four_stroke(2.0 * angle)
    return {"angle_deg": angle.tolist(), "pressure_Pa": pressure.tolist(), **rest}


def cylinder(head: dict[str, Any], turns: int = 2, **pressure: Any) -> dict[str, Any]:
    """A single-acting cylinder without a piston rod."""
    return {
        "bore_m": 0.1,
        "piston_rod_diameter_m": 0.0,
        "acting": "head",
        "ambient_pressure_Pa": 1.1e5,
        "pressure": {"head": head, "cycle_turns": turns, **pressure},
    }


def engine(firing_deg: Sequence[float], cylinders: Sequence[dict[str, Any]] | None = None, **rest: Any) -> Any:
    """An in-line engine whose cylinders fire at these shaft angles."""
    actual_cylinders = (
        [cylinder(trace(), dead_centre_deg=angle % 720.0) for angle in firing_deg] if cylinders is None else cylinders
    )
    sense = -1.0 if rest.get("rotation") == "cw" else 1.0
    count = len(firing_deg)
    return {
        "kind": "reciprocating",
        "speed_rpm": 1800.0,
        "throws": [
            {
                "position_m": 0.12 * k,
                "crank_radius_m": RADIUS,
                "crank_angle_deg": 90.0 - sense * fired,
                "rotating_mass_kg": 1.0,
                "rows": [
                    {
                        "axis_deg": 90.0,
                        "reciprocating_mass_kg": 0.9,
                        "connecting_rod": {"length_m": RADIUS / LAM, "mass_kg": 0.8},
                        "cylinder": actual_cylinders[k],
                    }
                ],
            }
            for k, fired in enumerate(firing_deg)
        ],
        "webs": [
            {"name": f"{k}{side}", "position_m": 0.12 * k + off, "counterweight_radius_m": 0.06, "max_mass_kg": 5.0}
            for k in range(count)
            for side, off in (("a", -0.04), ("b", 0.04))
        ],
        "bearings": [{"name": str(k), "position_m": 0.12 * k - 0.06} for k in range(count + 1)],
        "flywheel": {"irregularity": 0.02},
        **rest,
    }


#: a trace of two turns that has no entry at its ends
UNEVEN = {
    "angle_deg": [3.0, 40.0, 41.5, 200.0, 395.0, 640.0, 700.0],
    "pressure_Pa": [8e6, 3e6, 2e6, 1e5, 9e4, 1e6, 4e6],
}
#: of an in-line four, 1-3-4-2
FOUR = (0.0, 540.0, 180.0, 360.0)
