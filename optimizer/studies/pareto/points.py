"""Points of a front: its ends, those of two peaks that no other beats, and the knee."""

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from schemas.front.pareto import ParetoPoint

Point = TypeVar("Point")

#: a front whose points lie nearer to the straight line between its ends than this share of its range has no knee
_STRAIGHT = 1e-4


@record(frozen=True)
class TradeEnds:
    """Where each of D responses is smallest; in the answer all but sizes are times ``square`` and above ``there``."""

    values: Real  # (D, D) what all come to where each counts first
    smallest: Real  # (D,)
    lower_bound: Real  # (D,)
    size: Real  # (D,) what gaps are relative to
    at_rest: Real  # (D,) without counterweights
    square: Real | float = 1.0  # (D,) omega^2, where figures are over it
    there: Real | float = 0.0  # (D,) what is there whatever is chosen


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
