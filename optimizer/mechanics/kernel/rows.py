"""Forces of the rows as Taylor series in the shaft angle, at points or bounded over intervals; compiled.

The same closed forms as in :mod:`kinematics`, :mod:`gas`, :mod:`friction` and :mod:`rod`, written so that each keeps
its derivatives: W = cos^2 beta, secant = W^{-1/2}, and pressures as powers of the volume. Between two breaks a chamber
is in one of its four processes and a row moves one way, so that every form is analytic; which one counts is decided at
an angle within the piece.

Shapes: N designs, R rows, C chambers of a row, Q places: angles of designs one after the other.
"""

from typing import NamedTuple

import numpy as np

from optimizer.mechanics.kernel.pressures import cycle, decide, indicated
from optimizer.mechanics.kernel.row_motion import accelerate, carry, crank_at, move
from optimizer.mechanics.kernel.row_numbers import (
    COSINE,
    FIRST,
    FUNCTIONS,
    INSIDE,
    LAST,
    NUMBERS,
    OVER,
    OVER_CUBE,
    OVER_ROOT,
    OWN,
    PRESSURES,
    RATIO,
    ROOT,
    SHORT,
    SINE,
    UNIT,
    WITHIN,
)
from optimizer.mechanics.kernel.taylor import LANES, Series, any_of, copied
from optimizer.numerics.arrays import Real
from optimizer.numerics.compiling import inner, inner_with_arrays


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
    traces : the tables of pressures.
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


class Functions(NamedTuple):
    """What the forces of designs are made of: those that differ in masses, speed, friction and areas alone have them
    once.

    middle : (R, blocks, 6 + C, order + 1, LANES) acceleration over r omega^2, cos and sin of the crank angle, what is
        across and along the crank of a force 1 on the piston, 1 / cos beta, and pressures [Pa] unless there are none;
        block by block of places, of which the last may be less than full.
    radius : the same of enclosures; without functions at points.
    way : (R, Q) which way the row moves: 1 to the shaft; nan where they are not made.
    """

    middle: Real
    radius: Real
    way: Real


@inner_with_arrays
def row_functions(rows, places, order, with_gas, mask):  # type: ignore[no-untyped-def]
    """What all readings of the rows are made of; without pressures where it is not pressed.

    Parameters
    ----------
    mask : (R, Q) which rows count at which places: of many side by side that do not they are not made. (0, 0) where
        all count.
    """
    bounded = places.half.size > 0
    count, number = rows.motion.shape[1], places.centre.size
    chambers = rows.gas.shape[2] if with_gas else 0
    blocks = (number + LANES - 1) // LANES
    middle = np.empty((count, blocks, FUNCTIONS + chambers, order + 1, LANES))
    radius = np.empty((count, blocks, FUNCTIONS + chambers if bounded else 0, order + 1, LANES))
    way = np.empty((count, number))
    shape = (PRESSURES + chambers + 1, order + 1, LANES)
    series = Series(np.zeros(shape), np.zeros(shape), bounded)
    cranks, lane, process = np.zeros((3, 4, LANES)), np.zeros((NUMBERS, LANES)), np.zeros((4, LANES))
    lane[UNIT], lane[ROOT], lane[OVER], lane[OVER_ROOT], lane[OVER_CUBE] = 1.0, 0.5, -1.0, -0.5, -1.5
    room = (cranks, lane, process, np.zeros((8, LANES)), np.zeros(LANES, np.bool_))
    functions = Functions(middle, radius, way)
    _expand(rows, places, mask, _alike(rows.motion), series, room, functions)
    return functions


@inner
def _expand(rows, places, mask, alike, series, room, functions):  # type: ignore[no-untyped-def]
    """Write functions of the rows; nothing is made here, for to count who holds an array takes longer than to use it.

    Parameters
    ----------
    alike : (R,) of each row the first that moves as it does.
    room : work arrays of the lanes.
    """
    middle, radius, way = functions
    cranks, lane, process, trig, repeats = room
    bounded, chambers = series.bounded, middle.shape[2] - FUNCTIONS
    designs, count = rows.motion.shape[:2]
    number, terms = places.centre.size, middle.shape[3]
    for r in range(count):
        if alike[r] != r:
            continue
        for block in range(middle.shape[1]):
            first = block * LANES
            lanes, is_any = min(LANES, number - first), mask.size == 0
            for t in range(r, count):
                if mask.size > 0 and alike[t] == r:
                    is_any = is_any or any_of(mask[t], first, lanes)
                    for p in range(lanes):
                        way[t, first + p] = np.nan
            if not is_any:
                continue
            last = np.int64(-1)
            for p in range(lanes):
                q = first + p
                index = places.design[q] if designs > 1 else np.int64(0)
                motion = rows.motion[index, r]
                angle, within = places.centre[q] + motion[0], places.within[q] + motion[0]
                lane[RATIO, p], lane[SHORT, p] = motion[1], motion[2] * (1.0 + motion[1])
                lane[OWN, p], lane[WITHIN, p] = angle, within
                # many places of one piece stand side by side
                repeats[p] = p > 0 and index == last and places.within[q] == places.within[q - 1]
                last = index
                if repeats[p]:
                    # what is decided by the rest is repeated too
                    cranks[INSIDE, SINE, p] = cranks[INSIDE, SINE, p - 1]
                    cranks[INSIDE, COSINE, p] = cranks[INSIDE, COSINE, p - 1]
                else:
                    crank_at(cranks[INSIDE], p, within)
                if bounded:
                    crank_at(cranks[FIRST], p, angle - places.half[q])
                    crank_at(cranks[LAST], p, angle + places.half[q])
                elif angle == within and not repeats[p]:
                    for f in range(4):
                        cranks[FIRST, f, p] = cranks[INSIDE, f, p]
                else:
                    crank_at(cranks[FIRST], p, angle)
            move(series, lane, cranks, trig, lanes)
            accelerate(series, lane, rows.exact, lanes)
            carry(series, lane)
            travels = np.int64(0)
            for t in range(r, count):
                if alike[t] != r or (mask.size > 0 and not any_of(mask[t], first, lanes)):
                    continue
                for p in range(lanes):
                    way[t, first + p] = np.sign(cranks[INSIDE, SINE, p])
                for c in range(chambers):
                    out, trace = PRESSURES + c, rows.trace[t, c]
                    if trace < 0:
                        for p in range(lanes):
                            if repeats[p]:
                                for f in range(4):
                                    process[f, p] = process[f, p - 1]
                                continue
                            index = places.design[first + p] if designs > 1 else 0
                            decide(rows.gas[index, t, c], lane, rows.exact, c % 2, cranks[INSIDE], process, p)
                        travels = cycle(series, lane, rows.exact, process, c % 2, cranks, out, lanes, travels)
                    else:
                        indicated(series, rows.traces, places, trace, first, lane, out, lanes)
                for f in range(FUNCTIONS + chambers):
                    slot = f if f < FUNCTIONS else f - FUNCTIONS + PRESSURES
                    for k in range(terms):
                        copied(series.middle[slot, k], middle[t, block, f, k])
                        if bounded:
                            copied(series.radius[slot, k], radius[t, block, f, k])


@inner_with_arrays
def _alike(motion):  # type: ignore[no-untyped-def]
    """Of rows of D designs (D, R, 4) the first that moves as each does in all of them, as two on opposite throws do:
    what their motion is made of is made once."""
    designs, count, _ = motion.shape
    first = np.arange(count)
    for r in range(count):
        for t in range(r):
            same = first[r] == r
            for n in range(designs):
                for k in range(4):
                    same = same and motion[n, r, k] == motion[n, t, k]
                if not same:
                    break
            if same:
                first[r] = t
    return first
