"""Integrals over one turn that do not depend on how the outputs are sampled.

Forces jump or have kinks where valves open and rows reverse. Between those angles they are smooth, so
Gauss-Legendre panels between them converge fast; the end point of the turn is not counted twice.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from optimizer.response import Real

_NODES = 6
_ABSCISSAE, _WEIGHTS = legendre.leggauss(_NODES)


def _integration_matrix() -> Real:
    """Matrix from values at the Gauss nodes of [-1, 1] to the integrals of their interpolant from -1."""
    to_legendre = np.linalg.inv(legendre.legvander(_ABSCISSAE, _NODES - 1))
    integrals = [legendre.legval(_ABSCISSAE, legendre.legint(unit, lbnd=-1)) for unit in np.eye(_NODES)]
    return np.array(integrals).T @ to_legendre


_INTEGRATE = _integration_matrix()
#: from values at the Gauss nodes to those of their interpolant at both ends
_AT_ENDS = legendre.legvander(np.array([-1.0, 1.0]), _NODES - 1) @ np.linalg.inv(
    legendre.legvander(_ABSCISSAE, _NODES - 1)
)
_STEPS = np.diff(np.concatenate([[-1.0], _ABSCISSAE, [1.0]]))


@dataclass(frozen=True)
class Turn:
    """Panels over one turn. P panels with Gauss nodes each."""

    start: Real  # (..., P) rad
    width: Real  # (..., P) rad; 0 where two break angles coincide

    @property
    def angle(self) -> Real:
        """Nodes in rising order, (..., P * nodes) rad."""
        inside = 0.5 * (_ABSCISSAE + 1.0)
        nodes = self.start[..., None] + self.width[..., None] * inside
        return nodes.reshape(*nodes.shape[:-2], -1)


def panels(breaks: Real, widest: float, halved: bool = False) -> Turn:
    """Panels between break angles, cut at a regular grid as well; their number grows with that of the breaks.

    Parameters
    ----------
    breaks : (..., B) rad, any order; taken modulo one turn, nan counts as none.
    widest : rad, step of the grid.
    halved : every panel cut in two, for an estimate of the error.
    """
    inner = np.mod(np.where(np.isnan(breaks), 0.0, breaks), 2.0 * np.pi)
    grid = np.linspace(0.0, 2.0 * np.pi, int(np.ceil(2.0 * np.pi / widest)) + 1)
    edges = np.sort(np.concatenate([inner, np.broadcast_to(grid, (*inner.shape[:-1], grid.size))], axis=-1), axis=-1)
    width = np.diff(edges, axis=-1)
    if not halved:
        return Turn(edges[..., :-1], width)
    half = np.repeat(0.5 * width, 2, axis=-1)
    start = np.repeat(edges[..., :-1], 2, axis=-1)
    start[..., 1::2] += half[..., 1::2]
    return Turn(start, half)


def mean(turn: Turn, values: Real) -> Real:
    """Mean over the turn of values at its nodes (...)."""
    return np.sum(_per_panel(turn, values) @ _WEIGHTS * (0.5 * turn.width), axis=-1) / (2.0 * np.pi)


def fluctuation(turn: Turn, values: Real) -> Real:
    """Range of the running integral of values - mean over the turn (...).

    For a torque that is the energy a flywheel has to take up and give back (seed 004, 2-27, E004-17).
    The extremes lie where the value crosses its mean, between two nodes.
    """
    rest = _per_panel(turn, values - mean(turn, values)[..., None])
    half = 0.5 * turn.width[..., None]
    # every panel by itself, from end to end: the value may jump from one to the next
    first, last = np.split(rest @ _AT_ENDS.T, 2, axis=-1)
    value = np.concatenate([first, rest, last], axis=-1)
    whole = rest @ _WEIGHTS * half[..., 0]
    within = np.concatenate([np.zeros_like(first), rest @ _INTEGRATE.T * half, whole[..., None]], axis=-1)
    running = (np.cumsum(whole, axis=-1) - whole)[..., None] + within
    left, right = value[..., :-1], value[..., 1:]
    crosses = left * right < 0.0
    to_crossing = np.where(crosses, left / np.where(crosses, left - right, 1.0), 0.0) * _STEPS * half
    extremes = np.concatenate([running, running[..., :-1] + 0.5 * left * to_crossing], axis=-1)
    return np.max(extremes, axis=(-2, -1)) - np.min(extremes, axis=(-2, -1))


def _per_panel(turn: Turn, values: Real) -> Real:
    return values.reshape(*turn.width.shape, _NODES)
