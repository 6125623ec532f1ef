"""Quantities over the turn at angles all over it: their cuts lead close to an optimum in no time.

Every piece is looked at in a few places by its cubic, which costs next to nothing, and where that leaves out much by
the curve itself. Where a quantity may be largest, at the vertex of parabolas through three places, the curve is
evaluated in any case: so every sample is a true value.

Shapes: Q curves of one source, P pieces, S places in each.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.enclosing_circle import smallest_circle
from optimizer.program.cuts.cut import DUST, Cut, Evaluation, Quantity, Scatter
from optimizer.responses.boxes import worst_masses
from optimizer.responses.curve import TurnResponse
from optimizer.responses.piecewise_cubics import Index

#: in every piece, as shares of its half width; at its ends on the side of the piece
_PLACES = np.linspace(-1.0, 1.0, 7) * (1.0 - 1e-7)
_EXPONENTS = np.arange(_PLACES.size)
_POWERS = _PLACES ** _EXPONENTS[:, None]
#: from values at the places to the polynomial through them
_TO_POLYNOMIAL = np.linalg.inv(_POWERS)
#: share of what is added up from which on a cubic leaves out much
_STEEP = 1e-6
_BETWEEN = float(_PLACES[1] - _PLACES[0])
_BESIDE = np.arange(-1, 2)
#: distance of places, as a share of that, for the second search about a vertex
_CLOSER = 0.0625
#: largest number of local maxima that a curve returns
_MOST = 4
#: share by which a curve may be above what its cubic shows
_ABOUT = 1e-3
#: circles about a curve that are tried, and the change of their radius that ends it
_MOST_CIRCLES, _STEADY = 12, 1e-9
#: share of the largest radius below which a circle is good enough as it is
_SMALL = 0.9

#: squares of what a peak is the largest of: from curves, shaft angles and the numbers of the curves, all alike in shape
_Squares = Callable[[Complex, Real, Index], Real]


class _Maxima(NamedTuple):
    """Local maxima (m,), by curve and the highest first."""

    curve: Index
    piece: Index
    angle: Real  # rad
    value: Complex  # about that of the curve

    def subset(self, places: Index) -> "_Maxima":
        return _Maxima._make(field[places] for field in self)


def _concatenation(maxima: Sequence[_Maxima | None]) -> _Maxima:
    return _Maxima._make(map(np.concatenate, zip(*filter(None, maxima), strict=True)))


class _Curves:
    """Curves that are looked at together: what is added to them stands still, or it is only one."""

    def __init__(self, responses: Sequence[TurnResponse]) -> None:
        pieces = responses[0].curves.pieces
        self.number: Index = np.array([response.number for response in responses], dtype=np.intp)
        self.source = pieces.source
        self.piece = np.flatnonzero(pieces.half[self.number[0]] > 0.0)
        self.centre, self.half = (array[self.number[0], self.piece] for array in (pieces.centre, pieces.half))
        self.angle = self.centre[:, None] + self.half[:, None] * _PLACES
        values = pieces.cubic[self.number[:, None], self.piece] @ _POWERS[:4]
        size = pieces.size[self.number]
        self.nothing = ~(np.max(np.abs(values), axis=(-2, -1)) > DUST * size)
        steep = np.any(pieces.rest[self.number[:, None], self.piece] > _STEEP * size[:, None], axis=0)
        if np.any(steep):
            there = responses[0].curves.at(self.angle[steep].ravel())[self.number]
            values[:, steep] = there.reshape(self.number.size, -1, _PLACES.size)
        self.values: Complex = np.where(self.nothing[:, None, None], 0.0, values)
        self.polynomial: Complex = self.values @ _TO_POLYNOMIAL

    def squares(self, of: _Squares) -> Real:
        """At all places (Q, P, S)."""
        return of(self.values, self.angle, np.arange(self.number.size)[:, None, None])

    def maxima(self, of: _Squares, least: Real) -> _Maxima:
        """Local maxima above the square roots of ``least`` (Q,), of every curve the highest at any rate."""
        square = self.squares(of)
        place = np.argmax(square, axis=-1)
        middle = np.clip(place, 1, _PLACES.size - 2)
        around = np.take_along_axis(square, middle[..., None] + _BESIDE, axis=-1)
        step, highest = _vertex(around, place - middle)
        largest = np.max(highest, axis=-1, keepdims=True)
        # of two pieces that meet in a maximum it belongs to one
        local = (highest > np.roll(highest, 1, axis=-1)) & (highest >= np.roll(highest, -1, axis=-1))
        local &= highest >= np.minimum(least[:, None], largest) * (1.0 - _ABOUT)
        # of a constant none is above another
        local[~np.any(local, axis=-1), 0] = True
        curve, piece = np.nonzero(local)
        order = np.lexsort((-highest[curve, piece], curve))
        curve, piece = curve[order], piece[order]
        few = np.arange(curve.size) - np.searchsorted(curve, curve) < _MOST
        curve, piece = curve[few], piece[few]
        # once more, closer
        width = _BETWEEN * _CLOSER
        at = _PLACES[middle[curve, piece]] + _BETWEEN * step[curve, piece]
        near = np.clip(at, width - 1.0, 1.0 - width)[:, None] + width * _BESIDE
        polynomial, half = self.polynomial[curve, piece], self.half[piece]
        around = of(_at(polynomial, near), self.centre[piece, None] + half[:, None] * near, curve[:, None])
        step, _ = _vertex(around, np.argmax(around, axis=-1) - 1)
        at = np.clip(near[:, 1] + width * step, -1.0, 1.0)
        value = _at(polynomial, at[:, None])[:, 0]
        return _Maxima(curve, self.piece[piece], self.centre[piece] + half * at, value)

    def true(self, maxima: _Maxima) -> Complex:
        """The curves at their maxima (m,)."""
        values = self.source.values(self.number[maxima.curve], maxima.piece, maxima.angle)
        return np.where(self.nothing[maxima.curve], 0.0, values)

    def supports(self) -> _Maxima:
        """What holds the smallest circles, closely of those that are not much smaller than the largest."""
        # of a third of the places, to begin with
        circles = [smallest_circle(entry[:, ::3].ravel()) for entry in self.values]
        least = np.full(len(circles), np.inf)
        support: list[_Maxima | None] = [None] * len(circles)
        open_ = list(range(len(circles)))
        for _ in range(_MOST_CIRCLES):
            centre = np.array([entry.centre for entry in circles])
            every = self.maxima(_about(centre), least)
            still: list[int] = []
            for k in open_:
                points = _concatenation([support[k], every.subset(every.curve == k)])
                circle = smallest_circle(points.value)
                support[k] = points.subset(circle.support)
                before, circles[k] = circles[k].radius, circle
                if abs(circle.radius - before) > _STEADY * circle.radius:
                    still.append(k)
            most = max(entry.radius for entry in circles)
            open_ = [k for k in still if circles[k].radius > _SMALL * most]
            if not open_:
                break
        return _concatenation(support)


def _vertex(around: Real, otherwise: Index) -> tuple[Real, Real]:
    """Where parabolas through three values (..., 3) a step apart are highest between them, and what they are there.

    Parameters
    ----------
    otherwise : (...) step to the highest of parabolas that are bent upwards.
    """
    before, here, after = np.moveaxis(around, -1, 0)
    slope, bend = 0.5 * (after - before), before - 2.0 * here + after
    down = bend < 0.0
    step = np.where(down, -slope / np.where(down, bend, -1.0), otherwise)
    step = np.clip(step, -1.0, 1.0)
    return step, here + step * (slope + 0.5 * bend * step)


def _at(polynomial: Complex, place: Real) -> Complex:
    """Polynomials (m, S) at places (m, n)."""
    values: Complex = np.matmul(place[..., None] ** _EXPONENTS, polynomial[..., None])[..., 0]
    return values


class Samples:
    """Quantities all over the turn."""

    def __init__(self, quantities: Sequence[Quantity]) -> None:
        self.quantities = quantities
        self._rows: dict[int, Complex] = {}  # what rows add at the places of a quantity (P, S, R)
        together: dict[object, list[int]] = {}
        for q, quantity in enumerate(quantities):
            response = quantity.response
            if quantity.measure == "peak":
                pieces = response.curves.pieces
                alone = response.turning is not None or quantity.masses > 0.0
                key = q if alone else (id(pieces.source), pieces.half[response.number].tobytes())
                together.setdefault(key, []).append(q)
        self._curves = [(numbers, _Curves([quantities[q].response for q in numbers])) for numbers in together.values()]
        #: quantities whose curves cancel to their rounding error everywhere
        self.cancelled = [False] * len(quantities)
        for numbers, curves in self._curves:
            for q, nothing in zip(numbers, curves.nothing.tolist(), strict=True):
                self.cancelled[q] = nothing and not quantities[q].masses > 0.0

    def first(self) -> tuple[tuple[Cut, ...], ...]:
        """Cuts to begin with: what holds the smallest circle, or the still and the moving part by themselves."""
        cuts: list[list[Cut]] = [[] for _ in self.quantities]
        for q, quantity in enumerate(self.quantities):
            if quantity.measure == "rms":
                mean, off, influence = quantity.mean, quantity.rms_error, quantity.response.influence
                cuts[q] = [
                    Cut(0j, 0.0 * influence, quantity.spread - off, share=0.0),
                    Cut(mean, influence, -off, share=1.0),
                ]
        for numbers, curves in self._curves:
            support = curves.supports()
            for n, angle, value in zip(
                support.curve.tolist(), support.angle.tolist(), curves.true(support).tolist(), strict=True
            ):
                cuts[numbers[n]].append(self.quantities[numbers[n]].cut(angle, value))
        return tuple(map(tuple, cuts))

    def sizes(self, u: Complex, scatter: Scatter) -> Real:
        """(quantities,) about what each comes to with an unbalance (K,) kg m."""
        magnitudes = np.zeros(len(self.quantities))
        for q, quantity in enumerate(self.quantities):
            more = scatter.of(quantity.response.influence, u)
            magnitudes[q] = quantity.rms(u, scatter).lower if quantity.measure == "rms" else more
        for numbers, curves in self._curves:
            magnitudes[numbers] += np.sqrt(np.max(curves.squares(self._squares(numbers, u)), axis=(-2, -1)))
        return magnitudes

    def highest(self, u: Complex, scatter: Scatter, matters: Real) -> tuple[tuple[Evaluation, ...], ...]:
        """What every quantity comes to where it is largest, at least one place each, the highest first.

        Parameters
        ----------
        matters : (quantities,) above which more places than one count.
        """
        peaks: list[list[Evaluation]] = [[] for _ in self.quantities]
        for q, quantity in enumerate(self.quantities):
            if quantity.measure == "rms":
                peaks[q] = [quantity.rms(u, scatter)]
        for numbers, curves in self._curves:
            more = [scatter.of(self.quantities[q].response.influence, u) for q in numbers]
            maxima = curves.maxima(self._squares(numbers, u), np.maximum(matters[numbers] - more, 0.0) ** 2)
            value, angle = curves.true(maxima), maxima.angle
            total = value + self._contribution(numbers, u, angle, maxima.curve)
            if self.quantities[numbers[0]].masses > 0.0:
                parts = self._parts(numbers[0], angle)
                value = value + np.sum(worst_masses(total, parts) * parts, axis=-1)
                total = value + self._contribution(numbers, u, angle, maxima.curve)
            size = np.abs(total.real if self.quantities[numbers[0]].response.scalar else total)
            for n, *values in zip(*(part.tolist() for part in (maxima.curve, angle, value, size)), strict=True):
                at, there, lower = values
                quantity = self.quantities[numbers[n]]
                peaks[numbers[n]].append(quantity.peak(u, scatter, lower, lower, quantity.cut(at, there)))
        return tuple(tuple(sorted(reached, key=lambda peak: -peak.lower)) for reached in peaks)

    def _squares(self, numbers: list[int], u: Complex) -> _Squares:
        """Of quantities that are looked at together, with an unbalance (K,) kg m."""
        alone = self.quantities[numbers[0]]

        def squares(value: Complex, angle: Real, curve: Index) -> Real:
            total = value + self._contribution(numbers, u, angle, curve)
            if alone.masses > 0.0:
                parts = self._parts(numbers[0], angle)
                flat, matrix = total.ravel(), parts.reshape(-1, parts.shape[-1])
                total = total + np.sum(worst_masses(flat, matrix) * matrix, axis=-1).reshape(total.shape)
            return _squared(total.real if alone.response.scalar else total)

        return squares

    def _contribution(self, numbers: list[int], u: Complex, angle: Real, curve: Index) -> Complex:
        """What counterweights add at angles (...) to curves (...)."""
        response = self.quantities[numbers[0]].response
        if response.turning is None:
            offsets = np.array([self.quantities[q].response.offset(u) for q in numbers])
            return offsets[curve]
        return np.asarray(response.contribution(u, angle.ravel())).reshape(angle.shape)

    def _parts(self, q: int, angle: Real) -> Complex:
        """What rows add at angles (...) where their masses are off (..., R)."""
        response, (curves,) = self.quantities[q].response, (group for numbers, group in self._curves if numbers == [q])
        if angle is not curves.angle or q not in self._rows:
            parts = self.quantities[q].masses * response.curves.parts.at(response.number, angle.ravel())
            parts = parts.reshape(*angle.shape, -1)
            if angle is not curves.angle:
                return parts
            self._rows[q] = parts
        return self._rows[q]


def _squared(value: Complex | Real) -> Real:
    return np.asarray(value.real**2 + value.imag**2)


def _about(centre: Complex) -> _Squares:
    """Of curves about centres (Q,)."""
    return lambda value, _, curve: _squared(value - centre[curve])
