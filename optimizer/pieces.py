"""Curves over a period, piece by piece a cubic with a bound on what it leaves out, and their exact peaks.

Between the angles at which it jumps or has a kink a curve d is smooth. On a piece of half width h about its centre the
Taylor polynomial of degree 3 leaves out at most h^4/24 max|d''''|, the ``rest``. So the peak of |d + offset| over a
piece is at most sqrt(max |cubic + offset|^2) + rest, and a polynomial is nowhere above the largest of its Bernstein
coefficients, which close in on it fourfold with every halving. Pieces that cannot hold the peak are let go; those whose
rest is too coarse are expanded anew about more centres. So a peak is bracketed as narrowly as wished, also where
|d + offset| hardly changes over the turn, as it does at an optimum.

Shapes: J curves of P pieces each. A vector across the shaft is complex, x + jy; a scalar is real.
Source: R. T. Farouki, The Bernstein polynomial basis: a centennial retrospective, CAGD 29 (2012).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from optimizer.arrays import Complex, Real, Reals
from optimizer.polynomials import bernstein, shifts, squared

Index = NDArray[np.intp]
#: real for scalars, complex across the shaft
Vector = NDArray[Any]

#: what may hold a peak is cut into so many parts: by its polynomial, or expanded anew, which leaves out 16^-4 as much
_PARTS, _FINER = 4, 16
#: a rest of this share of the tolerance is no longer what keeps a bracket open
_ENOUGH = 0.125
#: after so many cuts in a row the bracket is told as it is
_MOST_CUTS = 40
#: and so it is where so many parts may hold peaks: what is so steep is not worth more time
_MOST_PARTS = 50_000
#: no bracket is narrower than this share of what is added up in it
ROUNDING = 32 * np.finfo(float).eps
#: rad, by which an angle may be rounded within two turns
ANGLE_ROUNDING = 64 * np.finfo(float).eps


class Bracket(NamedTuple):
    """Peaks (...) and what is proven of them."""

    angle: Real  # rad, where ``lower`` is attained
    value: Complex  # of the curve there, without the offset; beside a jump the one-sided limit
    lower: Real
    upper: Real  # nothing over the whole period is above it

    def where(self, known: NDArray[np.bool_]) -> "Bracket":
        """The same, nan where nothing is known (...)."""
        return self if np.all(known) else Bracket(*(np.where(known, each, np.nan) for each in self))


class Source(Protocol):
    """What the pieces of curves are made from."""

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (m, 4) about other centres (m,) rad within given pieces."""

    def rests(self, curve: Index, piece: Index, centre: Real, half: Real) -> Real:
        """Bounds (m,) on what these leave out within half widths (m,) rad."""

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        """Values (m,) at angles (m,) rad within given pieces; at their ends the one-sided limits."""


@dataclass(frozen=True)
class Pieces:
    """J curves over one period.

    centre, half : (J, P) rad; half is 0 where two breaks coincide.
    cubic : (J, P, 4) coefficients of ((angle - centre) / half)^k; real for scalars.
    rest : (J, P) bounds on what they leave out, half^4/24 times the largest fourth derivative.
    size : (J,) of the terms that are added up in a curve: no bracket is narrower than their rounding.
    source : of finer ones.
    """

    centre: Real
    half: Real
    cubic: Complex
    rest: Real
    size: Real
    source: Source

    @cached_property
    def reach(self) -> Real:
        """How far the curves may be from the middle of their pieces, (J, P)."""
        return np.sum(np.abs(self.cubic[..., 1:]), axis=-1) + self.rest

    def peaks(
        self, offset: Vector, tolerance: Reals, curve: Index | None = None, group: Index | None = None
    ) -> Bracket:
        """Peaks (m,) of |d + offset| over the period.

        Parameters
        ----------
        offset : (m,) in the unit of the curves; where it is nan there is no peak.
        tolerance : (m,) or one for all, of upper - lower, relative to lower; rounding sets a limit to it.
        curve : (m,) which curve each is asked of, by default all in turn.
        group : (m,) from 0, where only the largest of each group is asked for, which costs less: peaks (groups,).
        """
        of_member = np.arange(offset.size) if curve is None else curve
        sought = np.arange(offset.size) if group is None else group
        known = np.isfinite(offset)
        asked, count = np.broadcast_to(tolerance, offset.shape), int(np.max(sought, initial=-1)) + 1
        if not np.all(known):
            offset, of_member, asked, sought = offset[known], of_member[known], asked[known], sought[known]
        return _bracketed(self, offset, of_member, sought, count, asked, _SQUARE)

    def largest(self, sign: float, tolerance: float) -> Bracket:
        """Largest values (J,) of scalars times a sign: 1 for their maxima, -1 for their minima, negated."""
        measure = _Measure(lambda cubic: sign * cubic.real, lambda value: value)
        every = np.arange(self.half.shape[0])
        return _bracketed(self, np.zeros(every.size), every, every, every.size, np.full(every.size, tolerance), measure)


class _Measure(NamedTuple):
    """What a peak is the largest of: a real polynomial made of the cubic (n, 4), and a rising function of it."""

    polynomial: Callable[[Complex], Real]
    size: Callable[[Real], Real]


@dataclass(frozen=True)
class _Parts:
    """Parts of pieces that may hold peaks, (n,)."""

    member: Index  # whose peak
    piece: Index
    centre: Real
    half: Real
    cubic: Complex  # (n, 4), offset included
    rest: Real
    fourth: Real  # rest of an expansion about the centre, over half^4

    def chosen(self, keep: NDArray[np.bool_]) -> "_Parts":
        return _Parts(**{name: value[keep] for name, value in vars(self).items()})

    def and_(self, other: "_Parts") -> "_Parts":
        return _Parts(**{name: np.concatenate([value, getattr(other, name)]) for name, value in vars(self).items()})

    def cut(self, count: int) -> "_Parts":
        """Each in so many parts, by the same polynomial."""
        places, shift = shifts(count)
        again = _Parts(**{name: np.repeat(value, count, axis=0) for name, value in vars(self).items()})
        return replace(
            again,
            centre=(self.centre[:, None] + self.half[:, None] * places).reshape(-1),
            half=again.half / count,
            cubic=np.einsum("nk,pki->npi", self.cubic, shift).reshape(-1, 4),
        )


@dataclass
class _Best:
    """The best found of each of G peaks, and what nothing is above."""

    lower: Real
    upper: Real
    angle: Real
    piece: Index
    member: Index

    @staticmethod
    def of(count: int) -> "_Best":
        """Nothing found yet."""
        nowhere = np.zeros(count, dtype=np.intp)
        return _Best(np.full(count, np.nan), np.full(count, -np.inf), np.zeros(count), nowhere, nowhere.copy())

    def keep(self, peak: Index, value: Real, angle: Real, piece: Index, member: Index) -> None:
        """Keep the largest of the values (n,) for each peak, and what belongs to it, where it beats the best."""
        order = np.argsort(value, kind="stable")
        largest = np.full(self.lower.size, -1, dtype=np.intp)
        largest[peak[order]] = order  # of several for one peak the last counts
        better = np.flatnonzero((largest >= 0) & ~(value[largest] <= self.lower))
        for kept, new in zip(
            (self.lower, self.angle, self.piece, self.member), (value, angle, piece, member), strict=True
        ):
            kept[better] = new[largest[better]]


def _bracketed(
    pieces: Pieces, offset: Vector, of_member: Index, group: Index, count: int, tolerance: Real, measure: _Measure
) -> Bracket:
    """Brackets (count,), nan where a peak has no member.

    What is below the best found by less than the tolerance is let go, the rest looked at closer.

    Parameters
    ----------
    offset, of_member, group, tolerance : (m,) of every member: its curve, and the peak to which it belongs.
    """
    scale, share = np.zeros(count), np.zeros(count)
    np.maximum.at(scale, group, pieces.size[of_member] + np.abs(offset))
    np.maximum.at(share, group, tolerance)
    best = _Best.of(count)

    def allowed() -> Real:
        return np.maximum(share * np.abs(best.lower), ROUNDING * scale)

    def first_open() -> _Parts:
        """The pieces that may hold a peak above the best value at a centre, by how far a cubic may be from it."""
        rows = np.arange(of_member.size)
        in_turn = of_member.size == pieces.half.shape[0] and np.array_equal(of_member, rows)
        every = slice(None) if in_turn else of_member
        there = pieces.half[every] > 0.0
        centred = pieces.cubic[every, :, 0] + offset[:, None]
        middle = measure.size(measure.polynomial(centred[..., None])[..., 0])
        least = np.where(there, middle - pieces.rest[every], -np.inf)
        where = np.argmax(least, axis=-1)
        best.keep(group, least[rows, where], pieces.centre[every][rows, where], where, rows)
        most = np.where(there, middle + pieces.reach[every], -np.inf)
        open_ = most > (best.lower + allowed())[group][:, None]
        np.maximum.at(best.upper, group, np.max(np.where(open_, -np.inf, most), axis=-1))
        member, piece = np.nonzero(open_)
        at = (of_member[member], piece)
        half, rest, cubic = pieces.half[at], pieces.rest[at], _moved(pieces.cubic[at], offset[member])
        return still_open(_Parts(member, piece, pieces.centre[at], half, cubic, rest, rest / half**4), _MOST_PARTS)

    def still_open(parts: _Parts, most_parts: float) -> _Parts:
        """Those that may hold a peak above the best found, theirs included, unless there are too many; the others are
        told in the bracket."""
        if not parts.member.size:
            return parts
        coefficients = bernstein(measure.polynomial(parts.cubic))
        most = measure.size(np.max(coefficients, axis=-1)) + parts.rest
        first, final = (measure.size(coefficients[:, end]) - parts.rest for end in (0, -1))
        at_first, peak = first >= final, group[parts.member]
        angle = parts.centre + np.where(at_first, -parts.half, parts.half)
        best.keep(peak, np.where(at_first, first, final), angle, parts.piece, parts.member)
        open_ = most > (best.lower + allowed())[peak]
        if np.count_nonzero(open_) > most_parts:
            open_[:] = False
        rounding = ANGLE_ROUNDING * np.abs(parts.cubic[:, 1]) / parts.half
        np.maximum.at(best.upper, peak[~open_], (most + rounding)[~open_])
        return parts.chosen(open_)

    parts = first_open()
    for cuts in range(1, _MOST_CUTS):
        if not parts.member.size:
            break
        too_coarse = parts.rest > _ENOUGH * allowed()[group[parts.member]]
        fine = parts.chosen(~too_coarse).cut(_PARTS)
        # most of the finer ones are let go by what is known: an expansion costs far more
        coarse = still_open(parts.chosen(too_coarse).cut(_FINER), np.inf)
        coarse = _expanded(pieces, of_member, offset, coarse, allowed()[group[coarse.member]])
        parts = still_open(fine.and_(coarse), _MOST_PARTS if cuts < _MOST_CUTS - 1 else 0)
    if not group.size:
        return Bracket(*(np.full(count, np.nan) for _ in range(4)))
    value = pieces.source.values(of_member[best.member], best.piece, best.angle)
    lower = measure.size(measure.polynomial((value + offset[best.member])[:, None])[:, 0])
    return Bracket(best.angle, value, lower, best.upper + ROUNDING * scale).where(np.isin(np.arange(count), group))


def _expanded(pieces: Pieces, of_member: Index, offset: Vector, parts: _Parts, allowed: Real) -> _Parts:
    """The same parts (n,) by polynomials of their own; where that does not help enough, with bounds of their own too.

    Parameters
    ----------
    allowed : (n,) how wide the bracket may be.
    """
    if not parts.member.size:
        return parts
    curve = of_member[parts.member]
    cubic = pieces.source.cubics(curve, parts.piece, parts.centre, parts.half)
    rest = parts.fourth * parts.half**4
    steep = rest > _ENOUGH * allowed
    if np.any(steep):
        some = parts.chosen(steep)
        rest[steep] = np.minimum(rest[steep], pieces.source.rests(curve[steep], some.piece, some.centre, some.half))
    return replace(parts, cubic=_moved(cubic, offset[parts.member]), rest=rest, fourth=rest / parts.half**4)


def _moved(cubic: Vector, offset: Vector) -> Vector:
    """Polynomials (..., k) with a constant (...) added."""
    return np.concatenate([cubic[..., :1] + offset[..., None], cubic[..., 1:]], axis=-1)


_SQUARE = _Measure(squared, lambda value: np.sqrt(np.maximum(value, 0.0)))
