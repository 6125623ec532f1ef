"""Peaks of curves over the turn, from their pieces to the brackets, without a step outside of what is compiled."""

import numpy as np

from optimizer.mechanics.kernel.curves import series_of_curves
from optimizer.numerics.compiling import inner_with_arrays
from optimizer.responses.kernel.motion import into_motion
from optimizer.responses.kernel.parts import (
    ENOUGH,
    MOST_CUTS,
    MOST_PARTS,
    Parts,
    first_open,
    narrowed,
    still_open,
)

_CENTRE, _HALF, _REST, _FOURTH = range(4)
#: orders, as numpy's integers like all else that is handed on
_VALUE, _CUBIC, _BOUND, _NONE = np.int64(0), np.int64(3), np.int64(4), np.int64(0)


@inner_with_arrays
def search(cubics, members, best, rows, sums, middle, motion):  # type: ignore[no-untyped-def]
    """Narrow all peaks until each is cubics; the curves (G,) where they are best, without offsets and at rest."""
    parts, cuts = first_open(cubics, members, best), np.int64(0)
    while parts.member.size > 0:
        fine, coarse, cuts = narrowed(parts, members, best, cuts)
        if coarse.member.size > 0:
            _expand(coarse, members, best, rows, sums, middle, motion)
            fine = Parts(
                np.concatenate((fine.member, coarse.member)),
                np.concatenate((fine.piece, coarse.piece)),
                np.concatenate((fine.place, coarse.place)),
                np.concatenate((fine.cubic, coarse.cubic)),
            )
        parts = still_open(fine, members, best, MOST_PARTS if cuts < MOST_CUTS else _NONE)
    curve = members.curve[best.member] + motion.first
    return series_of_curves(rows, sums, middle, curve, best.piece, best.angle, np.empty(0), _VALUE)[0][:, 0].copy()


@inner_with_arrays
def _expand(parts, members, best, rows, sums, middle, motion):  # type: ignore[no-untyped-def]
    """Parts (n,) by polynomials of their own, and where that does not help enough by bounds of their own."""
    count, place = parts.member.size, parts.place
    curve, centre, half = members.curve[parts.member] + motion.first, place[:, _CENTRE].copy(), place[:, _HALF].copy()
    cubic, _ = series_of_curves(rows, sums, middle, curve, parts.piece, centre, np.empty(0), _CUBIC)
    steep, steep_count = np.empty(count, np.int64), 0
    for n in range(count):
        member, wide = parts.member[n], half[n]
        group = members.group[member]
        for k in range(4):
            parts.cubic[n, k] = cubic[n, k] * wide ** float(k)
        place[n, _REST] = place[n, _FOURTH] * wide**4.0
        if place[n, _REST] > ENOUGH * max(members.share[group] * abs(best.lower[group]), members.rounding[group]):
            steep[steep_count] = n
            steep_count += 1
    left, k = steep[:steep_count].copy(), 0
    bound, radius = series_of_curves(
        rows, sums, middle, curve[left], parts.piece[left], centre[left], half[left], _BOUND
    )
    for n in range(count):
        member, closer = parts.member[n], np.inf
        if k < steep_count and left[k] == n:
            closer = (abs(bound[k, 0]) + radius[k]) * half[n] ** 4.0
            k += 1
        closer = into_motion(motion, members.curve[member], parts.cubic[n], closer, centre[n], half[n])
        parts.cubic[n, 0] += members.offset[member]
        place[n, _REST] = min(place[n, _REST], closer)
        place[n, _FOURTH] = place[n, _REST] / half[n] ** 4.0
