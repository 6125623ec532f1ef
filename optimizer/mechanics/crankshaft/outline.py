"""The outline of a web across the shaft: arcs and straight sides, and how far it reaches."""

from collections.abc import Iterator

import numpy as np

from optimizer.mechanics.crankshaft.faces import Cylinders, Planes
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record

#: cosine with the shaft below which a face is along it
_ALONG = 1e-3
_WHOLE_DEG = 359.9
#: degrees by which arcs and gaps of points differ at most
_SAME_DEG = 1.0


@record(frozen=True)
class Arc:
    """Part of a circle: centre, radius, first angle and how far it goes on (rad)."""

    centre: complex
    radius: float
    first: float
    extent: float

    def at(self, angle: float) -> complex:
        """The point at an angle."""
        return self.centre + self.radius * complex(np.cos(angle), np.sin(angle))

    def holds(self, angle: float) -> bool:
        """Whether the arc has a point at an angle."""
        return bool((angle - self.first) % (2 * np.pi) <= self.extent + 1e-12)

    def extremes(self, opposite: complex | None) -> Iterator[complex]:
        """Its ends, its farthest point, and where it crosses the line through the shaft across a direction."""
        yield self.at(self.first)
        yield self.at(self.first + self.extent)
        angles = [float(np.angle(self.centre)) if self.centre else self.first]
        if opposite is not None:
            share = -(self.centre * opposite.conjugate()).real / self.radius
            if abs(share) <= 1.0:
                offset = float(np.arccos(share))
                angles += [float(np.angle(opposite)) + sign * offset for sign in (-1.0, 1.0)]
        yield from (self.at(angle) for angle in angles if self.holds(angle))


@record(frozen=True)
class Outline:
    """Arcs and straight sides of a web."""

    arcs: tuple[Arc, ...]
    sides: tuple[tuple[complex, complex], ...]

    @property
    def reach(self) -> float:
        """How far it reaches from the shaft."""
        return max(abs(point) for point in self._extremes(None))

    def reach_opposite(self, crank: complex | None) -> float:
        """How far it reaches on the other side of the shaft; on all sides where the crank has no direction."""
        if crank is None:
            return self.reach
        away = -crank / abs(crank)
        near = 1e-9 * self.reach
        points = (abs(point) for point in self._extremes(away) if (point * away.conjugate()).real >= -near)
        return max(points, default=0.0)

    def _extremes(self, opposite: complex | None) -> Iterator[complex]:
        for arc in self.arcs:
            yield from arc.extremes(opposite)
        for corner, end in self.sides:
            yield corner
            yield end
            if opposite is not None:
                a, b = ((point * opposite.conjugate()).real for point in (corner, end))
                if a * b < 0.0:
                    yield corner + (end - corner) * (a / (a - b))


def outline(
    cylinders: Cylinders, planes: Planes, points_beside: Real, low: float, high: float, tolerance: float
) -> Outline | None:
    """What bounds a web between two heights; None where the points of a face are missing, or nothing bounds it."""
    arcs: list[Arc] = []
    tips = np.sort(cylinders.tips[..., 2], axis=-1)
    for n in np.flatnonzero((tips[:, 0] < high - tolerance) & (tips[:, 1] > low + tolerance)):
        arc = _arc(cylinders, int(n))
        if arc is None:
            return None
        arcs.append(arc)
    sides = []
    for n in np.flatnonzero(np.abs(planes.normal[:, 2]) < _ALONG):
        points = planes.points[n]
        heights = points[:, 2] if len(points) else planes.point[n : n + 1, 2]
        if np.min(heights) < high - tolerance and np.max(heights) > low + tolerance:
            if len(points) < 2:
                return None
            flat = points[:, 0] + 1j * points[:, 1]
            along = (flat * complex(-planes.normal[n, 1], planes.normal[n, 0]).conjugate()).real
            sides.append((complex(flat[np.argmin(along)]), complex(flat[np.argmax(along)])))
    inside = points_beside[(points_beside[:, 2] > low + tolerance) & (points_beside[:, 2] < high - tolerance)]
    sides += [(point, point) for point in (complex(x, y) for x, y, _ in inside)]
    return Outline(tuple(arcs), tuple(sides)) if arcs or sides else None


def _arc(cylinders: Cylinders, n: int) -> Arc | None:
    """The arc of a face; of a part of a cylinder its points show which part."""
    centre, radius = complex(*cylinders.point[n, :2]), float(cylinders.radius[n])
    angle = float(cylinders.angle_deg[n])
    if angle >= _WHOLE_DEG:
        return Arc(centre, radius, 0.0, 2 * np.pi)
    points = cylinders.points[n]
    if len(points) < 2:
        return None
    angles = np.sort(np.angle(points[:, 0] + 1j * points[:, 1] - centre))
    gaps = np.rad2deg(np.diff(angles, append=angles[0] + 2 * np.pi))
    # what is left out lies between two neighbours
    fits = np.flatnonzero(np.abs(gaps - (360.0 - angle)) < _SAME_DEG)
    if len(fits) != 1:
        return None
    return Arc(centre, radius, float(angles[(fits[0] + 1) % len(angles)]), np.deg2rad(angle))
