"""Plates side by side: functions of all of them at once, those of one shape together."""

from collections.abc import Callable, Sequence

import numpy as np

from optimizer.mechanics.envelope import Envelope, opened_for
from optimizer.numerics.arrays import Real, Reals
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record

#: rad: openings from which on a mass says more than an unbalance; and the step of its slope
_STEEP, _STEP = 1.5, 1e-3


@record(frozen=True)
class Plates:
    """The plates of P of the webs of a machine, whose figures are (..., P) as those of an envelope."""

    webs: np.ndarray  # (P,) which webs have them
    kinds: np.ndarray  # (P,) those that are the same have the same number
    parts: Sequence[tuple[np.ndarray, Envelope]]  # those of one shape, with their places (p,) among all P

    @cached_property
    def outer(self) -> Real:
        """m."""
        return self._by_part(lambda part, _: part.outer, np.zeros(self.webs.size))

    @cached_property
    def most(self) -> Real:
        """Largest half-angles, rad."""
        return self._by_part(lambda part, _: part.most, np.zeros(self.webs.size))

    def unbalance(self, half_angle: Real) -> Real:
        """Mass times radius, kg m."""
        return self._by_part(lambda part, angle: part.unbalance(angle), half_angle)

    def mass(self, half_angle: Real) -> Real:
        """kg."""
        return self._by_part(lambda part, angle: part.mass(angle), half_angle)

    def lever(self, half_angle: Real) -> Real:
        """dU/dm of what is added at these openings, m."""
        return self._by_part(lambda part, angle: part.lever(angle), half_angle)

    def inertia(self, half_angle: Real) -> Real:
        """Moments of inertia about the shaft, kg m^2."""
        return self._by_part(lambda part, angle: part.inertia(angle), half_angle)

    def opened(self, unbalance: Real) -> Real:
        """Half-angles of the counterweights of unbalances, rad; the largest for more than a plate holds."""
        return self._by_part(lambda part, size: part.opened(size), unbalance)

    def chord(self, half_angle: Real) -> Real:
        """Distances of chords from the shaft, m; nan where there is none."""

        def chord_of(part: Envelope, angle: Real) -> Real:
            chord = part.chord(angle)
            return np.full(angle.shape, np.nan) if chord is None else chord

        return self._by_part(chord_of, half_angle)

    def opened_for(self, mass: Real) -> Real:
        """Half-angles of the counterweights of masses, rad; the largest for more than a plate holds."""
        return self._by_part(opened_for, mass)

    def opened_by_mass(self, mass: Real, radius: Real) -> Real:
        """The same of masses at their radii: near a right angle an unbalance says no more than 1e-8 of an opening."""
        half_angle = self.opened(mass * radius)
        steep = half_angle > _STEEP
        if not steep.any():
            return half_angle
        there = self.mass(half_angle)
        slope = (there - self.mass(half_angle - _STEP)) / _STEP
        return np.where(steep, np.minimum(half_angle + (mass - there) / slope, self.most), half_angle)

    def mass_of(self, unbalance: Real) -> Real:
        """Masses of the counterweights of unbalances, kg."""
        return self.mass(self.opened(unbalance))

    def _by_part(self, figure: Callable[[Envelope, Real], Reals], values: Real) -> Real:
        if len(self.parts) == 1:
            return np.asarray(figure(self.parts[0][1], values))
        result = np.empty(values.shape)
        for places, part in self.parts:
            result[..., places] = figure(part, values[..., places])
        return result
