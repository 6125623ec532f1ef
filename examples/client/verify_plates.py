"""A counterweight that is cut from a plate: its mass by its unbalance, and what an unbalance of it is worth.

With the half-angle a at the outer radius R, h = R cos a and what the hub of radius r takes away at the same h, an
annular sector has m = q a (R^2 - r^2), U = 2/3 q (R^3 - r^3) sin a, J = q a (R^4 - r^4) / 2. What lies beyond a chord
has m = q R^2 (a - sin a cos a), U = 2/3 q R^3 sin^3 a, J = q R^4 ((a - sin a cos a) / 2 + sin^3 a cos a / 3). Here q
is thickness times density. The mass is a convex function of the unbalance. So what an unbalance is worth, price * U -
cost * m(U), is largest where one more kilogram metre costs what it is worth, dm/dU = price / cost. In doubles, to 1e-9.
"""

from __future__ import annotations

from math import acos, asin, cos, pi, radians, sin
from typing import NamedTuple, Tuple

from verify_numbers import Place

FIGURE = 1e-9  # share of a figure of a plate by which doubles may be off


class Plate(NamedTuple):
    """Radii [m], thickness times density [kg/m^2], largest half-angle [rad]."""

    chord: bool
    inner: float
    outer: float
    areal: float
    most: float

    def _hub(self, angle: float) -> float:
        return acos(min(self.outer / self.inner * cos(angle), 1.0)) if self.inner > 0 else 0.0

    def mass(self, angle: float) -> float:
        if not self.chord:
            return self.areal * angle * (self.outer**2 - self.inner**2)
        hub = self._hub(angle)
        return self.areal * (self.outer**2 * _excess(angle) - self.inner**2 * _excess(hub))

    def unbalance(self, angle: float) -> float:
        if not self.chord:
            return 2 / 3 * self.areal * (self.outer**3 - self.inner**3) * sin(angle)
        return 2 / 3 * self.areal * ((self.outer * sin(angle)) ** 3 - (self.inner * sin(self._hub(angle))) ** 3)

    def inertia(self, angle: float) -> float:
        if not self.chord:
            return self.areal * angle * (self.outer**4 - self.inner**4) / 2
        sectors = ((self.outer, angle), (self.inner, self._hub(angle)))
        large, small = (r**4 * (_excess(a) / 2 + sin(a) ** 3 * cos(a) / 3) for r, a in sectors)
        return self.areal * (large - small)

    def lever(self, angle: float) -> float:
        """dU/dm of what is added at an opening."""
        if self.chord:
            return self.outer * cos(angle)
        cubes, squares = self.outer**3 - self.inner**3, self.outer**2 - self.inner**2
        return 2 / 3 * cubes / squares * cos(angle)

    def up_to(self, limit: float) -> float:
        """The largest opening of a mass up to a limit, by halving."""
        if self.mass(self.most) <= limit:
            return self.most
        low, high = 0.0, self.most
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if self.mass(middle) < limit else (low, middle)
        return high

    def opening(self, price: float, cost: float) -> float:
        """Up to which one more kilogram metre is worth what it costs."""
        return min(acos(min(cost / max(price * self.lever(0.0), 1e-300), 1.0)), self.most)

    def worth(self, price: float, cost: float, limit: float) -> Tuple[float, float]:
        """What price * U - cost * m(U) comes to at most, of masses up to a limit: between two figures."""
        most = self.up_to(limit)
        angle = min(self.opening(price, cost), most)
        off = 1e-12 * (price * self.unbalance(most) + cost * self.mass(most))
        value = max(price * self.unbalance(angle) - cost * self.mass(angle), 0.0)
        return max(value - off, 0.0), value + off


def _excess(angle: float) -> float:
    """a - sin a cos a, as a series where it is small."""
    if angle > 0.05:
        return angle - sin(angle) * cos(angle)
    square = (2 * angle) ** 2
    return angle * square / 6 * (1 - square / 20 * (1 - square / 42 * (1 - square / 72)))


def plate(place: Place) -> Plate:
    """That of an envelope in a request."""
    inner, outer = (place / "inner_radius_m").double(0.0), (place / "outer_radius_m").double()
    areal = (place / "thickness_m").double() * (place / "density_kg_m3").double(7850.0)
    most = radians((place / "max_half_angle_deg").double(90.0))
    most = min(most, pi / 2)
    return Plate((place / "shape").text("sector", "segment") == "segment", inner, outer, areal, most)


def opened(of: Plate, unbalance: float) -> float:
    """Half-angle [rad] of an unbalance, by halving the interval that it lies in."""
    if not of.chord:
        return min(asin(min(unbalance / of.unbalance(pi / 2), 1.0)), of.most)
    low, high = 0.0, of.most
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if of.unbalance(middle) < unbalance else (low, middle)
    return high
