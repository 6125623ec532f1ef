"""Plates that are cut: what they weigh, and openings that nearly agree put to one size."""

from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.methods.compensation import balanced
from optimizer.program.plate_pieces import Plates
from optimizer.program.statement import Statement

#: unbalances that differ by less than this share are nearly the same, as in ``optimizer.program.methods.rounding``
NEARLY = 1e-4
#: openings that differ by less are one size where that leaves an optimum, rad: 1e-3 degrees, and less
_NEARNESS = (1.75e-5, 1e-7, 1e-9, 1e-11)
#: shares by which what nearly agrees with a limit is there, the next where nothing makes up for equal sizes
_TOUCHED = (NEARLY, 1e-9)
#: openings that differ by less than this share are the same: what rounding leaves
SAME_SIZE = 1e-12


class CutWeights(NamedTuple):
    """Counterweights, of which some are cut from plates."""

    unbalance: Complex  # (K,) kg m
    angle: Real  # (P,) rad, half-angles of the plates
    mass: float  # kg, of all together


def equal_sizes(whole: Statement, plates: Plates, cut: CutWeights) -> Iterator[CutWeights]:
    """The same with openings that nearly agree put to the largest or the mean of them, those that differ more first.

    What nearly goes as far as it can goes so far, or else to the mean too. Other counterweights make up for it; the
    last is the cut as it is.
    """
    size, limits = np.abs(cut.unbalance), whole.limits
    # near a right angle a plate is all but full long before it is open: that counts as room where no other does
    for near, touched in product(_NEARNESS, _TOUCHED):
        is_fixed = at_limits(whole, cut, touched)
        near_full = np.where(cut.angle >= plates.most - near, plates.most, cut.angle)
        order = np.lexsort((near_full, plates.kinds))
        apart = (np.diff(near_full[order]) > near) | (np.diff(plates.kinds[order]) != 0)
        clusters = np.split(order, np.flatnonzero(apart) + 1)
        room = np.where(is_fixed, 0.0, size)
        for cluster in clusters:
            room[plates.webs[cluster]] *= cluster.size == 1
        for common, opened in ((np.max, near_full), (np.mean, near_full), (np.mean, cut.angle)):
            angle = opened.copy()
            for cluster in clusters:
                angle[cluster] = common(opened[cluster])
            angle = np.where(cut.angle > 0, angle, 0.0)
            if not np.any(angle != cut.angle):
                continue
            base = cut.unbalance.copy()
            base[plates.webs] *= plates.unbalance(angle) / np.where(size[plates.webs] > 0, size[plates.webs], 1.0)
            new = balanced(limits, whole.every_influence, cut.unbalance[None], base[None], room[None])[0]
            new = np.where(room > 0, new, base)
            openings = np.where(room[plates.webs] > 0, plates.opened(np.abs(new[plates.webs])), angle)
            for u, half in ((new, openings), (base, angle)):
                yield CutWeights(u, half, float(total_mass(whole, plates, u, half)))
    yield cut


def unlike(plates: Plates, angle: Real) -> bool:
    """Whether plates of one kind are opened (P,) rad so nearly alike that they should be alike."""
    apart = np.abs(angle[:, None] - angle)
    near = (apart <= _NEARNESS[0]) & (plates.kinds[:, None] == plates.kinds) & (angle[:, None] > 0) & (angle > 0)
    return bool(np.any(near & (apart > SAME_SIZE * angle)))


def at_limits(whole: Statement, cut: CutWeights, near: float = NEARLY) -> np.ndarray:
    """Webs (K,) that are all but full, by a share of what they may carry, or next to an edge of their sector."""
    limits = whole.limits
    full = np.abs(cut.unbalance) >= limits.reach[0] * (1.0 - near)
    v = cut.unbalance * np.conj(limits.centre[0])
    inwards = v.real * limits.half_angle_sin[0] - np.abs(v.imag) * limits.half_angle_cos[0]
    at_edge = ~limits.free[0] & (np.abs(v) > 0) & (inwards <= NEARLY * limits.half_angle_sin[0] * np.abs(v))
    return np.asarray(full | at_edge)


def total_mass(whole: Statement, plates: Plates, u: Complex, angle: Real) -> Real:
    """What unbalances (..., K) weigh (...), kg, those of plates (..., P) as they are opened."""
    mass = np.abs(u) / whole.limits.radius[0]
    mass[..., plates.webs] = plates.mass(angle)
    return np.add.reduce(mass, axis=-1)
