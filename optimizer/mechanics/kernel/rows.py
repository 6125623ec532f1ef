"""Forces of the rows as Taylor series in the shaft angle, at points or bounded over intervals; compiled.

The same closed forms as in :mod:`kinematics`, :mod:`gas`, :mod:`friction` and :mod:`rod`, written so that each keeps
its derivatives: W = cos^2 beta, secant = W^{-1/2}, and pressures as powers of the volume. Between two breaks a chamber
is in one of its four processes and a row moves one way, so that every form is analytic; which one counts is decided at
an angle within the piece.

Shapes: N designs or places, R rows, P angles.
"""

from typing import NamedTuple

import numpy as np

from optimizer.arrays import Real
from optimizer.compiling import inner, kernel
from optimizer.mechanics.kernel.taylor import (
    Series,
    between,
    circular,
    constant,
    cosine_range,
    power,
    product,
    scaled,
    summed,
)

#: functions of one row; as numpy's integers, for each Python literal that is handed on is a type of its own, for which
#: all that takes it is compiled anew. The first are what readings are made of, FORCE that of the gas
INERTIA, FORCE, COS, SIN, SIN_2, SIN_SQUARED, SECANT = np.arange(7)
KEPT = 7
_COS_2, _COS_4, _SIN_4, _UPRIGHT, _COS_BETA, _PRESSURE, _TRAVEL, _A, _B, _C = np.arange(KEPT, KEPT + 10)
_FUNCTIONS = KEPT + 10


class Rows(NamedTuple):
    """Data of the rows of D or S designs, 1 where all are the same.

    motion : (D, R, 4) angle ahead [rad], rod ratio, 1 - rod ratio, sense.
    scale : (S, R, 2) m r omega^2 [N], friction [N].
    gas : (D, R, C, 7) area [m^2] with the sign of its force in rod tension, suction and discharge pressure [Pa],
        relative clearance, exponents of expansion and compression, whether it is closed.
    given : (R, C) which of the traces gives the pressure of a chamber, or -1.
    exact : kinematics, or cut off after the second order.
    """

    motion: Real
    scale: Real
    gas: Real
    given: np.ndarray
    exact: bool


class Places(NamedTuple):
    """Angles (N or 1, P) rad.

    half : half widths of intervals; (0, 0) at points.
    within : angles that say which process counts.
    pressure, slope : (T, N or 1, P) of the traces, Pa and Pa/rad.
    """

    centre: Real
    half: Real
    within: Real
    pressure: Real
    slope: Real


class Functions(NamedTuple):
    """What the forces of M designs are made of: those that differ in masses, speed and friction alone have them once.

    middle : (M, R, P, 7, order + 1) acceleration over r omega^2, gas [N], cos and sin of the crank angle, sin of twice
        the angle, sin^2, 1 / cos beta.
    radius : the same of enclosures; (0, R, P, 7, order + 1) at points.
    way : (M, R, P) which way the row moves: 1 to the shaft.
    """

    middle: Real
    radius: Real
    way: Real


@kernel
def row_functions(rows, places, design, order, pressed):  # type: ignore[no-untyped-def]
    """What all readings of the rows are made of, at rows of angles of designs (N,); without the gas where it is not
    pressed."""
    bounded = places.half.size > 0
    designs, count = rows.motion.shape[:2]
    some, angles = places.centre.shape
    # the pressures may differ between designs that have all else in common
    number = 1 if max(designs, some, places.pressure.shape[1]) == 1 else design.size
    middle = np.empty((number, count, angles, KEPT, order + 1))
    radius = np.empty((number if bounded else 0, count, angles, KEPT, order + 1))
    way = np.empty((number, count, angles))
    series = Series(np.zeros((_FUNCTIONS, order + 1)), np.zeros((_FUNCTIONS, order + 1)), bounded)
    process = np.empty((rows.gas.shape[2], 4))
    half = 0.0
    for n in range(number):
        one, place = design[n] if designs > 1 else 0, n if some > 1 else 0
        for r in range(count):
            motion = rows.motion[one, r]
            known = np.nan
            for p in range(angles):
                angle, within = places.centre[place, p] + motion[0], places.within[place, p] + motion[0]
                if bounded:
                    half = places.half[place, p]
                if within != known:
                    # many places of one piece follow one another
                    known, inside = within, _turned(within)
                    if pressed:
                        _decide(rows.gas[one, r], motion, rows.exact, inside, process)
                there = _turned(angle)
                way[n, r, p] = np.sign(inside.sine)
                _move(series, motion, rows.exact, there, angle, half)
                _accelerate(series, motion, rows.exact)
                constant(series, 0.0, FORCE)
                if pressed:
                    for c in range(rows.gas.shape[2]):
                        area, trace = rows.gas[one, r, c, 0], rows.given[r, c]
                        if area == 0.0:
                            continue
                        if trace < 0:
                            _cycle(series, motion, rows.exact, process[c], c % 2, there, angle, half, inside)
                        else:
                            which = n if places.pressure.shape[1] > 1 else 0
                            _given(series, places.pressure[trace, which, p], places.slope[trace, which, p], half)
                        summed(series, FORCE, _PRESSURE, area, FORCE)
                for f in range(KEPT):
                    for k in range(order + 1):
                        middle[n, r, p, f, k] = series.middle[f, k]
                        if bounded:
                            radius[n, r, p, f, k] = series.radius[f, k]
    return Functions(middle, radius, way)


class _Turned(NamedTuple):
    """Where a crank stands."""

    sine: float
    cosine: float
    rise: float  # 1 - cos, without cancellation
    fall: float  # 1 + cos


@inner
def _turned(angle):  # type: ignore[no-untyped-def]
    """By the half angle: nothing cancels but what has no digits in the angle either."""
    sine, cosine = np.sin(0.5 * angle), np.cos(0.5 * angle)
    return _Turned(2.0 * sine * cosine, (cosine - sine) * (cosine + sine), 2.0 * sine**2, 2.0 * cosine**2)


@inner
def _move(series, motion, exact, there, angle, half):  # type: ignore[no-untyped-def]
    """What the motion of a row is made of."""
    middle, radius, bounded = series
    ratio = motion[1]
    short, square = motion[2] * (1.0 + ratio), ratio * ratio
    sine, cosine = there.sine, there.cosine
    for multiple, cos, sin in ((1, COS, SIN), (2, _COS_2, SIN_2), (4, _COS_4, _SIN_4)):
        if bounded:
            turned, wide = multiple * angle, multiple * half
            circular(series, multiple, cosine_range(turned, wide), cosine_range(turned - 0.5 * np.pi, wide), cos, sin)
        else:
            circular(series, multiple, (cosine, 0.0), (sine, 0.0), cos, sin)
            sine, cosine = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
    # W = cos^2 beta = 1 - lam^2 + lam^2 cos^2 phi
    scaled(series, _COS_2, 0.5 * square, short + 0.5 * square, _UPRIGHT)
    scaled(series, _COS_2, -0.5, 0.5, SIN_SQUARED)
    cos, sin = middle[COS, 0], middle[SIN, 0]
    if bounded:
        least, most = max(abs(cos) - radius[COS, 0], 0.0), abs(cos) + radius[COS, 0]
        between(series, _UPRIGHT, short + (ratio * least) ** 2, short + (ratio * most) ** 2)
        least, most = max(abs(sin) - radius[SIN, 0], 0.0), abs(sin) + radius[SIN, 0]
        between(series, SIN_SQUARED, least**2, most**2)
    else:
        middle[_UPRIGHT, 0], middle[SIN_SQUARED, 0] = short + (ratio * cos) ** 2, sin**2
    power(series, _UPRIGHT, 0.5, _COS_BETA)
    power(series, _UPRIGHT, -0.5, SECANT)


@inner
def _accelerate(series, motion, exact):  # type: ignore[no-untyped-def]
    """Acceleration over r omega^2."""
    middle, _, bounded = series
    ratio = motion[1]
    if not exact:
        summed(series, COS, _COS_2, ratio, INERTIA)
        return
    short, square = motion[2] * (1.0 + ratio), ratio * ratio
    # cos^4 = (3 + 4 cos 2 phi + cos 4 phi) / 8
    scaled(series, _COS_2, ratio * (short + 0.5 * square), 0.375 * ratio * square, _A)
    summed(series, _A, _COS_4, 0.125 * ratio * square, _A)
    if not bounded:
        # at 90 degrees the sum cancels, and what it is divided by may be as small
        middle[_A, 0] = ratio * (short * middle[_COS_2, 0] + square * middle[COS, 0] ** 4)
    power(series, _UPRIGHT, -1.5, _B)
    product(series, _A, _B, _C)
    summed(series, COS, _C, 1.0, INERTIA)


@inner
def _given(series, pressure, slope, half):  # type: ignore[no-untyped-def]
    """A pressure as a trace has it, Pa."""
    constant(series, pressure, _PRESSURE)
    if series.middle.shape[1] > 1:
        series.middle[_PRESSURE, 1] = slope
    series.radius[_PRESSURE, 0] = abs(slope) * half


@inner
def _decide(chambers, motion, exact, inside, process):  # type: ignore[no-untyped-def]
    """First pressure [Pa], exponent, and clearance and first volume over crank radius times area, of every chamber."""
    for c in range(len(chambers)):
        chamber, growing = chambers[c], (inside.sine > 0.0) == (c % 2 == 0)
        low, high, clear = chamber[1], chamber[2], 2.0 * chamber[3]
        if not chamber[6]:
            _kept(process, c, low, 0.0, 0.0, 1.0)
            continue
        volume = _travel_at(motion, exact, c % 2, inside) + clear
        if growing:
            exponent, full, first, other = chamber[4], clear, high, low
            acts = high * (full / volume) ** exponent > low
        else:
            exponent, full, first, other = chamber[5], 2.0 + clear, low, high
            acts = low * (full / volume) ** exponent < high
        if acts:
            _kept(process, c, first, exponent, clear, full)
        else:
            _kept(process, c, other, 0.0, 0.0, 1.0)


@inner
def _kept(process, c, first, exponent, clear, full):  # type: ignore[no-untyped-def]
    process[c, 0], process[c, 1], process[c, 2], process[c, 3] = first, exponent, clear, full


@inner
def _cycle(series, motion, exact, process, side, there, angle, half, inside):  # type: ignore[no-untyped-def]
    """Pressure of the four processes, Pa: constant, or a power of the volume in units of the crank radius."""
    first, exponent, clear, full = process[0], process[1], process[2], process[3]
    if exponent == 0.0:
        constant(series, first, _PRESSURE)
        return
    _travel(series, motion, exact, side, there, angle, half, inside)
    scaled(series, _TRAVEL, 1.0, clear, _TRAVEL)
    scaled(series, _TRAVEL, 1.0 / full, 0.0, _TRAVEL)
    power(series, _TRAVEL, -exponent, _PRESSURE)
    scaled(series, _PRESSURE, first, 0.0, _PRESSURE)


@inner
def _travel(series, motion, exact, side, there, angle, half, inside):  # type: ignore[no-untyped-def]
    """Own travel of a chamber of one side over the crank radius."""
    middle, _, bounded = series
    ratio = motion[1]
    if middle.shape[1] > 1:
        if not exact:
            sign = 1.0 if side == 0 else -1.0
            scaled(series, SIN_SQUARED, sign * 0.5 * ratio, 1.0, _TRAVEL)
            summed(series, _TRAVEL, COS, -sign, _TRAVEL)
        elif side == 0:
            # (1 - cos beta) / lam = lam sin^2 phi / (1 + cos beta)
            scaled(series, _COS_BETA, 1.0, 1.0, _A)
            power(series, _A, -1.0, _B)
            product(series, SIN_SQUARED, _B, _C)
            scaled(series, _C, ratio, 1.0, _TRAVEL)
            summed(series, _TRAVEL, COS, -1.0, _TRAVEL)
        else:
            # what motion() leaves to the inner dead centre: nothing cancels, however near lam is to 1
            if inside.cosine < 0.0:
                summed(series, _COS_BETA, COS, -ratio, _A)
                power(series, _A, -1.0, _B)
                scaled(series, _B, motion[2] * (1.0 + ratio), 0.0, _A)
            else:
                summed(series, _COS_BETA, COS, ratio, _A)
            scaled(series, COS, 1.0, 1.0, _B)
            product(series, _B, _A, _C)
            scaled(series, _A, 1.0, 1.0 + ratio, _A)
            power(series, _A, -1.0, _B)
            product(series, _C, _B, _TRAVEL)
            scaled(series, _TRAVEL, 2.0, 0.0, _TRAVEL)
    if bounded:
        # a row moves one way within a piece
        first, last = (
            _travel_at(motion, exact, side, _turned(angle - half)),
            _travel_at(motion, exact, side, _turned(angle + half)),
        )
        between(series, _TRAVEL, min(first, last), max(first, last))
    else:
        # where 1 - cos would cancel
        middle[_TRAVEL, 0] = _travel_at(motion, exact, side, there)


@inner
def _travel_at(motion, exact, side, there):  # type: ignore[no-untyped-def]
    """The same where a crank stands, as in :func:`kinematics.motion`."""
    ratio = motion[1]
    rise_or_fall = there.rise if side == 0 else there.fall
    if not exact:
        swing = 0.5 * ratio * there.sine**2
        return rise_or_fall + swing if side == 0 else rise_or_fall - swing
    short = motion[2] * (1.0 + ratio)
    cos_beta = np.sqrt(short + (ratio * there.cosine) ** 2)
    if side == 0:
        return rise_or_fall + ratio * there.sine**2 / (1.0 + cos_beta)
    upright = cos_beta + ratio * abs(there.cosine)
    u = upright if there.cosine >= 0.0 else short / upright
    return 2.0 * rise_or_fall * u / (u + 1.0 + ratio)
