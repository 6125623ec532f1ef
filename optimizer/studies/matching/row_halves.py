"""All assignments of a class of up to sixteen parts, set by set of the parts on half of its places.

A plane below the peaks takes its height of what they may come to; what is left, the slack, is no less than the sum of
lengths |g_j v_j|, with g_j what the plane leaves of the weight of a length. So each component of these vectors is no
larger than the slack, and few sums of one half meet one of the other there
(:mod:`optimizer.studies.matching.kernel.halves`).
"""

from collections.abc import Callable
from functools import lru_cache
from itertools import combinations, permutations
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.studies.matching.bound import Plane
from optimizer.studies.matching.kernel.halves import Peaks, Window, best_below
from optimizer.studies.matching.problem import Problem

#: parts of a class whose orders on half of the places can be listed, and of which all sets are looked at in a second
_MOST, _MOST_SETS = 16, 12
#: a share of a weight that is no more than rounding
_NOTHING = 1e-6
#: roundings by which windows are wider
_ROUNDINGS = 16.0


class Exhausted(NamedTuple):
    """What was looked at."""

    mass: Real | None  # (n,) of the class, place by place: better than the best before
    value: float  # of the best so far
    lower_bound: float  # of all assignments, but for the rounding of the problem
    complete: bool  # all of them were looked at


def single_class(problem: Problem) -> bool:
    """Whether the parts are of one class, of which the orders on half of the places can be listed."""
    return len(problem.classes) == 1 and problem.input_order.size <= _MOST


def all_sets(problem: Problem) -> bool:
    """Whether besides all sets of them can be looked at, as where equal masses balance."""
    return single_class(problem) and problem.input_order.size <= _MOST_SETS


def exhausted(problem: Problem, cut: Plane, value: float, near: float, spent: Callable[[], bool]) -> Exhausted:
    """The best assignment of a single class of parts, and what none is below.

    Parameters
    ----------
    cut : a plane below the peaks, with its smallest value over all assignments.
    value : of the best assignment so far; what is no better is not looked for.
    near : a bound so near to it is good enough.
    spent : whether the time is over.
    """
    lever = np.real(np.conj(cut.slope) @ problem.of_place)
    # along the plane few sets of parts fit such halves
    place = np.argsort(lever, kind="stable")
    effect = np.ascontiguousarray(problem.of_place[:, place])
    window = _window(problem, cut, effect, lever[place])
    if not window.start.size:
        return Exhausted(None, value, cut.least, False)
    masses, least = _sets(problem, cut, lever[place])
    peaks, size, half = Peaks(problem.start, effect, problem.peaks.weight), lever.size, (lever.size + 1) // 2
    orders = _orders(half), _orders(size - half)
    effects = window.effect[:, :half], window.effect[:, half:]
    best, bound, result = value, cut.least, None
    for mass, lowest in zip(masses, least.tolist(), strict=True):
        bound = max(bound, min(best, lowest))
        if best - bound <= near or spent():
            return Exhausted(result, best, bound, bound >= best)
        first, second = (_sums(*part) for part in zip(effects, (mass[:half], mass[half:]), orders, strict=True))
        rising = np.argsort(first[:, 0], kind="stable")
        rising_orders, sums = (orders[0][rising], orders[1]), (first[rising], second)
        reached, arrangement = best_below(window, peaks, mass, lowest, rising_orders, sums, best)
        if reached < best:
            best, result = float(reached), np.empty_like(arrangement)
            result[place] = arrangement
    return Exhausted(result, best, best, True)


def _sums(effect: Real, mass: Real, orders: np.ndarray) -> Real:
    """What parts of masses (h,) come to in every order (p, C)."""
    sums = np.zeros((len(orders), len(effect)))
    for place, parts in enumerate(orders.T):
        sums += mass[parts][:, None] * effect[:, place]
    return sums


def _window(problem: Problem, cut: Plane, effect: Complex, lever: Real) -> Window:
    """The height above the plane and the components of what it leaves, the one that tells most first; none of those
    that no assignment changes."""
    left = _left(problem, cut)
    start, change = left * problem.start, left[:, None] * effect
    height = cut.constant + float(np.real(np.vdot(cut.slope, problem.start)))
    rows = np.concatenate([lever[None], change.real, change.imag])
    begin = np.concatenate([[height], start.real, start.imag])
    is_height = np.arange(begin.size) == 0
    reach = np.stack([np.ones(begin.size), np.where(is_height, 0.0, 1.0)])
    scatter = np.std(rows, axis=1) / np.sum(reach, axis=0)
    order = np.argsort(-scatter, kind="stable")
    order = order[scatter[order] * np.ptp(problem.input_order) > _ROUNDINGS * problem.rounding]
    return Window(begin[order], rows[order], is_height[order].astype(float), np.take(reach, order, axis=1))


def _left(problem: Problem, cut: Plane) -> Real:
    """What a plane leaves of the weights of lengths (J,); the largest of several is no less than a mean of them."""
    weight = problem.peaks.weight
    ratio = np.where(weight > 0, np.abs(cut.slope) / np.where(weight > 0, weight, 1.0), 0.0)
    share = np.max(ratio, axis=1)
    share = share + max(1.0 - float(np.sum(share)), 0.0) / share.size
    left: Real = share @ weight - np.abs(cut.slope)
    return np.where(left > _NOTHING, left, 0.0)


def _sets(problem: Problem, cut: Plane, lever: Real) -> tuple[Real, Real]:
    """Masses (N, n) of the parts on the first half and of the others, in rising order of what none of their
    assignments is below (N,): its height by sorting each half."""
    mass, half = np.sort(problem.input_order), (lever.size + 1) // 2
    parts = np.array(list(combinations(range(mass.size), half)))
    left = np.ones((len(parts), mass.size), bool)
    np.put_along_axis(left, parts, False, axis=1)
    masses = mass[np.concatenate([parts, np.nonzero(left)[1].reshape(len(parts), -1)], axis=1)]
    height = cut.constant + float(np.real(np.vdot(cut.slope, problem.start)))
    # the lightest, which are first, where the lever is the longest
    longest_first = np.concatenate([np.sort(part)[::-1] for part in (lever[:half], lever[half:])])
    least = height + masses @ longest_first - _ROUNDINGS * problem.rounding
    order = np.argsort(least, kind="stable")
    return masses[order], least[order]


@lru_cache(maxsize=_MOST)
def _orders(n: int) -> np.ndarray:
    """All orders (n!, n) of n parts."""
    return np.array(list(permutations(range(n))), np.int64)
