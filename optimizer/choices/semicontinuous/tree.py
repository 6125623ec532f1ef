"""Branch and bound: whether something is fitted on a web, and then in which piece of its sector.

What is at least so heavy at any angle is no convex set, and neither is the least or nothing. A node is relaxed to discs
and cones about what is left, which the batch kernel takes as limits; whatever it returns, multipliers prove.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.choices.branch_and_bound import Termination, Tree, branch_and_bound
from optimizer.choices.clock import Clock
from optimizer.choices.semicontinuous.bound import proven, uphill
from optimizer.choices.semicontinuous.inside import BestPoint, cones, improved
from optimizer.choices.semicontinuous.places import WIDEST, Places
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.statement import Statement

#: nodes bounded at once, those of them whose relaxed points are made to keep everything, and those that may be open
_BATCH, _REPAIRS, _OPEN = 64, 4, 200_000
#: radius of the disc whose edge stands for a chord, in units of the largest unbalance
_SAG = 30.0
#: a piece this narrow is not cut, rad; and the share of the least by which a point may miss it
_NARROW, _MISSES = 1e-9, 1e-9
#: smallest target gap for the kernel, also where the search has none
_CLOSE = 1e-9


class _Open(NamedTuple):
    """A node that stays open (1, K), and the web on which it is split."""

    places: Places
    web: int
    towards: float  # rad, direction of the relaxed unbalance there


def branch(
    incumbent: BestPoint,
    at_least: float,
    gap: float,
    enough: Callable[[float], bool],
    clock: Clock,
    below: Statement,
) -> Tree:
    """Offer points until none is better by more than ``gap``, time or memory are spent, or a bound is enough.

    Parameters
    ----------
    at_least : lower bound of the objective.
    enough : whether a bound of everything ends the search.
    clock : what is left of the time.
    below : a program that is nowhere above the incumbent's, which bounds are of.
    """

    def bounded(nodes: list[Places], bounds: list[float]) -> tuple[float, list[tuple[float, _Open]]]:
        first, *rest = nodes
        return _bounded(incumbent, below, first.beside(*rest), np.array(bounds), gap, clock)

    ends = Termination(lambda: incumbent.least - gap, enough, _OPEN)
    return branch_and_bound(incumbent.places, at_least, bounded, _children, ends, clock, _BATCH)


def _bounded(
    incumbent: BestPoint, statement: Statement, places: Places, inherited: Real, gap: float, clock: Clock
) -> tuple[float, list[tuple[float, _Open]]]:
    """What is proven of all that nodes lose here, and those that stay open with their bounds."""
    count = inherited.size
    program = relaxed(statement, places)
    close = max(gap, _CLOSE)
    relaxations = incumbent.solved(program, np.full(count, 1e-3 * close), np.full(count, 0.1 * close), False, clock)
    near = np.where(places.out, 0.0, relaxations.unbalance)
    multipliers = replace(
        relaxations.multipliers, ceiling=relaxations.multipliers.ceiling[:, : statement.ceilings.cap.size]
    )
    _offer(incumbent, places, near, inherited, clock)
    target = incumbent.least - gap
    bounds = proven(statement, places, multipliers)
    raised = proven(statement, places, uphill(statement, places, multipliers, bounds.price, target))
    better = raised.bound > bounds.bound
    bound = np.maximum(inherited, np.where(better, raised.bound, bounds.bound))
    bound = np.where(relaxations.nowhere, np.inf, bound)
    closed = np.inf
    # what one web rules out by itself
    undecided = places.undecided
    forced = np.maximum(np.where(better[:, None, None], raised.forced, bounds.forced), bound[:, None, None])
    without, fitted = forced[..., 0], forced[..., 1]
    never = places.whole(undecided & (fitted >= target))
    if np.any(never):
        closed = min(closed, float(np.min(fitted[never])))
        places = replace(places, out=places.out | never)
    must = places.whole(undecided & ~never & (without >= target))
    if np.any(must):
        closed = min(closed, float(np.min(without[must])))
    nowhere = np.any(undecided & never & (without >= target), axis=-1)
    stays: list[tuple[float, _Open]] = []
    for n in range(count):
        if bound[n] >= target or nowhere[n]:
            closed = min(closed, max(float(bound[n]), target))
            continue
        web = _web(statement, places, must[n], near[n], n)
        if web is None:
            closed = min(closed, float(bound[n]))
            continue
        if must[n, web]:
            # it is split into pieces alone
            node = places.subset([n])
            node.fitted[0, places.beside_web(web)] = True
        else:
            node = places.subset([n])
        stays.append((float(bound[n]), _Open(node, web, float(np.angle(near[n, web])))))
    return closed, stays


def _offer(incumbent: BestPoint, places: Places, near: Complex, bounds: Real, clock: Clock) -> None:
    """Relaxed points as they are, and the most promising with everything kept."""
    least = places.least
    incumbent.offer(np.where((least > 0) & (np.abs(near) <= _MISSES * least), 0.0, near))
    # one after the other where the kernel may not take them
    best = np.argsort(bounds, kind="stable")[: _REPAIRS if places.alike is None else 1]
    points = near[best]
    improved(incumbent, points, places.whole(places.fitted[best] | (np.abs(points) >= 0.5 * least)), clock)


def relaxed(statement: Statement, places: Places) -> Statement:
    """Programs (N,) within discs and sectors, and above the chords of the pieces that have one, but for their sag.

    A chord is the ceiling |u_k - (R m cos b + s) e^{jc}| <= s of a large disc, behind those of the statement.
    """
    limits, count = statement.limits, len(places.out)
    whole = places.half > WIDEST * (1.0 + 1e-12)
    chorded = places.fitted & ~whole
    reach = np.where(places.out, 0.0, places.most)
    budget = np.broadcast_to(limits.max_total_mass, count)
    programs = replace(
        statement.about(np.zeros(places.out.shape, complex)),
        limits=cones(limits, reach, places.centre, places.half, budget),
    )
    webs = np.flatnonzero(np.any(chorded, axis=0))
    if not webs.size:
        return programs
    large = _SAG * places.most[webs]
    here = chorded[:, webs]
    middle = places.least[webs] * np.cos(places.half[:, webs]) + large
    constant = np.where(here, -middle * np.exp(1j * places.centre[:, webs]), 0.0)
    old, alone = programs.ceilings, np.eye(limits.radius.size)[webs]
    norms = replace(
        old.norms,
        constant=np.concatenate([old.norms.constant, constant], axis=-1),
        influence=np.concatenate(
            [old.norms.influence, np.broadcast_to(alone, (count, *alone.shape))],
            axis=-2,
        ),
    )
    wide = np.broadcast_to(large, (count, webs.size))
    ceilings = replace(
        old,
        names=(*old.names, *(f"chord:{k}" for k in webs.tolist())),
        norms=norms,
        cap=np.concatenate([old.cap, wide], axis=-1),
        size=np.concatenate([old.size, wide], axis=-1),
        scenarios=None,
        angles_deg=None,
    )
    return replace(programs, ceilings=ceilings)


def _web(statement: Statement, places: Places, must: np.ndarray, near: Complex, n: int) -> int | None:
    """The web on which a node is split: where a relaxed point misses most, or else where most is left."""
    norms, ceilings = statement.norms, statement.ceilings
    does = np.sum(np.abs(norms.influence), axis=-2)
    does = does + np.sum(np.abs(ceilings.norms.influence) / ceilings.size[:, None], axis=-2)
    least, size = places.least, np.abs(near)
    undecided, fitted = places.undecided[n], places.fitted[n]
    missing = np.maximum(least - size, 0.0)
    misses = np.where(undecided, np.where(must, missing, np.minimum(size, missing)), np.where(fitted, missing, 0.0))
    room = np.where(undecided, least, np.where(fitted, least * (1.0 - np.cos(np.minimum(places.half[n], WIDEST))), 0.0))
    room = np.where(fitted & (places.half[n] <= _NARROW), 0.0, room)
    worth = np.where(room > 0, (misses + 1e-6 * room) * does, 0.0)
    web = int(np.argmax(worth))
    return web if worth[web] > 0 else None


def _children(node: _Open) -> Iterator[Places]:
    """What a node is split into."""
    places, web = node.places, node.web
    centre, half = float(places.centre[0, web]), float(places.half[0, web])
    if not places.fitted[0, web]:
        yield places.without(0, web)
    wide = half > WIDEST * (1.0 + 1e-12)
    pieces = int(np.ceil(half / WIDEST - 1e-12)) if wide else 1 if not places.fitted[0, web] else 2
    # of a whole turn the relaxed unbalance is in the middle of a piece
    middle = node.towards if half >= np.pi else centre - half + half / pieces
    for piece in range(pieces):
        yield places.within(0, web, middle + 2.0 * half / pieces * piece, half / pieces)
