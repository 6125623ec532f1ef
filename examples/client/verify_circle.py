"""The smallest circle around a curve: what its length comes to at least, wherever counterweights put its middle.

Two or three points of the curve are no longer than the half of their distance, or than the radius around them. Any
middle is as far from one of them (Jung's theorem; the dual of the smallest enclosing circle). From those of two points
the farthest point of the curve is added until none is farther.
"""

from __future__ import annotations

from itertools import combinations
from typing import List, NamedTuple, Optional, Sequence, Tuple

from verify_loads import Periodic

ROUNDS = 60
WIDE = 2e-8  # share of the radius by which it is enclosed


class Circle(NamedTuple):
    """A radius is between these; around the middle the curve is no longer than the upper one."""

    low: float
    high: float
    middle: complex


def smallest(curve: Periodic, enough: float = 0.0) -> Optional[Circle]:
    """Around a curve; of no interest where it is no larger than ``enough``. None where that takes too long."""
    size = curve.plus(-curve.mean).size
    middle, low, support = curve.mean, 0.0, curve.sides(0.0)[:1]
    for _ in range(ROUNDS):
        peak = curve.plus(-middle).peak(enough)
        if peak is None:
            return None
        if peak.high <= max(low * (1 + WIDE), enough) + 1e-12 * size:
            return Circle(low, peak.high, middle)
        farthest = max(curve.sides(peak.angle), key=lambda point: abs(point - middle))
        low, middle, support = around([*support, farthest])
    return None


def around(points: Sequence[complex]) -> Tuple[float, complex, List[complex]]:
    """Radius and middle of the smallest circle around two to four points, and those that hold it."""
    circle = (0.0, points[0], [points[0]])
    for first, second in combinations(points, 2):
        circle = max(
            circle, (abs(first - second) / 2, (first + second) / 2, [first, second]), key=lambda candidate: candidate[0]
        )
    for a, b, c in combinations(points, 3):
        # of a triangle without an obtuse angle, as seen from its first corner
        p, q = b - a, c - a
        area = (p.conjugate() * q).imag
        acute = min((p.conjugate() * q).real, (-p.conjugate() * (c - b)).real, (q.conjugate() * (c - b)).real)
        if area and acute > 0:
            centre = a + 1j * (abs(q) ** 2 * p - abs(p) ** 2 * q) / (2 * area)
            circle = max(circle, (abs(centre - a), centre, [a, b, c]), key=lambda candidate: candidate[0])
    return circle
