"""Curves that are finite Fourier series, whose peaks, means and floors are known or soon found by other means."""

from dataclasses import dataclass
from functools import cached_property
from math import factorial

import numpy as np

from optimizer.mechanics.curve_series import CurveSeries
from optimizer.mechanics.row_data import RowData
from optimizer.numerics.arrays import Complex, Real
from optimizer.responses.floors import Floors
from optimizer.responses.kernel.motion import STILL, Motion
from optimizer.responses.kernel.parts import Best, Cubics, Members
from optimizer.responses.piecewise_cubics import Index, Pieces

#: rad, width of the pieces
_WIDEST = np.deg2rad(2.0)
#: of a mean square, in units of the sum of the magnitudes of its orders
_ROUNDING = 4 * np.finfo(float).eps
_ONE, _NONE = np.ones((1, 1)), np.zeros((1, 1))
#: a row that no curve counts
_ROW = RowData(1, _NONE, _ONE, 0.2 * _ONE, 0.8 * _ONE, _ONE, _ONE, _NONE, exact=True, area=None)


@dataclass(frozen=True)
class FourierCurves:
    """Curves d(theta) = sum over h of coefficient_h e^{j order_h theta}.

    order : (H,) whole numbers, each once, negative against the turn; halves with a period of 720 degrees.
    coefficient : (J, H).
    period_deg : 360 or 720.
    """

    order: Real
    coefficient: Complex
    period_deg: float = 360.0

    @cached_property
    def pieces(self) -> Pieces:
        """The curves piece by piece (J,), all of one width."""
        count = int(np.ceil(np.deg2rad(self.period_deg) / _WIDEST))
        shape = (self.coefficient.shape[0], count)
        half = np.full(shape, 0.5 * np.deg2rad(self.period_deg) / count)
        centre = half * (2.0 * np.arange(count) + 1.0)
        curve, piece = np.indices(shape)
        cubic = self.cubics(curve, piece, centre, half)
        # the fourth derivative is at most the sum of its terms' magnitudes, everywhere
        rest = np.sum(np.abs(self.coefficient[curve]) * (half[..., None] * self.order) ** 4, axis=-1) / 24.0
        return Pieces(centre, half, cubic, rest, np.sum(np.abs(self.coefficient), axis=-1), self)

    def at(self, angle: Real) -> Complex:
        """The curves at angles (n,) rad: (J, n)."""
        return self.coefficient @ np.exp(1j * self.order[:, None] * angle)

    @property
    def mean(self) -> Complex:
        """The coefficients of order 0."""
        return np.sum(np.where(self.order == 0, self.coefficient, 0.0), axis=-1)

    @property
    def variance(self) -> Real:
        """Parseval's sum of the others; every order is there once."""
        return np.sum(np.where(self.order == 0, 0.0, np.abs(self.coefficient) ** 2), axis=-1)

    @property
    def rms_error(self) -> Real:
        """Of a finite sum nothing but rounding."""
        return _ROUNDING * np.sum(np.abs(self.coefficient), axis=-1)

    def cubics(self, curve: Index, _piece: Index, centre: Real, half: Real) -> Complex:
        """Taylor polynomials of the exponentials about any centres."""
        size = half[..., None] * self.order
        terms = self.coefficient[curve] * np.exp(1j * centre[..., None] * self.order)
        return np.stack([np.sum(terms * (1j * size) ** k, axis=-1) / factorial(k) for k in range(4)], axis=-1)

    def values(self, curve: Index, _piece: Index, angle: Real) -> Complex:
        """Of the series."""
        return np.sum(self.coefficient[curve] * np.exp(1j * angle[:, None] * self.order), axis=-1)

    def search(self, cubics: Cubics, members: Members, best: Best, motion: Motion | None = None) -> Complex:
        """Harmonics that are added to what is 0."""
        by = STILL if motion is None else motion
        series, moving = self._turning(by)
        series.search(cubics, members, best, moving)
        return self.values(members.curve[best.member] + by.first, best.piece, best.angle)

    def circles(self, cubics: Cubics, members: Members, motion: Motion | None = None) -> Floors:
        """Around the same."""
        series, moving = self._turning(STILL if motion is None else motion)
        return series.circles(cubics, members, moving)

    def _turning(self, by: Motion) -> tuple[CurveSeries, Motion]:
        """Curves that are 0, and the harmonics that are added, of all or of the one that is in motion."""
        size, times = self.coefficient.astype(complex), self.order
        if by is not STILL:
            size = size[by.first : by.first + 1]
        if by.unit != 0.0:
            size, times = size * by.unit, times + by.sense
        if by.times.size:
            size, times = np.concatenate([size, by.size], axis=-1), np.concatenate([times, by.times])
        nothing = np.zeros((len(size), 1))
        series = CurveSeries(_ROW, self.pieces.centre[:1], ("piston",), nothing, nothing[:, 0])
        scalar = by.scalar or by.unit != 0.0
        return series, Motion(0, 0j, 0.0, times.astype(float), np.ascontiguousarray(size), scalar)
