"""What an objective comes to at worst where counterweights are not quite what they should be.

All counterweights are off together, each by up to a share of its mass or by up to an angle, whichever way is worst.
A norm |a + sum_k v_k| moves to |a + sum_k v_k (1 + e_k)|, or to |a + sum_k v_k e^{j psi_k}|; its largest value is that
of its projection, over all directions phi, and along one direction every counterweight is at its worst by itself. So
one angle is left to search, and between finitely many of its values the projection is a sine and a constant: exact.
"""

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.program.statement import Norms, Statement


def worst_by_mass(norms: Norms, u: Complex, share: float) -> Real:
    """Largest sizes (..., J) of norms where every counterweight (..., K) is off by up to a share of its mass."""
    middle, corners = norms.at(u), mass_corners(norms.influence * u[..., None, :])
    return np.max(np.abs(middle[..., None] + share * corners), axis=-1)


def mass_corners(vectors: Complex) -> Complex:
    """Corners of all sums of vectors (..., K), each times a number from -1 to 1: (..., 2 K + 2), some of them twice."""
    ahead = np.where((vectors.imag < 0) | ((vectors.imag == 0) & (vectors.real < 0)), -vectors, vectors)
    ahead = np.take_along_axis(ahead, np.argsort(np.angle(ahead), axis=-1), axis=-1)
    # around half of the outline the vectors change sign one after the other
    half = np.sum(ahead, axis=-1)[..., None] - 2.0 * np.cumsum(
        np.concatenate([np.zeros_like(ahead[..., :1], shape=(*ahead.shape[:-1], 1)), ahead], axis=-1), axis=-1
    )
    return np.concatenate([half, -half], axis=-1)


def worst_by_angle(norms: Norms, u: Complex, angle: float) -> Real:
    """Largest sizes (..., J) of norms where every counterweight (..., K) is off by up to an angle [rad] below pi/2.

    Along direction phi a counterweight v gives |v| cos(max(|phi - arg v| - angle, 0)).
    """
    vectors = norms.influence * u[..., None, :]
    size, towards = np.abs(vectors), np.angle(vectors)
    fixed = norms.at(u) - np.sum(vectors, axis=-1)
    ahead, behind = vectors * np.exp(1j * angle), vectors * np.exp(-1j * angle)
    # phi grows from -pi: every counterweight is turned ahead, not at all or back as phi is behind, near or ahead of it
    start = np.concatenate([towards - angle, towards + angle, towards + np.pi], axis=-1)
    turned = np.concatenate([-behind, ahead, behind - ahead], axis=-1)
    level = np.concatenate([size, -size, np.zeros_like(size)], axis=-1)
    wrapped = np.mod(start + np.pi, 2.0 * np.pi) - np.pi
    order = np.argsort(wrapped, axis=-1)
    turned, level, start = (np.take_along_axis(each, order, axis=-1) for each in (turned, level, wrapped))
    off = np.mod(-np.pi - towards + np.pi, 2.0 * np.pi) - np.pi
    near = np.abs(off) <= angle
    first = fixed + np.sum(np.where(near, 0.0, np.where(off > 0, ahead, behind)), axis=-1)
    flat = np.sum(np.where(near, size, 0.0), axis=-1)
    # between two of these angles the projection is |vector| cos(phi - arg vector) + flat
    vector = first[..., None] + np.concatenate([np.zeros_like(fixed)[..., None], np.cumsum(turned, axis=-1)], axis=-1)
    flat = flat[..., None] + np.concatenate([np.zeros_like(flat)[..., None], np.cumsum(level, axis=-1)], axis=-1)
    edge = np.full_like(flat[..., :1], np.pi)
    begin, end = np.concatenate([-edge, start], axis=-1), np.concatenate([start, edge], axis=-1)
    best = np.angle(vector)
    inside = (begin <= best) & (best <= end)
    at_ends = np.maximum(np.cos(begin - best), np.cos(end - best))
    return np.max(np.abs(vector) * np.where(inside, 1.0, at_ends) + flat, axis=-1)


def largest_objective(statement: Statement, sizes: Real) -> Real:
    """The objective (...) of norms of these sizes (..., J): of a sum of peaks no less than they come to together."""
    return np.sum(statement.largest(statement.rows(sizes)), axis=-1)


def angle_corners(vectors: Complex, angle: float) -> Complex:
    """Corners of an outline (..., 4 K) around all sums of v_k (e^{j psi_k} - 1), |psi_k| up to an angle [rad].

    Every arc lies inside the two ends and the two places where the tangents in the middle and at the ends meet, which
    are further out by less than a hundredth of what the angle moves the vector, of angles up to a degree.
    """
    turns = np.exp(1j * angle * np.array([-1.0, -0.5, 0.5, 1.0])) / np.array([1.0, *2 * [np.cos(0.5 * angle)], 1.0])
    outline = vectors[..., None] * (turns - 1.0)
    edges = np.roll(outline, -1, axis=-1) - outline
    # of a sum of outlines the edges stand in the order of their directions, and each is walked from its first on
    first = np.argmin(np.angle(edges), axis=-1)[..., None]
    start = np.sum(np.take_along_axis(outline, first, axis=-1)[..., 0], axis=-1)
    edges = edges.reshape(*edges.shape[:-2], 4 * edges.shape[-2])
    edges = np.take_along_axis(edges, np.argsort(np.angle(edges), axis=-1), axis=-1)
    return start[..., None] + np.cumsum(edges, axis=-1)
