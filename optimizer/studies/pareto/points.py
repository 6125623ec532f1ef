"""Points of a front: those of two peaks that no other beats, the knee, and what searches of choices come to."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.solve.solution import Solution
from schemas.front.pareto import ParetoPoint

Point = TypeVar("Point")

#: a front whose points lie nearer to the straight line between its ends than this share of its range has no knee
_STRAIGHT = 1e-4


@dataclass(frozen=True)
class ChosenPoint:
    """Counterweights that are chosen, beside what they come to in D responses, in the units of the answer."""

    solution: Solution
    values: Real  # (D,)
    corner: Real  # (D,) no choice is below this in all of them; nan where nothing is proven


def weighted_peaks(point: ParetoPoint) -> tuple[float, float]:
    """Of force and moment."""
    return point.weighted_force_peak_N, point.weighted_moment_peak_Nm


def undominated(points: Sequence[Point], peaks: Callable[[Point], tuple[float, float]]) -> list[Point]:
    """The points that no other equals or beats in both peaks, in the order of the rising first."""
    best: list[Point] = []
    for point in sorted(points, key=peaks):
        if not best or peaks(point)[1] < peaks(best[-1])[1]:
            best.append(point)
    return best


def knee(points: Sequence[ParetoPoint]) -> int | None:
    """Index of the point farthest below the straight line between the ends, in the plane of shares of the range."""
    if len(points) < 3:
        return None
    peaks = np.array([weighted_peaks(point) for point in points])
    share = (peaks - peaks[0]) / (peaks[-1] - peaks[0])
    # on the chord both shares of the way are equal; below it the moment is ahead of the force
    depth = share[:, 1] - share[:, 0]
    deepest = int(np.argmax(depth))
    return deepest if depth[deepest] > _STRAIGHT else None
