"""What the frame sees along one axis of a vector that the shaft sees, and its exact peak.

The shaft sees d(theta) of a force F = e^{j s theta} d on the frame, whose component along a unit vector e is
Re(conj(e) e^{j s theta} d). Its Taylor polynomials are the products of those of d and of e^{j s theta}, and by
Leibniz's rule no fourth derivative is larger than sum_k C(4, k) |d^(k)|: so its pieces are pieces all the same.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from math import comb, factorial

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.responses.curve import Curves, TurnResponse
from optimizer.responses.piecewise_cubics import Index, Pieces, Source
from optimizer.responses.worst_masses import Parts

_DEGREE = 3
#: for the rounding of a mean square, in units of what is added up in the curve
_ROUNDING = 16 * np.finfo(float).eps


def component(response: TurnResponse, axis: str, sense: float) -> TurnResponse:
    """A component of a vector on the frame that is known as the shaft sees it: a scalar.

    Parameters
    ----------
    axis : "x" or "y".
    sense : of the rotation, 1 or -1.
    """
    unit = complex(1.0 if axis == "x" else -1j)
    standing = np.zeros(response.influence.shape) if response.turning is None else response.turning
    return replace(
        response,
        name=f"{response.name}:{axis}",
        influence=(unit * response.influence).astype(complex),
        curves=Component(response.curves, response.number, unit, sense),
        number=0,
        turning=standing + sense,
        scalar=True,
    )


@dataclass(frozen=True)
class Component:
    """Re(unit e^{j s theta} d) of one of some curves d, as the only one (:class:`optimizer.responses.curve.Curves`)."""

    curves: Curves
    number: int
    unit: complex
    sense: float

    @property
    def period_deg(self) -> float:
        return self.curves.period_deg

    @cached_property
    def pieces(self) -> Pieces:
        whole, curve = self.curves.pieces, slice(self.number, self.number + 1)
        centre, half, cubic = whole.centre[curve], whole.half[curve], whole.cubic[curve]
        along, rest = self._source.product(cubic, centre, half), leibniz(cubic, whole.rest[curve], half)
        return Pieces(centre, half, along, rest, whole.size[curve], self._source)

    @cached_property
    def parts(self) -> "_ComponentParts":
        return _ComponentParts(self.curves.parts, self.pieces, self._source)

    @property
    def mean(self) -> Complex:
        """(1,), of the polynomials."""
        pieces = self.pieces
        of_pieces = pieces.cubic[..., 0] + pieces.cubic[..., 2] / 3.0
        return np.sum(self._shares * of_pieces, axis=-1)

    @property
    def variance(self) -> Real:
        """(1,), of the polynomials."""
        from_mean = self.pieces.cubic.real.copy()
        from_mean[..., 0] -= self.mean.real[:, None]
        # mean of x^(i + k) over [-1, 1]
        power = np.add.outer(np.arange(_DEGREE + 1), np.arange(_DEGREE + 1))
        moment = np.where(power % 2 == 0, 1.0 / (power + 1.0), 0.0)
        square: Real = np.einsum("jpi,ik,jpk->jp", from_mean, moment, from_mean)
        return np.sum(self._shares * square, axis=-1)

    @property
    def rms_error(self) -> Real:
        """(1,): root mean squares differ by no more than that of what the polynomials leave out."""
        pieces = self.pieces
        return np.sqrt(np.sum(self._shares * pieces.rest**2, axis=-1)) + _ROUNDING * pieces.size

    def at(self, angle: Real) -> Complex:
        seen = self.curves.at(angle)[self.number : self.number + 1]
        return (self.unit * np.exp(1j * self.sense * angle) * seen).real.astype(complex)

    @property
    def _source(self) -> "_Component":
        return _Component(self.curves.pieces.source, self.number, self.unit, self.sense)

    @property
    def _shares(self) -> Real:
        """Of the turn (1, P)."""
        return 2.0 * self.pieces.half / np.deg2rad(self.period_deg)


def leibniz(cubic: Complex, rest: Real, half: Real) -> Real:
    """What the product of a curve and e^{j s theta} leaves out of a Taylor polynomial of degree 3 (...).

    Parameters
    ----------
    cubic, rest, half : (..., 4), (...), (...) of the curve, as in :class:`optimizer.responses.piecewise_cubics.Pieces`.
    """
    fourth = factorial(4) * rest
    bound = fourth.copy()
    for k in range(_DEGREE + 1):
        # a derivative is that of the polynomial and what that leaves out of it
        factors = [factorial(i) / factorial(i - k) for i in range(k, _DEGREE + 1)]
        largest = np.sum(np.abs(cubic[..., k:]) * factors, axis=-1) + fourth / factorial(4 - k)
        bound = bound + comb(4, k) * half ** (4 - k) * largest
    return bound / factorial(4)


@dataclass(frozen=True)
class _Component:
    """What finer pieces are made from."""

    source: Source
    number: int
    unit: complex
    sense: float

    def product(self, cubic: Complex, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (..., 4) of the component from those of the curve."""
        there = self.unit * np.exp(1j * self.sense * centre)
        turning = [there * (1j * self.sense * half) ** k / factorial(k) for k in range(_DEGREE + 1)]
        parts = [sum(turning[k - i] * cubic[..., i] for i in range(k + 1)) for k in range(_DEGREE + 1)]
        return np.stack(parts, axis=-1).real.astype(complex)

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        return self.product(self.source.cubics(curve + self.number, piece, centre, half), centre, half)

    def rests(self, curve: Index, piece: Index, centre: Real, half: Real) -> Real:
        cubic = self.source.cubics(curve + self.number, piece, centre, half)
        return leibniz(cubic, self.source.rests(curve + self.number, piece, centre, half), half)

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        seen = self.source.values(curve + self.number, piece, angle)
        return (self.unit * np.exp(1j * self.sense * angle) * seen).real.astype(complex)


@dataclass(frozen=True)
class _ComponentParts:
    """What rows add to the component (:class:`optimizer.responses.worst_masses.Parts`)."""

    parts: Parts
    pieces: Pieces
    of: _Component

    @property
    def largest(self) -> Real:
        """No more than of the vector."""
        return self.parts.largest[self.of.number : self.of.number + 1]

    def fourth(self, curve: Index, piece: Index) -> Real:
        centre, half = self.pieces.centre[0, piece], self.pieces.half[0, piece]
        cubic = self.parts.cubics(curve + self.of.number, piece, centre, half)
        known, width = self.parts.fourth(curve + self.of.number, piece), half[:, None]
        # pieces without width hold nothing
        power = np.where(width > 0.0, width, 1.0) ** 4
        return leibniz(cubic, known * width**4, width) / power

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        cubic = self.parts.cubics(curve + self.of.number, piece, centre, half)
        return self.of.product(cubic, centre[:, None], half[:, None])

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        return self._seen(self.parts.values(curve + self.of.number, piece, angle), angle)

    def at(self, curve: int, angle: Real) -> Complex:
        return self._seen(self.parts.at(curve + self.of.number, angle), angle)

    def _seen(self, values: Complex, angle: Real) -> Complex:
        """Along the axis, of vectors (n, R) at angles (n,) rad."""
        turned = self.of.unit * np.exp(1j * self.of.sense * angle)
        return (turned[:, None] * values).real.astype(complex)
