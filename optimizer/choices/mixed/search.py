"""The way in: the best set of options beside the best of the other webs, and what is proven of both together."""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.branch import tree_of
from optimizer.choices.discrete.exchange import neighbourhoods, start
from optimizer.choices.discrete.options import EQUAL, Incumbent, Options
from optimizer.choices.discrete.search import TREE
from optimizer.choices.feasible_set import SearchResult
from optimizer.choices.mixed.free_webs import FreeWebs
from optimizer.choices.mixed.incumbent import MixedIncumbent
from optimizer.choices.mixed.tree import MixedWork
from optimizer.choices.semicontinuous.search import SearchGoal
from optimizer.choices.semicontinuous.search import search as search_others
from optimizer.numerics.arrays import Complex
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.statement import Statement

#: rounds of two steps: options beside the other webs as they are, then these webs beside the options
_TURNS = 8
#: neighbourhoods in a row for every slot without a better set, and the share of the time for them
_PATIENCE, _ALTERNATING = 2, 0.3
#: lighter sets that are looked at, and the share of the time for them
_LIGHTER, _LIGHTENING = 200, 0.1


class MixedChoice(NamedTuple):
    """Options on some webs, unbalances of all, and the proof."""

    selection: np.ndarray  # (K,) options
    beside: Complex  # (S,) kg m, of the other webs
    result: SearchResult


def search(
    statement: Statement,
    options: Options,
    free_webs: FreeWebs,
    points: Complex,
    at_least: float,
    goal: SearchGoal,
    below: Statement | None = None,
) -> MixedChoice:
    """The choice with the smallest objective, of equals a light one, and what is proven of all. Where none that keeps
    the ceilings is reached, it is the one closest to them.

    Parameters
    ----------
    statement : one program (no leading axes), the webs of the slots before the others.
    points : (M, W + S) kg m, its optimum of any masses, then earlier choices.
    at_least : lower bound of that optimum.
    below : nowhere above the statement and with no tighter ceilings, which bounds are of; by default that one.
    """
    if not options.slots:
        # nothing but the other webs
        u, alone = search_others(statement, free_webs.least, points[0], at_least, goal, list(points[1:]), below)
        return MixedChoice(np.zeros(0, int), u, alone)
    clock, gap, below = Clock(goal.time_limit_s), goal.gap, below or statement
    incumbent = MixedIncumbent(statement, options, free_webs, EQUAL * goal.yardstick, clock)
    _begin(incumbent, points)
    if incumbent.selection is None:
        # first of all one that keeps the ceilings
        first = _within(statement, options, free_webs, points, clock, below, goal.yardstick)
        if not first.result.feasible:
            return first
        incumbent.offer_beside(first.selection[None], first.beside[None])
        incumbent.offer(first.selection[None])
    _alternate(incumbent, points[0], Clock(_ALTERNATING * goal.time_limit_s), lambda: incumbent.least - at_least <= gap)
    work = MixedWork(options, incumbent, gap, below, goal.yardstick)
    tree = tree_of(work, at_least, lambda bound: False, clock)
    # a tree ends above what was offered; what any masses come to does not, or it contradicts that
    bound = max(at_least, min(tree.lower_bound, incumbent.least))
    closed = incumbent.least - bound <= gap
    result = SearchResult(True, bound, tree.nodes, TREE, ended=None if closed else tree.ended)
    share = min(goal.share, max(bound + gap - incumbent.least, 0.0))
    return _lightened(incumbent, bound + gap, share, Clock(_LIGHTENING * goal.time_limit_s), result)


def _begin(incumbent: MixedIncumbent, points: Complex) -> None:
    """Offer nothing, and the nearest options to points (M, W + S) as they are and partly."""
    start(incumbent, _first_webs(incumbent.options, points[:, : -incumbent.free_webs.least.size]))


def _first_webs(options: Options, u: Complex) -> Complex:
    return u if options.alike is None else options.alike.means(u)


def _within(
    statement: Statement,
    options: Options,
    free_webs: FreeWebs,
    points: Complex,
    clock: Clock,
    below: Statement,
    yardstick: float,
) -> MixedChoice:
    """The first choice that keeps the ceilings, or the proof that there is none."""
    incumbent = MixedIncumbent(statement.excess(), options, free_webs, 0.0, clock)

    def feasible() -> bool:
        return incumbent.least <= CEILING_TOLERANCE

    _begin(incumbent, points[:1])
    _alternate(incumbent, points[0], Clock(_ALTERNATING * clock.left_s), feasible)
    bound, nodes, ended = -np.inf, 0, None
    if not feasible():
        work = MixedWork(options, incumbent, 0.0, below.excess(), 1.0)
        tree = tree_of(work, -np.inf, lambda bound: feasible() or bound > CEILING_TOLERANCE, clock)
        bound, nodes, ended = tree.lower_bound, tree.nodes, tree.ended
    if incumbent.selection is None:
        raise AssertionError("nothing on any slot keeps budget and counts")
    none = not feasible() and min(bound, incumbent.least) > CEILING_TOLERANCE
    ended = None if feasible() or none else ended
    result = SearchResult(feasible(), np.inf if none else -np.inf, nodes, TREE, ended=ended)
    return MixedChoice(incumbent.selection, incumbent.beside, result)


def _alternate(incumbent: MixedIncumbent, relaxed: Complex, clock: Clock, enough: Callable[[], bool]) -> None:
    """Choose options beside what the other webs carry, and these anew beside the options, until nothing is better."""
    options, webs = incumbent.options, relaxed.size - incumbent.free_webs.least.size
    mask = np.arange(relaxed.size) < webs
    about = _first_webs(options, relaxed[:webs])
    alone = replace(options, beside=None)
    for _ in range(_TURNS):
        if enough() or clock.spent() or incumbent.selection is None:
            return
        before = incumbent.least
        there = np.concatenate([np.zeros(webs), incumbent.beside])
        sub = Incumbent(incumbent.statement.about(there).only(mask), alone, incumbent.resolution)
        sub.offer(incumbent.selection[None])
        neighbourhoods(sub, about, _PATIENCE, enough, clock)
        if sub.selection is not None:
            incumbent.offer(sub.selection[None])
        if incumbent.least >= before - incumbent.resolution:
            return


def _lightened(
    incumbent: MixedIncumbent, limit: float, share: float, clock: Clock, result: SearchResult
) -> MixedChoice:
    """The best choice, and as long as one is there a lighter one that differs on one slot, no worse than a limit. Then
    the lightest of the other webs, worse by a share at most."""
    selection, beside, free_webs = incumbent.selection, incumbent.beside, incumbent.free_webs
    assert selection is not None  # there is a choice
    while share > 0.0 and not clock.spent():
        sets = _lighter_sets(incumbent, selection)
        if not len(sets):
            break
        there = free_webs.best(incumbent.programs(sets), np.inf, clock)
        mass = np.where(incumbent.values(sets, there) <= limit, incumbent.masses(sets, there), np.inf)
        n = int(np.argmin(mass))
        if mass[n] >= incumbent.masses(selection[None], beside[None])[0] * (1.0 - EQUAL):
            break
        selection, beside = sets[n], there[n]
    program = incumbent.programs(selection[None]).subset(0)
    return MixedChoice(selection, free_webs.lightened(program, beside, share, clock), result)


def _lighter_sets(incumbent: MixedIncumbent, selection: np.ndarray) -> np.ndarray:
    """Sets (M, K) that differ from one on one slot, whose casting is lighter there, and keep the counts."""
    options = incumbent.options
    sets: list[np.ndarray] = []
    for k in range(options.slots):
        mass = np.where(options.exists[k], options.mass[k], np.inf)
        lighter = np.flatnonzero(mass < mass[selection[k]])
        order = lighter[np.argsort(-mass[lighter], kind="stable")].tolist()
        sets += [np.where(np.arange(options.slots) == k, option, selection) for option in order]
    every = np.array(sets, int).reshape(-1, options.slots)
    return every[options.counts(incumbent.statement, every)][:_LIGHTER] if len(every) else every
