"""A lower bound by sorting: for fixed multipliers the best permutation of a class is a sorted one.

For |y_j| <= weight_j a minorant is no smaller than constant + Re(conj(slope + y) v), which is a sum of worth times mass
over the places; of all permutations it is least where the worth falls as the masses rise (rearrangement inequality).
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.studies.matching.problem import Minorants, Problem

_ROUNDS = 60
#: lengths are smoothed by this share of the largest, and less where that is too much
_SMOOTH = 1e-3
#: a mixture so near to its bound, as a share of what is open, is the best
_CLOSE = 1e-2
_FAR = 1e3


class Plane(NamedTuple):
    """An affine minorant constant + Re(conj(slope) v), and the smallest value of it over all assignments."""

    constant: float
    slope: Complex  # (J,)
    least: float


def sorted_masses(problem: Problem, slope: Complex) -> Real:
    """Masses at places (T,) for which Re(conj(slope) v) is least."""
    worth = np.real(np.conj(slope) @ problem.of_place)
    mass = np.empty_like(worth)
    for group, part in zip(problem.classes, problem.slices, strict=True):
        mass[part][np.argsort(-worth[part], kind="stable")] = np.sort(group.mass)
    return mass


def plane(problem: Problem, constant: float, slope: Complex) -> tuple[Plane, Complex]:
    """The plane with its least value, and the vectors (J,) where it is."""
    v = problem.vectors(sorted_masses(problem, slope))
    return Plane(constant, slope, constant + float(np.real(np.vdot(slope, v)))), v


def best_plane(problem: Problem, minorants: Minorants, value: float, near: float) -> Plane:
    """The plane that proves most.

    Parameters
    ----------
    value : of the best assignment so far.
    near : a bound so near to it is good enough.
    """
    results = [_ascended(problem, minorant, value, near) for minorant in minorants.singles()]
    return max(results, key=lambda cut: cut.least)


def _ascended(problem: Problem, minorant: Minorants, value: float, near: float) -> Plane:
    """Of a minorant: its smallest value over all mixtures of assignments, whose gradient is the slope of the plane.

    Lengths are smoothed, |v_j| ~ (|v_j|^2 / s_j + s_j) / 2 with s_j the last length, and the mixtures grow by the
    assignment that the gradient asks for (column generation); each round proves something by itself.
    """
    constant, slope, weight = float(minorant.constant[0]), minorant.slope[0], minorant.weight[0]
    best, corner = plane(problem, constant, slope)
    middle = np.concatenate([np.full(places.mass.size, np.mean(places.mass)) for places in problem.classes])
    corners = np.stack([problem.vectors(middle), corner])
    v = corners[0]
    smooth = _SMOOTH * float(np.max(np.abs(corners)))
    for _ in range(_ROUNDS):
        length = np.sqrt(np.abs(v) ** 2 + smooth**2)
        if not np.all(length > 0):
            break
        candidate, corner = plane(problem, constant, slope + weight * v / length)
        best = max(best, candidate, key=lambda cut: cut.least)
        mixed = constant + float(np.real(np.vdot(slope, v)) + weight @ np.abs(v))
        if value - best.least <= near or mixed - best.least <= _CLOSE * abs(value - best.least):
            break
        if not np.any(np.all(corners == corner, axis=1)):
            corners = np.concatenate([corners, corner[None]])
        elif smooth > 0:
            smooth *= 0.5
        v = _mixture(corners, slope, weight / length) @ corners
    return best


def _mixture(corners: Complex, slope: Complex, stiffness: Real) -> Real:
    """Shares (N,) of corners (N, J), of sum 1, for which sum_j stiffness_j |v_j|^2 / 2 + Re(conj(slope) v) is least."""
    from scipy.optimize import nnls

    scaled = (corners * np.sqrt(stiffness)).T
    linear = np.real(corners @ np.conj(slope))
    linear = linear - np.min(linear)
    size = max(float(np.max(np.abs(scaled))), float(np.sqrt(np.max(linear))))
    if size == 0:
        return np.full(len(corners), 1.0 / len(corners))
    # a linear term as a square far from its least: (m + b/m)^2 / 2 = m^2 / 2 + b + ...
    far = _FAR * size
    squares = np.concatenate([scaled.real, scaled.imag, (far + linear / far)[None], np.full((1, len(corners)), far)])
    squares[-2] -= far
    target = np.zeros(len(squares))
    target[-1], target[-2] = far, -far
    shares, _ = nnls(squares, target)
    return shares / np.sum(shares)
