"""Crankshafts as lists of faces, written from their drawing; what the drawing says is what has to be found.

Two throws like those of the 2D12: crank radius 140, pins of 150, journals of 160 mm, oblong webs of 240 mm.
"""

from dataclasses import dataclass
from math import cos, hypot, pi, radians, sin
from typing import Any

import numpy as np

Json = dict[str, Any]

RADIUS, PIN, JOURNAL, HALF = 0.14, 0.075, 0.08, 0.12
#: z of the ends of what follows on each other: journal, web, pin, web, journal, web, pin, web, journal
ENDS = (-0.485, -0.315, -0.245, -0.105, -0.035, 0.035, 0.105, 0.245, 0.315, 0.485)
KINDS = ("journal", "web", "pin", "web", "journal", "web", "pin", "web", "journal")


@dataclass(frozen=True)
class Drawing:
    """Two throws; the second crank stands at an angle to the first."""

    second_deg: float = 180.0
    fillet: float = 0.0
    webs: bool = True

    def faces(self) -> list[Json]:
        """All plane and round faces, fillets by their points."""
        cylinders: list[Json] = []
        for n, (low, high, kind) in enumerate(zip(ENDS[:-1], ENDS[1:], KINDS, strict=True)):
            angle = radians(0.0 if high < 0.0 else self.second_deg)
            if kind == "web":
                cylinders += oblong(low, high, angle) if self.webs else []
            else:
                # a fillet at either end but those of the shaft
                first = 0.0 if n == 0 or not self.webs else self.fillet
                last = 0.0 if n == len(KINDS) - 1 or not self.webs else self.fillet
                offset = RADIUS if kind == "pin" else 0.0
                centre = [offset * cos(angle), offset * sin(angle)]
                radius = PIN if kind == "pin" else JOURNAL
                cylinders.append(cylinder(*centre, radius, low + first, high - last))
                if n == 0 or not self.webs:
                    cylinders.append(plane(*centre, low, -1, pi * radius**2))
                if n == len(KINDS) - 1 or not self.webs:
                    cylinders.append(plane(*centre, high, 1, pi * radius**2))
                if self.fillet:
                    ring = [[centre[0] + radius + self.fillet, centre[1], z] for z in (low, high)]
                    cylinders.append({"type": "other", "points_m": ring})
        return cylinders


def cylinder(x: float, y: float, radius: float, low: float, high: float, **more: Any) -> Json:
    return {
        "type": "cylinder",
        "centre_m": [x, y, 0.0],
        "axis": [0, 0, 1],
        "radius_m": radius,
        "ends_m": [low, high],
        **more,
    }


def plane(x: float, y: float, z: float, sense: int, area: float) -> Json:
    return {"type": "plane", "centre_m": [x, y, z], "normal": [0, 0, sense], "area_m2": area}


def oblong(low: float, high: float, angle: float) -> list[Json]:
    """A plate with round ends about the axis and about the pin, and flat sides."""
    x, y = RADIUS * cos(angle), RADIUS * sin(angle)
    area = pi * HALF**2 + 2 * HALF * RADIUS
    planes = [plane(x / 2, y / 2, low, -1, area), plane(x / 2, y / 2, high, 1, area)]
    for sign, middle, at in ((-1.0, angle + pi, (0.0, 0.0)), (1.0, angle, (x, y))):
        arc = [(at[0] + HALF * cos(middle + turn), at[1] + HALF * sin(middle + turn)) for turn in (-pi / 2, 0, pi / 2)]
        points = [[*point, z] for point in arc for z in (low, high)]
        planes.append(cylinder(*at, HALF, low, high, angle_deg=180.0, points_m=points))
        side = [HALF * sin(angle) * -sign, HALF * cos(angle) * sign]
        normal = [-sign * sin(angle), sign * cos(angle), 0.0]
        corners = [[side[0], side[1], low], [side[0] + x, side[1] + y, high]]
        centre = [side[0] + x / 2, side[1] + y / 2, (low + high) / 2]
        planes.append({"type": "plane", "centre_m": centre, "normal": normal, "points_m": corners})
    return planes


def moved(face: Json, turn: np.ndarray, origin: np.ndarray, scale: float = 1.0) -> Json:  # type: ignore[type-arg]
    """A face turned (or mirrored) by a matrix, scaled and shifted."""
    scales = dict(face)
    for name in ("centre_m",):
        if name in face:
            scales[name] = (scale * turn @ np.array(face[name]) + origin).tolist()
    for name in ("axis", "normal"):
        if name in face:
            scales[name] = (turn @ np.array(face[name], dtype=float)).tolist()
    if "points_m" in face:
        scales["points_m"] = [(scale * turn @ np.array(point_m) + origin).tolist() for point_m in face["points_m"]]
    if "radius_m" in face:
        scales["radius_m"] = scale * face["radius_m"]
        scales["ends_m"] = [scale * end_m for end_m in face["ends_m"]]
    if "area_m2" in face:
        scales["area_m2"] = scale**2 * face["area_m2"]
    return scales


def distance(first: list[float], second: list[float]) -> float:
    return hypot(*(a - b for a, b in zip(first, second, strict=True)))
