"""Forces of the rows as Taylor series in the shaft angle, at points or bounded over intervals; compiled.

The same closed forms as in :mod:`kinematics`, :mod:`gas`, :mod:`friction` and :mod:`rod`, written so that each keeps
its derivatives: W = cos^2 beta, secant = W^{-1/2}, and pressures as powers of the volume. Between two breaks a chamber
is in one of its four processes and a row moves one way, so that every form is analytic; which one counts is decided at
an angle within the piece.

Shapes: N designs, R rows, C chambers of a row, Q places: angles of designs one after the other.
"""

from typing import NamedTuple

import numpy as np

from optimizer.mechanics.kernel.taylor import (
    ALL,
    LANES,
    Series,
    between,
    circular,
    constant,
    copied,
    power,
    product,
    scaled,
    summed,
)
from optimizer.numerics.arrays import Real
from optimizer.numerics.compiling import inner, kernel

#: functions of one row; as numpy's integers, for each Python literal that is handed on is a type of its own, for which
#: all that takes it is compiled anew. The first are what readings are made of, and after them the pressures
INERTIA, COS, SIN, SIN_2, SIN_SQUARED, SECANT = np.arange(6)
FUNCTIONS = 6
_COS_2, _COS_4, _SIN_4, _UPRIGHT, _COS_BETA, _TRAVEL, _A, _B, _C = np.arange(FUNCTIONS, FUNCTIONS + 9)
_PRESSURES = FUNCTIONS + 9
#: where cranks stand: at the angle that says which process counts, at the place or the first end of the interval, and
#: at its other end
_INSIDE, _FIRST, _LAST = np.arange(3)
_SINE, _COSINE, _RISE, _FALL = np.arange(4)
#: cos and sin of a multiple of the angle: of the place or the middles of their ranges, and at both ends of the interval
_COS_AT, _SIN_AT, _COS_OFF, _SIN_OFF, _COS_FIRST, _SIN_FIRST, _COS_LAST, _SIN_LAST = np.arange(8)
#: numbers of every lane
_RATIO, _SHORT, _SQUARE, _ZERO, _UNIT, _ROOT, _OVER_ROOT, _OVER_CUBE, _OVER, _F, _G, _H = np.arange(12)
_OWN, _WITHIN = np.arange(12, 14)
_NUMBERS = 14
#: of the process in which a chamber is: first pressure [Pa], exponent, clearance and first volume over crank radius
#: times area
_START, _EXPONENT, _CLEAR, _FULL = np.arange(4)


class Tables(NamedTuple):
    """Pressures that T traces give, in D tables of at most K entries, of S designs or of all.

    angle, pressure, slope : (T, D, K) rad, Pa, and Pa/rad from each entry on.
    entries : (T,) of a table, the rest of which means nothing.
    cycle : (T,) rad, after which a trace repeats.
    table, lead : (T, S) which table a design has, and the own crank angle [rad] at which it begins.
    """

    angle: Real
    pressure: Real
    slope: Real
    entries: np.ndarray
    cycle: Real
    table: np.ndarray
    lead: Real


class Rows(NamedTuple):
    """Data of the rows of D, S or A designs, 1 where all are the same.

    motion : (D, R, 4) angle ahead [rad], rod ratio, 1 - rod ratio, sense.
    scale : (S, R, 2) m r omega^2 [N], friction [N].
    area : (A, R, C) m^2, with the sign of its force in rod tension.
    gas : (D, R, C, 8) suction and discharge pressure [Pa], relative clearance, exponents of expansion and compression,
        volumes over crank radius times area at which suction and discharge open, whether it is closed.
    trace : (R, C) which of the traces gives the pressure of a chamber, or -1.
    exact : kinematics, or cut off after the second order.
    traces : the pressures that are given.
    """

    motion: Real
    scale: Real
    area: Real
    gas: Real
    trace: np.ndarray
    exact: bool
    traces: Tables


class Places(NamedTuple):
    """Angles (Q,) rad.

    design : which design each is of.
    half : half widths of intervals, below pi/8; (0,) at points.
    within : angles that say which process counts.
    """

    design: np.ndarray
    centre: Real
    half: Real
    within: Real


#: which rows count where all do
ALL_ROWS = np.zeros((0, 0), np.bool_)


class Functions(NamedTuple):
    """What the forces of designs are made of: those that differ in masses, speed, friction and areas alone have them
    once.

    middle : (R, 6 + C, order + 1, Q) acceleration over r omega^2, cos and sin of the crank angle, sin of twice the
        angle, sin^2, 1 / cos beta, and pressures [Pa] unless there are none.
    radius : the same of enclosures; without functions at points.
    way : (R, Q) which way the row moves: 1 to the shaft; nan where they are not made.
    """

    middle: Real
    radius: Real
    way: Real


@kernel
def row_functions(rows, places, order, pressed, counted):  # type: ignore[no-untyped-def]
    """What all readings of the rows are made of; without pressures where it is not pressed.

    Parameters
    ----------
    counted : (R, Q) which rows count at which places: of many side by side that do not they are not made. (0, 0) where
        all count.
    """
    bounded = places.half.size > 0
    designs, count = rows.motion.shape[:2]
    number, chambers = places.centre.size, rows.gas.shape[2] if pressed else 0
    middle = np.empty((count, FUNCTIONS + chambers, order + 1, number))
    radius = np.empty((count, FUNCTIONS + chambers if bounded else 0, order + 1, number))
    way = np.empty((count, number))
    shape = (_PRESSURES + chambers, order + 1, LANES)
    series = Series(np.zeros(shape), np.zeros(shape), bounded)
    cranks, lane, process = np.zeros((3, 4, LANES)), np.zeros((_NUMBERS, LANES)), np.zeros((4, LANES))
    trig = np.zeros((8, LANES))
    lane[_UNIT], lane[_ROOT], lane[_OVER], lane[_OVER_ROOT], lane[_OVER_CUBE] = 1.0, 0.5, -1.0, -0.5, -1.5
    for r in range(count):
        for first in range(0, number, LANES):
            lanes = min(LANES, number - first)
            if counted.size > 0 and not np.any(counted[r, first : first + lanes]):
                way[r, first : first + lanes] = np.nan
                continue
            for p in range(lanes):
                q = first + p
                motion = rows.motion[places.design[q] if designs > 1 else 0, r]
                angle, within = places.centre[q] + motion[0], places.within[q] + motion[0]
                lane[_RATIO, p], lane[_SHORT, p] = motion[1], motion[2] * (1.0 + motion[1])
                lane[_OWN, p], lane[_WITHIN, p] = angle, within
                if p > 0 and places.within[q] == places.within[q - 1] and designs == 1:
                    # many places of one piece stand side by side
                    for f in range(4):
                        cranks[_INSIDE, f, p] = cranks[_INSIDE, f, p - 1]
                else:
                    _turn(cranks[_INSIDE], p, within)
                if bounded:
                    _turn(cranks[_FIRST], p, angle - places.half[q])
                    _turn(cranks[_LAST], p, angle + places.half[q])
                elif angle == within:
                    for f in range(4):
                        cranks[_FIRST, f, p] = cranks[_INSIDE, f, p]
                else:
                    _turn(cranks[_FIRST], p, angle)
                way[r, q] = np.sign(cranks[_INSIDE, _SINE, p])
            _move(series, lane, cranks, trig, lanes)
            _accelerate(series, lane, rows.exact, lanes)
            for c in range(chambers):
                out, trace = _PRESSURES + c, rows.trace[r, c]
                if trace < 0:
                    for p in range(lanes):
                        one = places.design[first + p] if designs > 1 else 0
                        _decide(rows.gas[one, r, c], lane, rows.exact, c % 2, cranks[_INSIDE], process, p)
                    _cycle(series, lane, rows.exact, process, c % 2, cranks, out, lanes)
                else:
                    _trace_pressure(series, rows.traces, places, trace, first, lane, out, lanes)
            for f in range(FUNCTIONS + chambers):
                made = f if f < FUNCTIONS else f - FUNCTIONS + _PRESSURES
                for k in range(order + 1):
                    copied(series.middle[made, k], middle[r, f, k, first:], lanes)
                    if bounded:
                        copied(series.radius[made, k], radius[r, f, k, first:], lanes)
    return Functions(middle, radius, way)


@inner
def _turn(crank, p, angle):  # type: ignore[no-untyped-def]
    """Where a crank stands: sine, cosine, 1 - cos, 1 + cos, by the half angle; nothing cancels but what has no digits
    in the angle either."""
    sine, cosine = np.sin(0.5 * angle), np.cos(0.5 * angle)
    crank[_SINE, p], crank[_COSINE, p] = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
    crank[_RISE, p], crank[_FALL, p] = 2.0 * sine**2, 2.0 * cosine**2


@inner
def _ranges(trig, lanes):  # type: ignore[no-untyped-def]
    """Middles and radii of cos and sin over intervals, into the first four, from what they are at both ends: an
    extreme is within where the other changes its sign."""
    for p in range(lanes):
        cos, sin, cos_last, sin_last = trig[_COS_FIRST, p], trig[_SIN_FIRST, p], trig[_COS_LAST, p], trig[_SIN_LAST, p]
        low, high = min(cos, cos_last), max(cos, cos_last)
        if sin * sin_last <= 0.0:
            if cos + cos_last > 0.0:
                high = 1.0
            else:
                low = -1.0
        trig[_COS_AT, p], trig[_COS_OFF, p] = 0.5 * (low + high), 0.5 * (high - low)
        low, high = min(sin, sin_last), max(sin, sin_last)
        if cos * cos_last <= 0.0:
            if sin + sin_last > 0.0:
                high = 1.0
            else:
                low = -1.0
        trig[_SIN_AT, p], trig[_SIN_OFF, p] = 0.5 * (low + high), 0.5 * (high - low)


@inner
def _doubled(trig, cos, sin, lanes):  # type: ignore[no-untyped-def]
    """cos and sin of twice the angle in their place."""
    one, other = trig[cos], trig[sin]
    for p in range(lanes):
        c, s = one[p], other[p]
        one[p], other[p] = (c - s) * (c + s), 2.0 * s * c


@inner
def _move(series, lane, cranks, trig, lanes):  # type: ignore[no-untyped-def]
    """What the motion of a row is made of."""
    middle, radius, bounded = series
    ratio, short, square, f, g = lane[_RATIO], lane[_SHORT], lane[_SQUARE], lane[_F], lane[_G]
    for p in range(lanes):
        square[p] = ratio[p] * ratio[p]
    cos, sin = (_COS_FIRST, _SIN_FIRST) if bounded else (_COS_AT, _SIN_AT)
    copied(cranks[_FIRST, _COSINE], trig[cos], lanes)
    copied(cranks[_FIRST, _SINE], trig[sin], lanes)
    copied(cranks[_LAST, _COSINE], trig[_COS_LAST], lanes)
    copied(cranks[_LAST, _SINE], trig[_SIN_LAST], lanes)
    for multiple, of_cos, of_sin in ((1, COS, SIN), (2, _COS_2, SIN_2), (4, _COS_4, _SIN_4)):
        if bounded:
            _ranges(trig, lanes)
            _doubled(trig, _COS_LAST, _SIN_LAST, lanes)
        circular(series, multiple, trig, of_cos, of_sin, lanes)
        _doubled(trig, cos, sin, lanes)
    # W = cos^2 beta = 1 - lam^2 + lam^2 cos^2 phi
    for p in range(lanes):
        f[p], g[p] = 0.5 * square[p], short[p] + 0.5 * square[p]
    scaled(series, _COS_2, f, g, _UPRIGHT, lanes)
    scaled(series, _COS_2, lane[_OVER_ROOT], lane[_ROOT], SIN_SQUARED, lanes)
    along, across = middle[COS, 0], middle[SIN, 0]
    if bounded:
        cos_off, sin_off = radius[COS, 0], radius[SIN, 0]
        for p in range(lanes):
            least, most = max(abs(along[p]) - cos_off[p], 0.0), abs(along[p]) + cos_off[p]
            f[p], g[p] = short[p] + square[p] * least * least, short[p] + square[p] * most * most
        between(series, _UPRIGHT, f, g, lanes)
        for p in range(lanes):
            least, most = max(abs(across[p]) - sin_off[p], 0.0), abs(across[p]) + sin_off[p]
            f[p], g[p] = least * least, most * most
        between(series, SIN_SQUARED, f, g, lanes)
    else:
        upright, sin_squared = middle[_UPRIGHT, 0], middle[SIN_SQUARED, 0]
        for p in range(lanes):
            upright[p], sin_squared[p] = short[p] + square[p] * along[p] * along[p], across[p] * across[p]
    power(series, _UPRIGHT, lane[_ROOT], _COS_BETA, lanes)
    power(series, _UPRIGHT, lane[_OVER_ROOT], SECANT, lanes)


@inner
def _accelerate(series, lane, exact, lanes):  # type: ignore[no-untyped-def]
    """Acceleration over r omega^2."""
    ratio, short, square, f, g = lane[_RATIO], lane[_SHORT], lane[_SQUARE], lane[_F], lane[_G]
    if not exact:
        summed(series, COS, _COS_2, ratio, INERTIA, lanes)
        return
    # cos^4 = (3 + 4 cos 2 phi + cos 4 phi) / 8
    for p in range(lanes):
        f[p], g[p] = ratio[p] * (short[p] + 0.5 * square[p]), 0.375 * ratio[p] * square[p]
    scaled(series, _COS_2, f, g, _A, lanes)
    for p in range(lanes):
        f[p] = 0.125 * ratio[p] * square[p]
    summed(series, _A, _COS_4, f, _A, lanes)
    if not series.bounded:
        # at 90 degrees the sum cancels, and what it is divided by may be as small
        found, cos, cos_2 = series.middle[_A, 0], series.middle[COS, 0], series.middle[_COS_2, 0]
        for p in range(lanes):
            found[p] = ratio[p] * (short[p] * cos_2[p] + square[p] * cos[p] ** 4)
    power(series, _UPRIGHT, lane[_OVER_CUBE], _B, lanes)
    product(series, _A, _B, _C, lanes, ALL)
    summed(series, COS, _C, lane[_UNIT], INERTIA, lanes)


@inner
def _trace_pressure(series, traces, places, trace, first, lane, out, lanes):  # type: ignore[no-untyped-def]
    """A pressure as a trace has it, Pa: linear from the entry of its table before the angle that says which counts."""
    pressure, slope = lane[_F], lane[_G]
    for p in range(lanes):
        design = places.design[first + p] if traces.table.shape[1] > 1 else 0
        table, inside = traces.table[trace, design], lane[_WITHIN, p]
        place = (inside - traces.lead[trace, design]) % traces.cycle[trace]
        entry, beyond = 0, traces.entries[trace] - 1
        while beyond - entry > 1:
            middle = (entry + beyond) // 2
            if traces.angle[trace, table, middle] <= place:
                entry = middle
            else:
                beyond = middle
        slope[p] = traces.slope[trace, table, entry]
        since = place - traces.angle[trace, table, entry] + (lane[_OWN, p] - inside)
        pressure[p] = traces.pressure[trace, table, entry] + slope[p] * since
    constant(series, pressure, out, lanes)
    for p in range(lanes):
        if series.middle.shape[1] > 1:
            series.middle[out, 1, p] = slope[p]
        if series.bounded:
            series.radius[out, 0, p] = abs(slope[p]) * places.half[first + p]


@inner
def _decide(chamber, lane, exact, side, inside, process, p):  # type: ignore[no-untyped-def]
    """The process in which a chamber is."""
    growing = (inside[_SINE, p] > 0.0) == (side == 0)
    low, high, clear = chamber[0], chamber[1], 2.0 * chamber[2]
    start, exponent, full = low, 0.0, 1.0
    if chamber[7]:
        volume = _travelled(lane, exact, side, inside, p) + clear
        if growing and volume < chamber[5]:
            start, exponent, full = high, chamber[3], clear
        elif not growing and volume > chamber[6]:
            start, exponent, full = low, chamber[4], 2.0 + clear
        elif not growing:
            start = high
    process[_START, p], process[_EXPONENT, p], process[_FULL, p] = start, exponent, full
    process[_CLEAR, p] = clear if exponent > 0.0 else 1.0


@inner
def _cycle(series, lane, exact, process, side, cranks, out, lanes):  # type: ignore[no-untyped-def]
    """Pressure of the four processes, Pa: constant, or a power of the volume in units of the crank radius."""
    start, exponent, clear, full = process[_START], process[_EXPONENT], process[_CLEAR], process[_FULL]
    f, g = lane[_F], lane[_G]
    moving = False
    for p in range(lanes):
        moving = moving or exponent[p] > 0.0
    if not moving:
        constant(series, start, out, lanes)
        return
    _travel(series, lane, exact, side, cranks, lanes)
    for p in range(lanes):
        f[p], g[p] = 1.0 / full[p], clear[p] / full[p]
    scaled(series, _TRAVEL, f, g, _TRAVEL, lanes)
    for p in range(lanes):
        f[p] = -exponent[p]
    power(series, _TRAVEL, f, out, lanes)
    scaled(series, out, start, lane[_ZERO], out, lanes)


@inner
def _travel(series, lane, exact, side, cranks, lanes):  # type: ignore[no-untyped-def]
    """Own travel of a chamber of one side over the crank radius."""
    middle, _, bounded = series
    ratio, short, one, f, g, h = lane[_RATIO], lane[_SHORT], lane[_UNIT], lane[_F], lane[_G], lane[_H]
    if middle.shape[1] > 1:
        if not exact:
            sign = 1.0 if side == 0 else -1.0
            for p in range(lanes):
                f[p], g[p] = sign * 0.5 * ratio[p], -sign
            scaled(series, SIN_SQUARED, f, one, _TRAVEL, lanes)
            summed(series, _TRAVEL, COS, g, _TRAVEL, lanes)
        elif side == 0:
            # (1 - cos beta) / lam = lam sin^2 phi / (1 + cos beta)
            scaled(series, _COS_BETA, one, one, _A, lanes)
            power(series, _A, lane[_OVER], _B, lanes)
            product(series, SIN_SQUARED, _B, _C, lanes, ALL)
            scaled(series, _C, ratio, one, _TRAVEL, lanes)
            summed(series, _TRAVEL, COS, lane[_OVER], _TRAVEL, lanes)
        else:
            # what motion() leaves to the inner dead centre: nothing cancels, however near lam is to 1
            for p in range(lanes):
                f[p] = ratio[p] if cranks[_INSIDE, _COSINE, p] >= 0.0 else -ratio[p]
            summed(series, _COS_BETA, COS, f, _A, lanes)
            power(series, _A, lane[_OVER], _B, lanes)
            scaled(series, _B, short, lane[_ZERO], _B, lanes)
            for k in range(middle.shape[1]):
                for p in range(lanes):
                    if cranks[_INSIDE, _COSINE, p] < 0.0:
                        middle[_A, k, p] = middle[_B, k, p]
                        series.radius[_A, k, p] = series.radius[_B, k, p]
            scaled(series, COS, one, one, _B, lanes)
            product(series, _B, _A, _C, lanes, ALL)
            for p in range(lanes):
                f[p] = 1.0 + ratio[p]
            scaled(series, _A, one, f, _A, lanes)
            power(series, _A, lane[_OVER], _B, lanes)
            product(series, _C, _B, _TRAVEL, lanes, ALL)
            for p in range(lanes):
                f[p] = 2.0
            scaled(series, _TRAVEL, f, lane[_ZERO], _TRAVEL, lanes)
    first, last, there = cranks[_FIRST], cranks[_LAST], middle[_TRAVEL, 0]
    if bounded:
        # a row moves one way within a piece
        for p in range(lanes):
            g[p], h[p] = _travelled(lane, exact, side, first, p), _travelled(lane, exact, side, last, p)
            g[p], h[p] = min(g[p], h[p]), max(g[p], h[p])
        between(series, _TRAVEL, g, h, lanes)
    else:
        # where 1 - cos would cancel
        for p in range(lanes):
            there[p] = _travelled(lane, exact, side, first, p)


@inner
def _travelled(lane, exact, side, crank, p):  # type: ignore[no-untyped-def]
    """The same where a crank stands, as in :func:`kinematics.motion`."""
    ratio, sine, cosine = lane[_RATIO, p], crank[_SINE, p], crank[_COSINE, p]
    rise_or_fall = crank[_RISE, p] if side == 0 else crank[_FALL, p]
    if not exact:
        swing = 0.5 * ratio * sine**2
        return rise_or_fall + swing if side == 0 else rise_or_fall - swing
    short = lane[_SHORT, p]
    cos_beta = np.sqrt(short + (ratio * cosine) ** 2)
    if side == 0:
        return rise_or_fall + ratio * sine**2 / (1.0 + cos_beta)
    upright = cos_beta + ratio * abs(cosine)
    u = upright if cosine >= 0.0 else short / upright
    return 2.0 * rise_or_fall * u / (u + 1.0 + ratio)
