"""Pressures in the chambers of a row, as Taylor series in the shaft angle; compiled."""

import numpy as np

from optimizer.mechanics.kernel.row_numbers import (
    CLEAR,
    COS,
    COS_BETA,
    COSINE,
    CRANK_TRAVEL,
    EXPONENT,
    FALL,
    FIRST,
    FULL,
    HEAD_TRAVEL,
    INSIDE,
    LAST,
    OVER,
    OWN,
    RATIO,
    RISE,
    SHORT,
    SIN_SQUARED,
    SINE,
    START,
    UNIT,
    VOLUME,
    WITHIN,
    ZERO,
    A,
    B,
    C,
    F,
    G,
    H,
)
from optimizer.mechanics.kernel.taylor import ALL, LANES, between, constant, power, product, scaled, summed
from optimizer.numerics.compiling import inner


@inner
def indicated(series, traces, places, trace, first, lane, out, lanes):  # type: ignore[no-untyped-def]
    """A pressure as a trace has it, Pa: linear from the entry of its table before the angle that says which counts."""
    pressure, slope = lane[F], lane[G]
    for p in range(lanes):
        design = places.design[first + p] if traces.table.shape[1] > 1 else 0
        table, inside = traces.table[trace, design], lane[WITHIN, p]
        place = (inside - traces.lead[trace, design]) % traces.cycle[trace]
        entry, beyond = 0, traces.entries[trace] - 1
        while beyond - entry > 1:
            middle = (entry + beyond) // 2
            if traces.angle[trace, table, middle] <= place:
                entry = middle
            else:
                beyond = middle
        slope[p] = traces.slope[trace, table, entry]
        since = place - traces.angle[trace, table, entry] + (lane[OWN, p] - inside)
        pressure[p] = traces.pressure[trace, table, entry] + slope[p] * since
    constant(series, pressure, out)
    for p in range(lanes):
        if series.middle.shape[1] > 1:
            series.middle[out, 1, p] = slope[p]
        if series.bounded:
            series.radius[out, 0, p] = abs(slope[p]) * places.half[first + p]


@inner
def decide(chamber, lane, exact, side, inside, process, p):  # type: ignore[no-untyped-def]
    """The process in which a chamber is."""
    growing = (inside[SINE, p] > 0.0) == (side == 0)
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
    process[START, p], process[EXPONENT, p], process[FULL, p] = start, exponent, full
    process[CLEAR, p] = clear if exponent > 0.0 else 1.0


@inner
def cycle(series, lane, exact, process, side, cranks, out, lanes, travels):  # type: ignore[no-untyped-def]
    """Pressure of the four processes, Pa: constant, or a power of the volume in units of the crank radius.

    Parameters
    ----------
    travels : sum of 1 and 2, whether the travel of head and crank sides is made; what it is afterwards is returned.
    """
    start, exponent, clear, full = process[START], process[EXPONENT], process[CLEAR], process[FULL]
    f, g = lane[F], lane[G]
    moving = False
    for p in range(lanes):
        moving = moving or exponent[p] > 0.0
    if not moving:
        constant(series, start, out)
        return travels
    travel = HEAD_TRAVEL if side == 0 else CRANK_TRAVEL
    if not travels & (1 + side):
        # chambers of all rows that move alike share it
        _travel(series, lane, exact, side, cranks, travel, lanes)
    for p in range(LANES):
        f[p], g[p] = 1.0 / full[p], clear[p] / full[p]
    scaled(series, travel, f, g, VOLUME)
    for p in range(LANES):
        f[p] = -exponent[p]
    power(series, VOLUME, f, out, lanes)
    scaled(series, out, start, lane[ZERO], out)
    return travels | (1 + side)


@inner
def _travel(series, lane, exact, side, cranks, out, lanes):  # type: ignore[no-untyped-def]
    """Own travel of a chamber of one side over the crank radius."""
    middle, _, bounded = series
    ratio, short, unit, f, g, h = lane[RATIO], lane[SHORT], lane[UNIT], lane[F], lane[G], lane[H]
    if middle.shape[1] > 1:
        if not exact:
            sign = 1.0 if side == 0 else -1.0
            for p in range(LANES):
                f[p], g[p] = sign * 0.5 * ratio[p], -sign
            scaled(series, SIN_SQUARED, f, unit, out)
            summed(series, out, COS, g, out)
        elif side == 0:
            # (1 - cos beta) / lam = lam sin^2 phi / (1 + cos beta)
            scaled(series, COS_BETA, unit, unit, A)
            power(series, A, lane[OVER], B, lanes)
            product(series, SIN_SQUARED, B, C, ALL)
            scaled(series, C, ratio, unit, out)
            summed(series, out, COS, lane[OVER], out)
        else:
            # what motion() leaves to the inner dead centre: nothing cancels, however near lam is to 1
            for p in range(LANES):
                f[p] = ratio[p] if cranks[INSIDE, COSINE, p] >= 0.0 else -ratio[p]
            summed(series, COS_BETA, COS, f, A)
            power(series, A, lane[OVER], B, lanes)
            scaled(series, B, short, lane[ZERO], B)
            for k in range(middle.shape[1]):
                for p in range(LANES):
                    if cranks[INSIDE, COSINE, p] < 0.0:
                        middle[A, k, p] = middle[B, k, p]
                        series.radius[A, k, p] = series.radius[B, k, p]
            scaled(series, COS, unit, unit, B)
            product(series, B, A, C, ALL)
            for p in range(LANES):
                f[p] = 1.0 + ratio[p]
            scaled(series, A, unit, f, A)
            power(series, A, lane[OVER], B, lanes)
            product(series, C, B, out, ALL)
            for p in range(LANES):
                f[p] = 2.0
            scaled(series, out, f, lane[ZERO], out)
    first, last, there = cranks[FIRST], cranks[LAST], middle[out, 0]
    if bounded:
        # a row moves one way within a piece
        for p in range(lanes):
            g[p], h[p] = _travelled(lane, exact, side, first, p), _travelled(lane, exact, side, last, p)
            g[p], h[p] = min(g[p], h[p]), max(g[p], h[p])
        between(series, out, g, h)
    else:
        # where 1 - cos would cancel
        for p in range(lanes):
            there[p] = _travelled(lane, exact, side, first, p)


@inner
def _travelled(lane, exact, side, crank, p):  # type: ignore[no-untyped-def]
    """The same where a crank stands, as in :func:`kinematics.motion`."""
    ratio, sine, cosine = lane[RATIO, p], crank[SINE, p], crank[COSINE, p]
    rise_or_fall = crank[RISE, p] if side == 0 else crank[FALL, p]
    if not exact:
        swing = 0.5 * ratio * sine**2
        return rise_or_fall + swing if side == 0 else rise_or_fall - swing
    short = lane[SHORT, p]
    cos_beta = np.sqrt(short + (ratio * cosine) ** 2)
    if side == 0:
        return rise_or_fall + ratio * sine**2 / (1.0 + cos_beta)
    upright = cos_beta + ratio * abs(cosine)
    u = upright if cosine >= 0.0 else short / upright
    return 2.0 * rise_or_fall * u / (u + 1.0 + ratio)
