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


def panels(breaks: Real, finest: float) -> Turn:
    """Panels between break angles, none wider than ``finest``.

    Parameters
    ----------
    breaks : (..., B) rad, any order; taken modulo one turn, nan counts as none.
    finest : rad.
    """
    inner = np.sort(np.mod(np.where(np.isnan(breaks), 0.0, breaks), 2.0 * np.pi), axis=-1)
    ends = np.zeros((*inner.shape[:-1], 1))
    edges = np.concatenate([ends, inner, ends + 2.0 * np.pi], axis=-1)
    gaps = np.diff(edges, axis=-1)
    parts = max(1, int(np.ceil(np.max(gaps) / finest)))
    width = np.repeat(gaps / parts, parts, axis=-1)
    step = np.tile(np.arange(parts), gaps.shape[-1])
    return Turn(np.repeat(edges[..., :-1], parts, axis=-1) + step * width, width)


def mean(turn: Turn, values: Real) -> Real:
    """Mean over the turn of values at its nodes (...)."""
    return np.sum(_per_panel(turn, values) @ _WEIGHTS * (0.5 * turn.width), axis=-1) / (2.0 * np.pi)


def fluctuation(turn: Turn, values: Real) -> Real:
    """Range of the running integral of values - mean over the turn (...).

    For a torque that is the energy a flywheel has to take up and give back (seed 004, 2-27, E004-17).
    The extremes lie where the value crosses its mean, between two nodes.
    """
    rest = values - mean(turn, values)[..., None]
    shaped = _per_panel(turn, rest)
    half = 0.5 * turn.width
    panel = shaped @ _WEIGHTS * half
    before = np.cumsum(panel, axis=-1) - panel
    running = before[..., None] + (shaped @ _INTEGRATE.T) * half[..., None]
    running = running.reshape(rest.shape)
    angle = turn.angle
    left, right = rest[..., :-1], rest[..., 1:]
    crosses = (left * right < 0.0) & (np.diff(angle, axis=-1) > 0.0)
    to_crossing = np.where(crosses, left / np.where(crosses, left - right, 1.0), 0.0) * np.diff(angle, axis=-1)
    at_crossing = running[..., :-1] + 0.5 * left * to_crossing
    # panel ends count as well: the value may jump across its mean there
    extremes = np.concatenate([running, np.where(crosses, at_crossing, 0.0), before], axis=-1)
    return np.max(extremes, axis=-1) - np.min(extremes, axis=-1)


def _per_panel(turn: Turn, values: Real) -> Real:
    return values.reshape(*turn.width.shape, _NODES)
