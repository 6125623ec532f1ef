"""What the motion of a row is made of, as Taylor series in the shaft angle; compiled."""

import numpy as np

from optimizer.mechanics.kernel.row_numbers import (
    COS,
    COS_2,
    COS_4,
    COS_AT,
    COS_BETA,
    COS_FIRST,
    COS_LAST,
    COS_OFF,
    COSINE,
    FALL,
    FIRST,
    INERTIA,
    LAST,
    OUTWARD,
    OVER_CUBE,
    OVER_ROOT,
    RATIO,
    RISE,
    ROOT,
    SECANT,
    SHORT,
    SIN,
    SIN_2,
    SIN_4,
    SIN_AT,
    SIN_FIRST,
    SIN_LAST,
    SIN_OFF,
    SIN_SQUARED,
    SINE,
    SQUARE,
    TURNING,
    UNIT,
    UPRIGHT,
    A,
    B,
    C,
    F,
    G,
)
from optimizer.mechanics.kernel.taylor import ALL, LANES, between, circular, copied, power, product, scaled, summed
from optimizer.numerics.compiling import inner


@inner
def crank_at(crank, p, angle):  # type: ignore[no-untyped-def]
    """Where a crank stands: sine, cosine, 1 - cos, 1 + cos, by the half angle; nothing cancels but what has no digits
    in the angle either."""
    sine, cosine = np.sin(0.5 * angle), np.cos(0.5 * angle)
    crank[SINE, p], crank[COSINE, p] = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
    crank[RISE, p], crank[FALL, p] = 2.0 * sine**2, 2.0 * cosine**2


@inner
def _ranges(trig):  # type: ignore[no-untyped-def]
    """Middles and radii of cos and sin over intervals, into the first four, from what they are at both ends: an
    extreme is within where the other changes its sign."""
    for p in range(LANES):
        cos, sin, cos_last, sin_last = trig[COS_FIRST, p], trig[SIN_FIRST, p], trig[COS_LAST, p], trig[SIN_LAST, p]
        low, high = min(cos, cos_last), max(cos, cos_last)
        if sin * sin_last <= 0.0:
            if cos + cos_last > 0.0:
                high = 1.0
            else:
                low = -1.0
        trig[COS_AT, p], trig[COS_OFF, p] = 0.5 * (low + high), 0.5 * (high - low)
        low, high = min(sin, sin_last), max(sin, sin_last)
        if cos * cos_last <= 0.0:
            if sin + sin_last > 0.0:
                high = 1.0
            else:
                low = -1.0
        trig[SIN_AT, p], trig[SIN_OFF, p] = 0.5 * (low + high), 0.5 * (high - low)


@inner
def _doubled(trig, cos, sin):  # type: ignore[no-untyped-def]
    """cos and sin of twice the angle in their place."""
    cosine, sine = trig[cos], trig[sin]
    for p in range(LANES):
        c, s = cosine[p], sine[p]
        cosine[p], sine[p] = (c - s) * (c + s), 2.0 * s * c


@inner
def move(series, lane, cranks, trig, lanes):  # type: ignore[no-untyped-def]
    """What the motion of a row is made of."""
    middle, radius, bounded = series
    ratio, short, square, f, g = lane[RATIO], lane[SHORT], lane[SQUARE], lane[F], lane[G]
    for p in range(LANES):
        square[p] = ratio[p] * ratio[p]
    cos, sin = (COS_FIRST, SIN_FIRST) if bounded else (COS_AT, SIN_AT)
    copied(cranks[FIRST, COSINE], trig[cos])
    copied(cranks[FIRST, SINE], trig[sin])
    copied(cranks[LAST, COSINE], trig[COS_LAST])
    copied(cranks[LAST, SINE], trig[SIN_LAST])
    for multiple, of_cos, of_sin in ((1, COS, SIN), (2, COS_2, SIN_2), (4, COS_4, SIN_4)):
        if bounded:
            _ranges(trig)
            _doubled(trig, COS_LAST, SIN_LAST)
        circular(series, multiple, trig, of_cos, of_sin)
        _doubled(trig, cos, sin)
    # W = cos^2 beta = 1 - lam^2 + lam^2 cos^2 phi
    for p in range(LANES):
        f[p], g[p] = 0.5 * square[p], short[p] + 0.5 * square[p]
    scaled(series, COS_2, f, g, UPRIGHT)
    scaled(series, COS_2, lane[OVER_ROOT], lane[ROOT], SIN_SQUARED)
    along, across = middle[COS, 0], middle[SIN, 0]
    if bounded:
        cos_off, sin_off = radius[COS, 0], radius[SIN, 0]
        for p in range(LANES):
            least, most = max(abs(along[p]) - cos_off[p], 0.0), abs(along[p]) + cos_off[p]
            f[p], g[p] = short[p] + square[p] * least * least, short[p] + square[p] * most * most
        between(series, UPRIGHT, f, g)
        for p in range(LANES):
            least, most = max(abs(across[p]) - sin_off[p], 0.0), abs(across[p]) + sin_off[p]
            f[p], g[p] = least * least, most * most
        between(series, SIN_SQUARED, f, g)
    else:
        upright, sin_squared = middle[UPRIGHT, 0], middle[SIN_SQUARED, 0]
        for p in range(LANES):
            upright[p], sin_squared[p] = short[p] + square[p] * along[p] * along[p], across[p] * across[p]
    power(series, UPRIGHT, lane[ROOT], COS_BETA, lanes)
    power(series, UPRIGHT, lane[OVER_ROOT], SECANT, lanes)


@inner
def accelerate(series, lane, exact, lanes):  # type: ignore[no-untyped-def]
    """Acceleration over r omega^2."""
    ratio, short, square, f, g = lane[RATIO], lane[SHORT], lane[SQUARE], lane[F], lane[G]
    if not exact:
        summed(series, COS, COS_2, ratio, INERTIA)
        return
    # cos^4 = (3 + 4 cos 2 phi + cos 4 phi) / 8
    for p in range(LANES):
        f[p], g[p] = ratio[p] * (short[p] + 0.5 * square[p]), 0.375 * ratio[p] * square[p]
    scaled(series, COS_2, f, g, A)
    for p in range(LANES):
        f[p] = 0.125 * ratio[p] * square[p]
    summed(series, A, COS_4, f, A)
    if not series.bounded:
        # at 90 degrees the sum cancels, and what it is divided by may be as small
        total, cos, cos_2 = series.middle[A, 0], series.middle[COS, 0], series.middle[COS_2, 0]
        for p in range(LANES):
            total[p] = ratio[p] * (short[p] * cos_2[p] + square[p] * cos[p] ** 4)
    power(series, UPRIGHT, lane[OVER_CUBE], B, lanes)
    product(series, A, B, C, ALL)
    summed(series, COS, C, lane[UNIT], INERTIA)


@inner
def carry(series, lane):  # type: ignore[no-untyped-def]
    """What a piston force comes to at the crank pin, along the crank and across it; of several forces the same."""
    ratio, f = lane[RATIO], lane[F]
    # sin(phi + beta) / cos beta, positive against rotation, and cos(phi + beta) / cos beta, positive outward
    for own, by_rod, share, out in ((SIN, SIN_2, 0.5, TURNING), (COS, SIN_SQUARED, -1.0, OUTWARD)):
        product(series, by_rod, SECANT, A, ALL)
        for p in range(LANES):
            f[p] = share * ratio[p]
        summed(series, own, A, f, out)
