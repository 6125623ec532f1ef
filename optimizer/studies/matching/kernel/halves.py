"""Two lists of sums that all but cancel, set by set of the parts; compiled."""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.compiling import inner, kernel
from optimizer.numerics.kernel.rising import first_no_less


class Window(NamedTuple):
    """Real coordinates of an assignment that are between bounds, where its peak is below a level.

    start : (C,) without the parts.
    effect : (C, n) what a kilogram at a place adds.
    anchor : (C,) share of the level about which a coordinate lies.
    reach : (2, C) how far below and above that, as a share of what the level leaves above a set.
    """

    start: Real
    effect: Real
    anchor: Real
    reach: Real


class Peaks(NamedTuple):
    """The largest of some weighted sums of lengths of start + effect m."""

    start: Complex  # (J,)
    effect: Complex  # (J, n)
    weight: Real  # (K, J)


@kernel
def best_below(window, peaks, mass, least, orders, sums, level):  # type: ignore[no-untyped-def]
    """The smallest peak below a level of all assignments that have a set of parts on the first half of the places.

    Parameters
    ----------
    window : its first coordinate is what sums are sorted by.
    mass : (n,) of the parts on the first half, then of the others.
    least : that no assignment with the set is below.
    orders : (p, h) and (q, n - h) of the parts of either half.
    sums : (p, C) and (q, C) what they come to; those of the first half in rising order of their first coordinate.

    Returns
    -------
    float : that peak, or the level where there is none below it.
    (n,) : masses place by place, where there is one.
    """
    (first, second), half, slack = sums, orders[0].shape[1], level - least
    best, arrangement = np.zeros(mass.size), np.zeros(mass.size)
    for k in range(len(second)):
        there = window.start[0] - window.anchor[0] * level + second[k, 0]
        at = first_no_less(first, -window.reach[0, 0] * slack - there)
        while at < len(first) and first[at, 0] + there <= window.reach[1, 0] * slack:
            i = at
            at += 1
            if not _within(window, first[i], second[k], level, slack):
                continue
            for place in range(half):
                arrangement[place] = mass[orders[0][i, place]]
            for place in range(arrangement.size - half):
                arrangement[half + place] = mass[half + orders[1][k, place]]
            value = _peak(peaks, arrangement)
            if value < level:
                level, slack = value, value - least
                for place in range(arrangement.size):
                    best[place] = arrangement[place]
    return level, best


@inner
def _within(window, first, second, level, slack):  # type: ignore[no-untyped-def]
    """Whether all other coordinates of two sums are between their bounds."""
    for c in range(1, window.start.size):
        total = window.start[c] - window.anchor[c] * level + first[c] + second[c]
        if total < -window.reach[0, c] * slack or total > window.reach[1, c] * slack:
            return False
    return True


@inner
def _peak(peaks, arrangement):  # type: ignore[no-untyped-def]
    largest = 0.0
    for row in range(peaks.weight.shape[0]):
        total = 0.0
        for j in range(peaks.start.size):
            if peaks.weight[row, j] > 0.0:
                v = peaks.start[j]
                for place in range(arrangement.size):
                    v += peaks.effect[j, place] * arrangement[place]
                total += peaks.weight[row, j] * abs(v)
        largest = max(largest, total)
    return largest
