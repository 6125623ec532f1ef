"""The smallest circle around points, with the proof that no smaller one holds them.

The radius of the smallest circle around a curve is the floor of its peak: no constant vector added to the curve brings
the farthest point nearer. The proof has two or three points of support, of weights lam >= 0 that sum to 1, with
sum lam (point - centre) = 0: for any other centre c the weighted mean of |point - c|^2 is radius^2 + |c - centre|^2.
"""

from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from optimizer.arrays import Complex, Real

#: a point this share of the extent outside a circle is on it
_ON = 1e-14


class Circle(NamedTuple):
    """The smallest circle around points."""

    centre: complex
    radius: float
    support: NDArray[np.intp]  # (1 to 3,) which points are on it and hold it
    weights: Real  # lam of each, > 0, sum 1: centre = sum lam point


def smallest_circle(points: Complex) -> Circle:
    """The smallest circle around points (n,), n >= 1, complex.

    From the circle of the last support and the farthest point outside it to the smallest circle of those few, which is
    always larger: so no support returns, and it ends (the simplex method of this problem). Three or four points have
    few pairs and triples, and the smallest circle of one that holds all is theirs.
    """
    points = np.asarray(points, dtype=complex)
    # about their own middle, so that a common offset costs no digits
    middle = 0.5 * (np.min(points.real) + np.max(points.real) + 1j * (np.min(points.imag) + np.max(points.imag)))
    places = points - middle
    slack = _ON * float(np.max(np.abs(places)))
    support = np.array([int(np.argmax(np.abs(places)))], dtype=np.intp)
    circle = _around(places[support])
    while True:
        distance = np.abs(places - circle.centre)
        farthest = int(np.argmax(distance))
        if distance[farthest] <= circle.radius + slack:
            break
        candidates = np.append(support, farthest)
        larger = _around(places[candidates])
        if larger.radius <= circle.radius:
            # what is left is rounding
            break
        support, circle = candidates[larger.support], larger
    return Circle(complex(circle.centre + middle), circle.radius, support, circle.weights)


def _around(points: Complex) -> Circle:
    """The smallest circle around at most four points, by trying each few of them."""
    count = len(points)
    groups = [group for size in (1, 2, 3) for group in combinations(range(count), size)]
    found = [_through(points, group) for group in groups]
    # the largest circle that is held by its own points: every one is a floor of the smallest around all
    return max((circle for circle in found if circle is not None), key=lambda circle: circle.radius)


def _through(points: Complex, group: tuple[int, ...]) -> Circle | None:
    """The circle that some points hold; None where one of three holds nothing."""
    on = points[list(group)]
    if len(group) == 1:
        centre, weights = on[0], np.ones(1)
    elif len(group) == 2:
        centre, weights = 0.5 * (on[0] + on[1]), np.array([0.5, 0.5])
    else:
        # barycentric weights of the circumcentre: sin 2A : sin 2B : sin 2C, positive for an acute triangle
        side = np.abs(on[[1, 2, 0]] - on[[2, 0, 1]]) ** 2
        share = side * (np.sum(side) - 2.0 * side)
        if not np.all(share > 0.0):
            return None
        weights = share / np.sum(share)
        centre = weights @ on
    return Circle(complex(centre), float(np.max(np.abs(on - centre))), np.array(group, dtype=np.intp), weights)
