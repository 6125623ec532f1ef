"""Responses along one axis of the frame, of vectors that the shaft sees."""

from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.curve import Curves, TurnResponse
from optimizer.responses.moving_curves import Axis, MovingCurve, along
from optimizer.responses.piecewise_cubics import Index, Pieces
from optimizer.responses.worst_masses import Parts

_DEGREE = 3
#: for the rounding of a mean square, in units of what is added up in the curve
_ROUNDING = 16 * np.finfo(float).eps


def component(response: TurnResponse, axis: str, sense: float) -> TurnResponse:
    """A component of a vector on the frame, from the vector as the shaft sees it: a scalar.

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
        curves=Component(response.curves, response.number, Axis(unit, sense)),
        number=0,
        turning=standing + sense,
        scalar=True,
    )


@record(frozen=True)
class Component:
    """One of some curves along an axis, as the only one (:class:`optimizer.responses.curve.Curves`)."""

    curves: Curves
    number: int
    axis: Axis

    @property
    def period_deg(self) -> float:
        return self.curves.period_deg

    @cached_property
    def pieces(self) -> Pieces:
        return along(self.curves.pieces, self.number, self.axis)

    @cached_property
    def parts(self) -> "_ComponentParts":
        curve = MovingCurve(self.curves.pieces.source, self.number, self.axis)
        return _ComponentParts(self.curves.parts, self.pieces, curve, self.axis)

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
        return self.axis.along(self.curves.at(angle)[self.number : self.number + 1], angle)

    @property
    def _shares(self) -> Real:
        """Of the turn (1, P)."""
        return 2.0 * self.pieces.half / np.deg2rad(self.period_deg)


@record(frozen=True)
class _ComponentParts:
    """What rows add to the component (:class:`optimizer.responses.worst_masses.Parts`)."""

    parts: Parts
    pieces: Pieces
    curve: MovingCurve
    axis: Axis

    @property
    def largest(self) -> Real:
        """No more than of the vector."""
        return self.parts.largest[self.curve.number : self.curve.number + 1]

    def fourth(self, curve: Index, piece: Index) -> Real:
        centre, half = self.pieces.centre[0, piece], self.pieces.half[0, piece]
        cubic = self.parts.cubics(curve + self.curve.number, piece, centre, half)
        rest = self.parts.fourth(curve + self.curve.number, piece) * half[:, None] ** 4
        # pieces without width hold nothing
        return self._in_motion(cubic, rest, centre, half)[1] / np.where(half > 0.0, half, 1.0)[:, None] ** 4

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        cubic = self.parts.cubics(curve + self.curve.number, piece, centre, half)
        return self._in_motion(cubic, np.zeros(cubic.shape[:-1]), centre, half)[0]

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        return self.axis.along(self.parts.values(curve + self.curve.number, piece, angle), angle[:, None])

    def at(self, curve: int, angle: Real) -> Complex:
        return self.axis.along(self.parts.at(curve + self.curve.number, angle), angle[:, None])

    def _in_motion(self, cubic: Complex, rest: Real, centre: Real, half: Real) -> tuple[Complex, Real]:
        """Cubics (m, R, 4) and what they leave out (m, R), of vectors about centres (m,)."""
        wide = (np.repeat(array, rest.shape[-1]) for array in (centre, half))
        along, left = self.curve.in_motion(cubic.reshape(-1, 4), rest.reshape(-1), *wide)
        return along.reshape(cubic.shape), left.reshape(rest.shape)
