"""Outlines of curves: their cubics without what these leave out, and the smallest circles around them."""

from functools import cached_property

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.enclosing_circle import Circle, smallest_circle
from optimizer.responses.piecewise_cubics import Index, Pieces

#: places in every piece at which its cubic is looked at
_PLACES = np.linspace(-1.0, 1.0, 17)
_POWERS = _PLACES ** np.arange(4)[:, None]
#: share of the largest distance by which others that may hold a circle are less
_ALIKE = 1e-3
#: how far the farthest places may be from these
_BETWEEN = float(_PLACES[1] - _PLACES[0])


class Outline:
    """One of some curves."""

    def __init__(self, pieces: Pieces, number: int) -> None:
        self._held = np.flatnonzero(pieces.half[number] > 0.0)
        self._centre, self._half = pieces.centre[number, self._held], pieces.half[number, self._held]
        self._cubic, self._rest = pieces.cubic[number, self._held], pieces.rest[number, self._held]
        self.values: Complex = (self._cubic @ _POWERS).ravel()
        self.size = float(np.max(np.abs(self.values)))

    @cached_property
    def circle(self) -> Circle:
        """The smallest one around the places."""
        return smallest_circle(self.values)

    @property
    def support(self) -> tuple[Index, Real]:
        """Pieces (m,) and angles (m,) rad of the places that hold it."""
        return self._at(self.circle.support)

    @property
    def lower(self) -> float:
        """What the radius of the smallest circle around the curve is not below."""
        return self.circle.radius - float(np.max(self._rest))

    @property
    def upper(self) -> float:
        """What no point of the curve is farther than from the centre of the circle.

        Between two places a cubic is no farther from its chord than an eighth of the square of their distance times
        its largest second derivative.
        """
        bend = 2.0 * np.abs(self._cubic[:, 2]) + 6.0 * np.abs(self._cubic[:, 3])
        distance = np.max(np.abs(self.values - self.circle.centre).reshape(-1, _PLACES.size), axis=-1)
        return float(np.max(distance + 0.125 * _BETWEEN**2 * bend + self._rest))

    def farthest(self, centre: complex) -> tuple[Index, Real]:
        """Pieces (m,) and angles (m,) rad in them where the outline is about as far from a centre as anywhere."""
        distance = np.abs(self.values - centre)
        some = np.flatnonzero(distance >= (1.0 - _ALIKE) * np.max(distance))
        no_less = distance[some] >= np.maximum(distance[some - 1], distance[(some + 1) % distance.size])
        some = some[no_less]
        piece, place = np.divmod(some, _PLACES.size)
        at = _farthest(self._cubic[piece], centre, _PLACES[place])
        return self._held[piece], self._centre[piece] + self._half[piece] * at

    def _at(self, some: Index) -> tuple[Index, Real]:
        piece, place = np.divmod(some, _PLACES.size)
        return self._held[piece], self._centre[piece] + self._half[piece] * _PLACES[place]


def nearer(pieces: Pieces, curve: Index, piece: Index, angle: Real, centre: Complex) -> Real:
    """Angles (m,) rad within pieces, near given ones, at which curves are farthest from centres (m,)."""
    middle, half = pieces.centre[curve, piece], pieces.half[curve, piece]
    cubic = pieces.source.cubics(curve, piece, angle, half)
    return np.clip(angle + half * _farthest(cubic, centre, np.zeros(angle.size)), middle - half, middle + half)


def _farthest(cubic: Complex, centre: Complex | complex, place: Real) -> Real:
    """Places (m,) within [-1, 1], near given ones, at which cubics (m, 4) are farthest from centres; by Newton."""
    constant, linear, square, cube = cubic.T
    constant = constant - centre
    for _ in range(2):
        value = constant + place * (linear + place * (square + place * cube))
        slope = linear + place * (2.0 * square + 3.0 * place * cube)
        bend = 2.0 * square + 6.0 * place * cube
        first = np.real(np.conj(value) * slope)
        second = np.abs(slope) ** 2 + np.real(np.conj(value) * bend)
        step = np.where(second < 0.0, -first / np.where(second < 0.0, second, -1.0), 0.0)
        place = np.clip(place + np.clip(step, -_BETWEEN, _BETWEEN), -1.0, 1.0)
    return place
