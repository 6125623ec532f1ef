"""Peaks over the turn where the masses of the rows scatter: the worst masses at the worst angle, bracketed.

Every row adds its part g_r(theta) to a curve d(theta), times 1 + e_r with |e_r| no more than a share p. For one angle
the largest |d + sum e_r g_r| is that along some direction phi, Re(e^{-j phi} d) + p sum_r |Re(e^{-j phi} g_r)|: a
search in angle and direction, two numbers however many rows there are. In a cell of both most rows have one sign all
over it, and with these signs they are one polynomial with the curve; the others are bounded by what they may come to
along its directions. Where few are left all their signs are tried, so that cells end with one sign for every row and
close in on a peak like those of a curve.
"""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.cells import Cells, Seen, look
from optimizer.pieces import ROUNDING, Index, Pieces

#: what may hold a peak is cut into so many parts of its angle, or expanded anew
_PARTS, _FINER = 4, 16
#: a rest of this share of the tolerance is no longer what keeps a bracket open
_ENOUGH = 0.125
#: signs of so many rows are tried one by one
_FEW = 3
#: after so many cuts the bracket is told as it is, and after so many coefficients of rows were looked at
_MOST_CUTS, _MOST_NUMBERS = 60, 4_000_000


class Parts(Protocol):
    """What rows add to J curves, each by itself, over the pieces of the curves."""

    @property
    def largest(self) -> Real:
        """What all parts of a curve come to together at most, (J, P)."""

    def fourth(self, curve: Index, piece: Index) -> Real:
        """Bounds (m, R) on fourth coefficients all over pieces."""

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (m, R, 4) about centres (m,) rad within pieces, in units of half widths."""

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        """Values (m, R) at angles (m,) rad within pieces, ends included."""

    def at(self, curve: int, angle: Real) -> Complex:
        """Values (n, R) at angles (n,) rad."""


class Worst(NamedTuple):
    """Peaks (m,) with the worst masses."""

    angle: Real  # rad, where ``lower`` is attained
    value: Complex  # of the curve there with these masses, without the offset
    lower: Real
    upper: Real  # no masses come to more, at any angle


@dataclass
class _Best:
    """The best found of each peak."""

    lower: Real
    upper: Real
    angle: Real
    piece: Index
    signs: Real  # (m, R)


def worst_peaks(pieces: Pieces, parts: Parts, share: float, offset: Complex, curve: Index, tolerance: Real) -> Worst:
    """Peaks (m,) of |d + offset| over the period, with the worst masses.

    Parameters
    ----------
    share : by which every mass may be off.
    offset : (m,) what is added to the curves.
    curve : (m,) which.
    tolerance : (m,) of upper - lower, relative to lower; rounding sets a limit to it.
    """
    count = offset.size
    scale = pieces.size[curve] + np.abs(offset) + share * np.max(parts.largest[curve], axis=-1)
    nowhere = np.zeros(count, dtype=np.intp)
    best = _Best(np.full(count, -np.inf), np.full(count, -np.inf), np.zeros(count), nowhere, np.zeros((count, 1)))

    def allowed() -> Real:
        return np.maximum(tolerance * np.maximum(best.lower, 0.0), ROUNDING * scale)

    def still_open(cells: Cells) -> tuple[Cells, Seen]:
        """Those that may hold a peak above the best found, theirs included; the others are told in the bracket."""
        seen = look(cells)
        _keep(best, cells, seen)
        open_ = seen.most > (best.lower + allowed())[cells.member]
        np.maximum.at(best.upper, cells.member[~open_], seen.most[~open_])
        kept = cells.chosen(open_)._replace(towards=seen.towards[open_], width=seen.width[open_])
        return kept, Seen._make(each[open_] for each in seen)

    def expanded(cells: Cells) -> Cells:
        """By polynomials of their own."""
        of, half = curve[cells.member], cells.half
        cubic = pieces.source.cubics(of, cells.piece, cells.centre, half)
        cubic[:, 0] += offset[cells.member]
        own = share * parts.cubics(of, cells.piece, cells.centre, half)
        rests = share * parts.fourth(of, cells.piece) * half[:, None] ** 4
        free = cells.signs == 0.0
        return cells._replace(
            cubic=cubic + np.sum(cells.signs[..., None] * own, axis=1),
            parts=np.where(free[..., None], own, 0.0),
            rest=pieces.rest[of, cells.piece] * (half / pieces.half[of, cells.piece]) ** 4
            + np.sum(np.where(free, 0.0, rests), axis=-1),
            rests=np.where(free, rests, 0.0),
        )

    cells, seen = still_open(expanded(_first(pieces, parts, share, offset, curve, tolerance, best)))
    spent = 0
    for cuts in range(1, _MOST_CUTS):
        if not cells.member.size:
            break
        coarse = seen.rest > _ENOUGH * allowed()[cells.member]
        count = np.count_nonzero(seen.open, axis=-1)
        few = ~coarse & (count > 0) & (count <= _FEW)
        turn = ~coarse & ~few & seen.by_direction
        cut = ~(coarse | few | turn)
        # what these make
        made = _FINER * np.sum(coarse) + np.sum(2 ** count[few]) + 2 * np.sum(turn) + _PARTS * np.sum(cut)
        spent += int(made) * cells.parts[0].size
        if spent > _MOST_NUMBERS or cuts == _MOST_CUTS - 1:
            np.maximum.at(best.upper, cells.member, seen.most)
            break
        finer, _ = still_open(cells.chosen(coarse).cut(_FINER))
        known = Seen._make(each[few] for each in seen)
        again = [expanded(finer), cells.chosen(few).decided(known), cells.chosen(turn).turned()]
        again.append(cells.chosen(cut).cut(_PARTS))
        cells, seen = still_open(Cells._make(map(np.concatenate, zip(*again, strict=True))))
    signs = best.signs
    own = parts.values(curve, best.piece, best.angle)
    value = pieces.source.values(curve, best.piece, best.angle) + share * np.sum(signs * own, axis=-1)
    lower = np.abs(value + offset)
    return Worst(best.angle, value, lower, np.maximum(best.upper, lower) + ROUNDING * scale)


def _first(
    pieces: Pieces, parts: Parts, share: float, offset: Complex, curve: Index, tolerance: Real, best: _Best
) -> Cells:
    """Pieces that may hold a peak, with all directions; the polynomials are left for later."""
    there = pieces.half[curve] > 0.0
    centred = np.abs(pieces.cubic[curve, :, 0] + offset[:, None])
    most = np.where(there, centred + pieces.reach[curve] + share * parts.largest[curve], -np.inf)
    known = np.max(np.where(there, centred - pieces.rest[curve], -np.inf), axis=-1)
    open_ = most > (known * (1.0 + tolerance))[:, None]
    best.upper = np.max(np.where(open_, -np.inf, most), axis=-1)
    member, piece = np.nonzero(open_)
    none = np.zeros(member.size)
    rows = parts.fourth(curve[:1], np.zeros(1, dtype=np.intp)).shape[-1]
    best.signs = np.zeros((offset.size, rows))
    centre, half = pieces.centre[curve[member], piece], pieces.half[curve[member], piece]
    blank, free = np.zeros((member.size, 4), dtype=complex), np.zeros((member.size, rows))
    every = np.full(member.size, np.pi)
    return Cells(member, piece, centre, half, blank, blank[:, None], none, none[:, None], none, every, free)


def _keep(best: _Best, cells: Cells, seen: Seen) -> None:
    """Keep the largest value for each peak where it beats the best."""
    order = np.argsort(seen.lower, kind="stable")
    largest = np.full(best.lower.size, -1, dtype=np.intp)
    largest[cells.member[order]] = order  # of several for one peak the last counts
    some = np.flatnonzero(largest >= 0)
    better = some[seen.lower[largest[some]] > best.lower[some]]
    new = largest[better]
    best.lower[better], best.angle[better] = seen.lower[new], seen.angle[new]
    best.piece[better], best.signs[better] = cells.piece[new], seen.there[new]
