"""The way in: the best counterweights that are heavy enough or not there, and what is proven of them."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from optimizer.choices.branch_and_bound import Tree
from optimizer.choices.clock import Clock
from optimizer.choices.discrete.search import TREE
from optimizer.choices.feasible_set import SearchResult
from optimizer.choices.semicontinuous.inside import BestPoint, lightened, sharing
from optimizer.choices.semicontinuous.places import Places, root
from optimizer.choices.semicontinuous.tree import branch
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.statement import Statement

#: objectives nearer than this share of the yardstick are equal
_EQUAL = 1e-9


class SearchGoal(NamedTuple):
    """What a search is to reach, in units of the objective."""

    gap: float
    yardstick: float
    share: float  # by which the objective of the lightest may be above that of the best
    time_limit_s: float


def search(
    statement: Statement,
    least: Real,
    continuous: Complex,
    at_least: float,
    goal: SearchGoal,
    points: Sequence[Complex] = (),
    below: Statement | None = None,
) -> tuple[Complex, SearchResult]:
    """The counterweights (K,) kg m with the smallest objective, of those with the same webs the lightest; what is
    proven of all. If none keep the ceilings, those closest to them.

    Parameters
    ----------
    statement : one program (no leading axes), with finite limits.
    least : (K,) kg m, the least unbalance that is fitted on every web; 0 where there is none.
    continuous : (K,) kg m, its optimum whatever the least.
    at_least : lower bound of that optimum.
    points : (K,) kg m each, points to begin with.
    below : nowhere above the statement and with no tighter ceilings, which bounds are of; by default that one.
    """
    clock, gap = Clock(goal.time_limit_s), goal.gap

    places = root(least, statement.limits)
    incumbent = BestPoint(statement, places, _EQUAL * goal.yardstick)
    # nothing on any web keeps every limit but ceilings
    incumbent.offer(np.zeros((1, least.size), complex))
    sharing(incumbent, continuous, clock)
    if points:
        incumbent.offer(np.stack(points))
    first = incumbent.unbalance
    if first is None:
        first, result = _within(statement, places, continuous, clock, below or statement)
        if not result.feasible:
            return first, result
        incumbent.offer(first[None])
    tree = branch(incumbent, at_least, gap, lambda bound: False, clock, below or statement)
    # a tree ends above what was offered; what any masses come to does not, or it contradicts that
    bound = max(at_least, min(tree.lower_bound, incumbent.least))
    share = min(goal.share, max(bound + gap - incumbent.least, 0.0))
    best = first if incumbent.unbalance is None else incumbent.unbalance
    lightest = lightened(incumbent, best, share, clock)
    closed = incumbent.least - bound <= gap
    return lightest, SearchResult(True, bound, tree.nodes, TREE, ended=None if closed else tree.ended)


def _within(
    statement: Statement,
    places: Places,
    continuous: Complex,
    clock: Clock,
    below: Statement,
) -> tuple[Complex, SearchResult]:
    """The first counterweights (K,) kg m that keep the ceilings, or the proof that there are none."""
    incumbent = BestPoint(statement.excess(), places, 0.0)

    def feasible() -> bool:
        return incumbent.least <= CEILING_TOLERANCE

    sharing(incumbent, continuous, clock)
    tree = Tree(-np.inf, 0, False, False)
    if not feasible():
        loose = below.excess()
        tree = branch(incumbent, -np.inf, 0.0, lambda bound: feasible() or bound > CEILING_TOLERANCE, clock, loose)
    u = np.zeros(places.least.shape, complex) if incumbent.unbalance is None else incumbent.unbalance
    none = min(tree.lower_bound, incumbent.least) > CEILING_TOLERANCE
    ended = None if feasible() or none else tree.ended
    return u, SearchResult(feasible(), np.inf if none else -np.inf, tree.nodes, TREE, ended=ended)
