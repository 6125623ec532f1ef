"""Peaks over the turn where the masses of the rows scatter: the worst masses at the worst angle, bracketed.

Every row adds its part g_r(theta) to a curve d(theta), times 1 + e_r with |e_r| no more than a share p. For one angle
the largest |d + sum e_r g_r| is that along some direction phi, Re(e^{-j phi} d) + p sum_r |Re(e^{-j phi} g_r)|. That is
a search in angle and direction, two numbers however many rows there are. In a cell of both most rows have one sign all
over it, and with these signs they are one polynomial with the curve. The others are bounded by their sizes along its
directions. Where few are left all their signs are tried, so that cells end with one sign for every row and close in on
a peak like those of a curve.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from optimizer.numerics.arrays import Complex, Real
from optimizer.responses.boxes import CellBounds, Cells, look
from optimizer.responses.piecewise_cubics import ROUNDING, Index, Pieces

#: what may hold a peak is cut into so many parts of its angle, or expanded anew
_PARTS, _FINER = 4, 16
#: a rest of this share of the tolerance is no longer what keeps a bracket open
_ENOUGH = 0.125
#: signs of so many rows are tried one by one
_FEW = 3
#: after so many rounds, and after so many coefficients of rows were looked at, which take about half a second, the
#: bracket stays as it is
_MOST_ROUNDS, _MOST_NUMBERS = 100, 2_000_000
#: brackets are narrowed step by step to widths relative to the peaks, and at last to the tolerance: what is broken off
#: has those of the step before
_LEVELS = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 0.0)


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


def worst_peaks(pieces: Pieces, parts: Parts, share: float, offset: Complex, curve: Index, tolerance: Real) -> Worst:
    """Peaks (m,) of |d + offset| over the period, with the worst masses.

    Parameters
    ----------
    share : by which every mass may be off.
    offset : (m,) what is added to the curves.
    curve : (m,) which.
    tolerance : (m,) of upper - lower, relative to lower; rounding sets a limit to it.
    """
    search = _Search(pieces, parts, share, offset, curve, tolerance)
    proven, best = search.run(), search.best
    own = parts.values(curve, best.piece, best.angle)
    value = pieces.source.values(curve, best.piece, best.angle) + share * np.sum(best.signs * own, axis=-1)
    lower = np.abs(value + offset)
    return Worst(best.angle, value, lower, np.maximum(proven, lower) + ROUNDING * search.scale)


@dataclass
class _Best:
    """The best value of each peak."""

    lower: Real
    upper: Real  # of all that can hold no peak above it
    angle: Real
    piece: Index
    signs: Real  # (m, R)


class _Boxes(NamedTuple):
    """Cells with their bounds."""

    cells: Cells
    bounds: CellBounds

    def subset(self, keep: NDArray[np.bool_]) -> "_Boxes":
        return _Boxes(self.cells.subset(keep), CellBounds._make(boxes[keep] for boxes in self.bounds))


class _Search:
    """Cells that may hold a peak, by brackets that become narrower step by step."""

    def __init__(
        self, pieces: Pieces, parts: Parts, share: float, offset: Complex, curve: Index, tolerance: Real
    ) -> None:
        self.pieces, self.parts, self.share, self.offset, self.curve = pieces, parts, share, offset, curve
        self.tolerance, self.level = tolerance, _LEVELS[0]
        self.scale = pieces.size[curve] + np.abs(offset) + share * np.max(parts.largest[curve], axis=-1)
        self.best, self.first = _first(pieces, parts, share, offset, curve, tolerance)
        self.later: list[_Boxes] = []  # what is wide enough for now
        self.spent = self.rounds = 0

    def run(self) -> Real:
        """What no masses come to more than, (m,)."""
        proven = np.full(self.offset.size, np.inf)
        cells = self._expanded(self.first) if self.first.member.size else self.first
        for level in _LEVELS:
            self.level = level
            left = self._still_open(cells)
            while left.cells.member.size and self._afforded(left):
                left = self._still_open(self._finer(left))
            # every cell that is left may hold a peak as large as its upper bound
            most = self.best.upper.copy()
            for boxes in (left, *self.later):
                np.maximum.at(most, boxes.cells.member, boxes.bounds.most)
            proven = np.minimum(proven, most)
            if left.cells.member.size or not any(boxes.cells.member.size for boxes in self.later):
                break
            cells = _together([boxes.cells for boxes in self.later])
            self.later = []
        return proven

    def _above(self, level: float) -> Real:
        """(m,) what holds a peak is above this, brackets as wide as a level or as the tolerance."""
        lower = self.best.lower
        return lower + np.maximum(np.maximum(self.tolerance, level) * np.maximum(lower, 0.0), ROUNDING * self.scale)

    def _still_open(self, cells: Cells) -> _Boxes:
        """Cells that may hold a peak above the best value, and those that hold it. Cells that matter only for
        finer brackets wait for these, and the bracket includes the rest."""
        bounds = look(cells)
        _keep(self.best, cells, bounds)
        boxes = _Boxes(cells._replace(towards=bounds.towards, width=bounds.width), bounds)
        # a peak at a jump of gas forces is steep on one side: what rounding of its angle leaves stays open for ever
        least = bounds.most - bounds.rounding
        now, ever = (least > self._above(level)[cells.member] for level in (self.level, 0.0))
        np.maximum.at(self.best.upper, cells.member[~ever], bounds.most[~ever])
        self.later.append(boxes.subset(ever & ~now))
        return boxes.subset(now)

    def _ways(self, boxes: _Boxes) -> tuple[NDArray[np.bool_], ...]:
        """Which cells are expanded anew, have few signs that are tried, and are cut by direction and by angle."""
        cells, bounds = boxes
        narrow = self._above(self.level) - self.best.lower
        coarse = bounds.rest > _ENOUGH * narrow[cells.member]
        free = np.count_nonzero(bounds.open, axis=-1)
        few = ~coarse & (free > 0) & (free <= _FEW)
        turn = ~coarse & ~few & bounds.by_direction
        return coarse, few, turn, ~(coarse | few | turn)

    def _afforded(self, boxes: _Boxes) -> bool:
        """Count what one more round makes; False where that is too much."""
        coarse, few, turn, cut = self._ways(boxes)
        free = np.count_nonzero(boxes.bounds.open[few], axis=-1)
        count = _FINER * np.sum(coarse) + np.sum(2**free) + 2 * np.sum(turn) + _PARTS * np.sum(cut)
        self.spent += int(count) * boxes.cells.parts[0].size
        self.rounds += 1
        return self.spent <= _MOST_NUMBERS and self.rounds < _MOST_ROUNDS

    def _finer(self, boxes: _Boxes) -> Cells:
        cells, (coarse, few, turn, cut) = boxes.cells, self._ways(boxes)
        finer = self._still_open(cells.subset(coarse).cut(_FINER)).cells
        decided = cells.subset(few).decided(boxes.subset(few).bounds)
        halves = cells.subset(turn).direction_halves()
        return _together([self._expanded(finer), decided, halves, cells.subset(cut).cut(_PARTS)])

    def _expanded(self, cells: Cells) -> Cells:
        """By polynomials of their own."""
        of, half = self.curve[cells.member], cells.half
        cubic = self.pieces.source.cubics(of, cells.piece, cells.centre, half)
        cubic[:, 0] += self.offset[cells.member]
        own = self.share * self.parts.cubics(of, cells.piece, cells.centre, half)
        rests = self.share * self.parts.fourth(of, cells.piece) * half[:, None] ** 4
        free = cells.signs == 0.0
        return cells._replace(
            cubic=cubic + np.sum(cells.signs[..., None] * own, axis=1),
            parts=np.where(free[..., None], own, 0.0),
            rest=self.pieces.rest[of, cells.piece] * (half / self.pieces.half[of, cells.piece]) ** 4
            + np.sum(np.where(free, 0.0, rests), axis=-1),
            rests=np.where(free, rests, 0.0),
        )


def _together(cells: Sequence[Cells]) -> Cells:
    return Cells._make(map(np.concatenate, zip(*cells, strict=True)))


def _first(
    pieces: Pieces, parts: Parts, share: float, offset: Complex, curve: Index, tolerance: Real
) -> tuple[_Best, Cells]:
    """Pieces that may hold a peak, with all directions, beside bounds that need no directions; the polynomials are left
    for later."""
    there = pieces.half[curve] > 0.0
    centred = np.abs(pieces.cubic[curve, :, 0] + offset[:, None])
    most = np.where(there, centred + pieces.reach[curve] + share * parts.largest[curve], -np.inf)
    least = np.where(there, centred - pieces.rest[curve], -np.inf)
    # masses as they are, in the middle of the piece that is largest there
    where, lower = np.argmax(least, axis=-1), np.max(least, axis=-1)
    open_ = most > (lower * (1.0 + tolerance))[:, None]
    member, piece = np.nonzero(open_)
    none = np.zeros(member.size)
    rows = parts.fourth(curve[:1], np.zeros(1, dtype=np.intp)).shape[-1]
    upper, signs = np.max(np.where(open_, -np.inf, most), axis=-1), np.zeros((offset.size, rows))
    best = _Best(lower, upper, pieces.centre[curve, where], where, signs)
    centre, half = pieces.centre[curve[member], piece], pieces.half[curve[member], piece]
    blank, free = np.zeros((member.size, 4), dtype=complex), np.zeros((member.size, rows))
    every = np.full(member.size, np.pi)
    cells = Cells(member, piece, centre, half, blank, blank[:, None], none, none[:, None], none, every, free)
    return best, cells


def _keep(best: _Best, cells: Cells, bounds: CellBounds) -> None:
    """Keep the largest value for each peak where it beats the best."""
    order = np.argsort(bounds.lower, kind="stable")
    largest = np.full(best.lower.size, -1, dtype=np.intp)
    largest[cells.member[order]] = order  # of several for one peak the last counts
    peaks = np.flatnonzero(largest >= 0)
    better = peaks[bounds.lower[largest[peaks]] > best.lower[peaks]]
    new = largest[better]
    best.lower[better], best.angle[better] = bounds.lower[new], bounds.angle[new]
    best.piece[better], best.signs[better] = cells.piece[new], bounds.there[new]
