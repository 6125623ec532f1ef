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

from optimizer.arrays import Complex, Real

Index = NDArray[np.intp]

#: what is too coarse is cut into so many parts
_PARTS = 4
#: after so many cuts in a row the bracket is told as it is
_MOST_CUTS = 40
#: no bracket is narrower than this share of what is added up in it
_ROUNDING = 32 * np.finfo(float).eps


class Bracket(NamedTuple):
    """Peaks (...) and what is proven of them."""

    angle: Real  # rad, where ``lower`` is attained
    value: Complex  # of the curve there, without the offset; beside a jump the one-sided limit
    lower: Real
    upper: Real  # nothing over the whole period is above it


class Expansion(NamedTuple):
    """Taylor polynomials of pieces, and bounds on what they leave out."""

    cubic: Complex  # (..., 4) coefficients of ((angle - centre) / half)^k; real for scalars
    rest: Real  # (...)


class Source(Protocol):
    """What the pieces of curves are made from."""

    def expansion(self, curve: Index, piece: Index, centre: Real, half: Real) -> Expansion:
        """Expansions within given pieces about centres (m,), rad; where ``half`` is 0 the values there."""


@dataclass(frozen=True)
class Pieces:
    """J curves over one period.

    centre, half : (J, P) rad; half is 0 where two breaks coincide.
    expansion : (J, P, 4) and (J, P).
    source : of finer ones.
    """

    centre: Real
    half: Real
    expansion: Expansion
    source: Source

    def peaks(self, offset: Complex, tolerance: float, curve: Index | None = None) -> Bracket:
        """Peaks (m,) of |d + offset| over the period.

        Parameters
        ----------
        offset : (m,) in the unit of the curves.
        tolerance : of upper - lower, relative to lower; rounding sets a limit to it.
        curve : (m,) which curve each is asked of, by default all in turn.
        """
        return _bracketed(self, np.asarray(offset, dtype=complex), curve, tolerance, _SQUARE)

    def largest(self, sign: float, tolerance: float) -> Bracket:
        """Largest values (J,) of scalars times a sign: 1 for their maxima, -1 for their minima, negated."""
        measure = _Measure(lambda cubic: sign * cubic.real, lambda value: value)
        return _bracketed(self, np.zeros(self.half.shape[0], dtype=complex), None, tolerance, measure)

    @property
    def mean(self) -> Complex:
        """Mean over the period (J,), but for the rests."""
        return self._mean_of(self.expansion.cubic)

    @property
    def variance(self) -> Real:
        """Mean of |d - mean|^2 over the period (J,), but for the rests."""
        return self._mean_of(_squared(_moved(self.expansion.cubic, -self.mean[:, None])))

    def _mean_of(self, polynomial: Any) -> Any:
        power = np.arange(polynomial.shape[-1])
        over_piece = polynomial @ np.where(power % 2 == 0, 1.0 / (power + 1.0), 0.0)
        return np.sum(over_piece * (self.half / np.sum(self.half, axis=-1, keepdims=True)), axis=-1)


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

    def chosen(self, keep: NDArray[np.bool_]) -> "_Parts":
        return _Parts(**{name: value[keep] for name, value in vars(self).items()})

    def and_(self, other: "_Parts") -> "_Parts":
        return _Parts(**{name: np.concatenate([value, getattr(other, name)]) for name, value in vars(self).items()})

    def cut(self) -> "_Parts":
        """Each in parts, by the same polynomial."""
        places, shift = _shifts(_PARTS)
        again = _Parts(**{name: np.repeat(value, _PARTS, axis=0) for name, value in vars(self).items()})
        return replace(
            again,
            centre=(self.centre[:, None] + self.half[:, None] * places).reshape(-1),
            half=again.half / _PARTS,
            cubic=np.einsum("nk,pki->npi", self.cubic, shift).reshape(-1, 4),
        )


def _bracketed(pieces: Pieces, offset: Complex, curve: Index | None, tolerance: float, measure: _Measure) -> Bracket:
    """Brackets (m,): what is below the best found by less than the tolerance is let go, the rest looked at closer."""
    of_peak = np.arange(offset.size) if curve is None else np.asarray(curve)
    parts = _all_parts(pieces, of_peak, offset)
    scale = np.zeros(offset.size)
    np.maximum.at(scale, parts.peak, np.sum(np.abs(parts.cubic), axis=-1) + parts.rest)
    scale += np.abs(offset)
    angle, piece = np.zeros(offset.size), np.zeros(offset.size, dtype=np.intp)
    lower, upper = np.full(offset.size, -np.inf), np.full(offset.size, -np.inf)
    for cuts in range(_MOST_CUTS):
        bernstein = _bernstein(measure.polynomial(parts.cubic))
        most = measure.size(np.max(bernstein, axis=-1)) + parts.rest
        first, last = (measure.size(bernstein[:, end]) - parts.rest for end in (0, -1))
        at_first = first >= last
        _keep_best(
            (lower, angle, piece),
            parts.peak,
            (
                np.where(at_first, first, last),
                parts.centre + np.where(at_first, -parts.half, parts.half),
                parts.piece,
            ),
        )
        allowed = np.maximum(tolerance * np.abs(lower), _ROUNDING * scale)
        open_ = most > (lower + allowed)[parts.peak]
        if cuts == _MOST_CUTS - 1:
            open_[:] = False
        np.maximum.at(upper, parts.peak[~open_], most[~open_])
        if not np.any(open_):
            break
        parts, too_coarse = parts.chosen(open_), (parts.rest > 0.125 * allowed[parts.peak])[open_]
        fine = parts.chosen(~too_coarse).cut()
        coarse = _expanded(pieces, of_peak, offset, parts.chosen(too_coarse).cut())
        parts = fine.and_(coarse)
    value = pieces.source.expansion(of_peak, piece, angle, np.zeros_like(angle)).cubic[:, 0]
    lower = measure.size(measure.polynomial((value + offset)[:, None])[:, 0])
    return Bracket(angle, value, lower, upper + _ROUNDING * scale)


def _all_parts(pieces: Pieces, of_peak: Index, offset: Complex) -> _Parts:
    """Every piece of every curve whose peak is asked for."""
    half = pieces.half[of_peak]
    peak, piece = np.nonzero(half > 0.0)
    where = (of_peak[peak], piece)
    return _Parts(
        peak,
        piece,
        pieces.centre[where],
        half[peak, piece],
        _moved(pieces.expansion.cubic[where], offset[peak]),
        pieces.expansion.rest[where],
    )


def _expanded(pieces: Pieces, of_peak: Index, offset: Complex, parts: _Parts) -> _Parts:
    """The same parts by polynomials of their own."""
    if not parts.peak.size:
        return parts
    found = pieces.source.expansion(of_peak[parts.peak], parts.piece, parts.centre, parts.half)
    # a part is never worse known than what it is a part of
    return replace(parts, cubic=_moved(found.cubic, offset[parts.peak]), rest=np.minimum(found.rest, parts.rest))


def _keep_best(best: tuple[Real, Real, Index], peak: Index, found: tuple[Real, Real, Index]) -> None:
    """Put the largest of the values found for each peak, and what belongs to it, where it beats the best so far."""
    order = np.argsort(found[0], kind="stable")
    largest = np.full(best[0].size, -1, dtype=np.intp)
    largest[peak[order]] = order  # of several for one peak the last counts
    better = np.flatnonzero((largest >= 0) & (found[0][largest] > best[0]))
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
