"""Curves that are finite Fourier series: of a few orders, as balance shafts and single orders make them."""

from dataclasses import dataclass
from functools import cached_property
from math import factorial

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.pieces import Expansion, Index, Pieces

#: rad, width of the pieces
_WIDEST = np.deg2rad(2.0)


@dataclass(frozen=True)
class FourierCurves:
    """Curves d(theta) = sum over h of coefficient_h e^{j order_h theta}.

    order : (H,) whole numbers, negative against the turn; halves with a period of 720 degrees.
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
        return Pieces(centre, half, self.expansion(curve, piece, centre, half), self)

    def at(self, angle: Real) -> Complex:
        """The curves at angles (n,) rad: (J, n)."""
        return self.coefficient @ np.exp(1j * self.order[:, None] * angle)

    def expansion(self, curve: Index, _piece: Index, centre: Real, half: Real) -> Expansion:
        """Taylor polynomials of the exponentials; the fourth derivative is at most the sum of their magnitudes."""
        coefficient, size = self.coefficient[curve], half[..., None] * self.order
        terms = coefficient * np.exp(1j * centre[..., None] * self.order)
        cubic = np.stack([np.sum(terms * (1j * size) ** k, axis=-1) / factorial(k) for k in range(4)], axis=-1)
        return Expansion(cubic, np.sum(np.abs(coefficient) * size**4, axis=-1) / 24.0)
