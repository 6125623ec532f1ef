"""Plates that are all but full, full; and plates that are all but alike, alike: what a workshop cuts the same way.

The least mass spends what an optimum may be off on hundredths of a degree here and there. Plates of one kind that hold
nearly the same are opened alike: as far as they go, or else as little as leaves an optimum. The other counterweights
are chosen anew, and what is found is taken where it is within what is proven.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.mechanics.envelope import Envelope
from optimizer.plate_pieces import pieces, tangents
from optimizer.program.compiled import both_stages, suits_kernel
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
    whole: Statement,
    plates: Mapping[int, Envelope],
    nodes: Mapping[int, Real],
    kinds: np.ndarray,
    u: Complex,
    optimum: tuple[float, float],
    least_mass: float,
) -> Complex:
    """Unbalances (K,) kg m with plates opened alike where they are no worse for it.

    Parameters
    ----------
    whole : one program of a leading axis (1,), whose limits hold what the plates hold.
    nodes : half-angles between which plates are taken for webs, rad.
    kinds : (K,) webs with the same plate have the same number.
    u : (K,) kg m, within the limits.
    optimum : proven lower bound of the objective, and largest objective of an optimum; that of ``u`` may be larger.
    least_mass : kg, no optimum is lighter; inf where the mass does not count.
    """
    if not suits_kernel(whole):
        return u
    limits, held, lower_bound = whole.limits, np.abs(u) == 0.0, optimum[0]
    plain = [k for k in range(u.size) if k not in plates]

    def mass(u: Complex) -> Real:
        """kg (...)."""
        cut = sum(plate.mass(plate.opened(np.abs(u[..., k]))) for k, plate in plates.items())
        return np.asarray(cut + np.sum(np.abs(u[..., plain]) / limits.radius[0, plain], axis=-1))

    for webs in _clusters(plates, kinds, u):
        held[webs] = True
        plate, size = plates[webs[0]], np.abs(u[webs])
        full = float(plate.unbalance(plate.most)) * (1.0 - _NEAR) <= np.max(size)
        low, high = (float(plate.opened(each)) for each in (np.min(size), np.max(size)))
        high = float(plate.most) if full else high
        if high - low <= _SAME * high:
            continue
        many, before = whole.chosen(np.zeros(_TRIED, int)), u
        largest = np.maximum(optimum[1], whole.objective(before)[0])
        heaviest = np.maximum(mass(before), least_mass / (1.0 - _OF_MASS * MASS_GAP))
        heaviest = np.minimum(heaviest, np.maximum(mass(before), limits.max_total_mass[0]))
        for _ in range(_ROUNDS):
            openings = np.linspace(low, high, _TRIED)
            tried = np.repeat(before[None], _TRIED, axis=0)
            tried[:, webs] = plate.unbalance(openings)[:, None] * (before[webs] / size)
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


def _clusters(plates: Mapping[int, Envelope], kinds: np.ndarray, u: Complex) -> Iterator[np.ndarray]:
    """Webs whose plates are of one kind and hold nearly the same, and plates that are all but full."""
    size = np.abs(u)
    for kind in np.unique(kinds[list(plates)]):
        webs = np.array([k for k in plates if kinds[k] == kind and size[k] > 0], int)
        webs = webs[np.argsort(size[webs], kind="stable")]
        apart = np.flatnonzero(np.diff(size[webs]) > _NEAR * size[webs][1:]) + 1
        for some in np.split(webs, apart):
            plate = plates[some[0]] if some.size else None
            if plate and (some.size > 1 or size[some[0]] >= (1.0 - _NEAR) * plate.unbalance(plate.most)):
                yield some


def _others(
    many: Statement,
    plates: Mapping[int, Envelope],
    nodes: Mapping[int, Real],
    held: np.ndarray,
    u: Complex,
    share: float,
    least_mass: bool,
) -> Complex:
    """Unbalances (N, K) with those that are not held chosen anew.

    Parameters
    ----------
    held : (K,) bool.
    share : by which the objective may be above the smallest.
    """
    rest = np.flatnonzero(~held & np.all(many.limits.reach > 0, axis=0)).tolist()
    fixed = np.where(held, u, 0.0)
    if not rest:
        return fixed

    spent = sum(plate.mass(plate.opened(np.abs(fixed[:, k]))) for k, plate in plates.items())
    owner = np.repeat(rest, [nodes[k].size - 1 if k in plates else 1 for k in rest])
    left = pieces(
        replace(
            many.about(fixed),
            limits=replace(many.limits, max_total_mass=many.limits.max_total_mass - spent),
        ),
        owner,
        {k: tangents(plate, nodes[k]) for k, plate in plates.items() if k in rest},
    )
    shares = np.full(len(u), share)
    found = both_stages(left, shares, shares, least_mass).unbalance
    new = fixed.copy()
    for place, k in enumerate(owner):
        new[:, k] += found[:, place]
    return new
