"""The entry to all that is made of rows over the whole turn: what their forces are made of, curves as sums of these,
their peaks, circles and crossings; compiled.

All but sums expand the rows, and machine code of that is made anew for every entry.
"""

from typing import NamedTuple

import numpy as np

from optimizer.mechanics.kernel.circles import circles
from optimizer.mechanics.kernel.crossings import crossings
from optimizer.mechanics.kernel.curves import NOTHING, Sums, sums_of_rows
from optimizer.mechanics.kernel.design_forces import design_forces
from optimizer.mechanics.kernel.rows import Functions, Places, Rows, Tables, row_functions
from optimizer.mechanics.kernel.search import search
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.compiling import kernel
from optimizer.responses.kernel.motion import STILL, Motion
from optimizer.responses.kernel.parts import Best, Cubics, Members

#: what is made: functions of the rows, sums of such, both at once; peaks or crossings of curves; forces of the rows of
#: many designs, and sums of such; or circles around curves
FUNCTIONS, SUMS, BOTH, PEAKS, CROSSINGS, FORCES, FORCE_SUMS, CIRCLES = range(8)

#: where all rows have functions of their own
NO_KINDS = np.zeros((2, 0), np.int64)


class Reading(NamedTuple):
    """Curves that are read of functions of the rows, as :func:`sums_of_rows` takes them.

    curve : (m,) which of the curves that are sums.
    design : (N,).
    half : (N, P) rad.
    order : up to which bounds count.
    angles : P of each design.
    kinds : kinds of the rows, and how many angles later they do what the first of their kind does, (2, R); or (2, 0).
    """

    curve: np.ndarray
    design: np.ndarray
    half: Real
    order: int
    angles: int
    kinds: np.ndarray = NO_KINDS


class Query(NamedTuple):
    """What is sought of curves: peaks as :func:`search` takes them, circles, or where they cross levels (N,)."""

    cubics: Cubics
    members: Members
    best: Best
    level: Real
    middle: Real
    motion: Motion


_NOWHERE, _NUMBERS, _PLANE = np.zeros(0, np.int64), np.zeros(0), np.zeros((0, 0))
NO_PLACES = Places(_NOWHERE, _NUMBERS, _NUMBERS, _NUMBERS)
NO_SUMS = Sums(_NOWHERE, np.zeros((0, 0), complex), np.zeros(0, complex))
NO_READING = Reading(_NOWHERE, _NOWHERE, _PLANE, -1, 0)
NO_MEMBERS = Members(_NOWHERE, _NOWHERE, np.zeros(0, complex), _NUMBERS, _NUMBERS, _NUMBERS)
NO_BEST = Best(_NUMBERS, _NUMBERS, _NUMBERS, _NOWHERE, _NOWHERE)
NO_LEVELS = _NUMBERS
_NO_CUBICS = Cubics(_PLANE, _PLANE, np.zeros((0, 0, 4), complex), _PLANE)
NO_QUERY = Query(_NO_CUBICS, NO_MEMBERS, NO_BEST, NO_LEVELS, _PLANE, STILL)


def over_turn(
    task: int,
    rows: Rows,
    sums: Sums = NO_SUMS,
    places: Places = NO_PLACES,
    order: int = 0,
    with_gas: bool = False,
    reading: Reading = NO_READING,
    points: Functions = NOTHING,
    bounds: Functions = NOTHING,
    query: Query = NO_QUERY,
) -> tuple[tuple[Real, Real, Real], Complex, Real, Real]:
    """Functions of the rows; coefficients (m, P, order + 1) of curves, what they leave out (m, P) and their size (m,).

    Of forces of many designs as functions come the results of :func:`design_forces`, about centres that are sought. Of
    peaks, which it improves, the curves there (G, 1, 1); of levels (N,) the angles (N, n) at which curves cross them
    in place of what is left out, and what their integrals may be off by (N,) in place of the size; of circles the
    results of :func:`circles`, (J, 4, 1) and (J, 10).

    Parameters
    ----------
    order, with_gas : of functions that are made at places.
    points, bounds : functions of which curves are sums; where both are made at once the points are those.
    """
    cubics, members, best, level, middle, motion = query
    # one by one: numba looks through tuples for the types of arrays, which takes longer than all else of a call
    return _over_turn(
        *(task, order, with_gas, rows.exact, reading.order, reading.angles),
        *(motion.first, motion.unit, motion.sense, motion.scalar),
        *(*rows[:5], *rows.traces, *sums, *places, *reading[:3], *points, *bounds),
        *(*cubics, *members, *best, level, middle, motion.times, motion.size, reading.kinds),
    )


@kernel
def _over_turn(  # type: ignore[no-untyped-def]
    task, order, with_gas, exact, bound, angles, first_curve, unit, sense, scalar, *parts
):
    # 0 to 11 rows, to 14 sums, to 18 places, to 21 readings, to 24 points, to 27 bounds, to 31 cubics, to 37 members,
    # to 42 the best, 43 levels, 44 middles, 45 and 46 of the motion, 47 kinds
    rows = Rows(parts[0], parts[1], parts[2], parts[3], parts[4], exact, Tables(*parts[5:12]))
    sums, places, points, bounds = Sums(*parts[12:15]), Places(*parts[15:19]), parts[22:25], parts[25:28]
    functions = Functions(np.empty((0, 0, 0, 0, 0)), np.empty((0, 0, 0, 0, 0)), np.empty((0, 0)))
    cubic, rest, size = np.empty((0, 0, 0), np.complex128), np.empty((0, 0)), np.empty(0)
    if task in (FUNCTIONS, BOTH):
        functions = row_functions(rows, places, order, with_gas, np.empty((0, 0), np.bool_))
    if task in (SUMS, BOTH, FORCE_SUMS):
        of = functions if task == BOTH else Functions(*points)
        curve, design, half = parts[19:22]
        cubic, rest, size = sums_of_rows(
            rows, sums, curve, of, Functions(*bounds), bound, design, angles, half, task == FORCE_SUMS, parts[47]
        )
    elif task in (PEAKS, CIRCLES):
        motion = Motion(first_curve, unit, sense, parts[45], parts[46], scalar)
        cubics, members = Cubics(*parts[28:32]), Members(*parts[32:38])
        if task == CIRCLES:
            vectors, rest = circles(cubics, members, rows, sums, parts[44], motion)
            cubic = vectors.reshape((len(vectors), 4, 1))
        else:
            there = search(cubics, members, Best(*parts[38:43]), rows, sums, parts[44], motion)
            cubic = there.reshape((there.size, 1, 1))
    elif task == FORCES:
        functions = design_forces(rows, parts[19], parts[44], parts[21], order, with_gas)
    elif task == CROSSINGS:
        rest, size = crossings(Cubics(*parts[28:32]), parts[43], rows, sums, parts[44])
    return (functions.middle, functions.radius, functions.way), cubic, rest, size
