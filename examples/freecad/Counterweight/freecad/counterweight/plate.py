"""What is cut from a plate as a counterweight, in closed form. No CAD; SI units, angles in radians.

Both outlines are symmetric about the direction of the unbalance and reach from an inner to an outer radius; ``half`` is
half the opening, as seen from the shaft at the outer radius. A sector is bounded by two edges through the shaft, a
segment by a chord.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, asin, cos, pi, sin
from typing import Any, List, Mapping, Tuple, Union

Point = Tuple[float, float]
#: straight, from a point to a point; an arc about the shaft, of a radius, from an angle to an angle
Edge = Union[Tuple[str, Point, Point], Tuple[str, float, float, float]]
SHAPES = ("sector", "segment")


class DoesNotFit(ValueError):
    """No opening of the plate has the unbalance."""


@dataclass(frozen=True)
class Plate:
    """A plate; ``largest`` is half of its largest opening, at most a right angle."""

    shape: str
    inner_m: float
    outer_m: float
    thickness_m: float
    density_kg_m3: float
    largest: float = pi / 2

    @classmethod
    def of(cls, envelope: Mapping[str, Any]) -> Plate:
        """The envelope of a web, as the service has it."""
        return cls(
            envelope["shape"],
            envelope.get("inner_radius_m", 0.0),
            envelope["outer_radius_m"],
            envelope["thickness_m"],
            envelope.get("density_kg_m3", 7850.0),
            envelope.get("max_half_angle_deg", 90.0) * pi / 180,
        )

    def hub(self, half: float) -> float:
        """Half of the angle that the hub takes from the plate."""
        if self.shape == "sector":
            return half
        height = self.outer_m * cos(half)
        return acos(height / self.inner_m) if height < self.inner_m else 0.0

    def mass_kg(self, half: float) -> float:
        if self.shape == "sector":
            area = (self.outer_m**2 - self.inner_m**2) * half
        else:
            area = _segment(self.outer_m, half) - _segment(self.inner_m, self.hub(half))
        return self.density_kg_m3 * self.thickness_m * area

    def unbalance_kg_m(self, half: float) -> float:
        """Mass times radius of its centre."""
        # the chord cuts from every circle about the shaft what its sector of the same chord has
        outer, inner = self.outer_m * sin(half), self.inner_m * sin(self.hub(half))
        if self.shape == "sector":
            first = (self.outer_m**3 - self.inner_m**3) * sin(half)
        else:
            first = outer**3 - inner**3
        return self.density_kg_m3 * self.thickness_m * 2 / 3 * first

    def half(self, unbalance_kg_m: float) -> float:
        """Half of the opening that has an unbalance.

        Raises
        ------
        DoesNotFit
        """
        most = self.unbalance_kg_m(self.largest)
        if not 0.0 < unbalance_kg_m <= most * (1 + 1e-9):
            raise DoesNotFit(f"{unbalance_kg_m:.6g} kg m asked for, {most:.6g} kg m is the most that fits")
        if self.shape == "sector":
            return min(self.largest, asin(min(1.0, unbalance_kg_m / most * sin(self.largest))))
        low, high = 0.0, self.largest
        while low < (middle := (low + high) / 2) < high:
            if self.unbalance_kg_m(middle) < unbalance_kg_m:
                low = middle
            else:
                high = middle
        return high

    def outline(self, half: float, towards: float) -> List[Edge]:
        """Its edges one after the other, counter-clockwise, with the unbalance in a direction."""
        low, high, hub = towards - half, towards + half, self.hub(half)
        edges: List[Edge] = [("arc", self.outer_m, low, high)]
        if self.inner_m * hub > 0.0:
            first, last = towards + hub, towards - hub
            edges.append(("line", _at(self.outer_m, high), _at(self.inner_m, first)))
            edges.append(("arc", self.inner_m, first, last))
            edges.append(("line", _at(self.inner_m, last), _at(self.outer_m, low)))
        elif self.shape == "sector":
            edges.append(("line", _at(self.outer_m, high), (0.0, 0.0)))
            edges.append(("line", (0.0, 0.0), _at(self.outer_m, low)))
        else:
            edges.append(("line", _at(self.outer_m, high), _at(self.outer_m, low)))
        return edges


def _segment(radius: float, half: float) -> float:
    """Area between an arc and its chord."""
    return radius**2 * (half - sin(half) * cos(half))


def _at(radius: float, angle: float) -> Point:
    return radius * cos(angle), radius * sin(angle)
