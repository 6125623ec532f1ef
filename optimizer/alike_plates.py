"""Plates that are all but full, full; and plates that are all but alike, alike: what a workshop cuts the same way.

The least mass spends what an optimum may be off on hundredths of a degree here and there. Plates of one kind that hold
nearly the same are opened alike: as far as they go, or else as little as leaves an optimum. The other counterweights
are chosen anew, and what is found is taken where it is within what is proven.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.mechanics.plates import Plates
from optimizer.plate_pieces import pieces, tangents
from optimizer.program.compiled import suits_kernel, unproven
from optimizer.program.points import excess_at
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.program.statement import Statement
from optimizer.program.verdict import MASS_GAP

#: unbalances that differ by less than this share are nearly the same, as in ``optimizer.program.settled``
_NEAR = 1e-4
#: openings that are tried at once for plates that are to be alike, and how often closer ones
_TRIED, _ROUNDS = 6, 3
#: shares of what is certified that may be used up: of the mass, and of the objective by the choice of the others
_OF_MASS, _OF_OBJECTIVE = 0.9, 0.5
#: openings that differ by less than this share are the same
_SAME = 1e-12


def alike(
    whole: Statement, plates: Plates, nodes: Real, u: Complex, optimum: tuple[float, float], least_mass: float
) -> Complex:
    """Unbalances (K,) kg m with plates opened alike where they are no worse for it.

    Parameters
    ----------
    whole : one program of a leading axis (1,), whose limits hold what the plates hold.
    nodes : (n, P) half-angles between which plates are taken for webs, rad.
    u : (K,) kg m, within the limits.
    optimum : proven lower bound of the objective, and largest objective of an optimum; that of ``u`` may be larger.
    least_mass : kg, no optimum is lighter; inf where the mass does not count.
    """
    if not suits_kernel(whole):
        return u
    limits, held, lower_bound = whole.limits, np.abs(u) == 0.0, optimum[0]
    most = plates.unbalance(plates.most)
    plain = np.setdiff1d(np.arange(u.size), plates.webs)

    def mass(u: Complex) -> Real:
        """kg (...)."""
        cut = np.add.reduce(plates.mass_of(np.abs(u[..., plates.webs])), axis=-1)
        return np.asarray(cut + np.add.reduce(np.abs(u[..., plain]) / limits.radius[0, plain], axis=-1))

    for some in _clusters(plates, most, np.abs(u[plates.webs])):
        webs = plates.webs[some]
        held[webs] = True
        size = np.abs(u[webs])
        full = float(most[some[0]]) * (1.0 - _NEAR) <= np.max(size)
        angle = plates.opened(np.abs(u[plates.webs]))[some]
        low, high = float(np.min(angle)), float(plates.most[some[0]] if full else np.max(angle))
        if high - low <= _SAME * high:
            continue
        many, before = whole.chosen(np.zeros(_TRIED, int)), u
        largest = np.maximum(optimum[1], whole.objective(before)[0])
        heaviest = np.maximum(mass(before), least_mass / (1.0 - _OF_MASS * MASS_GAP))
        heaviest = np.minimum(heaviest, np.maximum(mass(before), limits.max_total_mass[0]))
        for _ in range(_ROUNDS):
            openings = np.linspace(low, high, _TRIED)
            tried = np.repeat(before[None], _TRIED, axis=0)
            every = np.repeat(openings[:, None], plates.webs.size, axis=1)
            tried[:, webs] = plates.unbalance(every)[:, some] * (before[webs] / size)
            share = _OF_OBJECTIVE * float(largest - lower_bound)
            tried = _others(many, plates, nodes, held, tried, share, np.isfinite(least_mass))
            close = many.objective(tried) <= largest + many.rounding(tried)
            close &= excess_at(many, tried) <= np.maximum(excess_at(whole, before[None])[0], CEILING_ROUNDING)
            light = mass(tried) <= heaviest
            if np.any(close & light):
                u = tried[-1 if full and close[-1] & light[-1] else int(np.argmax(close & light))]
                break
            # the lightest that is an optimum is between two of them
            first = int(np.argmax(close))
            if not first or not light[first - 1]:
                break
            low, high, full = openings[first - 1], openings[first], False
    return u


def _clusters(plates: Plates, most: Real, size: Real) -> Iterator[np.ndarray]:
    """Plates of one kind that hold nearly the same, and plates that are all but full: their places (n,) among all.

    Parameters
    ----------
    most, size : (P,) what they hold at most, and what is cut of them, kg m.
    """
    for kind in np.unique(plates.kinds):
        places = np.flatnonzero((plates.kinds == kind) & (size > 0))
        places = places[np.argsort(size[places], kind="stable")]
        apart = np.flatnonzero(np.diff(size[places]) > _NEAR * size[places][1:]) + 1
        for some in np.split(places, apart):
            if some.size > 1 or np.any(size[some] >= (1.0 - _NEAR) * most[some]):
                yield some


def _others(
    many: Statement, plates: Plates, nodes: Real, held: np.ndarray, u: Complex, share: float, least_mass: bool
) -> Complex:
    """Unbalances (N, K) with those that are not held chosen anew.

    Parameters
    ----------
    held : (K,) bool.
    share : by which the objective may be above the smallest.
    """
    left, fixed = ~held & np.all(many.limits.reach > 0, axis=0), np.where(held, u, 0.0)
    if not left.any():
        return fixed
    spent = np.add.reduce(plates.mass_of(np.abs(fixed[:, plates.webs])), axis=-1)
    limits = replace(many.limits, max_total_mass=many.limits.max_total_mass - spent)
    laid = pieces(replace(many.about(fixed), limits=limits), plates, tangents(plates, nodes), left)
    found, _ = unproven(laid.program, np.full(len(u), share), least_mass)
    return fixed + laid.carried(found)
