"""Readings: forces in the mechanism of every row from what they are made of (:mod:`rows`); compiled.

Shapes: N designs, M that differ in more than masses, speed and friction, R rows, P angles.
"""

import numpy as np

from optimizer.compiling import inner, kernel
from optimizer.mechanics.kernel.rows import COS, FORCE, INERTIA, KEPT, SECANT, SIN, SIN_2, SIN_SQUARED
from optimizer.mechanics.kernel.taylor import Series, constant, product, scaled, summed

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
#: functions beside those that are kept
_ONE, _FACTOR, _OF_INERTIA, _OF_GAS = np.arange(KEPT, KEPT + 4)
_FUNCTIONS = KEPT + 4


@kernel
def row_series(rows, functions, design, reading):  # type: ignore[no-untyped-def]
    """Coefficients of a force of the rows: (2, order + 1, N, R, P) at points; of enclosures the middles (2, 1, N, R, P)
    and radii (N, R, P) of the last; rows of angles of designs (N,).

    The first part is along the crank, or all of a scalar; the second across it, against the sense of rotation.
    A force is the acceleration times m r omega^2, the friction and the gas, each times one function of the motion.
    """
    made, count, angles, _, terms = functions.middle.shape
    bounded, parts = functions.radius.shape[0] > 0, 2 if reading in (ON_SHAFT, ON_FRAME) else 1
    designs, scales = rows.motion.shape[0], rows.scale.shape[0]
    number, first = design.size, terms - 1 if bounded else 0
    middle = np.empty((parts, terms - first, number, count, angles))
    radius = np.zeros((number if bounded else 0, count, angles))
    series = Series(np.zeros((_FUNCTIONS, terms)), np.zeros((_FUNCTIONS, terms)), bounded)
    moves = reading != ROD_AT_REST and reading != GAS
    rubs = moves and reading != ON_FRAME
    pressed = reading != ROD_WITHOUT_GAS and reading != ON_FRAME
    for m in range(made):
        low, high = (m, m + 1) if made > 1 else (0, number)
        for r in range(count):
            motion = rows.motion[design[m] if designs > 1 else 0, r]
            for p in range(angles):
                way = functions.way[m, r, p]
                for f in range(KEPT):
                    for k in range(terms):
                        series.middle[f, k] = functions.middle[m, r, p, f, k]
                        if bounded:
                            series.radius[f, k] = functions.radius[m, r, p, f, k]
                for part in range(parts):
                    one, inertia, gas = _read(series, reading, part, motion)
                    sign = -motion[3] if part == 1 else 1.0
                    for n in range(low, high):
                        mass, friction = rows.scale[design[n] if scales > 1 else 0, r]
                        for k in range(first, terms):
                            value = series.middle[gas, k] if pressed else 0.0
                            if moves:
                                value += mass * series.middle[inertia, k]
                            if rubs:
                                value += friction * way * series.middle[one, k]
                            middle[part, k - first, n, r, p] = sign * value
                        if bounded:
                            off = series.radius[gas, first] if pressed else 0.0
                            if moves:
                                off += abs(mass) * series.radius[inertia, first]
                            if rubs:
                                off += abs(friction) * series.radius[one, first]
                            radius[n, r, p] = np.hypot(radius[n, r, p], off)
    return middle, radius


@inner
def _read(series, reading, part, motion):  # type: ignore[no-untyped-def]
    """Numbers of the functions that make a part of a reading: its factor, and what inertia and gas come to by it."""
    ratio = motion[1]
    if reading in (PISTON, GAS):
        constant(series, 1.0, _ONE)
        return _ONE, INERTIA, FORCE
    if reading == ON_FRAME:
        factor = COS if part == 0 else SIN
    elif reading in (ROD, ROD_WITHOUT_GAS, ROD_AT_REST):
        # P / cos beta
        factor = SECANT
    elif reading == SIDE:
        # P tan beta
        product(series, SIN, SECANT, _FACTOR)
        scaled(series, _FACTOR, ratio, 0.0, _FACTOR)
        factor = _FACTOR
    elif reading == TANGENTIAL or part == 1:
        # P sin(phi + beta) / cos beta, positive against rotation
        product(series, SIN_2, SECANT, _FACTOR)
        summed(series, SIN, _FACTOR, 0.5 * ratio, _FACTOR)
        factor = _FACTOR
    else:
        # P cos(phi + beta) / cos beta, positive outward along the crank
        product(series, SIN_SQUARED, SECANT, _FACTOR)
        summed(series, COS, _FACTOR, -ratio, _FACTOR)
        factor = _FACTOR
    product(series, INERTIA, factor, _OF_INERTIA)
    product(series, FORCE, factor, _OF_GAS)
    return factor, _OF_INERTIA, _OF_GAS
