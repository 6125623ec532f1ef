"""What an objective comes to at worst where counterweights are not quite what they should be.

All counterweights are off together, each by up to a share of its mass or by up to an angle, whichever way is worst.
A norm |a + sum_k v_k| moves to |a + sum_k v_k (1 + e_k)|, or to |a + sum_k v_k e^{j psi_k}|; its largest value is that
of its projection, over all directions phi. Along one direction every counterweight is at its worst by itself. So one
angle is left to search, and between finitely many of its values the projection is a sine and a constant: exact.
"""

import math
from functools import cache
from types import ModuleType

import numpy as np

from optimizer.numerics.arrays import Complex, Real, in_order, single_axis
from optimizer.program.norms import Norms
from optimizer.program.statement import Statement


def worst_objectives(statement: Statement, u: Complex, angle: float, share: float) -> Real:
    """What the objective of programs (*leading) comes to with counterweights (*leading, K) kg m, (3, *leading).

    As they are; each off by up to an angle; and by up to a share of its mass. Of a sum of peaks no less than that.
    """
    flat = statement.flat
    programs, objectives = flat.programs, np.empty((3, math.prod(flat.leading)))
    _outlines().objectives(
        programs.owner,
        programs.group,
        programs.floor,
        programs.scalar,
        programs.constant,
        programs.influence,
        programs.across,
        single_axis(flat.leading, u, 1),
        angle,
        share,
        objectives,
    )
    return objectives.reshape(3, *flat.leading)


def worst_by_mass(norms: Norms, u: Complex, share: float) -> Real:
    """Largest sizes (..., J) of norms where every counterweight (..., K) is off by up to a share of its mass."""
    return farthest_by_mass(norms.at(u), norms.influence * u[..., None, :], share)


def farthest_by_mass(middle: Complex, vectors: Complex, share: float) -> Real:
    """Largest |middle + sum_k e_k v_k| (...) of vectors (..., K), |e_k| up to a share."""
    worst = np.empty(middle.size)
    rows = in_order(vectors).reshape(worst.size, vectors.shape[-1])
    _outlines().worst_scaled(rows, in_order(middle).reshape(-1), share, worst)
    return worst.reshape(middle.shape)


def mass_corners(vectors: Complex) -> Complex:
    """Corners of all sums of vectors (..., K), each times a number from -1 to 1: (..., 2 K + 2), some of them twice."""
    x, y = vectors.real, vectors.imag
    *leading, webs = vectors.shape
    rows = np.where((y < 0) | ((y == 0) & (x < 0)), -vectors, vectors).reshape(math.prod(leading), webs)
    order = np.argsort(np.arctan2(rows.imag, rows.real), axis=-1)
    ahead = rows[np.arange(len(rows))[:, None], order].reshape(vectors.shape)
    # around half of the outline the vectors change sign one after the other
    first = np.add.reduce(ahead, axis=-1)[..., None]
    half = np.concatenate([first, first - 2.0 * np.cumsum(ahead, axis=-1)], axis=-1)
    return np.concatenate([half, -half], axis=-1)


def worst_by_angle(norms: Norms, u: Complex, angle: float) -> Real:
    """Largest sizes (..., J) of norms where every counterweight (..., K) is off by up to an angle [rad] below pi/2."""
    vectors = norms.influence * u[..., None, :]
    return farthest_by_angle(norms.at(u) - np.add.reduce(vectors, axis=-1), vectors, angle)


def farthest_by_angle(fixed: Complex, vectors: Complex, angle: float) -> Real:
    """Largest |fixed + sum_k v_k e^{j psi_k}| (...) of vectors (..., K), |psi_k| up to an angle [rad] below pi/2."""
    worst = np.empty(fixed.size)
    rows = in_order(vectors).reshape(worst.size, vectors.shape[-1])
    _outlines().worst_rotation(rows, in_order(fixed).reshape(-1), angle, worst)
    return worst.reshape(fixed.shape)


def angle_corners(vectors: Complex, angle: float) -> Complex:
    """Corners of an outline (..., 4 K) around all sums of v_k (e^{j psi_k} - 1), |psi_k| up to an angle [rad].

    Every arc lies inside its two ends and the two places where the tangents in the middle and at the ends meet. For
    angles up to a degree these are further out by less than a hundredth of what the angle moves the vector.
    """
    turns = np.exp(1j * angle * np.array([-1.0, -0.5, 0.5, 1.0])) / np.array([1.0, *2 * [np.cos(0.5 * angle)], 1.0])
    outline = vectors[..., None] * (turns - 1.0)
    edges = np.roll(outline, -1, axis=-1) - outline
    # of a sum of outlines the edges stand in the order of their directions, and each is walked from its first on
    first = np.argmin(np.angle(edges), axis=-1)[..., None]
    start = np.add.reduce(np.take_along_axis(outline, first, axis=-1)[..., 0], axis=-1)
    edges = edges.reshape(*edges.shape[:-2], 4 * edges.shape[-2])
    edges = np.take_along_axis(edges, np.argsort(np.angle(edges), axis=-1), axis=-1)
    return start[..., None] + np.cumsum(edges, axis=-1)


# loads the compiler, a tenth of a second, and so at the first call; an import at each takes as long as a short loop
@cache
def _outlines() -> ModuleType:
    from optimizer.program.kernel import outlines

    return outlines
