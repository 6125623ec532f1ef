"""Pairs of phasors of one machine in plain numbers, and the ellipses that their vectors move on.

Small arrays cost by their number: what is done with few pairs takes a tenth of the time in plain numbers. Magnitudes
are those of arrays, all at once, so that an answer and a sweep have the same peaks to the last digit.
"""

import math
from cmath import phase
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class Ellipse(NamedTuple):
    """How the vector of one pair moves.

    co, counter : magnitudes of both phasors.
    peak, minor : semi-axes.
    axis_deg : direction of the major axis, from 0 up to 180; 0 for a circle.
    co_deg, counter_deg : directions of both phasors at shaft angle 0, from 0 up to 360.
    """

    co: float
    counter: float
    peak: float
    minor: float
    axis_deg: float
    co_deg: float
    counter_deg: float


class PolarPair(NamedTuple):
    """A pair of phasors of one machine, with magnitudes and phases [rad]."""

    co: complex
    counter: complex
    co_size: float
    counter_size: float
    co_phase: float
    counter_phase: float

    @property
    def axis_deg(self) -> float:
        """As :attr:`optimizer.responses.response.Phasors.major_axis_deg`."""
        if not (self.co_size and self.counter_size):
            return 0.0
        axis = math.degrees(0.5 * (self.co_phase + self.counter_phase)) % 180.0
        return axis if axis < 180.0 else 0.0

    @property
    def ellipse(self) -> Ellipse:
        """How its vector moves."""
        co, counter = self.co_size, self.counter_size
        return Ellipse(
            co,
            counter,
            co + counter,
            abs(co - counter),
            self.axis_deg,
            _of_turn(co, self.co_phase),
            _of_turn(counter, self.counter_phase),
        )


def _of_turn(size: float, phase_rad: float) -> float:
    """A direction from 0 up to 360 degrees; 0 of nothing, which has none."""
    angle = math.degrees(phase_rad)
    if angle < 0.0:
        angle += 360.0
    # a hair below 0 comes to 360
    return angle if size and angle < 360.0 else 0.0


def magnitudes(vectors: Sequence[complex]) -> list[float]:
    """Those of vectors."""
    sizes: list[float] = np.abs(np.array(vectors, complex)).tolist()
    return sizes


def polar_pairs(vectors: Sequence[complex]) -> list[PolarPair]:
    """Pairs of phasors, each pair one that turns with the shaft and then the other."""
    sizes, phases = magnitudes(vectors), list(map(phase, vectors))
    co, counter = slice(0, None, 2), slice(1, None, 2)
    parts = vectors[co], vectors[counter], sizes[co], sizes[counter], phases[co], phases[counter]
    return list(map(PolarPair, *parts))
