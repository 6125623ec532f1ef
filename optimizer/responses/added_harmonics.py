"""Curves to which vectors are added that turn at whole multiples of the shaft's speed, and their exact peaks.

What balance shafts put on the frame turns as the shaft sees it: e^{j n theta}, with n = s (rho - 1). Its Taylor
polynomials and what they leave out have closed forms, so the pieces of a curve with it are pieces all the same.
"""

from dataclasses import dataclass, replace
from math import factorial

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.responses.piecewise_cubics import Index, Pieces, Source


@dataclass(frozen=True)
class Harmonics:
    """sum_i size_i e^{j times_i theta}, or the real part of it."""

    times: Real  # (m,)
    size: Complex  # (m,)
    scalar: bool = False  # only the real part counts

    def cubics(self, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (..., 4) about centres (...) rad, in units of half widths (...)."""
        there = self.size * np.exp(1j * centre[..., None] * self.times)
        parts = [np.sum(there * (1j * self.times) ** k, axis=-1) * half**k / factorial(k) for k in range(4)]
        return self._counting(np.stack(parts, axis=-1))

    def rests(self, half: Real) -> Real:
        """What these leave out within half widths (...)."""
        fourth: Real = np.sum(np.abs(self.size) * self.times**4) / factorial(4) * half**4
        return fourth

    def at(self, angle: Real) -> Complex:
        """Values (...) at angles (...) rad."""
        values: Complex = np.sum(self.size * np.exp(1j * angle[..., None] * self.times), axis=-1)
        return self._counting(values)

    def _counting(self, values: Complex) -> Complex:
        return values.real.astype(complex) if self.scalar else values


def moved(pieces: Pieces, number: int, by: Harmonics) -> Pieces:
    """One of some curves with harmonics added, as the only one."""
    curve = slice(number, number + 1)
    centre, half = pieces.centre[curve], pieces.half[curve]
    return replace(
        pieces,
        centre=centre,
        half=half,
        cubic=pieces.cubic[curve] + by.cubics(centre, half),
        rest=pieces.rest[curve] + by.rests(half),
        size=pieces.size[curve] + np.sum(np.abs(by.size)),
        source=_Moved(pieces.source, number, by),
    )


@dataclass(frozen=True)
class _Moved:
    """What finer pieces are made from."""

    source: Source
    number: int
    by: Harmonics

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        return self.source.cubics(curve + self.number, piece, centre, half) + self.by.cubics(centre, half)

    def rests(self, curve: Index, piece: Index, centre: Real, half: Real) -> Real:
        return self.source.rests(curve + self.number, piece, centre, half) + self.by.rests(half)

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        return self.source.values(curve + self.number, piece, angle) + self.by.at(angle)
