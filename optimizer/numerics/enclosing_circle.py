"""The smallest circle around points, with the proof that no smaller one holds them.

The radius of the smallest circle around a curve is the floor of its peak: no constant vector added to the curve brings
the farthest point nearer. The proof has two or three points of support, of weights lam >= 0 that sum to 1, with
sum lam (point - centre) = 0: for any other centre c the weighted mean of |point - c|^2 is radius^2 + |c - centre|^2.
"""

from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from optimizer.numerics.arrays import Complex, Real

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
    far = np.abs(places)
    first = int(np.argmax(far))
    slack = _ON * float(far[first])
    support, circle = [first], _Held(complex(places[first]), 0.0, (0,), (1.0,))
    while True:
        distance = np.abs(places - circle.centre)
        farthest = int(np.argmax(distance))
        if distance[farthest] <= circle.radius + slack:
            break
        candidates = [*support, farthest]
        larger = _around(places[candidates].tolist())
        if larger.radius <= circle.radius:
            # what is left is rounding
            break
        support, circle = [candidates[k] for k in larger.points], larger
    centre = complex(circle.centre + middle)
    return Circle(centre, circle.radius, np.array(support, dtype=np.intp), np.array(circle.weights))


class _Held(NamedTuple):
    """A circle held by some of a few points; in plain numbers, which cost a tenth of arrays."""

    centre: complex
    radius: float
    points: tuple[int, ...]
    weights: tuple[float, ...]


def _around(points: list[complex]) -> _Held:
    """The smallest circle around two to four points of which the last is on it, by trying each few with that one."""
    last = len(points) - 1
    groups = [(*others, last) for size in (0, 1, 2) for others in combinations(range(last), size)]
    found = [_through(points, group) for group in groups]
    # the largest circle that is held by its own points: every one is a floor of the smallest around all
    return max((circle for circle in found if circle is not None), key=lambda circle: circle.radius)


def _through(points: list[complex], group: tuple[int, ...]) -> _Held | None:
    """The circle that some points hold; None where one of three holds nothing."""
    on = [points[k] for k in group]
    weights: tuple[float, ...] = (1.0,)
    if len(on) == 2:
        weights = (0.5, 0.5)
    elif len(on) == 3:
        # barycentric weights of the circumcentre: sin 2A : sin 2B : sin 2C, positive for an acute triangle
        a, b, c = (abs(on[1] - on[2]) ** 2, abs(on[2] - on[0]) ** 2, abs(on[0] - on[1]) ** 2)
        share = (a * (b + c - a), b * (c + a - b), c * (a + b - c))
        if not min(share) > 0.0:
            return None
        weights = tuple(each / sum(share) for each in share)
    centre = sum((weight * point for weight, point in zip(weights, on, strict=True)), 0j)
    return _Held(centre, max(abs(point - centre) for point in on), group, weights)
