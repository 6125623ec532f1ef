"""Machines with main bearings, from one throw to sixty rows, as request bodies."""

import copy
from typing import Any

Body = dict[str, Any]

#: a compressor's cycle whose gas pushes about as hard as the inertia of the engines below
CYCLE: Body = {
    "bore_m": 0.085,
    "piston_rod_diameter_m": 0.02,
    "acting": "double",
    "suction_pressure_Pa": 1e5,
    "discharge_pressure_Pa": 4e6,
    "relative_clearance": 0.02,
    "expansion_exponent": 1.35,
    "compression_exponent": 1.35,
}
PITCH = 0.11


def shaft(
    cranks: list[float],
    axes: tuple[float, ...] = (90.0,),
    *,
    pitch: float = PITCH,
    rod: float | None = 0.145,
    speed: float = 4000.0,
    gas: bool = False,
    most: float | None = 5.0,
    **more: Any,
) -> Body:
    """Throws of these crank angles with rows of these axes on each, bearings midway, two webs a throw."""
    throws, webs = [], []
    for k, crank in enumerate(cranks):
        z = k * pitch
        rows = [
            {
                "axis_deg": axis,
                "offset_m": 0.2 * pitch * (n - 0.5 * (len(axes) - 1)),
                "reciprocating_mass_kg": 0.5,
                "connecting_rod": {"length_m": rod, "mass_kg": 0.6, "reciprocating_share": 0.3},
                **({"cylinder": copy.deepcopy(CYCLE)} if gas else {}),
            }
            for n, axis in enumerate(axes)
        ]
        throws.append(
            {
                "position_m": z,
                "crank_radius_m": 0.045,
                "crank_angle_deg": crank,
                "rotating_mass_kg": 0.8,
                "rows": rows,
            }
        )
        webs += [
            {
                "name": f"{k}{side}",
                "position_m": z + off * pitch,
                "counterweight_radius_m": 0.06,
                "max_mass_kg": most,
            }
            for side, off in (("a", -0.25), ("b", 0.25))
        ]
    bearings = [
        {"name": str(k), "position_m": (k - 0.5) * pitch, "diameter_m": 0.06, "length_m": 0.02}
        for k in range(len(cranks) + 1)
    ]
    return {"kind": "reciprocating", "speed_rpm": speed, "throws": throws, "webs": webs, "bearings": bearings, **more}


def single(**more: Any) -> Body:
    return shaft([30.0], **more)


def twin(**more: Any) -> Body:
    return shaft([0.0, 180.0], **more)


def three(**more: Any) -> Body:
    return shaft([0.0, 120.0, 240.0], **more)


def four(**more: Any) -> Body:
    return shaft([0.0, 180.0, 180.0, 0.0], **more)


def six(**more: Any) -> Body:
    return shaft([0.0, 120.0, 240.0, 240.0, 120.0, 0.0], **more)


def vee(**more: Any) -> Body:
    """Four throws of a cross-plane shaft with two rows each."""
    return shaft([0.0, 90.0, 270.0, 180.0], (45.0, 135.0), **more)


def sixteen(**more: Any) -> Body:
    """Eight throws, sixteen rows, nine bearings."""
    return shaft([0.0, 180.0, 90.0, 270.0, 270.0, 90.0, 180.0, 0.0], (60.0, 120.0), **more)


def radial(count: int, **more: Any) -> Body:
    """One throw with a star of rows."""
    body = shaft([0.0], tuple(360.0 * k / count for k in range(count)), **more)
    for row in body["throws"][0]["rows"]:
        row["offset_m"] = 0.0
    return body


def sixty(**more: Any) -> Body:
    """Twenty throws with three rows each, nine bearings."""
    body = shaft([72.0 * k * k for k in range(20)], (60.0, 90.0, 120.0), **more)
    body["bearings"] = [
        {"name": str(k), "position_m": (2.5 * k - 0.5) * PITCH, "diameter_m": 0.06, "length_m": 0.02} for k in range(9)
    ]
    return body


SMALL = {"single": single, "twin": twin, "three": three}
MEDIUM = {"four": four, "six": six, "vee": vee}
LARGE = {"sixteen": sixteen, "sixty": sixty}
