"""The smallest circle around points, with the proof that no smaller one holds them.

The radius of the smallest circle around a curve is the floor of its peak: no constant vector added to the curve brings
the farthest point nearer. The proof has two or three points of support, of weights lam >= 0 that sum to 1, with
sum lam (point - centre) = 0: for any other centre c the weighted mean of |point - c|^2 is radius^2 + |c - centre|^2.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from optimizer.numerics.arrays import Complex, Real, in_order


class Circle(NamedTuple):
    """The smallest circle around points."""

    centre: complex
    radius: float
    support: NDArray[np.intp]  # (1 to 3,) which points are on it and hold it
    weights: Real  # lam of each, > 0, sum 1: centre = sum lam point


def smallest_circle(points: Complex) -> Circle:
    """The smallest circle around points (n,), n >= 1, complex.

    From the circle of the last support and the farthest point outside it to the smallest circle of those few, which is
    always larger. So no support returns, and it ends (the simplex method of this problem). Three or four points have
    few pairs and triples, and the smallest circle of one that holds all is theirs.
    """
    from optimizer.numerics.kernel.circle import smallest

    return Circle(*smallest(in_order(np.asarray(points, complex))))
