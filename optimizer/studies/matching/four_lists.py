"""Assignments of several classes whose vectors nearly cancel, of more than can be compared.

The places are dealt into four groups, and the parts of each are put on it in every order. Of two groups those pairs of
orders are kept that come about to a share of what is wanted, of the other two those that come about to the rest, and
of these the nearest to one another (Schroeppel and Shamir 1981, Wagner 2002). The next groups are dealt by chance.
"""

from collections.abc import Callable
from functools import lru_cache
from itertools import permutations
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.numerics.kernel.meeting import met
from optimizer.studies.matching.problem import Problem

#: places of a group, and pairs of orders of two groups that are kept
_PLACES, _PAIRS = 8, 300_000
#: pairs of these that are evaluated
_OFFERED = 64
#: deals in a row that find nothing better
_PATIENCE = 30
#: of two normal sums of deviation 1 that come together, density where they do: 1 / sqrt(2 pi)
_SPREAD = 2.51
_SEED = 17


class _Orders(NamedTuple):
    """The parts of a group of places in all orders."""

    places: np.ndarray  # (n,)
    mass: Real  # (N, n)
    points: Real  # (N, d) what they change


class _Pairs(NamedTuple):
    """Some orders of two groups at once."""

    groups: tuple[_Orders, _Orders]
    which: np.ndarray  # (2, k)
    points: Real  # (k, d) what they change

    def put(self, mass: Real, some: np.ndarray) -> None:
        """Some of them on their places (N, T)."""
        for group, which in zip(self.groups, self.which, strict=True):
            mass[:, group.places] = group.mass[which[some]]


def near_to_nothing(problem: Problem, mass: Real, enough: float, spent: Callable[[], bool]) -> Real:
    """An assignment (T,) no worse than a given one, sought until it is good enough or nothing better is found."""
    chance, value, left = np.random.default_rng(_SEED), _value(problem, mass), _PATIENCE
    axes, rows = _axes(problem)
    while value > enough and left > 0 and not spent():
        groups = _dealt(problem, chance)
        if len(groups) < 4:
            break
        one, two, three, four = (_orders(rows, mass, places) for places in groups)
        wanted = -axes @ _real(problem, problem.vectors(mass))
        middle = np.mean(one.points, axis=0) + np.mean(two.points, axis=0)
        rest = wanted - np.mean(three.points, axis=0) - np.mean(four.points, axis=0)
        # any share will do that is as near to the middle of both pairs
        about = chance.random() * 0.5 * (middle + rest)
        pairs = _together(one, two, about), _together(three, four, wanted - about)
        tried = _nearest(*pairs, wanted, mass)
        values = problem.peaks.at(problem.vectors(tried))
        left -= 1
        if values.size and np.min(values) < value:
            mass, value, left = tried[np.argmin(values)], float(np.min(values)), _PATIENCE
    return mass


def _value(problem: Problem, mass: Real) -> float:
    return float(problem.peaks.at(problem.vectors(mass)))


def _real(problem: Problem, vectors: np.ndarray) -> Real:
    """Weighted vectors (J, ...) as real coordinates (2 J, ...)."""
    weighted = (np.max(problem.peaks.weight, axis=0) * vectors.T).T
    return np.concatenate([weighted.real, weighted.imag])


def _axes(problem: Problem) -> tuple[Real, Real]:
    """Axes (d, 2 J) along which the places are not the same, and what a kilogram adds along these (d, T)."""
    effect = _real(problem, problem.of_place)
    axes, size, _ = np.linalg.svd(effect, full_matrices=False)
    axes = axes[:, size > 1e-9 * size[0]].T
    return axes, axes @ effect


def _dealt(problem: Problem, chance: np.random.Generator) -> list[np.ndarray]:
    """Four groups of places, each of one class; fewer where there are no more places."""
    size, groups = np.array([part.stop - part.start for part in problem.slices]), []
    for least in range(1, 5):
        # of a class no more groups than it has places
        many = np.minimum(np.maximum(least, -(-size // _PLACES)), size)
        if np.sum(many) >= 4:
            break
    for part, count in zip(problem.slices, many.tolist(), strict=True):
        groups += np.array_split(chance.permutation(np.arange(part.start, part.stop)), count)
    return [groups[k] for k in chance.permutation(len(groups))[:4]]


def _orders(rows: Real, mass: Real, places: np.ndarray) -> _Orders:
    put = mass[places][_every(places.size)]
    return _Orders(places, put, (put - mass[places]) @ rows[:, places].T)


@lru_cache(maxsize=_PLACES)
def _every(n: int) -> np.ndarray:
    """All orders of n things."""
    return np.array(list(permutations(range(n))))


def _together(left: _Orders, right: _Orders, about: Real) -> _Pairs:
    """Orders of two groups of places that come near to a point."""
    which = _met(left.points, about - right.points)
    return _Pairs((left, right), which, left.points[which[0]] + right.points[which[1]])


def _nearest(left: _Pairs, right: _Pairs, wanted: Real, mass: Real) -> Real:
    """Assignments (N, T) that come nearest to what is wanted."""
    i, j = _met(left.points, wanted - right.points)
    apart = np.sum((left.points[i] + right.points[j] - wanted) ** 2, axis=1)
    best = np.argpartition(apart, _OFFERED)[:_OFFERED] if apart.size > _OFFERED else np.arange(apart.size)
    tried = np.tile(mass, (best.size, 1))
    left.put(tried, i[best])
    right.put(tried, j[best])
    return tried


def _met(left: Real, right: Real) -> np.ndarray:
    """Which points are near to one another (2, k): about as many as are kept, if they scatter as normal ones do."""
    scatter = _SPREAD * np.hypot(np.std(left, axis=0), np.std(right, axis=0))
    wide, most = scatter > 0, 2 * _PAIRS
    few = len(left) * len(right) <= most or not np.any(wide)
    side = (
        np.inf if few else float((_PAIRS / (len(left) * len(right)) * np.prod(scatter[wide])) ** (1.0 / np.sum(wide)))
    )
    result: np.ndarray = met(np.ascontiguousarray(left), np.ascontiguousarray(right), side, most)
    return result
