"""Readings: forces in the mechanism of every row from what they are made of (:mod:`rows`); compiled.

Shapes: N designs, R rows, P angles of each, Q places: the angles of all designs, or once where all have the same.
"""

import numpy as np

from optimizer.mechanics.kernel.row_numbers import COS, FUNCTIONS, INERTIA, OUTWARD, SECANT, SIN, TURNING
from optimizer.mechanics.kernel.taylor import ALL, LANES, Series, constant, copied, product, scaled, summed
from optimizer.numerics.compiling import inner, inner_with_arrays

#: what may be asked of the rows; the first column counts from 0 in the compiled code
READINGS = (
    "piston",
    "rod",
    "rod_without_gas",
    "rod_at_rest",
    "side",
    "tangential",
    "radial",
    "on_shaft",
    "on_frame",
    "gas",
)
PISTON, ROD, ROD_WITHOUT_GAS, ROD_AT_REST, SIDE, TANGENTIAL, RADIAL, ON_SHAFT, ON_FRAME, GAS = range(len(READINGS))
#: of these the gas is no part
WITHOUT_GAS = ("rod_without_gas", "on_frame")
#: of each reading, which of the functions it is made of beside the inertia
_MADE_OF = np.zeros((len(READINGS), FUNCTIONS), np.bool_)
_MADE_OF[:, INERTIA] = True
for _reading, *_functions in (
    (ROD, SECANT),
    (ROD_WITHOUT_GAS, SECANT),
    (ROD_AT_REST, SECANT),
    (SIDE, SIN, SECANT),
    (TANGENTIAL, TURNING),
    (RADIAL, OUTWARD),
    (ON_SHAFT, TURNING, OUTWARD),
    (ON_FRAME, COS, SIN),
):
    _MADE_OF[_reading, _functions] = True
#: functions beside those that are kept
_UNITY, _FACTOR, _FORCE, _OF_INERTIA, _OF_GAS = np.arange(FUNCTIONS, FUNCTIONS + 5)
_PRESSURES = FUNCTIONS + 5
#: numbers of every lane
_RATIO, _SIGN, _ZERO, _UNIT, _MASS, _FRICTION, _AREA, _VALUE, _OFF = np.arange(9)
_NUMBERS = 9
_NUMBER, _ANGLE, _DESIGN = np.arange(3)


@inner_with_arrays
def row_series(rows, functions, design, angles, reading, terms):  # type: ignore[no-untyped-def]
    """The first coefficients of a force of the rows: (2, terms, N, R, P) at points; of enclosures the middles
    (2, 1, N, R, P) and radii (N, R, P) of the last of these; P angles of each of designs (N,).

    The first part is along the crank, or all of a scalar; the second across it, against the sense of rotation.
    A force is the acceleration times m r omega^2, the friction and the gas, each times one function of the motion.
    Where the functions of a row are not made its numbers mean nothing.
    """
    count, function_count, _, _ = functions.middle.shape
    bounded, parts = functions.radius.shape[1] > 0, 2 if reading in (ON_SHAFT, ON_FRAME) else 1
    number, first = design.size, terms - 1 if bounded else 0
    middle = np.empty((parts, terms - first, number, count, angles))
    radius = np.zeros((number if bounded else 0, count, angles))
    shape = (_PRESSURES + function_count - FUNCTIONS, terms, LANES)
    series, lane = Series(np.zeros(shape), np.zeros(shape), bounded), np.zeros((_NUMBERS, LANES))
    lane[_UNIT] = 1.0
    # of every lane: its place in the result, and its design
    where = np.zeros((3, LANES), np.int64)
    _add_up(rows, functions, design, angles, reading, (series, lane, where), (middle, radius))
    return middle, radius


@inner
def _add_up(rows, functions, design, angles, reading, room, results):  # type: ignore[no-untyped-def]
    """Write the coefficients of a force and the radii of the last; nothing is made here, for to count who holds an
    array takes longer than to use it."""
    (series, lane, where), (middle, radius) = room, results
    count, function_count, _, places = functions.middle.shape
    parts, terms, bounded = middle.shape[0], series.middle.shape[1], series.bounded
    number, first = design.size, terms - middle.shape[1]
    moves = reading != ROD_AT_REST and reading != GAS
    rubs = moves and reading != ON_FRAME
    pressed = reading != ROD_WITHOUT_GAS and reading != ON_FRAME and function_count > FUNCTIONS
    # where designs have all of this in common, one after the other is made of it
    turns = number if places == angles else 1
    for r in range(count):
        for start in range(0, places, LANES):
            lanes = min(LANES, places - start)
            if np.isnan(functions.way[r, start]):
                continue
            for f in range(function_count if pressed else FUNCTIONS):
                if f < FUNCTIONS and not _MADE_OF[reading, f]:
                    continue
                to = f if f < FUNCTIONS else f - FUNCTIONS + _PRESSURES
                for k in range(terms):
                    copied(functions.middle[r, f, k, start:], series.middle[to, k], lanes)
                    if bounded:
                        copied(functions.radius[r, f, k, start:], series.radius[to, k], lanes)
            number_of_first, angle_of_first = start // angles, start % angles
            # of one design alone, as mostly, results stand side by side
            alone = angle_of_first + lanes <= angles
            n, at = number_of_first, angle_of_first
            for p in range(lanes):
                where[_NUMBER, p], where[_ANGLE, p], where[_DESIGN, p] = n, at, design[n]
                motion = rows.motion[design[n] if rows.motion.shape[0] > 1 else 0, r]
                lane[_RATIO, p], lane[_SIGN, p] = motion[1], -motion[3]
                at += 1
                if at == angles:
                    n, at = n + 1, 0
            for part in range(parts):
                factor, inertia = _read(series, reading, part, lane, lanes, first)
                gas = _FORCE if factor == _UNITY else _OF_GAS
                for turn in range(turns):
                    for p in range(lanes):
                        n = design[turn] if turns > 1 else where[_DESIGN, p]
                        index = n if rows.scale.shape[0] > 1 else 0
                        lane[_MASS, p] = rows.scale[index, r, 0]
                        lane[_FRICTION, p] = rows.scale[index, r, 1] * functions.way[r, start + p]
                    if pressed and (turn == 0 or rows.area.shape[0] > 1):
                        constant(series, lane[_ZERO], _FORCE, lanes)
                        for c in range(function_count - FUNCTIONS):
                            for p in range(lanes):
                                n = design[turn] if turns > 1 else where[_DESIGN, p]
                                lane[_AREA, p] = rows.area[n if rows.area.shape[0] > 1 else 0, r, c]
                            summed(series, _FORCE, _PRESSURES + c, lane[_AREA], _FORCE, lanes)
                        if gas == _OF_GAS:
                            product(series, _FORCE, factor, _OF_GAS, lanes, first)
                    for k in range(first, terms):
                        value, off = lane[_VALUE], lane[_OFF]
                        for p in range(lanes):
                            value[p] = series.middle[gas, k, p] if pressed else 0.0
                            off[p] = series.radius[gas, k, p] if pressed else 0.0
                        if moves:
                            _added(series, inertia, k, lane[_MASS], value, off, lanes)
                        if rubs:
                            _added(series, factor, k, lane[_FRICTION], value, off, lanes)
                        if part == 1:
                            sign = lane[_SIGN]
                            for p in range(lanes):
                                value[p] *= sign[p]
                        if turns > 1 or alone:
                            to = turn if turns > 1 else number_of_first
                            copied(value, middle[part, k - first, to, r, angle_of_first:], lanes)
                            if bounded:
                                spread = radius[to, r, angle_of_first:]
                                for p in range(lanes):
                                    spread[p] = _with_part(spread[p], off[p], part)
                            continue
                        for p in range(lanes):
                            middle[part, k - first, where[_NUMBER, p], r, where[_ANGLE, p]] = value[p]
                        if bounded:
                            for p in range(lanes):
                                n, at = where[_NUMBER, p], where[_ANGLE, p]
                                radius[n, r, at] = _with_part(radius[n, r, at], off[p], part)


@inner
def _with_part(first, off, part):  # type: ignore[no-untyped-def]
    """How far a vector may be off, by the first of its parts or with the second."""
    return off if part == 0 else np.sqrt(first * first + off * off)


@inner
def _added(series, a, k, factor, value, off, lanes):  # type: ignore[no-untyped-def]
    """What a function adds, times a factor (LANES,)."""
    middle = series.middle[a, k]
    for p in range(lanes):
        value[p] += factor[p] * middle[p]
    if series.bounded:
        spread = series.radius[a, k]
        for p in range(lanes):
            off[p] += abs(factor[p]) * spread[p]


@inner
def _read(series, reading, part, lane, lanes, first):  # type: ignore[no-untyped-def]
    """Numbers of the functions that make a part of a reading: its factor, and what inertia comes to by it.

    Of the latter the coefficients from the first that is wanted.
    """
    if reading in (PISTON, GAS):
        constant(series, lane[_UNIT], _UNITY, lanes)
        return _UNITY, INERTIA
    if reading == ON_FRAME:
        factor = COS if part == 0 else SIN
    elif reading in (ROD, ROD_WITHOUT_GAS, ROD_AT_REST):
        # P / cos beta
        factor = SECANT
    elif reading == SIDE:
        # P tan beta
        product(series, SIN, SECANT, _FACTOR, lanes, ALL)
        scaled(series, _FACTOR, lane[_RATIO], lane[_ZERO], _FACTOR, lanes)
        factor = _FACTOR
    elif reading == TANGENTIAL or part == 1:
        factor = TURNING
    else:
        factor = OUTWARD
    product(series, INERTIA, factor, _OF_INERTIA, lanes, first)
    return factor, _OF_INERTIA
