"""The way in: the best set of options, and what is proven of it."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.ample import light_sizes, offer_light_sets
from optimizer.choices.discrete.branch import branch
from optimizer.choices.discrete.exchange import neighbourhoods, start
from optimizer.choices.discrete.few_slots import lightest_near
from optimizer.choices.discrete.halves import exhaust
from optimizer.choices.discrete.options import EQUAL, Incumbent, Options
from optimizer.choices.discrete.quarters import quarters
from optimizer.choices.feasible_set import SearchResult
from optimizer.numerics.arrays import Complex
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.statement import Statement

EXHAUSTED = "exhaustion in halves"
TREE = "branch and bound"
#: sums of a half, and pairs of them, that are searched outright
_SUMS, _PAIRS = 20_000_000, 3_000_000
#: sums of a half where a search near a point of so many coordinates is no faster than a look at all
_FEW_SUMS, _COORDINATES = 10_000, 4
#: share of the time for light sets near the optimum of any masses; where part numbers are few no tree closes soon
_LIGHT, _LIGHT_OF_PARTS = 0.4, 0.7
#: share of the time for lighter sets within the target gap; of few part numbers many sizes are tried
_LIGHTER, _LIGHTER_OF_PARTS = 0.1, 0.3
#: how long neighbourhoods are tried before a tree, and the nodes of that, whose roundings are better sooner
_SEARCHES = ((0, 1), (0, 1_200.0), (6, np.inf))


class Prior(NamedTuple):
    """What a search begins with."""

    sets: Sequence[Complex] = ()  # (W,) kg m each
    below: Statement | None = None  # of few rows in one group and nowhere above the one searched; None is that one


_NOTHING = Prior()


def search(
    statement: Statement,
    options: Options,
    relaxed: Complex,
    at_least: float,
    relative_gap: float,
    yardstick: float,
    time_limit_s: float,
    prior: Prior = _NOTHING,
) -> tuple[np.ndarray, SearchResult]:
    """The set of options (K,) with the smallest objective, of equals the lightest, and what is proven of all.

    Where the search has none that keeps the ceilings, it is the one closest to them. The clock decides the result only
    where the time ends it.

    Parameters
    ----------
    statement : one program (no leading axes), whose limits hold every option.
    relaxed : (W,) kg m, its optimum without options.
    at_least : lower bound of that optimum.
    relative_gap : target gap, in units of the yardstick; one of EQUAL or less compares all equals as well.
    prior : sets to begin with, and what a tree is of.
    """
    clock, half = Clock(time_limit_s), Clock(0.5 * time_limit_s)

    points, below = np.stack([relaxed, *prior.sets]), prior.below or statement
    if options.alike is not None:
        points = options.alike.means(points)
    relaxed, resolution = points[0], EQUAL * yardstick
    incumbent = Incumbent(statement, options, resolution)
    start(incumbent, points)
    every = [np.flatnonzero(row) for row in options.exists]
    if incumbent.selection is None:
        # first of all a set that keeps the ceilings
        selection, result = _within(statement, options, relaxed, every, clock, below)
        if not result.feasible:
            return selection, result
        incumbent.offer(selection[None])
    if exhaust(options, every, incumbent, _most_sums(incumbent), _PAIRS, clock):
        return _selection(incumbent), SearchResult(True, max(at_least, incumbent.least), 0, EXHAUSTED, True)
    gap = relative_gap * yardstick if relative_gap > EQUAL else -resolution
    nodes, floor = 0, at_least

    def enough() -> bool:
        return incumbent.least - at_least <= gap

    light: Clock | None = None
    # over the turn and where all equals count nothing is made lighter
    sizes = light_sizes(statement, options, relaxed) if prior.below is None and gap > 0 else None
    for patience, most_nodes in _SEARCHES:
        neighbourhoods(incumbent, relaxed, patience, enough, half)
        tree = branch(options, incumbent, at_least, gap, lambda bound: False, clock, most_nodes, below)
        nodes, at_least = nodes + tree.nodes, max(at_least, tree.lower_bound)
        # the options reach what no masses undercut, and no tree tells more
        ample = tree.nodes == 1 and tree.lower_bound <= floor + gap
        if light is None and (ample or options.limits_parts or most_nodes > 1):
            light = Clock((_LIGHT_OF_PARTS if options.limits_parts else _LIGHT) * time_limit_s)
            offer_light_sets(incumbent, below, relaxed, enough, light, sizes, at_least + gap)
        if ample:
            quarters(incumbent, enough, half)
        # a tree ends above what was offered; what any masses come to does not, or it contradicts that
        bound = max(floor, min(at_least, incumbent.least))
        closed = incumbent.least - bound <= max(gap, 0.0)
        if closed or clock.spent():
            break
    result = SearchResult(True, bound, nodes, TREE, closed and gap < 0, None if closed else tree.ended)
    if closed and gap > 0 and prior.below is None:
        # all within the target gap are as good, and a lighter one is cheaper
        share = _LIGHTER_OF_PARTS if options.limits_parts else _LIGHTER
        light = Clock(min(clock.left_s, share * time_limit_s))
        return lightest_near(incumbent, _selection(incumbent), (bound, bound + gap), light, sizes), result
    return _selection(incumbent), result


def _most_sums(incumbent: Incumbent) -> int:
    return _SUMS if incumbent.coordinates[0].shape[-1] < _COORDINATES else min(_SUMS, _FEW_SUMS)


def _selection(incumbent: Incumbent) -> np.ndarray:
    if incumbent.selection is None:
        raise AssertionError("nothing on any slot keeps budget and counts")
    return incumbent.selection


def _within(
    statement: Statement,
    options: Options,
    relaxed: Complex,
    every: list[np.ndarray],
    clock: Clock,
    below: Statement,
) -> tuple[np.ndarray, SearchResult]:
    """The first set (K,) that keeps the ceilings, or the proof that there is none."""
    incumbent = Incumbent(statement.excess(), options, 0.0)

    def feasible() -> bool:
        return incumbent.least <= CEILING_TOLERANCE

    start(incumbent, relaxed[None])
    neighbourhoods(incumbent, relaxed, _SEARCHES[-1][0], feasible, clock)
    bound, nodes, method, ended = -np.inf, 0, EXHAUSTED, None
    if not feasible():
        if exhaust(options, every, incumbent, _most_sums(incumbent), _PAIRS, clock):
            bound = incumbent.least
        else:
            tree = branch(
                options,
                incumbent,
                -np.inf,
                0.0,
                lambda bound: feasible() or bound > CEILING_TOLERANCE,
                clock,
                below=below.excess(),
            )
            bound, nodes, method = tree.lower_bound, tree.nodes, TREE
            ended = tree.ended
    if not feasible() and min(bound, incumbent.least) > CEILING_TOLERANCE:
        return _selection(incumbent), SearchResult(False, np.inf, nodes, method)
    return _selection(incumbent), SearchResult(feasible(), -np.inf, nodes, method, False, ended)
