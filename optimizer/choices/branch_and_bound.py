"""Branch and bound: what is open is divided, the lowest bound first, until nothing can be better by more than a gap."""

import heapq
from collections.abc import Callable, Iterable
from typing import NamedTuple, TypeVar

import numpy as np

from optimizer.choices.clock import Clock, Pace

Node = TypeVar("Node")
Open = TypeVar("Open")


class Tree(NamedTuple):
    """What a tree has proven."""

    lower_bound: float  # of all that was not offered, inf where there is nothing, -inf where nothing is proven
    nodes: int
    full: bool  # it ended because it had grown too large
    is_complete: bool  # nothing was left to divide

    @property
    def ended(self) -> str:
        """Why it has left a gap."""
        return "size" if self.full else "rounding" if self.is_complete else "time"


class Termination(NamedTuple):
    """What ends a tree, beside the time."""

    target: Callable[[], float]  # only a smaller bound is worth a look
    enough: Callable[[float], bool]  # whether a bound of all that was not offered suffices
    most_open: float  # nodes that may be open
    most_nodes: float = np.inf  # nodes that are bounded


def branch_and_bound(
    root: Node,
    at_least: float,
    bounded: Callable[[list[Node], list[float]], tuple[float, Iterable[tuple[float, Open]]]],
    children: Callable[[Open], Iterable[Node]],
    ends: Termination,
    clock: Clock,
    at_once: int,
) -> Tree:
    """Divide until no bound is below the target, time or memory are spent, or a bound is enough.

    Parameters
    ----------
    at_least : lower bound of the objective.
    bounded : nodes and the bounds that they inherit -> what is proven of all that they lose, and what stays open of
        them, with its bound.
    children : what is open -> the nodes that it is divided into.
    clock : what is left of the time.
    at_once : about so many nodes are bounded together.
    """
    target, enough, most_open, most_nodes = ends
    fresh, bounds, nodes, ties, closed, pace = [root], [at_least], 0, 0, np.inf, Pace(clock)
    heap: list[tuple[float, int, Open]] = []
    while True:
        if fresh:
            nodes += len(fresh)
            out, stays = bounded(fresh, bounds)
            closed = min(closed, out)
            for bound, node in stays:
                ties += 1
                heapq.heappush(heap, (bound, ties, node))
            pace.took(len(fresh))
        lowest = min(closed, heap[0][0] if heap else np.inf)
        full = len(heap) > most_open
        is_complete = not heap or lowest >= target()
        if is_complete or full or enough(lowest) or nodes >= most_nodes or clock.spent():
            return Tree(lowest, nodes, full and not is_complete, is_complete)
        fresh, bounds, most = [], [], pace.most(at_once)
        while heap and len(fresh) < most:
            bound, _, node = heapq.heappop(heap)
            if bound >= target():
                closed = min(closed, bound)
                continue
            fresh += children(node)
            bounds += [bound] * (len(fresh) - len(bounds))
