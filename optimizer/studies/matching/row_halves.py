"""All assignments of a class of up to sixteen parts, set by set of the parts on half of its places.

A plane below the peaks takes its height of what they may come to; what is left, the slack, is no less than the sum of
lengths |g_j v_j|, with g_j what the plane leaves of the weight of a length. So every coordinate of these vectors lies
in a window, and few sums of one half meet one of the other there (:mod:`optimizer.studies.matching.kernel.joined`).
"""

from collections.abc import Callable
from functools import lru_cache
from itertools import combinations, permutations
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.studies.matching.bound import Plane
from optimizer.studies.matching.kernel.joined import MAP, Peaks, Sets, Window, joined
from optimizer.studies.matching.kernel.quarters import BITS, LANES, Quarters, Tables, tabled
from optimizer.studies.matching.problem import Problem

#: parts of a class for which all sets are looked at in some seconds
MOST = 16
#: a share of a weight that is no more than rounding
_NOTHING = 1e-6
#: two normal sums are in a window with a probability of its width over this and the deviation of both: 2 sqrt(pi)
_SPREAD = 3.54
#: pairs for each set there is in the first windows, about; and how far a level that nothing is below is raised
_PAIRS, _RAISED = 4.0, 2.0
#: bits of a cell, of all coordinates
_CELLS = 24
#: sets between two looks at the time, at first and at most; pairs that are looked at between them
_FEW, _MANY = 4, 64
_SUMS_A_LOOK = 20_000_000
#: roundings by which windows are wider
_ROUNDINGS = 16.0


class Exhausted(NamedTuple):
    """What was looked at."""

    mass: Real | None  # (n,) of the class, place by place: better than what was known
    value: float  # of the best that is known
    lower_bound: float  # of all assignments, but for the rounding of the problem
    complete: bool  # all of them were looked at


class _Coordinates(NamedTuple):
    """Up to LANES coordinates of sums, each from anchor level - down slack to anchor level + up slack."""

    effect: Real  # (C, n) what a kilogram at a place adds
    start: Real  # (C,) without the parts
    anchor: Real  # (C,)
    down: Real  # (C,)
    up: Real  # (C,)
    scatter: Real  # (C,) about their standard deviation over all assignments
    narrow: Real  # (C,) the same of the half that scatters less
    share: Real  # (A,) width of the window over it, of all axes there are, for the slack of the best known


def exhausted(
    problem: Problem, cut: Plane, value: float, near: float, spent: Callable[[], bool], most: int | None = None
) -> Exhausted:
    """The best assignment of a single class of parts, and what none is below.

    Parameters
    ----------
    cut : a plane below the peaks, with its smallest value over all assignments.
    value : of the best assignment known; what is no better is not looked for.
    near : a bound so near to it is good enough.
    spent : whether the time is over.
    most : sets that are looked at; None is all.
    """
    one = _Class(problem, cut, value)
    best, result, bound = value, None, cut.least
    if not one.coordinates.scatter.size:
        return Exhausted(None, value, bound, False)
    level, left = one.first_level(value), np.inf if most is None else float(most)
    while best - bound > near:
        one.look_below(level)
        at, many = 0, _FEW
        while at < one.below(level):
            bound = max(bound, min(level, float(one.least[at])))
            if best - bound <= near or left <= 0 or spent():
                return Exhausted(result, best, bound, bound >= best)
            asked = min(many, one.below(level) - at)
            reached, done, mass = one.look(slice(at, at + asked), level)
            if done == 0 and reached == level:
                return Exhausted(result, best, bound, False)
            if reached < level:
                best, level, result = reached, reached, mass
            at, many, left = at + done, min(2 * many, _MANY) if done == asked else max(done, 1), left - done
        bound = max(bound, level)
        if level >= best:
            return Exhausted(result, best, best, True)
        level = min(cut.least + _RAISED * (level - cut.least), best)
    return Exhausted(result, best, bound, bound >= best)


class _Class:
    """A class as compiled loops take it: the lightest parts first, and the places that want the heaviest."""

    def __init__(self, problem: Problem, cut: Plane, value: float) -> None:
        start, effect = problem.start, problem.of_place
        lever = np.real(np.conj(cut.slope) @ effect)
        self._mass, self._cut, self._rounding = np.sort(problem.listed), cut, _ROUNDINGS * problem.rounding
        # along a plane few sets of parts fit such halves; without one the places stay in the order of the machine
        flat = np.ptp(lever) * np.ptp(self._mass) <= self._rounding
        self._place = np.arange(lever.size) if flat else np.argsort(lever, kind="stable")
        lever, effect = lever[self._place], np.ascontiguousarray(effect[:, self._place])
        self._height = cut.constant + float(np.real(np.vdot(cut.slope, start)))
        self._peaks = Peaks(start, effect, problem.peaks.weight, self._mass)
        self._quarters = _quarters(self._mass.size)
        vectors = _left(problem, cut)[:, None] * np.concatenate([start[:, None], effect], axis=1)
        lifted = np.concatenate([[self._height], lever])
        half = int(np.sum(self._quarters.size[:2]))
        self.coordinates = _coordinates(vectors, lifted, half, float(np.std(self._mass)), value - cut.least)
        self._sets = self._by_height(lever, half)
        self.least = self._sets.least

    def below(self, level: float) -> int:
        """How many sets may have an assignment below a level."""
        return int(np.searchsorted(self.least, level))

    def first_level(self, value: float) -> float:
        """What about as many pairs as there are sets are below, if sums scatter as normal ones do; at most a value."""
        told, size = np.minimum(self.coordinates.share / _SPREAD, 1.0), self._quarters.size
        pairs = _factorial(size[0] + size[1]) * _factorial(size[2] + size[3]) * float(np.prod(told))
        slack, most = value - self._cut.least, _PAIRS * self.least.size
        while self.below(self._cut.least + slack) * pairs > most:
            slack, pairs = slack / _RAISED, pairs / _RAISED**told.size
        return self._cut.least + slack

    def look_below(self, level: float) -> None:
        """Tables and windows for a level, and for lower ones."""
        axes = self.coordinates
        used = axes.scatter.size
        width = (axes.down + axes.up) * (level - self._cut.least + self._rounding)
        width = np.maximum(width, np.finfo(np.float32).eps * axes.scatter)
        # cells as narrow as the maps are large, in the proportions of the windows, and none narrower than those
        fine = float(np.prod(_SPREAD * axes.narrow / width)) / 2.0**MAP
        bits = min(_CELLS // used, BITS - 6)
        unit = max(fine ** (1.0 / used), 1.0) * width / (2.0 ** (BITS - bits) - 32.0)
        inside = sum(((1 << (BITS - bits)) - 1) << (BITS * k) for k in range(used))
        lane = sum(((1 << BITS) - 1) << (BITS * k) for k in range(used))
        lanes = (axes.start / unit, axes.anchor / unit, axes.down / unit, axes.up / unit)
        self._window = Window(np.uint64(lane - inside), np.uint64(inside), *lanes)
        self._scaled = self._sets._replace(low=self._sets.low / unit, high=self._sets.high / unit)
        self._tables = Tables(*tabled(self._quarters, self._mass, axes.effect / unit[:, None]))

    def look(self, some: slice, level: float) -> tuple[float, int, Real]:
        """Below a level: the smallest peak of some sets, of how many, and the masses (n,) in the order of the class."""
        sets = Sets(*(each[some] for each in self._scaled))
        reached, done, result = joined(
            self._quarters, self._tables, self._window, self._peaks, sets, level, _SUMS_A_LOOK
        )
        mass = np.empty_like(result)
        mass[self._place] = result
        return float(reached), int(done), mass

    def _by_height(self, lever: Real, half: int) -> Sets:
        """Sets on the first half, in rising order of the height that none of their assignments is below.

        Of equal heights those come first that come to least in the mean of their assignments.
        """
        parts = _sets(self._mass.size, half)
        if self._mirrored(self._rounding / _ROUNDINGS):
            # whichever half the first part is on
            parts = parts[parts[:, 0] == 0]
        if np.any(np.diff(self._mass) == 0):
            # of those with equal masses one is enough
            parts = parts[np.sort(np.unique(self._mass[parts], axis=0, return_index=True)[1])]
        one, other = self._mass[parts], self._mass[_others(parts, self._mass.size)]
        effect = np.concatenate([lever[None], self.coordinates.effect])
        # by sorting each half
        rising = [np.sort(part, axis=1) for part in (effect[:, :half], effect[:, half:])]
        low = np.stack([one @ rising[0][:, ::-1].T, other @ rising[1][:, ::-1].T], axis=1)
        high = np.stack([one @ rising[0].T, other @ rising[1].T], axis=1)
        least = self._height + low[:, 0, 0] + low[:, 1, 0] - self._rounding
        effect = self._peaks.effect
        middle = self._peaks.start + _middle(one) * np.sum(effect[:, :half], axis=1)
        middle = middle + _middle(other) * np.sum(effect[:, half:], axis=1)
        order = np.lexsort((np.abs(middle) @ np.sum(self._peaks.weight, axis=0), least))
        return Sets(np.sum(1 << parts, axis=1)[order], least[order], low[order, :, 1:], high[order, :, 1:])

    def _mirrored(self, rounding: float) -> bool:
        """Whether the places the other way round leave every length as it is: one of two assignments is enough then."""
        start, effect, weight, mass = self._peaks
        one = np.concatenate([start[:, None], effect], axis=1)
        other = np.concatenate([start[:, None], effect[:, ::-1]], axis=1)
        apart = np.minimum(_apart(one, other), _apart(one, np.conj(other)))
        heaviest = np.concatenate([[1.0], np.full(mass.size, mass[-1])])
        return bool(np.max(weight @ (apart @ heaviest)) <= rounding)


def _apart(left: Complex, right: Complex) -> Real:
    """How far numbers (J, N) are from others, but for a turn of each row."""
    turn = np.sum(left * np.conj(right), axis=1, keepdims=True)
    return np.abs(left - np.exp(1j * np.angle(turn)) * right)


@lru_cache(maxsize=MOST)
def _quarters(n: int) -> Quarters:
    size = np.array([(n + k) // 4 for k in (3, 2, 1, 0)])
    count = np.array([_factorial(each) for each in size])
    orders = np.zeros((4, max(count), max(size)), np.int64)
    for q, each in enumerate(size.tolist()):
        orders[q, : count[q], :each] = list(permutations(range(each)))
    sets = np.arange(1 << n)
    taken = np.sum(sets[:, None] >> np.arange(n) & 1, axis=1)
    number = np.zeros(sets.size, np.int64)
    for each in set(size.tolist()):
        number[taken == each] = np.arange(np.sum(taken == each))
    return Quarters(size, orders, count, taken, number)


@lru_cache(maxsize=MOST)
def _sets(n: int, size: int) -> np.ndarray:
    """Sets (N, size) of so many of n parts, the first part in the first of them."""
    return np.array(list(combinations(range(n), size)))


def _others(sets: np.ndarray, n: int) -> np.ndarray:
    """The parts (N, n - size) that are not in each set."""
    left = np.ones((len(sets), n), bool)
    np.put_along_axis(left, sets, False, axis=1)
    return np.nonzero(left)[1].reshape(len(sets), -1)


def _factorial(n: int) -> int:
    return int(np.prod(np.arange(1, n + 1)))


def _left(problem: Problem, cut: Plane) -> Real:
    """What a plane leaves of the weights of lengths (J,); the largest of several is no less than a mean of them."""
    weight = problem.peaks.weight
    held = np.where(weight > 0, np.abs(cut.slope) / np.where(weight > 0, weight, 1.0), 0.0)
    share = np.max(held, axis=1)
    share = share + max(1.0 - float(np.sum(share)), 0.0) / share.size
    left: Real = share @ weight - np.abs(cut.slope)
    return np.where(left > _NOTHING, left, 0.0)


def _coordinates(vectors: Complex, lifted: Real, half: int, scatter: float, slack: float) -> _Coordinates:
    """The axes along which vectors scatter, and the height above a plane: those whose windows tell most.

    Along each axis one half of the places scatters as much more than the other as can be: what the other does not
    reach need not be looked at.

    Parameters
    ----------
    vectors : (J, 1 + n) without the parts, and what a kilogram at a place adds; the sum of their lengths is no more
        than the slack.
    lifted : (1 + n,) the same of the height.
    half : places of the first half.
    scatter : kg, of the masses.
    """
    flat = np.concatenate([vectors.real, vectors.imag])
    axes, size, along = np.linalg.svd(_centred(flat[:, 1:]), full_matrices=False)
    known = size > 1e-9 * max(float(size[0]), np.finfo(float).tiny)
    one = _centred(along[known, :half])
    _, apart = np.linalg.eigh(one @ one.T)
    axes = (axes[:, known] / size[known] @ apart).T
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    reach = np.max(np.hypot(*np.split(axes, 2, axis=1)), axis=1, initial=0.0)
    rows = np.concatenate([lifted[None], axes @ flat])
    none = np.zeros(len(axes))
    anchor, down, up = (np.concatenate([[first], rest]) for first, rest in ((1.0, none), (1.0, reach), (0.0, reach)))
    wide = scatter * np.linalg.norm(_centred(rows[:, 1:]), axis=1)
    narrow = scatter * np.min(
        [np.linalg.norm(_centred(part), axis=1) for part in (rows[:, 1 : 1 + half], rows[:, 1 + half :])], axis=0
    )
    told = np.where(wide > 0, (down + up) * slack / np.where(wide > 0, wide, 1.0), np.inf)
    best = [k for k in np.argsort(told, kind="stable")[:LANES] if np.isfinite(told[k])]
    return _Coordinates(
        rows[best, 1:],
        rows[best, 0],
        anchor[best],
        down[best],
        up[best],
        wide[best],
        narrow[best],
        told[np.isfinite(told)],
    )


def _centred(rows: Real) -> Real:
    """What is left without the mean of each row."""
    return rows - _middle(rows)


def _middle(rows: Real) -> Real:
    """Mean of each row (N, 1); 0 of none, as the second half of two places has."""
    return np.sum(rows, axis=1, keepdims=True) / max(rows.shape[1], 1)
