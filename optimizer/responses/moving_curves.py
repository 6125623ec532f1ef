"""Curves seen along an axis of the frame, or with vectors added that turn at whole multiples of the shaft's speed.

The shaft sees d(theta) of a force F = e^{j s theta} d on the frame, whose component along a unit vector e is
Re(conj(e) e^{j s theta} d). What balance shafts put on the frame turns as the shaft sees it: e^{j n theta}, with
n = s (rho - 1). The pieces of a curve in such motion are pieces all the same (:mod:`.kernel.motion`).
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from optimizer.numerics.arrays import Complex, Real, in_order, plain
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.floors import Floors
from optimizer.responses.piecewise_cubics import Index, Pieces, Source

if TYPE_CHECKING:
    from optimizer.responses.kernel.motion import Motion
    from optimizer.responses.kernel.parts import Best, Cubics, Members


@record(frozen=True)
class Harmonics:
    """sum_i size_i e^{j times_i theta}, or the real part of it."""

    times: Real  # (m,)
    size: Complex  # (m,)
    scalar: bool = False  # only the real part counts

    def at(self, angle: Real) -> Complex:
        """Values (...) at angles (...) rad."""
        values: Complex = np.sum(self.size * np.exp(1j * angle[..., None] * self.times), axis=-1)
        return values.real.astype(complex) if self.scalar else values


@record(frozen=True)
class Axis:
    """What the frame sees along an axis.

    unit : conj(e) of its unit vector e.
    sense : of the rotation, 1 or -1.
    """

    unit: complex
    sense: float

    def along(self, vector: Complex, angle: Real) -> Complex:
        """Components (...) of what the shaft sees at angles (...) rad."""
        return (self.unit * np.exp(1j * self.sense * angle) * vector).real.astype(complex)


@record(frozen=True)
class MovingCurve:
    """One of the curves of a source, along an axis or as it is, with harmonics or without: a source of this alone."""

    source: Source
    number: int
    axis: Axis | None = None
    harmonics: Harmonics | None = None

    @cached_property
    def motion(self) -> "Motion":
        """What is compiled takes it as."""
        from optimizer.responses.kernel.motion import STILL, Motion

        unit, sense = (STILL.unit, STILL.sense) if self.axis is None else (self.axis.unit, self.axis.sense)
        if self.harmonics is None:
            return Motion(self.number, unit, sense, STILL.times, STILL.size, STILL.scalar)
        times, size = (
            plain(np.asarray(self.harmonics.times, float)),
            plain(np.asarray(self.harmonics.size, complex)),
        )
        return Motion(self.number, unit, sense, times, size[None], self.harmonics.scalar)

    def in_motion(self, cubic: Complex, rest: Real, centre: Real, half: Real) -> tuple[Complex, Real]:
        """Cubics (m, 4) of the curve in motion and what they leave out (m,), from those of the source."""
        from optimizer.responses.kernel.motion import in_motion

        real = (in_order(np.asarray(array, float)) for array in (centre, half))
        result: tuple[Complex, Real] = in_motion(
            self.motion, *real, in_order(np.asarray(cubic, complex)), in_order(np.asarray(rest, float))
        )
        return result

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        cubic = self.source.cubics(curve + self.number, piece, centre, half)
        return self.in_motion(cubic, np.zeros(len(cubic)), centre, half)[0]

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        return self._along_axis(self.source.values(curve + self.number, piece, angle), angle)

    def search(self, cubics: "Cubics", members: "Members", best: "Best", motion: "Motion | None" = None) -> Complex:
        assert motion is None  # what moves is brought into another motion as one
        return self._along_axis(self.source.search(cubics, members, best, self.motion), best.angle)

    def circles(self, cubics: "Cubics", members: "Members", motion: "Motion | None" = None) -> Floors:
        assert motion is None  # as above
        return self.source.circles(cubics, members, self.motion)

    def _along_axis(self, values: Complex, angle: Real) -> Complex:
        if self.axis is not None:
            values = self.axis.along(values, angle)
        return values if self.harmonics is None else values + self.harmonics.at(angle)


def along(pieces: Pieces, number: int, axis: Axis) -> Pieces:
    """One of some curves along an axis, as the only one."""
    return _pieces(pieces, number, MovingCurve(pieces.source, number, axis))


def with_harmonics(pieces: Pieces, number: int, by: Harmonics) -> Pieces:
    """One of some curves with harmonics added, as the only one."""
    first = _pieces(pieces, number, MovingCurve(pieces.source, number, harmonics=by))
    source = pieces.source
    if isinstance(source, MovingCurve):
        # its pieces are along the axis already
        first = replace(first, source=replace(source, harmonics=by))
    return replace(first, size=first.size + np.sum(np.abs(by.size)))


def _pieces(pieces: Pieces, number: int, source: MovingCurve) -> Pieces:
    centre, half = pieces.centre[number], pieces.half[number]
    cubic, rest = source.in_motion(pieces.cubic[number], pieces.rest[number], centre, half)
    return Pieces(centre[None], half[None], cubic[None], rest[None], pieces.size[number : number + 1], source)
