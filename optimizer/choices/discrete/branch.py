"""Branch and bound: nodes are what is left of the options; the batch kernel finds the multipliers of their bounds.

A node is first bounded by the multipliers of its parent, raised a little. What that does not close is
relaxed to discs, segments and sectors about its options, which the kernel takes as limits (``relaxed.py``). Whatever it
returns, multipliers prove (``bound.py``), and options by which the bound rises to the incumbent are left out.
"""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from optimizer.choices.branch_and_bound import Termination, Tree, branch_and_bound
from optimizer.choices.clock import Clock
from optimizer.choices.discrete.bound import proven, uphill
from optimizer.choices.discrete.few import at_most, costs, offer_few
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.choices.discrete.relaxed import apart, on_first, relaxed
from optimizer.choices.relaxations import solved
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers
from optimizer.program.methods.compiled import stage_solutions, suits_kernel
from optimizer.program.statement import Statement

#: nodes bounded at once, and options of all of them together
_BATCH, _BATCH_OPTIONS = 128, 2_000_000
#: sets up to which what is left of a node is looked at set by set
_SETS = 20_000
#: bytes that open nodes may hold
_MEMORY = 200_000_000


class Node(NamedTuple):
    """Options left (K, O), packed into bits; the part numbers that count as used; what its parent was bounded by."""

    bits: np.ndarray
    parts: frozenset[int]
    multipliers: Multipliers | None = None


class Split(NamedTuple):
    """A node that stays open, and how it is split."""

    node: Node
    first: np.ndarray  # (K, O) packed: what the first child keeps
    part: int = -1  # part number that the first child goes without and that counts as used in the second one


def branch(
    options: Options,
    incumbent: Incumbent,
    at_least: float,
    gap: float,
    enough: Callable[[float], bool],
    clock: Clock,
    most_nodes: float = np.inf,
    below: Statement | None = None,
) -> Tree:
    """Offer sets until no other is better by more than ``gap``, time or memory are spent, or a bound is enough.

    Parameters
    ----------
    at_least : lower bound of the objective.
    gap : in units of the objective, 0 to tell all but equals apart.
    enough : whether a bound of all sets that were not offered ends the search.
    clock : what is left of the time.
    most_nodes : after which it ends as well.
    below : a program of one group that is nowhere above the incumbent's, which bounds are of; by default that one.
    """
    return tree_of(Work(options, incumbent, gap, below or incumbent.statement), at_least, enough, clock, most_nodes)


def tree_of(
    work: "Work", at_least: float, enough: Callable[[float], bool], clock: Clock, most_nodes: float = np.inf
) -> Tree:
    """The same, of what is done with its nodes."""
    options, incumbent = work.options, work.incumbent
    root = work.propagation(options.exists, frozenset())
    if root is None:
        return Tree(np.inf, 0, False, True)
    size = max(1, min(_BATCH, _BATCH_OPTIONS // max(options.exists.size, 1)))

    def bounded(nodes: list[Node], bounds: list[float]) -> tuple[float, list[tuple[float, Split]]]:
        parts = [work.bounded(nodes[n : n + size], bounds[n : n + size], clock) for n in range(0, len(nodes), size)]
        return min(closed for closed, _ in parts), [split for _, splits in parts for split in splits]

    ends = Termination(lambda: incumbent.least - work.gap, enough, _MEMORY / max(2 * root.bits.size, 1), most_nodes)
    return branch_and_bound(root, at_least, bounded, work.children, ends, clock, size)


@record(frozen=True)
class Work:
    """What is done with the nodes of a tree."""

    options: Options
    incumbent: Incumbent
    gap: float  # in units of the objective
    statement: Statement  # of which bounds are

    @cached_property
    def apart(self) -> tuple[Statement, Options, np.ndarray]:
        """What the kernel takes."""
        return apart(self.statement, self.options)

    @property
    def is_coupled(self) -> bool:
        """Whether counts or the budget couple what the slots may take."""
        options = self.options
        budget = np.isfinite(self.incumbent.statement.limits.max_total_mass)
        return bool(budget or options.limits_fitted or options.limits_parts)

    def propagation(self, left: np.ndarray, parts: frozenset[int]) -> Node | None:
        """A node with all that counts and budget rule out taken away (K, O); None where nothing is left."""
        options, left = self.options, left.copy()
        budget = options.budget(self.incumbent.statement)
        slots = np.arange(options.slots)
        while True:
            before = int(np.sum(left))
            if not np.all(np.any(left, axis=-1)):
                return None
            if np.isfinite(budget):
                least = np.min(np.where(left, options.mass, np.inf), axis=-1)
                left &= options.mass <= (budget * (1.0 + 1e-12) - (np.sum(least) - least))[:, None]
            fitted = ~left[:, 0]
            if options.limits_fitted:
                room = (options.most_fitted or 0) - int(np.sum(options.webs[fitted]))
                if room < 0:
                    return None
                left[np.ix_(slots[~fitted & (options.webs > room)], np.arange(1, left.shape[1]))] = False
            if options.limits_parts:
                lone = (np.min(np.where(left, options.part, np.inf), axis=-1)) == np.max(
                    np.where(left, options.part, -1), axis=-1
                )
                parts = parts | {int(options.part[k][left[k]][0]) for k in slots[fitted & lone]}
                if len(parts) > (options.most_parts or 0):
                    return None
                if len(parts) == options.most_parts:
                    left &= (options.part < 0) | np.isin(options.part, list(parts))
            if int(np.sum(left)) == before:
                return Node(np.packbits(left, axis=-1), parts)

    def left(self, bits: np.ndarray) -> np.ndarray:
        """Options (..., K, O) of bits."""
        return np.unpackbits(bits, axis=-1, count=self.options.mass.shape[1]).astype(bool)

    def bounded(
        self, nodes: list[Node], inherited: list[float], clock: Clock
    ) -> tuple[float, list[tuple[float, Split]]]:
        """What is proven of all that nodes lose here, and those that stay open with their bounds."""
        options, statement = self.options, self.statement
        left, bound, closed = self.left(np.array([node.bits for node in nodes])), np.array(inherited), np.inf
        rows = np.arange(len(nodes))

        def pruning(left: np.ndarray, multipliers: Multipliers) -> tuple[np.ndarray, np.ndarray, Real]:
            """Nodes of ``rows`` that stay open, what is left of all, and what is proven of each option."""
            nonlocal closed
            proof, target = proven(statement, options, left, multipliers), self.incumbent.least - self.gap
            bound[rows] = np.maximum(bound[rows], proof.bound)
            out = left & (np.maximum(proof.forced, bound[rows][:, None, None]) >= target)
            if np.any(out):
                closed = min(closed, float(np.min(np.maximum(proof.forced, bound[rows][:, None, None])[out])))
            left = left & ~out
            stays = np.all(np.any(left, axis=-1), axis=-1)
            return stays, left, proof.forced

        if nodes[0].multipliers is not None:
            multipliers = _side_by_side([node.multipliers for node in nodes if node.multipliers is not None])
            multipliers = self._raised(left, multipliers)
            stays, left, _ = pruning(left, multipliers)
            rows, left = rows[stays], left[stays]
        if not rows.size:
            return closed, []
        near, multipliers, nowhere = self.relaxation(left, clock)
        bound[rows[nowhere]] = np.inf
        self.incumbent.offer(np.argmin(np.where(left, np.abs(options.unbalance - near[..., None]), np.inf), axis=-1))
        multipliers = self._raised(left, multipliers)
        stays, left, forced = pruning(left, multipliers)
        rows, left, near, multipliers = rows[stays], left[stays], near[stays], multipliers.subset(stays)
        few, lowest = self.enumeration(left, forced[stays], bound[rows], clock)
        closed = min(closed, lowest)
        return closed, self._splits(nodes, rows[~few], bound, left[~few], near[~few], multipliers.subset(~few))

    def relaxation(self, left: np.ndarray, clock: Clock) -> tuple[Complex, Multipliers, np.ndarray]:
        """Optima of nodes (N, K, O) within discs, segments and sectors. They are unbalances of first webs (N, K) kg m,
        the multipliers of their bounds, and whether it is proven that nothing keeps their ceilings (N,)."""
        whole, parts_of, slot = self.apart
        base, program = relaxed(whole, parts_of, left[:, slot])
        count = len(left)
        if not suits_kernel(program):
            # over a revolution the shafts that turn faster are at other angles than the crankshaft
            near, multipliers, nowhere = solved(program, None, np.full(count, 1e-9), np.zeros(count), False, clock)
            return on_first(self.options, base + near), multipliers, nowhere
        relaxation = stage_solutions(program, np.full(count, 1e-9), np.zeros(count), False)
        near = on_first(self.options, np.nan_to_num(base + relaxation.smallest))
        return near, relaxation.multipliers, np.zeros(count, bool)

    def enumeration(self, left: np.ndarray, forced: Real, bound: Real, clock: Clock) -> tuple[np.ndarray, float]:
        """Nodes (N,) of so few sets that all of these are looked at, and what all that are not offered come to.

        Parameters
        ----------
        forced : (N, K, O) what is proven of all sets with an option.
        bound : (N,) of all sets of a node.
        """
        incumbent, closed = self.incumbent, np.inf
        lowest, cost = costs(left, forced)
        few = at_most(cost, incumbent.least - self.gap - lowest) <= _SETS
        for n in np.flatnonzero(few):
            if clock.spent():
                closed = min(closed, float(bound[n]))
                continue
            rest = offer_few(self.statement, incumbent, cost[n], incumbent.least - self.gap - float(lowest[n]))
            closed = min(closed, float(lowest[n]) + rest)
        return few, closed

    def _raised(self, left: np.ndarray, multipliers: Multipliers) -> Multipliers:
        statement, options = self.statement, self.options
        price = proven(statement, options, left, multipliers).price if self.is_coupled else np.zeros(left.shape[0])
        return uphill(statement, options, left, multipliers, price, self.incumbent.least - self.gap)

    def _splits(
        self,
        nodes: list[Node],
        rows: np.ndarray,
        bound: Real,
        left: np.ndarray,
        near: Complex,
        multipliers: Multipliers,
    ) -> list[tuple[float, Split]]:
        """Open nodes with what their first children keep.

        Parameters
        ----------
        left, near : (M, K, O) and (M, K) kg m, what is left of those, and their relaxed unbalances.
        """
        if not rows.size:
            return []
        off = np.where(left, np.abs(self.options.unbalance - near[..., None]), np.inf)
        first, bits = np.packbits(self._first(left, near, off), axis=-1), np.packbits(left, axis=-1)
        splits = []
        for n, node in enumerate(rows.tolist()):
            own = Node(bits[n], nodes[node].parts, multipliers.subset(n))
            by_part = self._by_part(own, left[n], off[n]) if self.options.limits_parts else None
            splits.append((float(bound[node]), by_part or Split(own, first[n])))
        return splits

    def _by_part(self, node: Node, left: np.ndarray, off: Real) -> Split | None:
        """Split by whether a part number is used, where not all that are left may be."""
        options = self.options
        free = set(np.unique(options.part[left]).tolist()) - node.parts - {-1}
        if len(free) + len(node.parts) <= (options.most_parts or 0):
            return None
        # the one that most of the relaxed unbalances are nearest to
        nearest = options.of(options.part, np.argmin(off, axis=-1))
        part = max(sorted(free), key=lambda number: int(np.sum(nearest == number)))
        return Split(node, np.packbits(left & (options.part != part), axis=-1), part)

    def _first(self, left: np.ndarray, near: Complex, off: Real) -> np.ndarray:
        """What the first children keep (M, K, O): of one slot the options up to the relaxed unbalance."""
        options, statement = self.options, self.statement
        norms, ceilings = statement.norms, statement.ceilings.norms
        does = np.sum(np.abs(norms.influence), axis=-2)
        does = does + np.sum(np.abs(ceilings.influence) / statement.ceilings.size[:, None], axis=-2)
        if options.beside is not None:
            does = does[..., : -options.beside.most.size]
        does = options.together(does)
        # where the nearest option does most harm; where none does any, the slot with most room
        several, room = np.sum(left, axis=-1) > 1, np.max(np.where(left, off, 0.0), axis=-1)
        k = np.argmax(np.where(several, (np.min(off, axis=-1) + 1e-6 * room) * does, -1.0), axis=-1)
        node = np.arange(k.size)
        mask, at = left[node, k], options.unbalance[k]
        mean = np.sum(np.where(mask, at, 0.0), axis=-1) / np.sum(mask, axis=-1)
        about = np.where(mask, at - mean[:, None], 0.0)
        # along the longest axis of what is left
        axis = np.exp(-0.5j * np.angle(np.sum(about**2, axis=-1)))
        along = (about * axis[:, None]).real
        here = ((near[node, k] - mean) * axis).real
        low = np.min(np.where(mask, along, np.inf), axis=-1)
        high = np.max(np.where(mask, along, -np.inf), axis=-1)
        here = np.where((low <= here) & (here < high), here, 0.5 * (low + high))
        first = mask & (along <= here[:, None])
        count = np.sum(first, axis=-1)
        level = (count == 0) | (count == np.sum(mask, axis=-1))
        half = mask & (np.cumsum(mask, axis=-1) <= np.sum(mask, axis=-1, keepdims=True) // 2)
        remainder = left.copy()
        remainder[node, k] = np.where(level[:, None], half, first)
        return remainder

    def children(self, split: Split) -> Iterator[Node]:
        """The two halves of a node, as far as anything is left in them."""
        node, part = split.node, split.part
        rest = node.bits & ~split.first
        changed = np.any(rest, axis=-1, keepdims=True)
        second = node.bits if part >= 0 else np.where(changed, rest, node.bits)
        for bits, parts in ((split.first, node.parts), (second, node.parts | {part} if part >= 0 else node.parts)):
            child = self.propagation(self.left(bits), parts) if self.is_coupled else Node(bits, parts)
            if child is not None:
                yield child._replace(multipliers=node.multipliers)


def _side_by_side(proofs: list[Multipliers]) -> Multipliers:
    return Multipliers(
        np.array([proof.term for proof in proofs]),
        np.array([proof.row for proof in proofs]),
        np.array([proof.ceiling for proof in proofs]),
    )
