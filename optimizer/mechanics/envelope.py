"""Counterweights that are cut from a plate, by half of their opening: unbalance, mass, inertia.

A plate has a thickness t and a density rho, and lies between an inner and an outer radius R1, R2. Of all its parts the
outermost along the direction of the unbalance have the longest lever. So the lightest counterweight is the part beyond
a chord; one that is bounded by two edges through the shaft is an annular sector. Of both the mass is a convex function
of the unbalance: one more kilogram metre needs dm/dU, the reciprocal of the lever of what is added.

The half-angle a [rad] is that at the outer radius, as seen from the shaft, from 0 to at most a right angle. All
functions broadcast.
"""

from collections.abc import Callable
from typing import Protocol

import numpy as np

from optimizer.numerics.arrays import Real, Reals
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record

#: cuts of an interval into as many parts: to the last bit
_CUTS, _PARTS = 10, 64
#: Newton's steps: the fourth leaves rounding alone
_STEPS = 4
#: of the outer radius: a hub that is smaller is none to any digit, and would be too small to divide by
_HUB = 1e-300
#: below it x - sin x is summed as a series
_SMALL = 0.05


@record(frozen=True)
class Plate:
    """Where a counterweight may be.

    inner, outer : radii, m.
    areal : thickness times density, kg/m^2.
    most : largest half-angle, rad.
    """

    inner: Reals
    outer: Reals
    areal: Reals
    most: Reals


class Envelope(Protocol):
    """A plate and what is cut from it."""

    @property
    def outer(self) -> Reals: ...

    @property
    def most(self) -> Reals: ...

    def unbalance(self, half_angle: Reals) -> Real:
        """Mass times radius, kg m."""
        ...

    def mass(self, half_angle: Reals) -> Real:
        """kg."""
        ...

    def lever(self, half_angle: Reals) -> Real:
        """dU/dm of what is added at this opening, m; 0 where edges stand at a right angle."""
        ...

    def inertia(self, half_angle: Reals) -> Real:
        """Moment of inertia about the shaft, kg m^2."""
        ...

    def opened(self, unbalance: Reals) -> Real:
        """Half-angle of the counterweight of an unbalance, rad; the largest for more than the plate holds."""
        ...

    def chord(self, half_angle: Reals) -> Real | None:
        """Distance of the chord from the shaft, m; None where there is none."""
        ...


@record(frozen=True)
class AnnularSector(Plate):
    """m = rho t a (R2^2 - R1^2), U = 2/3 rho t (R2^3 - R1^3) sin a, J = rho t a (R2^4 - R1^4) / 2."""

    def unbalance(self, half_angle: Reals) -> Real:
        return self._whole * np.sin(half_angle)

    def mass(self, half_angle: Reals) -> Real:
        return np.asarray(self._of_angle * half_angle)

    def lever(self, half_angle: Reals) -> Real:
        return self._whole / self._of_angle * np.cos(half_angle)

    def inertia(self, half_angle: Reals) -> Real:
        return np.asarray(0.5 * self.areal * (self.outer**4 - self.inner**4) * half_angle)

    def opened(self, unbalance: Reals) -> Real:
        half_angle: Real = np.minimum(np.arcsin(np.minimum(unbalance / self._whole, 1.0)), self.most)
        return half_angle

    def chord(self, half_angle: Reals) -> None:
        return None

    @cached_property
    def _of_angle(self) -> Reals:
        return self.areal * (self.outer**2 - self.inner**2)

    @cached_property
    def _whole(self) -> Reals:
        return 2.0 / 3.0 * self.areal * (self.outer**3 - self.inner**3)


@record(frozen=True)
class Segment(Plate):
    """What lies beyond a chord at h = R2 cos a, of the disc of the outer radius without that of the inner one.

    Of a disc with h = R cos b, m = rho t R^2 (b - sin b cos b), U = 2/3 rho t R^3 sin^3 b and
    J = rho t R^4 (b/2 - sin b cos^3 b / 2 - sin^3 b cos b / 6).
    """

    def unbalance(self, half_angle: Reals) -> Real:
        return 2.0 / 3.0 * self.areal * self._of_discs(half_angle, 3, lambda b: np.sin(b) ** 3)

    def mass(self, half_angle: Reals) -> Real:
        return self.areal * self._of_discs(half_angle, 2, lambda b: 0.5 * _excess(2.0 * b))

    def lever(self, half_angle: Reals) -> Real:
        return self.outer * np.cos(half_angle)

    def inertia(self, half_angle: Reals) -> Real:
        # b/2 - s c^3 / 2 - s^3 c / 6 = (b - s c) / 2 + s^3 c / 3
        return self.areal * self._of_discs(
            half_angle, 4, lambda b: 0.25 * _excess(2.0 * b) + np.sin(b) ** 3 * np.cos(b) / 3.0
        )

    def opened(self, unbalance: Reals) -> Real:
        # in units of 2/3 rho t: c = p^3 - q^3 with p, q half the chords of both discs; q is 0 where it misses the hub
        cube = np.asarray(unbalance / (2.0 / 3.0 * self.areal))
        apart = (self.outer - self.inner) * (self.outer + self.inner)
        size = np.maximum(cube / apart**1.5, 1.0)
        total = np.sqrt(apart) * _sum_of_halves(size)
        half = np.where(size > 1.0, 0.5 * (total + apart / total), np.cbrt(cube))
        result = np.minimum(np.arcsin(np.minimum(half / self.outer, 1.0)), self.most)
        # near a right angle an opening has an error of 1e-8, but a full plate is full
        return np.where(unbalance >= self.unbalance(self.most), self.most, result)

    def chord(self, half_angle: Reals) -> Real:
        return self.lever(half_angle)

    def _of_discs(self, half_angle: Reals, power: int, of_disc: "_OfAngle") -> Real:
        """R2^n f(a) - R1^n f(b), b the half-angle at the inner radius."""
        inside = np.arccos(np.minimum(self._wider * np.cos(half_angle), 1.0))
        return self.outer**power * of_disc(np.asarray(half_angle)) - self.inner**power * of_disc(inside)

    @cached_property
    def _wider(self) -> Real:
        """Outer over inner radius; that of the disc itself where there is no hub."""
        hub = np.asarray(self.inner) > _HUB * np.asarray(self.outer)
        return self.outer / np.where(hub, self.inner, 1.0)


class _OfAngle(Protocol):
    def __call__(self, half_angle: Real, /) -> Real: ...


def opened_for(plate: Envelope, mass: Reals) -> Real:
    """Half-angle of the counterweight of a mass, rad; the largest for more than the plate holds."""
    result = _inverse(plate.mass, *np.broadcast_arrays(0.0, plate.most, mass))
    return np.where(mass >= plate.mass(plate.most), plate.most, result)


def _sum_of_halves(size: Real) -> Real:
    """The s >= 1 with 3 s + s^-3 = 4 c, of c >= 1: p + q where p^2 - q^2 = 1 and p^3 - q^3 = c.

    The left side is convex and rises, so Newton's steps come from above after the first one.
    """
    result = np.maximum(1.0 + np.sqrt((2.0 / 3.0) * (size - 1.0)), (4.0 / 3.0) * size - 1.0 / 3.0)
    for _ in range(_STEPS):
        cube = result**-3
        rise = 3.0 * (1.0 - cube / result)
        over = 3.0 * result + cube - 4.0 * size
        result = result - np.where(rise > 0.0, over / np.where(rise > 0.0, rise, 1.0), 0.0)
    return result


def _inverse(rising: Callable[[Real], Real], low: Real, high: Real, value: Real) -> Real:
    """Where a function that rises has a value, between two angles."""
    share = (np.arange(1, _PARTS) / _PARTS).reshape(-1, *np.ones(np.ndim(low), int))
    for _ in range(_CUTS):
        width = high - low
        part = np.sum(rising(low + share * width) <= value, axis=0)
        low, high = low + part / _PARTS * width, low + (part + 1) / _PARTS * width
    return low


def _excess(angle: Real) -> Real:
    """x - sin x, from 0 to pi."""
    square = angle**2
    series = angle * square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)))
    return np.where(angle < _SMALL, series, angle - np.sin(angle))
