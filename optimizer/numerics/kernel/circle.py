"""The smallest circle around points, compiled: :mod:`optimizer.numerics.enclosing_circle` has the method."""

import numpy as np

from optimizer.numerics.arrays import SMALLEST
from optimizer.numerics.compiling import inner, kernel

#: a point this share of the extent outside a circle is on it
_ON = 1e-14
#: as numpy's integer, like all that is handed on
_SINGLE = np.int64(1)


@kernel
def smallest(points):  # type: ignore[no-untyped-def]
    """Centre, radius, support (1 to 3,) and its weights, of the smallest circle around points (n,), n >= 1."""
    low, high = points[0], points[0]
    for point in points:
        low = complex(min(low.real, point.real), min(low.imag, point.imag))
        high = complex(max(high.real, point.real), max(high.imag, point.imag))
    # about their own middle, so that a common offset costs no digits
    middle = 0.5 * (low + high)
    # squares of shares of the extent neither overflow nor vanish
    per_extent = 1.0 / max(high.real - low.real, high.imag - low.imag, SMALLEST)
    first = _farthest(points, middle, 0j, per_extent)
    slack = _ON * abs(points[first] - middle)
    support, weights, count = np.zeros(3, np.int64), np.ones(3), _SINGLE
    support[0] = first
    centre, radius = points[first] - middle, 0.0
    trial, on_circle, circle_weights, few = (
        np.zeros(4, np.int64),
        np.zeros(3, np.int64),
        np.ones(3),
        np.zeros(4, np.complex128),
    )
    while True:
        farthest = _farthest(points, middle, centre, per_extent)
        if abs(points[farthest] - middle - centre) <= radius + slack:
            break
        trial[count] = farthest
        for k in range(count):
            trial[k] = support[k]
        for k in range(count + 1):
            few[k] = points[trial[k]] - middle
        of_few, larger, number = _around(few, count, on_circle, circle_weights)
        if larger <= radius:
            # what is left is rounding
            break
        centre, radius, count = of_few, larger, number
        for k in range(count):
            support[k], weights[k] = trial[on_circle[k]], circle_weights[k]
    own, of_own = np.empty(count, np.int64), np.empty(count)
    for k in range(count):
        own[k], of_own[k] = support[k], weights[k]
    return centre + middle, radius, own, of_own


@inner
def _farthest(points, middle, centre, per_extent):  # type: ignore[no-untyped-def]
    """Which point is farthest from a centre about the middle; of several the first."""
    most, number = -1.0, 0
    for k in range(points.size):
        place = points[k] - middle - centre
        along, across = place.real * per_extent, place.imag * per_extent
        square = along * along + across * across
        if square > most:
            most, number = square, k
    return number


@inner
def length(vector):  # type: ignore[no-untyped-def]
    """Magnitude, which neither overflows nor vanishes, and costs less than a hypotenuse."""
    along, across = abs(vector.real), abs(vector.imag)
    long, short = max(along, across), min(along, across)
    share = short / max(long, SMALLEST)
    return long * np.sqrt(1.0 + share * share)


@inner
def _around(few, last, on_circle, weights):  # type: ignore[no-untyped-def]
    """The smallest circle around two to four points of which the last is on it: centre, radius, how many hold it.

    The largest that is held by its own points, by trying each few with the last one: every one is a floor of the
    smallest around all.
    """
    centre, radius, number = few[last], 0.0, 1
    on_circle[0], weights[0] = last, 1.0
    for k in range(last):
        middle = 0.5 * few[k] + 0.5 * few[last]
        size = max(abs(few[k] - middle), abs(few[last] - middle))
        if size > radius:
            centre, radius, number = middle, size, 2
            on_circle[0], on_circle[1], weights[0], weights[1] = k, last, 0.5, 0.5
    for k in range(last):
        for m in range(k + 1, last):
            # barycentric weights of the circumcentre: sin 2A : sin 2B : sin 2C, positive for an acute triangle
            a, b, c = abs(few[m] - few[last]) ** 2, abs(few[last] - few[k]) ** 2, abs(few[k] - few[m]) ** 2
            share, two, three = a * (b + c - a), b * (c + a - b), c * (a + b - c)
            if not min(share, two, three) > 0.0:
                continue
            total = share + two + three
            share, two, three = share / total, two / total, three / total
            middle = share * few[k] + two * few[m] + three * few[last]
            size = _mean(few[k] - middle, few[m] - middle, few[last] - middle, share, two, three)
            if size > radius:
                centre, radius, number = middle, size, 3
                on_circle[0], on_circle[1], on_circle[2] = k, m, last
                weights[0], weights[1], weights[2] = share, two, three
    return centre, radius, number


@inner
def _mean(first, second, third, share, two, three):  # type: ignore[no-untyped-def]
    """Root of the weighted mean square of three lengths: no more than any centre leaves, however weights are rounded.

    Of points that all but coincide the weights lose digits, and the longest of the three would be too long.
    """
    a, b, c = abs(first), abs(second), abs(third)
    most = max(a, b, c, SMALLEST)
    a, b, c = a / most, b / most, c / most
    return most * np.sqrt(share * a * a + two * b * b + three * c * c)
