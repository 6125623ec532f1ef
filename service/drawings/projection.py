"""From metres to px: the machine from the front, and from the side."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from service.drawings.labels import Shape
from service.drawings.layout import Fitted
from service.drawings.svg import Point

#: width and height of the front view, px
SIZE = 400.0
#: width of the side view, the ends of the shaft in it, and its axis, px
WIDTH = 560.0
LEFT, RIGHT, MIDDLE = 50.0, WIDTH - 50.0, 142.0
#: radius of the disc for the heaviest weight of unknown shape, as a share of the radius of its centre of mass
_DISC = 0.34


class FrontProjection(NamedTuple):
    """Seen from +z, x to the right and y upwards."""

    scale: float
    centre: Point = (SIZE / 2, SIZE / 2)

    def __call__(self, radius: float, angle_deg: float) -> Point:
        return self.at(self.scale * radius, angle_deg)

    def at(self, distance: float, angle_deg: float) -> Point:
        """A place so many px from the shaft."""
        angle, (x, y) = math.radians(angle_deg), self.centre
        return x + distance * math.cos(angle), y - distance * math.sin(angle)

    def arc(self, distance: float, start_deg: float, end_deg: float) -> list[Point]:
        steps = max(2, math.ceil(abs(end_deg - start_deg) / 4))
        return [self.at(distance, start_deg + (end_deg - start_deg) * step / steps) for step in range(steps + 1)]


def disc(view: FrontProjection, fitted: Fitted, weights: Sequence[Fitted]) -> Shape:
    """A disc in place of a weight without a shape: its area is proportional to the mass."""
    heaviest = max(weights, key=lambda weight: weight.mass_kg)
    radius = _DISC * heaviest.radius_m * math.sqrt(fitted.mass_kg / heaviest.mass_kg)
    return FrontProjection(1.0, view(fitted.radius_m, fitted.angle_deg)).arc(max(3.0, view.scale * radius), 0, 360)


class SideProjection(NamedTuple):
    """From places along a shaft and radii about it, m, to px.

    facing_deg : the direction that is upwards.
    depth : of what stands towards the reader, as shares of its distance.
    aside : from the crankshaft to the shaft, px.
    """

    low: float
    per_m: float
    across_per_m: float
    facing_deg: float
    depth: Point
    aside: Point = (0.0, 0.0)

    def z(self, position: float) -> float:
        return LEFT + (position - self.low) * self.per_m

    def __call__(self, position: float, radius: float, angle_deg: float) -> Point:
        angle = math.radians(angle_deg - self.facing_deg)
        height, depth = (self.across_per_m * radius * part for part in (math.cos(angle), -math.sin(angle)))
        along, down = self.aside
        return self.z(position) + along + self.depth[0] * depth, MIDDLE + down - height + self.depth[1] * depth

    def about(self, distance: float, angle_deg: float) -> "SideProjection":
        """The same about a shaft beside the crankshaft, m and deg."""
        x, y = self(self.low, distance, angle_deg)
        return self._replace(aside=(x - self.z(self.low), y - MIDDLE))
