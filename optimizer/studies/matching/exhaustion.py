"""All assignments that may be better than the best one so far, by halves.

The sums of half the classes lie in a tree, and those of the others are looked up in it. Of two sums only those matter
whose vectors nearly cancel, or that are on the near side of a plane. The former lie in a ball: a sum of lengths is no
less than the length of all together. What either leaves over is evaluated one by one, so nothing better is missed.
"""

from itertools import combinations
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrangements import few_arrangements
from optimizer.numerics.arrays import Complex, Real
from optimizer.studies.matching.bound import Plane, plane
from optimizer.studies.matching.problem import Minorants, Places, Problem

#: sums in a half, and pairs of sums that are looked at
_SUMS = 100_000
_PAIRS = 5_000_000
#: pairs that are evaluated at once
_CHUNK = 200_000
#: sums that are looked up to guess how many pairs there are
_SAMPLE = 200


class Half(NamedTuple):
    """All arrangements of some classes."""

    classes: tuple[int, ...]
    masses: tuple[Real, ...]  # (N_c, n_c) of every class, masses at its rows, place by place
    sums: Complex  # (N, J) what they add to the vectors, the last class changing fastest

    def mass(self, number: int) -> dict[int, Real]:
        """Masses at the rows of every class of one arrangement."""
        digits = np.unravel_index(number, [len(mass) for mass in self.masses])
        return {c: mass[k] for c, mass, k in zip(self.classes, self.masses, digits, strict=True)}


def _arranged(places: Places) -> Real | None:
    """All different arrangements of a class (N, rows), masses row by row; None where there are too many."""
    masses, times = np.unique(places.mass, return_counts=True)
    result = few_arrangements(times, int(np.sum(places.row >= 0)), _SUMS)
    return None if result is None else masses[result]


def halves(problem: Problem) -> tuple[Half, Half] | None:
    """The classes in two halves of as equal size as can be; None where there are too many arrangements."""
    results = [_arranged(group) for group in problem.classes]
    masses = [result for result in results if result is not None]
    if len(masses) < len(results):
        return None
    sizes, every = [float(len(mass)) for mass in masses], range(len(masses))
    splits = [subset for count in range(len(masses)) for subset in combinations(every, count)]
    half = min(splits, key=lambda subset: max(np.prod([sizes[c] for c in subset]), _rest(sizes, subset)))
    rest = tuple(c for c in every if c not in half)
    if max(np.prod([sizes[c] for c in half]), np.prod([sizes[c] for c in rest])) > _SUMS:
        return None
    return _half(problem, half, masses), _half(problem, rest, masses)


def _rest(sizes: list[float], subset: tuple[int, ...]) -> float:
    return float(np.prod([size for c, size in enumerate(sizes) if c not in subset]))


def _half(problem: Problem, classes: tuple[int, ...], masses: list[Real]) -> Half:
    sums = np.zeros((1, problem.start.size), complex)
    for c in classes:
        on = problem.classes[c].row
        contribution = masses[c] @ problem.of_row[:, on[on >= 0]].T
        sums = (sums[:, None, :] + contribution[None, :, :]).reshape(-1, problem.start.size)
    return Half(classes, tuple(masses[c] for c in classes), sums)


def candidates(problem: Problem, minorants: Minorants, value: float, cut: Plane) -> tuple[Real, Real] | None:
    """Every assignment (N, T) whose largest minorant is below a value, with that (N,), in rising order.

    None where there are too many to look at.

    Parameters
    ----------
    cut : a plane below the minorants.
    """
    parts = halves(problem)
    if parts is None:
        return None
    half, rest = parts
    base = problem.start + rest.sums
    pairs = _pairs(problem, minorants, value, cut, half.sums, base)
    if pairs is None:
        return None
    first, second = pairs
    places, values = [], []
    for at in range(0, first.size, _CHUNK):
        part = slice(at, at + _CHUNK)
        result = minorants.at(half.sums[first[part]] + base[second[part]])
        below = np.flatnonzero(result < value)
        places.append(below + at)
        values.append(result[below])
    numbers, worth = np.concatenate([*places, np.zeros(0, int)]), np.concatenate([*values, np.zeros(0)])
    # many assignments may equal the best so far: those are no better, and not here
    order = np.argsort(worth, kind="stable")[:_CHUNK]
    if numbers.size > _CHUNK:
        return None
    masses = [
        _assignment(problem, half.mass(int(first[n])) | rest.mass(int(second[n]))) for n in numbers[order].tolist()
    ]
    return np.array(masses).reshape(-1, problem.input_order.size), worth[order]


def _assignment(problem: Problem, by_class: dict[int, Real]) -> Real:
    """Masses at all places (T,) of masses at rows; what is left over lies beside the machine."""
    results = []
    for c, group in enumerate(problem.classes):
        on = group.row >= 0
        mass = np.empty_like(group.mass)
        mass[on] = by_class[c]
        kinds, left = np.unique(group.mass, return_counts=True)
        left = left - np.array([np.sum(by_class[c] == kind) for kind in kinds])
        mass[~on] = np.repeat(kinds, left)
        results.append(mass)
    return np.concatenate(results)


def _pairs(
    problem: Problem, minorants: Minorants, value: float, cut: Plane, left: Complex, right: Complex
) -> tuple[np.ndarray, np.ndarray] | None:
    """Pairs of sums, numbers of the first and of the second, among which all are that come below the value."""
    if len(left) * len(right) <= _CHUNK:
        return tuple(np.indices((len(left), len(right))).reshape(2, -1))  # type: ignore[return-value]
    # a margin for the rounding of what is compared
    margin = problem.rounding
    near = _beyond_plane(value + margin, cut, left, right)
    if near is not None:
        return near
    for minorant in minorants.singles():
        within = _in_ball(problem, minorant, value + margin, left, right)
        if within is not None:
            return within
    return None


def _beyond_plane(value: float, cut: Plane, left: Complex, right: Complex) -> tuple[np.ndarray, np.ndarray] | None:
    """Pairs whose plane is no higher than the value."""
    height, rest = np.real(left @ np.conj(cut.slope)), cut.constant + np.real(right @ np.conj(cut.slope))
    order = np.argsort(height, kind="stable")
    count = np.searchsorted(height[order], value - rest, side="right")
    if np.sum(count, dtype=float) > _PAIRS:
        return None
    second = np.repeat(np.arange(len(right)), count)
    place = np.arange(second.size) - np.repeat(np.cumsum(count) - count, count)
    return order[place], second


def _in_ball(
    problem: Problem, minorant: Minorants, value: float, left: Complex, right: Complex
) -> tuple[np.ndarray, np.ndarray] | None:
    """Pairs whose weighted vectors together are no longer than the value leaves to their lengths."""
    from scipy.spatial import cKDTree

    weight = minorant.weight[0]
    flat, _ = plane(problem, float(minorant.constant[0]), minorant.slope[0])
    radius = value - flat.least
    if radius < 0 or not np.any(weight > 0):
        return None
    first, second = (_real(part[:, weight > 0] * weight[weight > 0]) for part in (left, -right))
    tree = cKDTree(first)
    # counting takes long where much is near: a few tell
    few = second[:: max(1, len(second) // _SAMPLE)]
    if np.sum(tree.query_ball_point(few, radius, return_length=True)) > 2.0 * _PAIRS * len(few) / len(second):
        return None
    rest = cKDTree(second)
    if tree.count_neighbors(rest, radius) > _PAIRS:
        return None
    result = tree.sparse_distance_matrix(rest, radius, output_type="ndarray")
    return result["i"], result["j"]


def _real(vectors: Complex) -> Real:
    return np.concatenate([vectors.real, vectors.imag], axis=1)
