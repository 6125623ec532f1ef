"""The published two-row compressor: its data, its tables over the turn, and its rows as arrays."""

import csv
from pathlib import Path
from typing import Any

import numpy as np

from optimizer.mechanics.gas import Chambers
from optimizer.mechanics.layout import Layout, Reciprocating, Rotating, Webs
from optimizer.numerics.arrays import Real

_TABLES = Path(__file__).parent / "tables"
#: rad/s: the tables use a rounded speed, the friction does not
TABLE_OMEGA, OMEGA = 52.33, 500.0 * np.pi / 30.0
ROWS = ("I", "II")
MASS = np.array([303.6, 277.53])  # kg, with the rounded share of the rod
RADIUS, ROD = 0.14, 0.7  # m
AREAS = np.array([[0.41729, 0.41092], [0.15747, 0.1511]])  # m^2, head and crank side
INDICATED = np.array([608300.0, 583000.0])  # W
EFFICIENCY, SHARE = 0.94, 0.7
_STATE = {
    "I": {"suction_pressure_Pa": 286000.0, "discharge_pressure_Pa": 852000.0, "relative_clearance": 0.1},
    "II": {"suction_pressure_Pa": 760000.0, "discharge_pressure_Pa": 2224000.0, "relative_clearance": 0.12},
}
_BORES = {"I": 0.73, "II": 0.45}  # m


def table(name: str) -> dict[str, Real]:
    """Columns of a table over one turn in steps of 10 degrees, 0 to 360; nan where the printed figure errs.

    printed : as published. corrected : recomputed with the errors removed (analytic); columns without more in
    their name use the series and the rounded speed, "exact" ones neither; "bored" ones have the areas of the
    final bores.
    """
    with (_TABLES / f"{name}.csv").open() as file:
        rows = list(csv.DictReader(file))
    return {column: np.array([float(row[column] or "nan") for row in rows]) for column in rows[0]}


def arrays(omega: float = TABLE_OMEGA, mass: Real = MASS) -> Layout:
    """Both rows as a layout, opposed."""
    ahead = np.array([1.0, -1.0], dtype=complex)
    rows = mass.size
    same = np.ones(rows)
    return Layout(
        omega=np.asarray(omega),
        sense=np.asarray(1.0),
        centre_plane=np.asarray(0.0),
        reference_plane=np.asarray(0.0),
        rotating=Rotating(np.zeros(0), np.zeros(0), np.zeros(0, dtype=complex), np.zeros(0)),
        reciprocating=Reciprocating(mass, RADIUS * same, ahead[:rows], ahead[:rows], 0.0 * same, (RADIUS / ROD) * same),
        webs=Webs(np.zeros(0), np.zeros(0)),
    )


def chambers() -> Chambers:
    """Chambers of both rows, with the areas of the tables."""
    low, high, clearance = (
        np.repeat([[_STATE[row][name]] for row in ROWS], 2, axis=1)
        for name in ("suction_pressure_Pa", "discharge_pressure_Pa", "relative_clearance")
    )
    exponent = np.full((2, 2), 1.4)
    return Chambers(AREAS, low, high, clearance, exponent, exponent, np.ones((2, 2), dtype=bool))


def machine(bored: bool = False) -> dict[str, Any]:
    """The machine as a client posts it, with the areas of the tables or of the final bores."""
    throws = []
    for k, row in enumerate(ROWS):
        sizes = (
            {"bore_m": _BORES[row], "piston_rod_diameter_m": 0.11}
            if bored
            else {"head_area_m2": AREAS[k, 0], "crank_area_m2": AREAS[k, 1]}
        )
        exponents = {"expansion_exponent": 1.4, "compression_exponent": 1.4}
        throws.append(
            {
                "position_m": 0.175 - 0.35 * k,
                "crank_radius_m": RADIUS,
                "crank_angle_deg": 180.0 * k,
                "rows": [
                    {
                        "name": row,
                        "axis_deg": 180.0 * k,
                        "reciprocating_mass_kg": MASS[k],
                        "connecting_rod": {"length_m": ROD},
                        "cylinder": {**sizes, **_STATE[row], **exponents},
                    }
                ],
            }
        )
    return {
        "kind": "reciprocating",
        "speed_rpm": 500.0,
        "throws": throws,
        "friction": {
            "mechanical_efficiency": EFFICIENCY,
            "reciprocating_share": SHARE,
            "indicated_power_W": INDICATED.tolist(),
        },
        "flywheel": {"irregularity": 0.01},
    }
