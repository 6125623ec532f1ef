"""Plates that are all but full, full; and plates that are all but alike, alike: what a workshop cuts the same way.

The least mass spends what an optimum may be off on hundredths of a degree here and there. Plates of one kind that hold
nearly the same are opened alike: as far as they go, or else as little as leaves an optimum. The other counterweights
are chosen anew, and the result replaces the optimum where it is within what is proven.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from optimizer.mechanics.plates import Plates
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.methods.compensation import balanced
from optimizer.program.methods.compiled import suits_kernel, unproven
from optimizer.program.methods.plate_sizes import NEARLY, SAME_SIZE, CutWeights, at_limits, total_mass
from optimizer.program.plate_pieces import pieces, tangents
from optimizer.program.points import points_at
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.program.statement import Statement
from optimizer.program.verdict import MASS_GAP

#: openings that are tried at once for plates that are to be alike, and how often closer ones
_OPENINGS, _ROUNDS = 6, 3
#: shares of what is certified that may be used up: of the mass, and of the objective by the choice of the others
_OF_MASS, _OF_OBJECTIVE = 0.9, 0.5


def alike(
    whole: Statement, plates: Plates, nodes: Real, cut: CutWeights, optimum: tuple[float, float], least_mass: float
) -> CutWeights:
    """The same with plates opened alike where they are no worse for it.

    Parameters
    ----------
    whole : one program of a leading axis (1,), whose limits hold what the plates hold.
    nodes : (n, P) half-angles between which plates are taken for webs, rad.
    cut : within the limits.
    optimum : proven lower bound of the objective, and largest objective of an optimum; that of ``cut`` may be larger.
    least_mass : kg, no optimum is lighter; inf where the mass does not count.
    """
    if not suits_kernel(whole):
        return cut
    clusters = list(_clusters(plates, cut))
    apart = [cluster for cluster in clusters if cluster.high - cluster.low > SAME_SIZE * cluster.high]
    if not apart:
        return cut
    admitted = _admitted(whole, cut, optimum, least_mass)
    empty = np.abs(cut.unbalance) == 0.0
    every = empty.copy()
    every[plates.webs[np.concatenate([cluster.places for cluster in clusters])]] = True
    if len(apart) > 1:
        # all at once, which mostly does
        result = _opened(whole, plates, nodes, cut, every, apart, admitted)
        if result is not None:
            return result
    weights, is_fixed, left = cut, empty.copy(), False
    for cluster in clusters:
        is_fixed[plates.webs[cluster.places]] = True
        if cluster.high - cluster.low > SAME_SIZE * cluster.high:
            result = _opened(whole, plates, nodes, weights, is_fixed, [cluster], admitted)
            weights, left = result or weights, left or result is None
    if not left:
        return weights
    # an optimum may be nearer to the smallest objective, and is then turned as that is
    alternative = _with_smallest_directions(whole, plates, nodes, cut, empty, admitted)
    return _opened(whole, plates, nodes, alternative, every, apart, admitted) or weights


def emptied(whole: Statement, plates: Plates, cut: CutWeights, empty: np.ndarray) -> CutWeights:
    """The same with some webs (K,) bool left empty, for which counterweights between their limits make up."""
    limits, base = whole.limits, np.where(empty, 0.0, cut.unbalance)
    room = np.where(empty | at_limits(whole, cut), 0.0, np.abs(cut.unbalance))
    new = balanced(limits, whole.every_influence, cut.unbalance[None], base[None], room[None])[0]
    u = np.where(room > 0, new, base)
    angle = np.where(room[plates.webs] > 0, plates.opened(np.abs(u[plates.webs])), cut.angle)
    angle = np.where(empty[plates.webs], 0.0, angle)
    return CutWeights(u, angle, float(total_mass(whole, plates, u, angle)))


class _Cluster(NamedTuple):
    """Plates to be opened alike."""

    places: np.ndarray  # (n,) among all
    low: float  # rad, half-angles between which
    high: float
    full: bool  # as far as they go, if that may be


def _clusters(plates: Plates, cut: CutWeights) -> Iterator[_Cluster]:
    """Plates of one kind that hold nearly the same, and plates that are all but full."""
    size = np.abs(cut.unbalance[plates.webs])
    full = size >= plates.unbalance(plates.most) * (1.0 - NEARLY)
    for kind in np.unique(plates.kinds):
        places = np.flatnonzero((plates.kinds == kind) & (size > 0))
        places = places[np.argsort(size[places], kind="stable")]
        apart = np.flatnonzero(np.diff(size[places]) > NEARLY * size[places][1:]) + 1
        for group in np.split(places, apart):
            if group.size > 1 or np.any(full[group]):
                angle, to_the_end = cut.angle[group], bool(np.any(full[group]))
                high = plates.most[group[0]] if to_the_end else np.max(angle)
                yield _Cluster(group, float(np.min(angle)), float(high), to_the_end)


class _Admitted(NamedTuple):
    """What a cut has to keep to be no worse than the one that is proven."""

    bound: float  # proven of the objective
    objective: float
    excess: float  # relative, over the ceilings
    mass: float  # kg
    least_mass: bool  # the mass counts


def _admitted(whole: Statement, cut: CutWeights, optimum: tuple[float, float], least_mass: float) -> _Admitted:
    u = cut.unbalance
    heaviest = max(cut.mass, least_mass / (1.0 - _OF_MASS * MASS_GAP))
    return _Admitted(
        optimum[0],
        float(np.maximum(optimum[1], whole.objective(u)[0])),
        float(np.maximum(points_at(whole, u[None]).excess[0], CEILING_ROUNDING)),
        heaviest,
        bool(np.isfinite(least_mass)),
    )


def _with_smallest_directions(
    whole: Statement, plates: Plates, nodes: Real, cut: CutWeights, empty: np.ndarray, admitted: _Admitted
) -> CutWeights:
    """The same with every counterweight turned to where it is for the smallest objective, and no heavier."""
    share = _OF_OBJECTIVE * (admitted.objective - admitted.bound)
    smallest = _completion(whole, plates, nodes, empty, np.zeros_like(cut.unbalance)[None], share, False)[0]
    size = np.abs(smallest)
    u = np.abs(cut.unbalance) * smallest / np.where(size > 0, size, 1.0)
    return cut._replace(unbalance=np.where(size > 0, u, cut.unbalance))


def _opened(
    whole: Statement,
    plates: Plates,
    nodes: Real,
    before: CutWeights,
    is_fixed: np.ndarray,
    clusters: Sequence[_Cluster],
    admitted: _Admitted,
) -> CutWeights | None:
    """The same with the plates of each cluster opened alike, None where that is worse.

    Parameters
    ----------
    is_fixed : (K,) bool, webs that stay as they are or are opened so; the others are free.
    """
    many, places = whole.subset(np.zeros(_OPENINGS, int)), np.concatenate([cluster.places for cluster in clusters])
    webs, size = plates.webs[places], [cluster.places.size for cluster in clusters]
    low, high = (np.repeat([getattr(cluster, name) for cluster in clusters], size) for name in ("low", "high"))
    full, u = any(cluster.full for cluster in clusters), before.unbalance
    for _ in range(_ROUNDS):
        openings = np.repeat(before.angle[None], _OPENINGS, axis=0)
        openings[:, places] = np.linspace(low, high, _OPENINGS)
        trials = np.repeat(u[None], _OPENINGS, axis=0)
        trials[:, webs] = plates.unbalance(openings)[:, places] * (u[webs] / np.abs(u[webs]))
        share = _OF_OBJECTIVE * (admitted.objective - admitted.bound)
        trials = _completion(many, plates, nodes, is_fixed, trials, share, admitted.least_mass)
        close = many.objective(trials) <= admitted.objective + many.rounding(trials)
        close &= points_at(many, trials).excess <= admitted.excess
        opened = plates.opened(np.abs(trials[:, plates.webs]))
        mass = total_mass(whole, plates, trials, opened)
        light = mass <= admitted.mass
        if np.any(close & light):
            best = -1 if full and close[-1] & light[-1] else int(np.argmax(close & light))
            return CutWeights(trials[best], opened[best], float(mass[best]))
        # the lightest that is an optimum is between two of them
        first = int(np.argmax(close))
        if not first or not light[first - 1]:
            break
        low, high, full = openings[first - 1, places], openings[first, places], False
    return None


def _completion(
    many: Statement, plates: Plates, nodes: Real, is_fixed: np.ndarray, u: Complex, share: float, least_mass: bool
) -> Complex:
    """Unbalances (N, K) with the best ones on webs that are not fixed.

    Parameters
    ----------
    is_fixed : (K,) bool.
    share : by which the objective may be above the smallest.
    """
    left, fixed = ~is_fixed & np.all(many.limits.reach > 0, axis=0), np.where(is_fixed, u, 0.0)
    if not left.any():
        return fixed
    laid = pieces(many.about(fixed), plates, tangents(plates, nodes), left)
    solution, _ = unproven(laid.program, np.full(len(u), share), least_mass)
    return fixed + laid.carried(solution)
