"""The peaks' part of a step of the interior point for discs, compiled: :mod:`optimizer.program.kernel.discs`.

Every vector is a_j = c_j + f_j U_b, with U_b what the webs add to the force or to the moment. Of a term of the
objective the size s_j is free, and that of the multiplier, l_j, is the price of the objective. Of what is below a
ceiling the size is that of the ceiling, and l_j is free. Of either the free one is eliminated: with (o, o') = (l, y) of
a term and (s, a) of a ceiling,

    (o l - o' y') da + (o s - o' a') dy = o r - o' r_0                    for every vector

where da_j = f_j (G_b + sum_i N_bb(i) f_i dy_i) is what the webs do. In the second stage the price of the objective is a
further unknown, in the first that of a budget.

A number of vector j stands at ``NAME + t`` of its row of ``peak``, lane t. Every loop takes the rows that it needs as
arrays of their own: the compiler would not see that places in one array, which vary at run time, do not overlap.
"""

from optimizer.program.kernel.compiling import fused, fused_inlined
from optimizer.program.kernel.disc_webs import (
    AIM,
    BOTH,
    BUDGET,
    CHANGE,
    D_BUDGET,
    D_PRICE,
    DU,
    DUAL,
    GAP,
    KEEP,
    LANES,
    LEFT,
    MASS,
    MOST,
    PRICE,
    PRIMAL,
    R_LEFT,
    RISE,
    N,
    U,
    crossing,
    determinant,
)

(
    CX, CY, F, OVER,  # constant, multiple of force or moment, what the size is over the ceiling
    YX, YY, S, L,  # multiplier, size, size of the multiplier
    AX, AY,  # vector
    KA, KB, KC, KD,  # f (o l - o' y')
    J0, JX, JY,  # right sides
    DYX, DYY, DS, DL, DAX, DAY,  # the step
    PEAK,  # numbers of a vector
) = range(0, 24 * LANES, LANES)  # fmt: skip
#: numbers of a vector and of a block of 2 x 2
PAIR, BLOCK = 2 * LANES, 4 * LANES


@fused
def add_multiple(vector, pair, total):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        total[t] += vector[t + F] * vector[t + pair]
        total[t + LANES] += vector[t + F] * vector[t + pair + LANES]


@fused
def look_at_peaks(least_mass, budgeted, terms, basis, peak, own):  # type: ignore[no-untyped-def]
    """Where the peaks stand, what they add to the gap, and the right sides of a step to products of 0."""
    for t in range(LANES):
        own[t + LEFT] = own[t + MOST]
    for j in range(basis.size):
        vector = peak[j]
        _look_at_vector(vector, own[U + PAIR * basis[j] : N])
        for t in range(LANES):
            own[t + GAP] -= vector[t + J0]
        if j < terms:
            for t in range(LANES):
                own[t + LEFT] -= vector[t + S]
    if least_mass:
        for t in range(LANES):
            own[t + R_LEFT] = -own[t + LEFT] * own[t + PRICE]
            own[t + GAP] -= own[t + R_LEFT]
    elif budgeted:
        for t in range(LANES):
            own[t + LEFT] = 1.0 - own[t + MASS]
            own[t + R_LEFT] = -own[t + LEFT] * own[t + BUDGET]
            own[t + GAP] -= own[t + R_LEFT]


@fused
def _look_at_vector(vector, of_webs):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        s, size, yx, yy, f = vector[t + S], vector[t + L], vector[t + YX], vector[t + YY], vector[t + F]
        ax, ay = vector[t + CX] + f * of_webs[t], vector[t + CY] + f * of_webs[t + LANES]
        vector[t + AX], vector[t + AY], vector[t + J0] = ax, ay, -(s * size + ax * yx + ay * yy)
        vector[t + JX], vector[t + JY] = -(s * yx + size * ax), -(s * yy + size * ay)


@fused_inlined
def _slower(vector, own, t):  # type: ignore[no-untyped-def]
    """No longer steps than those to the boundary of a cone."""
    c, d = (
        determinant(vector[t + S], vector[t + AX], vector[t + AY]),
        determinant(vector[t + L], vector[t + YX], vector[t + YY]),
    )
    per = 1.0 / (c * d)
    primal = (
        d
        * per
        * crossing(c, vector[t + S], vector[t + AX], vector[t + AY], vector[t + DS], vector[t + DAX], vector[t + DAY])
    )
    dual = (
        c
        * per
        * crossing(d, vector[t + L], vector[t + YX], vector[t + YY], vector[t + DL], vector[t + DYX], vector[t + DYY])
    )
    own[t + PRIMAL] = primal if primal > own[t + PRIMAL] else own[t + PRIMAL]
    own[t + DUAL] = dual if dual > own[t + DUAL] else own[t + DUAL]


@fused_inlined
def _along(vector, t, dax, day):  # type: ignore[no-untyped-def]
    """What a step does to the product of a vector with its multiplier."""
    of_multiplier = vector[t + AX] * vector[t + DYX] + vector[t + AY] * vector[t + DYY]
    return of_multiplier + vector[t + YX] * dax + vector[t + YY] * day


@fused
def _step_term(vector, webs, own):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        dax, day = vector[t + F] * webs[t], vector[t + F] * webs[t + LANES]
        ds = (vector[t + J0] - _along(vector, t, dax, day) - vector[t + S] * own[t + D_PRICE]) / vector[t + L]
        vector[t + DS], vector[t + DL], vector[t + DAX], vector[t + DAY] = ds, own[t + D_PRICE], dax, day
        own[t + RISE] += ds
        _slower(vector, own, t)


@fused
def _step_ceiling(vector, webs, own):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        dax, day = vector[t + F] * webs[t], vector[t + F] * webs[t + LANES]
        vector[t + DL] = (vector[t + J0] - _along(vector, t, dax, day) - vector[t + L] * vector[t + DS]) / vector[t + S]
        vector[t + DAX], vector[t + DAY] = dax, day
        _slower(vector, own, t)


@fused
def step_peaks(least_mass, budgeted, terms, basis, peak, own):  # type: ignore[no-untyped-def]
    """The step of the peaks, from that of the webs, and how long it may be for slacks and multipliers together."""
    for j in range(basis.size):
        vector, of = peak[j], DU + PAIR * basis[j]
        if j < terms:
            _step_term(vector, own[of : of + PAIR], own)
        else:
            _step_ceiling(vector, own[of : of + PAIR], own)
    for t in range(LANES):
        primal, dual = own[t + PRIMAL], own[t + DUAL]
        if least_mass:
            shrinks, falls = own[t + RISE] / own[t + LEFT], -own[t + D_PRICE] / own[t + PRICE]
            primal, dual = shrinks if shrinks > primal else primal, falls if falls > dual else dual
        elif budgeted:
            shrinks, falls = own[t + CHANGE] / own[t + LEFT], -own[t + D_BUDGET] / own[t + BUDGET]
            primal, dual = shrinks if shrinks > primal else primal, falls if falls > dual else dual
        own[t + PRIMAL], own[t + DUAL] = 1.0 / primal, 1.0 / dual


@fused
def correct_peaks(least_mass, budgeted, peak, own):  # type: ignore[no-untyped-def]
    """Right sides of a step to products ``AIM``, corrected by the second-order products of the last direction."""
    for j in range(peak.shape[0]):
        vector = peak[j]
        for t in range(LANES):
            coupling, dl, dyx, dyy = own[t + BOTH], vector[t + DL], vector[t + DYX], vector[t + DYY]
            ds, dax, day = coupling * vector[t + DS], coupling * vector[t + DAX], coupling * vector[t + DAY]
            vector[t + J0] += own[t + AIM] - ds * dl - dax * dyx - day * dyy
            vector[t + JX] -= ds * dyx + dl * dax
            vector[t + JY] -= ds * dyy + dl * day
    if least_mass:
        for t in range(LANES):
            own[t + R_LEFT] += own[t + AIM] + own[t + BOTH] * own[t + RISE] * own[t + D_PRICE]
    elif budgeted:
        for t in range(LANES):
            own[t + R_LEFT] += own[t + AIM] + own[t + BOTH] * own[t + CHANGE] * own[t + D_BUDGET]


@fused
def move_peaks(least_mass, budgeted, terms, peak, own):  # type: ignore[no-untyped-def]
    """Slacks by ``PRIMAL``, multipliers by ``DUAL``; and what they add to the gap then."""
    for t in range(LANES):
        own[t + PRICE] += own[t + DUAL] * own[t + D_PRICE]
        own[t + BUDGET] += own[t + DUAL] * own[t + D_BUDGET]
        own[t + LEFT] = own[t + MOST]
    for j in range(peak.shape[0]):
        vector = peak[j]
        for t in range(LANES):
            primal, dual = own[t + PRIMAL], own[t + DUAL]
            s, size = vector[t + S] + primal * vector[t + DS], vector[t + L] + dual * vector[t + DL]
            yx, yy = vector[t + YX] + dual * vector[t + DYX], vector[t + YY] + dual * vector[t + DYY]
            ax, ay = vector[t + AX] + primal * vector[t + DAX], vector[t + AY] + primal * vector[t + DAY]
            vector[t + S], vector[t + L], vector[t + YX], vector[t + YY] = s, size, yx, yy
            own[t + GAP] += s * size + (ax * yx + ay * yy)
        if j < terms:
            for t in range(LANES):
                own[t + LEFT] -= vector[t + S]
        else:
            # a full step takes all of it away, to the last bit
            for t in range(LANES):
                vector[t + OVER] *= 1.0 - own[t + PRIMAL] * own[t + KEEP]
    if least_mass:
        for t in range(LANES):
            own[t + GAP] += own[t + LEFT] * own[t + PRICE]
    elif budgeted:
        for t in range(LANES):
            own[t + GAP] += (1.0 - own[t + MASS]) * own[t + BUDGET]
