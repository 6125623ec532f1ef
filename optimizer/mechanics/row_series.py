"""Forces of the rows as Taylor series in the shaft angle, at points or bounded over pieces of the turn.

The same closed forms as in :mod:`kinematics`, :mod:`gas`, :mod:`friction` and :mod:`rod`, written so that each keeps
its derivatives: W = cos^2 beta, secant = W^{-1/2}, and pressures as powers of the volume. Between two breaks a chamber
is in one of its four processes and a row moves one way, so that every form is analytic; which one counts is decided at
an angle within the piece.

Shapes: N designs or places, R rows, P angles.
"""

from dataclasses import dataclass
from functools import cached_property, reduce
from operator import add

import numpy as np

from optimizer.arrays import Real
from optimizer.mechanics.row_data import RowData
from optimizer.mechanics.taylor import Taylor, cosine, sine

#: sign of a chamber's force in rod tension, head and crank side
_SIGN = (-1.0, 1.0)


@dataclass(frozen=True)
class RowSeries:
    """Series of the rows about shaft angles, each (order + 1, N, R, P); worked out when asked for.

    centre, half : (N, P) rad; half None for series at points.
    within : (N, P) rad, angles that say which process counts.
    """

    data: RowData
    centre: Real
    half: Real | None
    within: Real
    order: int

    @cached_property
    def piston(self) -> Taylor:
        """Force on the pistons, N, positive in rod tension."""
        force = self.inertia.plus(self.friction)
        return force if self.gas is None else force + self.gas

    @property
    def rod(self) -> Taylor:
        """P / cos beta, N."""
        return self.piston * self.secant

    @property
    def rod_without_gas(self) -> Taylor:
        """The same of inertia and friction, N."""
        return self.inertia.plus(self.friction) * self.secant

    @property
    def rod_at_rest(self) -> Taylor:
        """The same of the gas, N."""
        return self.secant.times(0.0) if self.gas is None else self.gas * self.secant

    @property
    def side(self) -> Taylor:
        """P tan beta, N."""
        return self.piston * (self._sine * self.secant).times(self._each(self.data.rod_ratio))

    @cached_property
    def tangential(self) -> Taylor:
        """P sin(phi + beta) / cos beta, N, positive against rotation."""
        half_ratio = 0.5 * self._each(self.data.rod_ratio)
        return self.piston * (self._sine + (self._trigonometric(sine, 2) * self.secant).times(half_ratio))

    @cached_property
    def radial(self) -> Taylor:
        """P cos(phi + beta) / cos beta, N, positive outward along the crank."""
        lam = self._each(self.data.rod_ratio)
        return self.piston * (self._cosine - (self._sine_squared * self.secant).times(lam))

    @cached_property
    def on_shaft(self) -> Taylor:
        """Force on the crank pin as the shaft sees it, over the direction of the crank: radial - j s tangential, N."""
        return self._seen(self.radial, self.tangential)

    @cached_property
    def on_frame(self) -> Taylor:
        """Inertia force along the axis as the shaft sees it, over the direction of the crank, N."""
        return self._seen(self.inertia * self._cosine, self.inertia * self._sine)

    def _seen(self, along: Taylor, across: Taylor) -> Taylor:
        """along - j s across."""
        sense = self._each(self.data.sense)
        radius = None
        if along.radius is not None and across.radius is not None:
            radius = np.hypot(along.radius, across.radius)
        return Taylor(along.middle - 1j * sense * across.middle, radius)

    @cached_property
    def secant(self) -> Taylor:
        """1 / cos beta."""
        return self._upright.power(-0.5)

    @cached_property
    def inertia(self) -> Taylor:
        """m a, N."""
        lam, size = self._each(self.data.rod_ratio), self._each(self.data.inertia)
        if not self.data.exact:
            return (self._cosine + self._cosine_twice.times(lam)).times(size)
        short = self._each(self.data.rod_margin) * (1.0 + lam)
        twice, four_times = self._cosine_twice, self._trigonometric(cosine, 4)
        # cos^4 = (3 + 4 cos 2 phi + cos 4 phi) / 8
        upper = twice.times(lam * (short + 0.5 * lam**2)) + four_times.times(0.125 * lam**3)
        upper = upper.plus(0.375 * lam**3)
        if upper.radius is None:
            # at 90 degrees the sum cancels, and what it is divided by may be as small
            upper.middle[0] = lam * (short * twice.middle[0] + lam**2 * np.square(np.square(self._cosine.middle[0])))
        return (self._cosine + upper * self._upright.power(-1.5)).times(size)

    @property
    def friction(self) -> Real:
        """(N, R, P) N, against the motion."""
        return np.sign(np.sin(self._within)) * self._each(self.data.friction)

    @cached_property
    def gas(self) -> Taylor | None:
        """Gas force, N; None without gas."""
        data = self.data
        if data.area is None:
            return None
        first, *others = (
            self._pressure(one).times(_SIGN[one % 2] * self._each(data.area[..., one]))
            for one in range(data.area.shape[-1])
        )
        return reduce(add, others, first)

    def _pressure(self, chamber: int) -> Taylor:
        """Pressure in one chamber of every row, Pa: of a cycle, or as it is given."""
        cycle = self._of_cycle(chamber)
        given = [
            (trace.row, *trace.at(self._angle[:, trace.row], self._within[:, trace.row]))
            for trace in self.data.traces
            if trace.side == chamber
        ]
        if not given:
            return cycle
        # the pressures may differ between designs that have all else in common
        rows = np.broadcast_shapes(cycle.middle.shape[1:], *((len(value), 1, 1) for _, value, _ in given))
        shape = (self.order + 1, *rows)
        middle = np.array(np.broadcast_to(cycle.middle, shape))
        radius = None if cycle.radius is None else np.array(np.broadcast_to(cycle.radius, shape))
        for row, value, slope in given:
            middle[:, :, row] = 0.0
            middle[0, :, row] = value
            if self.order > 0:
                middle[1, :, row] = slope
            if radius is not None and self.half is not None:
                radius[:, :, row] = 0.0
                radius[0, :, row] = np.abs(slope) * self.half
        return Taylor(middle, radius)

    def _of_cycle(self, chamber: int) -> Taylor:
        """Pressure of the four processes, Pa: constant, or a power of the volume."""
        data = self.data
        low, high, clear, expansion, compression, closed = (
            self._each(getattr(data, name)[..., chamber])
            for name in ("suction", "discharge", "clearance", "expansion_exponent", "compression_exponent", "closed")
        )
        if not np.any(closed):
            middle = np.zeros((self.order + 1, *np.broadcast_shapes(self._angle.shape, low.shape)))
            middle[0] = low
            return Taylor(middle, None if self.half is None else np.zeros_like(middle))
        # in units of the crank radius; an open side has no clearance to divide by
        clear = np.where(closed, 2.0 * clear, 1.0)
        side = chamber % 2
        travel = self._travel(side)
        at_points = self.half is None and self.within is self.centre
        there = travel.middle[0] if at_points else self._travel_at(side, self._within)
        growing = (np.sin(self._within) > 0.0) == (side == 0)
        expanding = closed & growing & (high * (clear / (there + clear)) ** expansion > low)
        compressing = closed & ~growing & (low * ((2.0 + clear) / (there + clear)) ** compression < high)
        exponent = np.where(expanding, expansion, np.where(compressing, compression, 0.0))
        full = np.where(expanding, clear, 2.0 + clear)
        first = np.where(expanding | (closed & ~growing & ~compressing), high, low)
        return travel.plus(clear).times(1.0 / full).power(-exponent).times(first)

    def _travel(self, side: int) -> Taylor:
        """Own travel of the chambers of one side over the crank radius."""
        if self.half is None and self.order == 0:
            return Taylor(self._travel_at(side, self._angle)[None])
        lam = self._each(self.data.rod_ratio)
        if not self.data.exact:
            swing = self._sine_squared.times(0.5 * lam)
            series = (swing - self._cosine).plus(1.0) if side == 0 else (self._cosine - swing).plus(1.0)
        elif side == 0:
            series = (self._swing - self._cosine).plus(1.0)
        else:
            # what motion() leaves to the inner dead centre: nothing cancels, however near lam is to 1
            away = np.cos(self._within) < 0.0
            short = self._each(self.data.rod_margin) * (1.0 + lam)
            upright = self._cos_beta + self._cosine.times(np.where(away, -lam, lam))
            u = upright.power(np.where(away, -1.0, 1.0)).times(np.where(away, short, 1.0))
            series = (self._cosine.plus(1.0) * u * u.plus(1.0 + lam).power(-1.0)).times(2.0)
        if self.half is None:
            # where 1 - cos would cancel
            return Taylor(np.concatenate([self._travel_at(side, self._angle)[None], series.middle[1:]]))
        # a row moves one way within a piece
        ends = [self._travel_at(side, self._angle + end * self.half[:, None, :]) for end in (-1.0, 1.0)]
        return series.between(np.minimum(*ends), np.maximum(*ends))

    def _travel_at(self, side: int, angle: Real) -> Real:
        """The same at angles (N, R, P), as in :func:`kinematics.motion`."""
        lam = self._each(self.data.rod_ratio)
        if not self.data.exact:
            swing = 0.5 * lam * np.sin(angle) ** 2
            return 2.0 * np.sin(0.5 * angle) ** 2 + swing if side == 0 else 2.0 * np.cos(0.5 * angle) ** 2 - swing
        short, cosine = self._each(self.data.rod_margin) * (1.0 + lam), np.cos(angle)
        cos_beta = np.sqrt(short + (lam * cosine) ** 2)
        if side == 0:
            return 2.0 * np.sin(0.5 * angle) ** 2 + lam * np.sin(angle) ** 2 / (1.0 + cos_beta)
        upright = cos_beta + lam * np.abs(cosine)
        u = np.where(cosine >= 0.0, upright, short / upright)
        return 4.0 * np.cos(0.5 * angle) ** 2 * u / (u + 1.0 + lam)

    @cached_property
    def _swing(self) -> Taylor:
        """(1 - cos beta) / lam = lam sin^2 phi / (1 + cos beta)."""
        return (self._sine_squared * self._cos_beta.plus(1.0).power(-1.0)).times(self._each(self.data.rod_ratio))

    @cached_property
    def _upright(self) -> Taylor:
        """W = cos^2 beta = 1 - lam^2 + lam^2 cos^2 phi."""
        lam = self._each(self.data.rod_ratio)
        short = self._each(self.data.rod_margin) * (1.0 + lam)
        series = self._cosine_twice.times(0.5 * lam**2).plus(short + 0.5 * lam**2)
        if self._cosine.radius is None:
            series.middle[0] = short + (lam * self._cosine.middle[0]) ** 2
            return series
        middle, radius = np.abs(self._cosine.middle[0]), self._cosine.radius[0]
        least, most = np.maximum(middle - radius, 0.0), middle + radius
        return series.between(short + (lam * least) ** 2, short + (lam * most) ** 2)

    @cached_property
    def _cos_beta(self) -> Taylor:
        return self._upright.power(0.5)

    @cached_property
    def _sine_squared(self) -> Taylor:
        series = self._cosine_twice.times(-0.5).plus(0.5)
        if self._sine.radius is None:
            series.middle[0] = self._sine.middle[0] ** 2
            return series
        middle, radius = np.abs(self._sine.middle[0]), self._sine.radius[0]
        return series.between(np.maximum(middle - radius, 0.0) ** 2, (middle + radius) ** 2)

    @cached_property
    def _cosine_twice(self) -> Taylor:
        return self._trigonometric(cosine, 2)

    @cached_property
    def _cosine(self) -> Taylor:
        return self._trigonometric(cosine, 1)

    @cached_property
    def _sine(self) -> Taylor:
        return self._trigonometric(sine, 1)

    def _trigonometric(self, function, multiple: int) -> Taylor:  # type: ignore[no-untyped-def]
        half = None if self.half is None else self.half[:, None, :]
        return function(multiple, self._angle, half, self.order)

    @cached_property
    def _angle(self) -> Real:
        return self.centre[:, None, :] + self.data.ahead[..., None]

    @cached_property
    def _within(self) -> Real:
        return self.within[:, None, :] + self.data.ahead[..., None]

    @staticmethod
    def _each(value: Real) -> Real:
        """Data (N, R), for every angle."""
        return value[..., None]
