"""The way in: the best set of options, and what is proven of it."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from optimizer.arrays import Complex
from optimizer.discrete.branch import branch
from optimizer.discrete.exchange import neighbourhoods, start
from optimizer.discrete.halves import exhaust
from optimizer.discrete.options import EQUAL, Incumbent, Options
from optimizer.discrete.quarters import quarters
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.statement import Statement

EXHAUSTED = "exhaustion in halves"
TREE = "branch and bound"
#: sums of a half, and pairs of them, that are searched outright
_SUMS, _PAIRS = 300_000, 3_000_000
#: how long neighbourhoods are tried before a tree, and the nodes of that: what it does not close is searched better
_SEARCHES = ((1, 1), (0, 1_200.0), (6, np.inf))


@dataclass(frozen=True)
class Found:
    """The best set that was found."""

    chosen: np.ndarray  # (K,), the set; where none that keeps the ceilings was found, the one closest to them
    kept: bool  # whether it keeps the ceilings
    lower_bound: float  # of every set within the limits; inf where it is proven that none is
    nodes: int  # of the tree
    method: str
    proven: bool  # all equals were compared as well
    ended: str | None = None  # "time" or "size" where that ended the search before the asked gap


def search(
    statement: Statement,
    options: Options,
    relaxed: Complex,
    at_least: float,
    relative_gap: float,
    yardstick: float,
    time_limit_s: float,
) -> Found:
    """The set of options with the smallest objective; of equals the lightest.

    What is found depends on the clock only where the time ends it.

    Parameters
    ----------
    statement : one program (no leading axes), whose limits hold every option.
    relaxed : (W,) kg m, its optimum without options.
    at_least : lower bound of that optimum.
    relative_gap : asked gap, in units of the yardstick; one of EQUAL or less compares all equals as well.
    """
    began = time.monotonic()

    def spent() -> bool:
        return time.monotonic() >= began + time_limit_s

    def halfway() -> bool:
        return time.monotonic() >= began + 0.5 * time_limit_s

    if options.alike is not None:
        relaxed = options.alike.means(relaxed)
    resolution = EQUAL * yardstick
    incumbent = Incumbent(statement, options, resolution)
    start(incumbent, relaxed[None])
    every = [np.flatnonzero(some) for some in options.exists]
    if incumbent.chosen is None:
        # first of all a set that keeps the ceilings
        within = _within(statement, options, relaxed, every, spent)
        if not within.kept:
            return within
        incumbent.offer(within.chosen[None])
    if exhaust(options, every, incumbent, _SUMS, _PAIRS, spent):
        return _found(incumbent, incumbent.least, 0, EXHAUSTED, True)
    gap = relative_gap * yardstick if relative_gap > EQUAL else -resolution
    nodes, floor = 0, at_least

    def enough() -> bool:
        return incumbent.least - at_least <= gap

    for patience, most_nodes in _SEARCHES:
        neighbourhoods(incumbent, relaxed, patience, enough, halfway)
        tree = branch(options, incumbent, at_least, gap, lambda bound: False, spent, most_nodes)
        nodes, at_least = nodes + tree.nodes, max(at_least, tree.lower_bound)
        if tree.nodes == 1 and tree.lower_bound <= floor + gap:
            # the options reach what no masses undercut, and no tree tells more
            quarters(incumbent, enough, halfway)
        bound = min(at_least, incumbent.least)
        closed = incumbent.least - bound <= max(gap, 0.0)
        if closed or spent():
            break
    ended = None if closed else "size" if tree.full else "time"
    return _found(incumbent, bound, nodes, TREE, closed and gap < 0, ended)


def _found(
    incumbent: Incumbent, bound: float, nodes: int, method: str, proven: bool, ended: str | None = None
) -> Found:
    if incumbent.chosen is None:
        raise AssertionError("nothing on any slot keeps budget and counts")
    return Found(incumbent.chosen, True, bound, nodes, method, proven, ended)


def _within(
    statement: Statement,
    options: Options,
    relaxed: Complex,
    every: list[np.ndarray],
    spent: Callable[[], bool],
) -> Found:
    """The first set that keeps the ceilings, or the proof that there is none."""
    incumbent = Incumbent(statement.excess(), options, 0.0)

    def kept() -> bool:
        return incumbent.least <= CEILING_TOLERANCE

    start(incumbent, relaxed[None])
    neighbourhoods(incumbent, relaxed, _SEARCHES[-1][0], kept, spent)
    bound, nodes, method, ended = -np.inf, 0, EXHAUSTED, None
    if not kept():
        if exhaust(options, every, incumbent, _SUMS, _PAIRS, spent):
            bound = incumbent.least
        else:
            tree = branch(options, incumbent, -np.inf, 0.0, lambda bound: kept() or bound > CEILING_TOLERANCE, spent)
            bound, nodes, method = tree.lower_bound, tree.nodes, TREE
            ended = "size" if tree.full else "time"
    found = _found(incumbent, -np.inf, nodes, method, False, ended)
    if kept():
        return found
    if min(bound, incumbent.least) > CEILING_TOLERANCE:
        return replace(found, kept=False, lower_bound=np.inf, ended=None)
    return replace(found, kept=False)
