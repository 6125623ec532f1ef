"""Branch and bound: nodes are what is left of the options; the batch kernel finds the multipliers of their bounds.

A node is relaxed to discs, segments and sectors about its options, which the kernel takes as limits. Whatever it
returns, multipliers prove: P >= constant + sum_k min over the options left of Re(conj(slope_k) u), with prices for the
budget and for the number of counterweights (docs/mathematics.md section 16).
"""

import heapq
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.discrete.halves import exhaust
from optimizer.discrete.options import Incumbent, Options
from optimizer.program.certificate import Multipliers, affine_minorant
from optimizer.program.compiled import both_stages
from optimizer.program.limits import Limits
from optimizer.program.statement import Norms, Statement

#: nodes bounded at once, and options of all of them together
_BATCH, _BATCH_OPTIONS = 128, 2_000_000
#: sums of a half, and pairs, up to which what is left of a node is exhausted in halves
_SUMS, _PAIRS = 100, 10_000
#: bytes that open nodes may hold
_MEMORY = 200_000_000
#: steps in which the price of the budget is halved in on
_HALVINGS = 24
#: share of its size that a relaxed slot without room is given, which the kernel needs
_SPECK = 1e-9


class Tree(NamedTuple):
    """What a tree has proven."""

    lower_bound: float  # of every set that was not offered, -inf where nothing is proven
    nodes: int
    full: bool  # it ended because it had grown too large


class _Node(NamedTuple):
    """Options left (K, O), packed into bits; the part numbers that count as used; and how it is split."""

    bits: np.ndarray
    parts: frozenset[int]
    first: np.ndarray | None = None  # (K, O) packed: what the first child keeps
    part: int = -1  # part number that the first child goes without and that counts as used in the second one


def branch(
    options: Options,
    incumbent: Incumbent,
    at_least: float,
    gap: float,
    enough: Callable[[float], bool],
    spent: Callable[[], bool],
) -> Tree:
    """Offer sets until no other is better by more than ``gap``, time or memory are spent, or a bound is enough.

    Parameters
    ----------
    at_least : what the objective is known to come to.
    gap : in units of the objective, 0 to tell all but equals apart.
    enough : whether a bound of all sets that were not offered ends the search.
    """
    work = _Work(options, incumbent)
    root = work.settled(options.exists, frozenset())
    if root is None:
        return Tree(np.inf, 0, False)
    nodes, closed, ties = 0, np.inf, 0
    open_nodes: list[tuple[float, int, _Node]] = []
    fresh, bounds = [root], [at_least]
    size = max(1, min(_BATCH, _BATCH_OPTIONS // max(options.exists.size, 1)))
    while True:
        # bound what is new
        for first in range(0, len(fresh), size):
            batch = fresh[first : first + size]
            nodes += len(batch)
            for node, bound, inherited in zip(*work.bounded(batch, spent), bounds[first : first + size], strict=True):
                bound = max(bound, inherited)
                if node is None:
                    continue
                if bound >= incumbent.least - gap:
                    closed = min(closed, bound)
                    continue
                ties += 1
                heapq.heappush(open_nodes, (bound, ties, node))
        lowest = min(closed, open_nodes[0][0] if open_nodes else np.inf)
        full = len(open_nodes) * 2 * root.bits.size > _MEMORY
        done = not open_nodes or lowest >= incumbent.least - gap
        if done or full or enough(lowest) or spent():
            return Tree(lowest, nodes, full and not done)
        fresh, bounds = [], []
        while open_nodes and len(fresh) < size:
            bound, _, node = heapq.heappop(open_nodes)
            if bound >= incumbent.least - gap:
                closed = min(closed, bound)
                continue
            for child in work.children(node):
                fresh.append(child)
                bounds.append(bound)


@dataclass(frozen=True)
class _Work:
    options: Options
    incumbent: Incumbent

    def settled(self, left: np.ndarray, parts: frozenset[int]) -> _Node | None:
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
                if np.sum(fitted) > (options.most_fitted or 0):
                    return None
                if np.sum(fitted) == options.most_fitted:
                    left[np.ix_(slots[~fitted], np.arange(1, left.shape[1]))] = False
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
                return _Node(np.packbits(left, axis=-1), parts)

    def left(self, bits: np.ndarray) -> np.ndarray:
        """Options (K, O) of bits."""
        return np.unpackbits(bits, axis=-1, count=self.options.mass.shape[1]).astype(bool)

    def bounded(self, nodes: list[_Node], spent: Callable[[], bool]) -> tuple[list[_Node | None], list[float]]:
        """Nodes with how they are to be split, None where nothing is left to split; and their bounds."""
        options, incumbent = self.options, self.incumbent
        left = np.array([self.left(node.bits) for node in nodes])
        base, statement = _relaxed(incumbent.statement, options, left)
        found = both_stages(statement, np.full(len(nodes), 1e-9), np.zeros(len(nodes)), False)
        near = np.nan_to_num(base + found.smallest)
        bound = _bound(incumbent.statement, options, left, found.multipliers)
        off = np.where(left, np.abs(options.unbalance - near[..., None]), np.inf)
        incumbent.offer(np.argmin(off, axis=-1))
        kept: list[_Node | None] = []
        for n, node in enumerate(nodes):
            which = [np.flatnonzero(slot) for slot in left[n]]
            if bound[n] >= incumbent.level:
                kept.append(node)
            elif exhaust(options, which, incumbent, _SUMS, _PAIRS, spent):
                kept.append(None)
            else:
                kept.append(self._split(node, left[n], near[n], off[n]))
        return kept, bound.tolist()

    def _split(self, node: _Node, left: np.ndarray, near: Complex, off: Real) -> _Node:
        """The node with what its first child keeps, by relaxed unbalances (K,) and how far options are off (K, O)."""
        options, norms, ceilings = self.options, self.incumbent.statement.norms, self.incumbent.statement.ceilings.norms
        if options.limits_parts:
            free = set(np.unique(options.part[left]).tolist()) - node.parts - {-1}
            if len(free) + len(node.parts) > (options.most_parts or 0):
                # the one that most of the relaxed unbalances are nearest to
                wanted = options.of(options.part, np.argmin(off, axis=-1))
                part = max(sorted(free), key=lambda one: int(np.sum(wanted == one)))
                return node._replace(first=np.packbits(left & (options.part != part), axis=-1), part=part)
        does = np.sum(np.abs(norms.influence), axis=-2)
        does = does + np.sum(np.abs(ceilings.influence) / self.incumbent.statement.ceilings.size[:, None], axis=-2)
        # where the nearest option does most harm; where none does any, the slot with most room
        several, room = np.sum(left, axis=-1) > 1, np.max(np.where(left, off, 0.0), axis=-1)
        k = int(np.argmax(np.where(several, (np.min(off, axis=-1) + 1e-6 * room) * does, -1.0)))
        some = np.flatnonzero(left[k])
        at = options.unbalance[k, some]
        about = at - np.mean(at)
        # along the longest axis of what is left
        axis = np.exp(0.5j * np.angle(np.sum(about**2)))
        along = (about * np.conj(axis)).real
        here = float(((near[k] - np.mean(at)) * np.conj(axis)).real)
        low, high = float(np.min(along)), float(np.max(along))
        if not low <= here < high:
            here = 0.5 * (low + high)
        first = along <= here
        if np.all(first) or not np.any(first):
            first = np.arange(some.size) < some.size // 2
        kept = left.copy()
        kept[k, some[~first]] = False
        return node._replace(first=np.packbits(kept, axis=-1))

    def children(self, node: _Node) -> Iterator[_Node]:
        """The two halves of a node, as far as anything is left in them."""
        left = self.left(node.bits)
        first = left if node.first is None else self.left(node.first)
        if node.part >= 0:
            both = (first, node.parts), (left, node.parts | {node.part})
        else:
            changed = np.any(first != left, axis=-1, keepdims=True)
            both = (first, node.parts), (np.where(changed, left & ~first, left), node.parts)
        for some, parts in both:
            child = self.settled(some, parts)
            if child is not None:
                yield child


def _relaxed(statement: Statement, options: Options, left: np.ndarray) -> tuple[Complex, Statement]:
    """Base points (N, K) and programs in what is added to them, within discs, segments and sectors about the options.

    Where nothing is left a choice the base is 0 and masses are those of the program; elsewhere the base is the nearest
    of options on one ray, or the middle of the others.

    Parameters
    ----------
    left : (N, K, O) options of N nodes.
    """
    u, size = options.unbalance, np.abs(options.unbalance)
    angle = np.angle(u)
    some = left & (size > 0)
    mean = np.angle(np.sum(np.where(some, np.exp(1j * angle), 0.0), axis=-1))
    off = np.mod(angle - mean[..., None] + np.pi, 2.0 * np.pi) - np.pi
    low = np.min(np.where(some, off, np.inf), axis=-1)
    low, high = np.where(np.isinf(low), 0.0, low), np.max(np.where(some, off, -np.inf), axis=-1)
    high = np.maximum(high, low)
    half, centre = 0.5 * (high - low), np.exp(1j * (mean + 0.5 * (low + high)))
    far = np.max(np.where(left, size, 0.0), axis=-1)
    near = np.min(np.where(left, size, np.inf), axis=-1)
    ray = half < 1e-9
    parts = [(np.min(np.where(left, part, np.inf), axis=-1), np.max(np.where(left, part, -np.inf), axis=-1))
             for part in (u.real, u.imag)]  # fmt: skip
    middle = 0.5 * (parts[0][0] + parts[0][1]) + 0.5j * (parts[1][0] + parts[1][1])
    from_zero = left[..., 0]
    base = np.where(from_zero, 0.0, np.where(ray, near * centre, middle))
    around = np.max(np.where(left, np.abs(u - base[..., None]), 0.0), axis=-1)
    reach = np.where(from_zero, far, np.where(ray, far - near, around))
    reach = np.maximum(reach, _SPECK * float(np.max(size, initial=0.0)))
    free = np.where(from_zero, half > 0.5 * np.pi, ~ray)
    half = np.where(free, 0.5 * np.pi, np.where(ray, 0.0, half))
    held = np.sum(np.min(np.where(left, options.mass, np.inf), axis=-1), axis=-1)
    limits = Limits(
        radius=np.broadcast_to(statement.limits.radius, reach.shape),
        max_mass=reach / statement.limits.radius,
        free=free,
        centre=np.where(free, 1.0, centre),
        half_angle_cos=np.where(free, 0.0, np.cos(half)),
        half_angle_sin=np.where(free, 1.0, np.sin(half)),
        max_total_mass=np.maximum(statement.limits.max_total_mass - held, _SPECK * (held + 1e-300)),
    )

    def many(array: np.ndarray) -> np.ndarray:
        return np.broadcast_to(array, (base.shape[0], *array.shape))

    def moved(norms: Norms) -> Norms:
        return replace(norms, constant=norms.constant + base @ norms.influence.T, influence=many(norms.influence))

    ceilings = statement.ceilings
    ceilings = replace(ceilings, norms=moved(ceilings.norms), cap=many(ceilings.cap), size=many(ceilings.size))
    return base, replace(
        statement, norms=moved(statement.norms), floor=many(statement.floor), ceilings=ceilings, limits=limits
    )


def _bound(statement: Statement, options: Options, left: np.ndarray, multipliers: Multipliers) -> Real:
    """What multipliers prove of the options left (N, K, O) of N nodes (N,)."""
    constant, slope, rounding = affine_minorant(statement, multipliers)
    size = np.abs(options.unbalance)
    each = (np.conj(slope)[..., None] * options.unbalance).real - rounding[..., None] * size
    each = np.where(left, each, np.inf)
    budget = options.budget(statement)
    charged = budget if np.isfinite(budget) else 0.0

    def least(price: Real) -> tuple[Real, Real]:
        """The least sum at a price of the mass (N,), and the mass that it takes."""
        priced = each + price[:, None, None] * options.mass
        place = np.argmin(priced, axis=-1)[..., None]
        found = np.take_along_axis(priced, place, axis=-1)[..., 0]
        mass = np.take_along_axis(np.broadcast_to(options.mass, left.shape), place, axis=-1)[..., 0]
        if options.limits_fitted:
            can_stay = left[..., 0]
            gain = np.where(can_stay, np.minimum(found - priced[..., 0], 0.0), 0.0)
            gain = np.where(can_stay, gain, 0.0)
            room = (options.most_fitted or 0) - np.sum(~can_stay, axis=-1)
            order = np.argsort(gain, axis=-1, kind="stable")
            used = np.argsort(order, axis=-1, kind="stable") < room[:, None]
            found = np.where(can_stay, np.where(used, found, priced[..., 0]), found)
            mass = np.where(can_stay & ~used, 0.0, mass)
        return np.sum(found, axis=-1), np.sum(mass, axis=-1)

    price = np.zeros(left.shape[0])
    best, mass = least(price)
    if np.any(mass > budget):
        # concave in the price: its slope is what the mass is above the budget
        lightest = np.where(left, options.mass, np.inf)
        step = np.max(np.where(left & (options.mass > 0), np.abs(each), 0.0), axis=(1, 2))
        step = step / np.maximum(np.min(np.where(lightest > 0, lightest, np.inf), axis=(1, 2)), 1e-300)
        low, high = price, np.where(np.isfinite(step), 2.0 * step, 0.0)
        for _ in range(_HALVINGS):
            price = 0.5 * (low + high)
            value, mass = least(price)
            best = np.maximum(best, value - price * charged)
            low, high = np.where(mass > budget, price, low), np.where(mass > budget, high, price)
    magnitude = np.abs(constant) + np.sum(np.max(np.where(left, np.abs(each), 0.0), axis=-1), axis=-1)
    bound = constant + best - 1e-14 * (magnitude + options.slots * np.abs(price) * charged)
    return np.where(np.isnan(bound), -np.inf, bound)
