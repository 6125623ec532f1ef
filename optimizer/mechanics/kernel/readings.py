"""Readings: forces in the mechanism of every row from what they are made of (:mod:`rows`); compiled.

Shapes: N designs, R rows, P angles of each, Q places: the angles of all designs, or once where all have the same.
"""

import numpy as np

from optimizer.mechanics.kernel.row_numbers import COS, FUNCTIONS, INERTIA, OUTWARD, SECANT, SIN, TURNING
from optimizer.mechanics.kernel.taylor import ALL, LANES, Series, any_of, constant, copied, multiplied, scaled
from optimizer.mechanics.reading import READINGS
from optimizer.numerics.compiling import inner, inner_with_arrays

#: places of the readings; the first counts from 0 in the compiled code
PISTON, ROD, ROD_WITHOUT_GAS, ROD_AT_REST, SIDE, TANGENTIAL, RADIAL, ON_SHAFT, ON_FRAME, GAS, ACCELERATION = range(
    len(READINGS)
)
#: functions beside those that are kept
_FACTOR, _FORCE, _OF_INERTIA, _OF_GAS, _TOTAL = np.arange(5)
_OWN = 5
#: numbers of every lane
_RATIO, _TURNS, _ZERO, _MASS, _RUBBED, _FRICTION = np.arange(6)
_AREA = 6
_NUMBER, _ANGLE, _DESIGN = np.arange(3)
#: numbers of a row among those of its motion and of its scale, as numpy's integers like all that is handed on
_LAM, _SENSE, _INERTIA, _RUBBING = np.array((1, 3, 0, 1))


@inner_with_arrays
def row_series(rows, functions, design, angles, reading, terms, mask):  # type: ignore[no-untyped-def]
    """The first coefficients of a force of the rows: (2, terms, N, R, P) at points; of enclosures the middles
    (2, 1, N, R, P) and radii (N, R, P) of the last of these; P angles of each of designs (N,).

    The first part is along the crank, or all of a scalar; the second across it, against the sense of rotation.
    A force is the acceleration times m r omega^2, the friction and the gas, each times one function of the motion.
    Where the functions of a row are not made its numbers mean nothing.

    Parameters
    ----------
    mask : (R, Q) which rows count at which places: of many side by side where they do not its numbers mean nothing
        either. (0, 0) where all count.
    """
    count = functions.middle.shape[0]
    bounded, parts = functions.radius.shape[2] > 0, 2 if reading in (ON_SHAFT, ON_FRAME) else 1
    number, first = design.size, terms - 1 if bounded else 0
    middle = np.empty((parts, terms - first, number, count, angles))
    radius = np.zeros((number if bounded else 0, count, angles))
    shape = (_OWN, terms, LANES)
    series, lane = Series(np.zeros(shape), np.zeros(shape), bounded), np.zeros((_AREA + rows.area.shape[2], LANES))
    # of every lane: its place in the result, and its design
    where = np.zeros((3, LANES), np.int64)
    _add_up(rows, functions, design, angles, reading, (series, lane, where, mask), (middle, radius))
    return middle, radius


@inner
def _add_up(rows, functions, design, angles, reading, room, results):  # type: ignore[no-untyped-def]
    """Write the coefficients of a force and the radii of the last; nothing is made here, for to count who holds an
    array takes longer than to use it."""
    (series, lane, where, mask), (middle, radius) = room, results
    (count, places), parts, bounded, own = functions.way.shape, middle.shape[0], series.bounded, where[_DESIGN]
    terms, number, total = series.middle.shape[1], design.size, (series.middle[_TOTAL], series.radius[_TOTAL])
    first = terms - middle.shape[1]
    moves = reading != ROD_AT_REST and reading != GAS
    rubs = moves and reading not in (ON_FRAME, ACCELERATION)
    with_gas = reading not in (ROD_WITHOUT_GAS, ON_FRAME, ACCELERATION) and functions.middle.shape[2] > FUNCTIONS
    # by what the force on the piston is multiplied
    factored = reading not in (PISTON, GAS, ACCELERATION)
    gas = (series.middle[_OF_GAS if factored else _FORCE], series.radius[_OF_GAS if factored else _FORCE])
    # where designs have all of this in common, one after the other is made of it
    turns, various, last = number if places == angles else 1, rows.area.shape[0] > 1, -1
    for r in range(count):
        for start in range(0, places, LANES):
            lanes, block, n, at = min(LANES, places - start), start // LANES, start // angles, start % angles
            if np.isnan(functions.way[r, start]) or (mask.size > 0 and not any_of(mask[r], start, lanes)):
                continue
            coefficients = functions.middle[r, block]
            of_row = Series(coefficients, functions.radius[r, block] if bounded else coefficients, bounded)
            # of one design alone, as mostly, results stand side by side
            alone = turns > 1 or at + lanes <= angles
            _place(n, at, angles, design, 1 if alone else lanes, where)
            if alone:
                own[:] = design[n]
            if turns > 1 or not alone or last != r * number + n:
                _of_lanes(rows, own, r, alone, lane)
                last = r * number + n if alone else -1
            for part in range(parts):
                source, f = of_row, _factor(reading, part)
                if reading == SIDE:
                    _lean(of_row, series, lane)
                    source, f = series, _FACTOR
                factor = (source.middle[f], source.radius[f])
                source, f = of_row, INERTIA
                if factored and moves:
                    source, f = series, _OF_INERTIA
                    multiplied(
                        (coefficients[INERTIA], of_row.radius[INERTIA]),
                        factor,
                        (source.middle[f], source.radius[f]),
                        bounded,
                        first,
                    )
                inertia = (source.middle[f], source.radius[f])
                for turn in range(turns):
                    if turns > 1:
                        own[:] = design[turn]
                        _of_lanes(rows, own, r, alone, lane)
                    if with_gas and (turn == 0 or various):
                        if part == 0 or (various and turns > 1):
                            _press(of_row, series, lane)
                        if factored:
                            multiplied((series.middle[_FORCE], series.radius[_FORCE]), factor, gas, bounded, first)
                    for p in range(lanes if rubs else 0):
                        lane[_FRICTION, p] = lane[_RUBBED, p] * functions.way[r, start + p]
                    for k in range(first, terms):
                        if with_gas:
                            copied(gas[0][k], total[0][k])
                            copied(gas[1][k], total[1][k])
                        else:
                            total[0][k, :], total[1][k, :] = 0.0, 0.0
                    if moves:
                        _add_multiple(inertia, lane[_MASS], total, bounded, first)
                    if rubs and factored:
                        _add_multiple(factor, lane[_FRICTION], total, bounded, first)
                    elif rubs and first == 0:
                        for p in range(LANES):
                            total[0][0, p] += lane[_FRICTION, p]
                    for k in range(first, terms):
                        value, off, to = total[0][k], total[1][k], middle[part, k - first]
                        if part == 1:
                            for p in range(LANES):
                                value[p] *= -lane[_TURNS, p]
                        if alone:
                            _together(value, off, (to, radius), (turn if turns > 1 else n, r, at), part, lanes)
                        else:
                            _apart(value, off, (to, radius), where, r, part, lanes)


@inner
def _place(n, at, angles, design, lanes, where):  # type: ignore[no-untyped-def]
    """Write which design and angle each lane has, and the number of the design."""
    for p in range(lanes):
        where[_NUMBER, p], where[_ANGLE, p], where[_DESIGN, p] = n, at, design[n]
        at += 1
        if at == angles:
            n, at = n + 1, 0


@inner
def _of_lanes(rows, own, r, alone, lane):  # type: ignore[no-untyped-def]
    """Write the numbers of a row for the design of each lane; of one design alone, for it once."""
    _of_designs(rows.motion, own, r, _LAM, alone, lane[_RATIO])
    _of_designs(rows.motion, own, r, _SENSE, alone, lane[_TURNS])
    _of_designs(rows.scale, own, r, _INERTIA, alone, lane[_MASS])
    _of_designs(rows.scale, own, r, _RUBBING, alone, lane[_RUBBED])
    for c in range(rows.area.shape[2]):
        _of_designs(rows.area, own, r, c, alone, lane[_AREA + c])


@inner
def _of_designs(values, own, r, column, alone, out):  # type: ignore[no-untyped-def]
    """Write a number of a row for the design of each lane, of values (D, R, ...) or of (1, R, ...) for all designs."""
    if alone or values.shape[0] == 1:
        out[:] = values[own[0] if values.shape[0] > 1 else 0, r, column]
    else:
        for p in range(LANES):
            out[p] = values[own[p], r, column]


@inner
def _together(value, off, results, there, part, lanes):  # type: ignore[no-untyped-def]
    """Write lanes to angles side by side, with their error bounds if there are any."""
    (middle, radius), (n, r, at) = results, there
    out = middle[n, r, at:]
    for p in range(lanes):
        out[p] = value[p]
    if radius.shape[0] > 0:
        spread = radius[n, r, at:]
        for p in range(lanes):
            spread[p] = _with_part(spread[p], off[p], part)


@inner
def _apart(value, off, results, where, r, part, lanes):  # type: ignore[no-untyped-def]
    """The same, to angles of several designs."""
    middle, radius = results
    for p in range(lanes):
        n, at = where[_NUMBER, p], where[_ANGLE, p]
        middle[n, r, at] = value[p]
        if radius.shape[0] > 0:
            radius[n, r, at] = _with_part(radius[n, r, at], off[p], part)


@inner
def _with_part(first, off, part):  # type: ignore[no-untyped-def]
    """How far a vector may be off, by the first of its parts or with the second."""
    return off if part == 0 else np.sqrt(first * first + off * off)


@inner
def _add_multiple(function, factor, total, bounded, first):  # type: ignore[no-untyped-def]
    """Add a function times a factor (LANES,) to another, from coefficient ``first`` on."""
    (middle, radius), (out, out_off) = function, total
    for k in range(first, out.shape[0]):
        addend, result = middle[k], out[k]
        for p in range(LANES):
            result[p] += factor[p] * addend[p]
        if bounded:
            spread, off = radius[k], out_off[k]
            for p in range(LANES):
                off[p] += abs(factor[p]) * spread[p]


@inner
def _press(of_row, series, lane):  # type: ignore[no-untyped-def]
    """Force of the gas on the piston."""
    constant(series, lane[_ZERO], _FORCE)
    force = (series.middle[_FORCE], series.radius[_FORCE])
    for c in range(of_row.middle.shape[0] - FUNCTIONS):
        pressure = (of_row.middle[FUNCTIONS + c], of_row.radius[FUNCTIONS + c])
        _add_multiple(pressure, lane[_AREA + c], force, series.bounded, ALL)


@inner
def _lean(of_row, series, lane):  # type: ignore[no-untyped-def]
    """P tan beta of a force P = 1."""
    sine, secant = (of_row.middle[SIN], of_row.radius[SIN]), (of_row.middle[SECANT], of_row.radius[SECANT])
    multiplied(sine, secant, (series.middle[_FACTOR], series.radius[_FACTOR]), series.bounded, ALL)
    scaled(series, _FACTOR, lane[_RATIO], lane[_ZERO], _FACTOR)


@inner
def _factor(reading, part):  # type: ignore[no-untyped-def]
    """Number of the function by which the force on the piston is multiplied, unless it is made of others."""
    if reading == ON_FRAME:
        return COS if part == 0 else SIN
    if reading in (ROD, ROD_WITHOUT_GAS, ROD_AT_REST):
        # P / cos beta
        return SECANT
    return TURNING if reading == TANGENTIAL or part == 1 else OUTWARD
