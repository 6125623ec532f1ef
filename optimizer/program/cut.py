"""Quantities over the whole turn that are the largest of infinitely many norms, each known by cuts.

A cut is one of these norms, floor + |c + H u|, so that no u makes the quantity smaller: a row of a statement. The
peak of |d(theta) + H u| over the turn has a cut at every angle; the root mean square sqrt(V + |mean d + H u|^2) one for
every split of a unit between the part that stays and the part that moves.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.curve import Floor, TurnResponse, floor, peaks

#: the smallest circle is known to this share of its radius: its points only start a search
_CIRCLE = 1e-3


class Cut(NamedTuple):
    """floor + |constant + influence @ u|, which the quantity is never below."""

    constant: complex
    influence: Real | Complex  # (K,)
    floor: float = 0.0
    angle_deg: float | None = None  # of the shaft, where the cut belongs to one

    def at(self, u: Complex) -> float:
        """What it comes to with an unbalance (K,)."""
        return self.floor + float(abs(self.constant + np.sum(self.influence * u)))


class Reached(NamedTuple):
    """What a quantity comes to, between two figures that are proven, and the cut that comes to the lower one."""

    lower: float
    upper: float
    cut: Cut


@dataclass(frozen=True)
class Quantity:
    """What is to be small of a response over the turn."""

    response: TurnResponse
    measure: Literal["peak", "rms"] = "peak"

    @property
    def name(self) -> str:
        return self.response.name

    @cached_property
    def circle(self) -> Floor:
        """The smallest circle around the curve."""
        return floor(self.response, _CIRCLE)

    @cached_property
    def first(self) -> tuple[Cut, ...]:
        """Cuts to begin with: what holds the smallest circle, or the still and the moving part by themselves."""
        influence = self.response.influence
        if self.measure == "rms":
            return Cut(0j, 0.0 * influence, self.spread), Cut(self.response.mean, influence)
        points = zip(self.circle.angle.tolist(), self.circle.value.tolist(), strict=True)
        return tuple(Cut(value, influence, angle_deg=float(np.rad2deg(angle))) for angle, value in points)

    @cached_property
    def spread(self) -> float:
        """sqrt(V), what the root mean square comes to at least."""
        return float(np.sqrt(self.response.variance))

    def rms(self, u: Complex) -> Reached:
        """The root mean square: with the angle of the vector (|mean + H u|, sqrt(V)) its cut is it."""
        mean, influence = self.response.mean, self.response.influence
        moved = abs(mean + self.response.offset(u))
        value = float(np.hypot(moved, self.spread))
        along, across = (moved / value, self.spread / value) if value > 0 else (1.0, 0.0)
        return Reached(value, value, Cut(along * mean, along * influence, across * self.spread))


def reached(quantities: Sequence[Quantity], u: Complex, tolerance: float) -> tuple[Reached, ...]:
    """What quantities come to with an unbalance (K,) kg m.

    Parameters
    ----------
    tolerance : of upper - lower, relative to lower.
    """
    turning = [quantity.response for quantity in quantities if quantity.measure == "peak"]
    bracket = iter(zip(*(part.tolist() for part in peaks(turning, u, tolerance)), strict=True) if turning else ())
    found = []
    for quantity in quantities:
        if quantity.measure == "rms":
            found.append(quantity.rms(u))
            continue
        angle, value, lower, upper = next(bracket)
        cut = Cut(value, quantity.response.influence, angle_deg=float(np.rad2deg(angle)))
        found.append(Reached(lower, upper, cut))
    return tuple(found)
