"""Assignments of several classes whose vectors nearly cancel, of more than can be compared.

The places are dealt into four groups, and the parts of each are put on it in every order. Orders that come near to
nothing together come from sums of four lists (:mod:`optimizer.numerics.four_lists`). The next groups are dealt by
chance.
"""

from collections.abc import Callable
from functools import lru_cache
from itertools import permutations
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.numerics.four_lists import nearest_sums
from optimizer.studies.matching.problem import Problem

#: places of a group
_PLACES = 8
#: deals in a row that find nothing better
_PATIENCE = 30
_SEED = 17


class _Orders(NamedTuple):
    """The parts of a group of places in all orders."""

    places: np.ndarray  # (n,)
    mass: Real  # (N, n)
    points: Real  # (N, d) what they change


def near_to_nothing(problem: Problem, mass: Real, enough: float, spent: Callable[[], bool]) -> Real:
    """An assignment (T,) no worse than ``mass``: the search ends at ``enough``, or after many attempts without gain."""
    chance, value, left = np.random.default_rng(_SEED), _value(problem, mass), _PATIENCE
    axes, rows = _axes(problem)
    while value > enough and left > 0 and not spent():
        groups = _dealt(problem, chance)
        if len(groups) < 4:
            break
        every = first, second, third, fourth = [_orders(rows, mass, places) for places in groups]
        target = -axes @ _real(problem, problem.vectors(mass))
        middle = np.mean(first.points, axis=0) + np.mean(second.points, axis=0)
        rest = target - np.mean(third.points, axis=0) - np.mean(fourth.points, axis=0)
        # any share will do that is as near to the middle of both pairs
        about = chance.random() * 0.5 * (middle + rest)
        orders = nearest_sums([group.points for group in every], about, target)
        trials = np.tile(mass, (orders.shape[1], 1))
        for group, order in zip(every, orders, strict=True):
            trials[:, group.places] = group.mass[order]
        values = problem.peaks.at(problem.vectors(trials))
        left -= 1
        if values.size and np.min(values) < value:
            mass, value, left = trials[np.argmin(values)], float(np.min(values)), _PATIENCE
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
    arrangement = mass[places][_every(places.size)]
    return _Orders(places, arrangement, (arrangement - mass[places]) @ rows[:, places].T)


@lru_cache(maxsize=_PLACES)
def _every(n: int) -> np.ndarray:
    """All orders of n things."""
    return np.array(list(permutations(range(n))))
