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
from functools import cache
from math import comb
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from optimizer.arrays import Complex, Real, Reals

Index = NDArray[np.intp]

#: what may hold a peak is cut into so many parts: by its polynomial, or expanded anew, which leaves out 16^-4 as much
_PARTS, _FINER = 4, 16
#: a rest of this share of the tolerance is no longer what keeps a bracket open
_ENOUGH = 0.125
#: after so many cuts in a row the bracket is told as it is
_MOST_CUTS = 40
#: and so it is where so many parts may hold peaks: what is so steep is not worth more time
_MOST_PARTS = 50_000
#: no bracket is narrower than this share of what is added up in it
_ROUNDING = 32 * np.finfo(float).eps
#: rad, by which an angle may be rounded within two turns
_ANGLE_ROUNDING = 64 * np.finfo(float).eps


class Bracket(NamedTuple):
    """Peaks (...) and what is proven of them."""

    angle: Real  # rad, where ``lower`` is attained
    value: Complex  # of the curve there, without the offset; beside a jump the one-sided limit
    lower: Real
    upper: Real  # nothing over the whole period is above it


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

    def peaks(self, offset: Complex, tolerance: Reals, curve: Index | None = None) -> Bracket:
        """Peaks (m,) of |d + offset| over the period.

        Parameters
        ----------
        offset : (m,) in the unit of the curves; where it is nan there is no peak.
        tolerance : (m,) or one for all, of upper - lower, relative to lower; rounding sets a limit to it.
        curve : (m,) which curve each is asked of, by default all in turn.
        """
        known = np.isfinite(offset)
        of_peak = np.arange(offset.size) if curve is None else curve
        asked = np.broadcast_to(tolerance, offset.shape)[known]
        found = _bracketed(self, offset[known], of_peak[known], asked, _SQUARE)
        if np.all(known):
            return found

        def everywhere(values: Any) -> Any:
            whole = np.full(offset.shape, np.nan, dtype=values.dtype)
            whole[known] = values
            return whole

        return Bracket(*(everywhere(each) for each in found))

    def largest(self, sign: float, tolerance: float) -> Bracket:
        """Largest values (J,) of scalars times a sign: 1 for their maxima, -1 for their minima, negated."""
        measure = _Measure(lambda cubic: sign * cubic.real, lambda value: value)
        count = self.half.shape[0]
        return _bracketed(self, np.zeros(count, dtype=complex), np.arange(count), tolerance, measure)


class _Measure(NamedTuple):
    """What a peak is the largest of: a real polynomial made of the cubic (n, 4), and a rising function of it."""

    polynomial: Callable[[Complex], Real]
    size: Callable[[Real], Real]


@dataclass(frozen=True)
class _Parts:
    """Parts of pieces that may hold peaks, (n,)."""

    peak: Index  # which of the peaks
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
        places, shift = _shifts(count)
        again = _Parts(**{name: np.repeat(value, count, axis=0) for name, value in vars(self).items()})
        return replace(
            again,
            centre=(self.centre[:, None] + self.half[:, None] * places).reshape(-1),
            half=again.half / count,
            cubic=np.einsum("nk,pki->npi", self.cubic, shift).reshape(-1, 4),
        )


def _bracketed(pieces: Pieces, offset: Complex, of_peak: Index, tolerance: Reals, measure: _Measure) -> Bracket:
    """Brackets (m,): what is below the best found by less than the tolerance is let go, the rest looked at closer."""
    scale = pieces.size[of_peak] + np.abs(offset)
    angle, piece = np.zeros(offset.size), np.zeros(offset.size, dtype=np.intp)
    lower, upper = np.full(offset.size, np.nan), np.full(offset.size, -np.inf)

    def allowed() -> Real:
        return np.maximum(tolerance * np.abs(lower), _ROUNDING * scale)

    def still_open(parts: _Parts, most_parts: float) -> _Parts:
        """Those that may hold a peak above the best found, theirs included, unless there are too many; the others are
        told in the bracket."""
        if not parts.peak.size:
            return parts
        bernstein = _bernstein(measure.polynomial(parts.cubic))
        most = measure.size(np.max(bernstein, axis=-1)) + parts.rest
        first, final = (measure.size(bernstein[:, end]) - parts.rest for end in (0, -1))
        at_first = first >= final
        _keep_best(
            (lower, angle, piece),
            parts.peak,
            (
                np.where(at_first, first, final),
                parts.centre + np.where(at_first, -parts.half, parts.half),
                parts.piece,
            ),
        )
        open_ = most > (lower + allowed())[parts.peak]
        if np.count_nonzero(open_) > most_parts:
            open_[:] = False
        rounding = _ANGLE_ROUNDING * np.abs(parts.cubic[:, 1]) / parts.half
        np.maximum.at(upper, parts.peak[~open_], (most + rounding)[~open_])
        return parts.chosen(open_)

    parts = still_open(_all_parts(pieces, of_peak, offset), _MOST_PARTS)
    for cuts in range(1, _MOST_CUTS):
        if not parts.peak.size:
            break
        too_coarse = parts.rest > _ENOUGH * allowed()[parts.peak]
        fine = parts.chosen(~too_coarse).cut(_PARTS)
        # most of the finer ones are let go by what is known: an expansion costs far more
        coarse = still_open(parts.chosen(too_coarse).cut(_FINER), np.inf)
        coarse = _expanded(pieces, of_peak, offset, coarse, allowed())
        parts = still_open(fine.and_(coarse), _MOST_PARTS if cuts < _MOST_CUTS - 1 else 0)
    value = pieces.source.values(of_peak, piece, angle)
    lower = measure.size(measure.polynomial((value + offset)[:, None])[:, 0])
    return Bracket(angle, value, lower, upper + _ROUNDING * scale)


def _all_parts(pieces: Pieces, of_peak: Index, offset: Complex) -> _Parts:
    """Every piece of every curve whose peak is asked for."""
    peak, piece = np.nonzero(pieces.half[of_peak] > 0.0)
    where = (of_peak[peak], piece)
    half, rest = pieces.half[where], pieces.rest[where]
    cubic = _moved(pieces.cubic[where], offset[peak])
    return _Parts(peak, piece, pieces.centre[where], half, cubic, rest, rest / half**4)


def _expanded(pieces: Pieces, of_peak: Index, offset: Complex, parts: _Parts, allowed: Real) -> _Parts:
    """The same parts by polynomials of their own; where that does not help enough, with bounds of their own as well."""
    if not parts.peak.size:
        return parts
    curve = of_peak[parts.peak]
    cubic = pieces.source.cubics(curve, parts.piece, parts.centre, parts.half)
    rest = parts.fourth * parts.half**4
    steep = rest > _ENOUGH * allowed[parts.peak]
    if np.any(steep):
        some = parts.chosen(steep)
        rest[steep] = np.minimum(rest[steep], pieces.source.rests(curve[steep], some.piece, some.centre, some.half))
    return replace(parts, cubic=_moved(cubic, offset[parts.peak]), rest=rest, fourth=rest / parts.half**4)


def _keep_best(best: tuple[Real, Real, Index], peak: Index, found: tuple[Real, Real, Index]) -> None:
    """Put the largest of the values found for each peak, and what belongs to it, where it beats the best so far."""
    order = np.argsort(found[0], kind="stable")
    largest = np.full(best[0].size, -1, dtype=np.intp)
    largest[peak[order]] = order  # of several for one peak the last counts
    better = np.flatnonzero((largest >= 0) & ~(found[0][largest] <= best[0]))
    for kept, new in zip(best, found, strict=True):
        kept[better] = new[largest[better]]


def _moved(cubic: Complex, offset: Complex) -> Complex:
    """Polynomials (..., k) with a constant (...) added."""
    return np.concatenate([cubic[..., :1] + offset[..., None], cubic[..., 1:]], axis=-1)


def _squared(polynomial: Complex) -> Real:
    """|p|^2 of polynomials (..., k) of a real variable: (..., 2 k - 1)."""
    count = polynomial.shape[-1]
    found = np.zeros((*polynomial.shape[:-1], 2 * count - 1))
    for i in range(count):
        found[..., i : i + count] += (polynomial[..., i : i + 1] * np.conj(polynomial)).real
    return found


_SQUARE = _Measure(_squared, lambda value: np.sqrt(np.maximum(value, 0.0)))


def _bernstein(polynomial: Real) -> Real:
    """Bernstein coefficients on [-1, 1] of polynomials (n, k); the first and last are the values at the ends."""
    return polynomial @ _to_bernstein(polynomial.shape[-1] - 1)


@cache
def _to_bernstein(degree: int) -> Real:
    """(degree + 1, degree + 1): x^k = (2 t - 1)^k, and t^i = sum_j C(j, i) / C(degree, i) B_j(t)."""
    in_t = [[comb(k, i) * 2.0**i * (-1.0) ** (k - i) for i in range(degree + 1)] for k in range(degree + 1)]
    raised = [[comb(j, i) / comb(degree, i) for j in range(degree + 1)] for i in range(degree + 1)]
    return np.array(in_t) @ np.array(raised)


@cache
def _shifts(parts: int) -> tuple[Real, NDArray[np.float64]]:
    """Centres (parts,) of equal parts of [-1, 1], and what takes a cubic to each of them (parts, 4, 4)."""
    places = (2.0 * np.arange(parts) + 1.0) / parts - 1.0
    matrix = [
        [[comb(k, i) * place ** (k - i) * parts**-i if i <= k else 0.0 for i in range(4)] for k in range(4)]
        for place in places.tolist()
    ]
    return places, np.array(matrix)
