"""Integrals over one turn, or over two where gas takes so long, that do not depend on how the outputs are sampled.

Forces jump or have kinks where valves open and rows reverse, and at the entries of tables. Between those angles they
are smooth, so Gauss-Legendre panels between them converge fast; the end point of the turn is not counted twice.
"""

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from optimizer.numerics.arrays import Real, spread
from optimizer.numerics.records import record

#: nodes of a panel, by the number of panels up to which they serve: many breaks make narrow panels, which need fewer
_NODES = ((500, 12), (1500, 8))
_FEWEST_NODES = 6
_NEWTON_STEPS = 5


class _Rule(NamedTuple):
    """Gauss-Legendre quadrature on [-1, 1] with n nodes, and the interpolant between them."""

    abscissae: Real  # (n,)
    weights: Real  # (n,)
    to_legendre: Real  # (n, n) from values at the nodes to Legendre coefficients
    at_ends: Real  # (2, n) from values at the nodes to those at -1 and 1


@cache
def _rule(nodes: int) -> _Rule:
    abscissae, weights = legendre.leggauss(nodes)
    vander = legendre.legvander(abscissae, nodes - 1)
    to_legendre = (np.arange(nodes) + 0.5)[:, None] * vander.T * weights
    at_ends = legendre.legvander(np.array([-1.0, 1.0]), nodes - 1) @ to_legendre
    return _Rule(abscissae, weights, to_legendre, at_ends)


@record(frozen=True)
class Turn:
    """Panels over all turns. P panels with Gauss nodes each."""

    start: Real  # (..., P) rad
    width: Real  # (..., P) rad; 0 where two break angles coincide
    turns: int = 1  # of the shaft, after which all repeats

    @property
    def rule(self) -> _Rule:
        count = self.width.shape[-1]
        return _rule(next((nodes for most, nodes in _NODES if count <= most), _FEWEST_NODES))

    @property
    def angle(self) -> Real:
        """Nodes in rising order, (..., P * nodes) rad."""
        inside = 0.5 * (self.rule.abscissae + 1.0)
        nodes = self.start[..., None] + self.width[..., None] * inside
        return nodes.reshape(*nodes.shape[:-2], -1)

    @property
    def middle(self) -> Real:
        """Middle of the panel of every node, (..., P * nodes) rad."""
        return np.repeat(self.start + 0.5 * self.width, self.rule.weights.size, axis=-1)


@cache
def _grid(turns: int, widest: float) -> Real:
    """Equal steps over so many turns, rad; nobody writes to them."""
    period = 2.0 * np.pi * turns
    return np.linspace(0.0, period, int(np.ceil(period / widest)) + 1)


def panels(breaks: Real, widest: float, halved: bool = False, turns: int = 1) -> Turn:
    """Panels between break angles, cut at a regular grid as well; their number grows with that of the breaks.

    Parameters
    ----------
    breaks : (..., B) rad, any order; taken modulo all turns, nan counts as none.
    widest : rad, step of the grid.
    halved : every panel cut in two, for an estimate of the error.
    turns : of the shaft, after which all repeats.
    """
    period = 2.0 * np.pi * turns
    inner = np.mod(np.where(np.isnan(breaks), 0.0, breaks), period)
    grid = _grid(turns, widest)
    edges = np.concatenate([inner, spread(grid, (*inner.shape[:-1], grid.size))], axis=-1)
    edges.sort(axis=-1)
    width = edges[..., 1:] - edges[..., :-1]
    if not halved:
        return Turn(edges[..., :-1], width, turns)
    half = np.repeat(0.5 * width, 2, axis=-1)
    start = np.repeat(edges[..., :-1], 2, axis=-1)
    start[..., 1::2] += half[..., 1::2]
    return Turn(start, half, turns)


def mean(turn: Turn, values: Real) -> Real:
    """Mean over all turns of values at the nodes (...)."""
    integrals = _per_panel(turn, values) @ turn.rule.weights * (0.5 * turn.width)
    # one after the other: panels without width, which a neighbour brings, change no bit
    whole: Real = np.cumsum(integrals, axis=-1)[..., -1]
    return whole / (2.0 * np.pi * turn.turns)


def fluctuation(turn: Turn, values: Real) -> Real:
    """Range of the running integral of values - mean over all turns (...).

    For a torque that is the energy a flywheel has to take up and give back (design calculation of the
    2D12, 2-27, whose areas do not close).
    The extremes lie at the ends of panels and where the value crosses its mean: roots of its interpolant, where the
    running integral of the interpolant is taken.
    """
    rest = _per_panel(turn, values - mean(turn, values)[..., None])
    # every panel by itself, from end to end: the value may jump from one to the next
    first, last = np.split(rest @ turn.rule.at_ends.T, 2, axis=-1)
    value = np.concatenate([first, rest, last], axis=-1)
    whole = rest @ turn.rule.weights * (0.5 * turn.width)
    # summed in the order of the panels, so that neighbours agree on the end that they share
    end = np.cumsum(whole, axis=-1)
    crossing = np.nonzero(value[..., :-1] * value[..., 1:] < 0.0)
    panel, interval = crossing[:-1], crossing[-1]
    inner = np.zeros(value[..., :-1].shape)
    inner[crossing] = _to_crossing(turn.rule, rest[panel], interval) * (0.5 * turn.width[panel])
    extremes = (end - whole)[..., None] + inner
    high = np.maximum(np.max(extremes, axis=(-2, -1)), np.max(end, axis=-1))
    return high - np.minimum(np.min(extremes, axis=(-2, -1)), np.min(end, axis=-1))


def _to_crossing(rule: _Rule, values: Real, interval: NDArray[np.intp]) -> Real:
    """Integral over [-1, root] of the interpolants of values (m, nodes), each with a root in an interval (m,).

    Newton's method inside the interval. Where it stops short of the root the integral is off by the square of that.
    """
    coefficients = rule.to_legendre @ values.T
    places = np.concatenate([[-1.0], rule.abscissae, [1.0]])
    slopes = legendre.legder(coefficients)
    low, high = places[interval], places[interval + 1]
    at_low, at_high = (legendre.legval(place, coefficients, tensor=False) for place in (low, high))
    root = np.clip(low + (high - low) * at_low / _nonzero(at_low - at_high), low, high)
    for _ in range(_NEWTON_STEPS):
        step = legendre.legval(root, coefficients, tensor=False) / _nonzero(legendre.legval(root, slopes, tensor=False))
        root = np.clip(root - step, low, high)
    return np.asarray(legendre.legval(root, legendre.legint(coefficients, lbnd=-1), tensor=False), dtype=float)


def _nonzero(value: Real) -> Real:
    return np.where(value == 0.0, 1.0, value)


def _per_panel(turn: Turn, values: Real) -> Real:
    return values.reshape(*turn.width.shape, turn.rule.weights.size)
