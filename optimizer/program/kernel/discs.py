"""A primal-dual interior point for webs under force and moment, compiled: both stages, any limits.

Every web is a disc, |v_k| <= 1, of which two straight edges leave a sector. The objective is a sum of sizes of vectors,
each a constant and a multiple of force or moment; so are those below ceilings. With w_b the multipliers of force and
moment, that of web k is p_k = -sum_b h_bk w_b - sum_e g_e n_e, and its size z_k above |p_k| is free; vectors follow the
webs. So no residuals are left but the products, and what is over the ceilings. What the webs of a program have in
common in a step is two unknowns of each vector, and the price of the objective or of a budget. What the webs do
stands in :mod:`optimizer.program.kernel.disc_webs`, what the vectors do in :mod:`optimizer.program.kernel.disc_peaks`,
and what is solved for them in :mod:`optimizer.program.kernel.disc_matrix`. Slacks and multipliers each go as far as
they may.

It has one answer to all trouble, which is none: what does not reach its gap in a few steps is left at 0, which proves
nothing, and is for :mod:`optimizer.program.kernel.interior_point`. Notation as there.
"""

import numpy as np

from optimizer.program.kernel.compiling import inner, inner_with_arrays, kernel
from optimizer.program.kernel.disc_matrix import eliminate, solve_peaks
from optimizer.program.kernel.disc_peaks import (
    BLOCK,
    CX,
    OVER,
    PAIR,
    PEAK,
    YX,
    correct_peaks,
    look_at_peaks,
    move_peaks,
    step_peaks,
)
from optimizer.program.kernel.disc_starts import Discs, begin_first, begin_second
from optimizer.program.kernel.disc_webs import (
    AIM,
    BOTH,
    BUDGET,
    BX,
    CHANGE,
    COST,
    DUAL,
    E1,
    EDGE,
    G1,
    GAP,
    H1,
    H2,
    KEEP,
    LANES,
    MASS,
    MOST,
    N1X,
    OWN,
    PRICE,
    PRIMAL,
    RISE,
    VX,
    WEB,
    add_own_mass,
    correct_webs,
    look_at_webs,
    move_edges,
    move_webs,
    share_budget,
    step_webs,
)
from optimizer.program.kernel.stages import BLOCK as AT_A_TIME

_MOST_STEPS = 25
#: least share of the way to the boundary that a step goes; the rest is the gap at most
_STEP, _LONGEST = 0.995, 0.99999
#: multiples of the target gap that are enough where a step led no farther, and where several did not
_NEARLY, _LOOSEST, _LOOSEST_MASS = 8.0, 500.0, 30.0
#: a step below this is short, and share of the gap that the next one aims at then
_SHORT, _CAUTIOUS = 0.1, 0.5


@inner
def _load(programs, n, cost, where, t, web, peak, own):  # type: ignore[no-untyped-def]
    """Program n and where it stands (:mod:`optimizer.program.kernel.disc_starts`) into lane t."""
    vectors, webs = programs.basis.size, cost.size
    terms, at_prices = vectors - programs.cap.shape[1], 6 * webs + 4 * vectors
    for k in range(webs):
        at = k * WEB + t
        web[at + H1], web[at + H2] = programs.influence[n, 0, k], programs.influence[n, 1, k]
        web[at + COST] = cost[k]
        for i in range(6):
            web[at + VX + i * LANES] = where[i * webs + k]
    for j in range(vectors):
        vector, at = peak[j], 6 * webs + 4 * j
        vector[t + CX], vector[t + CX + LANES] = programs.constant[n, j, 0], programs.constant[n, j, 1]
        vector[t + CX + PAIR] = programs.multiple[n, j]
        for i in range(4):
            vector[t + YX + i * LANES] = where[at + i]
        vector[t + OVER] = where[at + 2] - programs.cap[n, j - terms] if j >= terms else 0.0
    own[t + PRICE], own[t + BUDGET] = where[at_prices], where[at_prices + 1]


@inner
def _load_edges(normals, where, vectors, t, edge):  # type: ignore[no-untyped-def]
    """The edges of the webs of a program (5, K), and where they stand, into lane t."""
    webs = normals.shape[1]
    for k in range(webs):
        on = k * EDGE + t
        for i in range(5):
            edge[on + N1X + i * LANES] = normals[i, k]
        for i in range(2):
            # where there is no edge its slack is 1, and stays so
            slack = normals[2 * i, k] * where[k] + normals[2 * i + 1, k] * where[webs + k]
            edge[on + E1 + i * LANES] = slack + 1.0 - normals[4, k]
            edge[on + G1 + i * LANES] = where[6 * webs + 4 * vectors + 2 + i * webs + k]
            # what the lane held before may be no number
            edge[on + BX + i * LANES] = 0.0


@inner
def _save_edges(webs, vectors, t, edge, where):  # type: ignore[no-untyped-def]
    """Where the edges of lane t stand."""
    for k in range(webs):
        for i in range(2):
            where[6 * webs + 4 * vectors + 2 + i * webs + k] = edge[k * EDGE + G1 + i * LANES + t]


@inner
def _save(webs, t, web, peak, own, where):  # type: ignore[no-untyped-def]
    """Where lane t stands."""
    vectors = peak.shape[0]
    at_prices = 6 * webs + 4 * vectors
    for k in range(webs):
        for i in range(6):
            where[i * webs + k] = web[k * WEB + VX + i * LANES + t]
    for j in range(vectors):
        for i in range(4):
            where[6 * webs + 4 * j + i] = peak[j, YX + i * LANES + t]
    where[at_prices], where[at_prices + 1] = own[PRICE + t], own[BUDGET + t]


@inner_with_arrays
def run(least_mass, budgeted, edged, programs, first, edge, cost, most, tolerance, middle, starts, ends, reached):  # type: ignore[no-untyped-def]
    """A stage of N programs, from the first one on.

    Parameters
    ----------
    budgeted : whether cost is a share of the budget, that of the first stage.
    edged, edge : whether webs have edges, and memory for those.
    cost, most : (N, K) of each web, and (N,) largest sum of the sizes, in the second stage.
    tolerance : (N,) gap at which the stage ends.
    middle : (N,) where it is above 0, the state with a gap below it for the first time is left in ``starts``.
    starts : (N, S) states.
    ends, reached : (N, S) and (N,) where it ended, and the gap; inf where it did not end well.
    """
    (number, webs), vectors = cost.shape, programs.basis.size
    basis, terms, sized = programs.basis, vectors - programs.cap.shape[1], least_mass or budgeted
    # of one axis and then of their shape: to fill arrays the compiler makes a function for each number of axes
    web, own, peak = np.ones(webs * WEB), np.ones(OWN), np.ones(vectors * PEAK).reshape((vectors, PEAK))
    matrix = np.ones((vectors + 1) * (vectors + 1) * BLOCK).reshape((vectors + 1, vectors + 1, BLOCK))
    step, target = np.zeros((vectors + 1, PAIR)), np.zeros(LANES)
    program, steps = np.zeros(LANES, np.int64), np.zeros(LANES, np.int64)
    degree, before, stalls = np.ones(LANES), np.zeros(LANES), np.zeros(LANES, np.int64)
    # with edges or a budget limits are of very different size, and less is sure of steps to all of them at once
    longest = _LONGEST if edged or budgeted else 1.0
    loosest = _LOOSEST_MASS if least_mass else _LOOSEST
    for t in range(LANES):
        program[t] = -1
    waiting, solved = 0, 0
    while True:
        for t in range(LANES):
            if program[t] < 0 and waiting < number:
                n = waiting
                program[t], steps[t], stalls[t], target[t] = n, 1, 0, middle[n]
                at = programs.numbers[first + n]
                _load(programs, at, cost[n], starts[n], t, web, peak, own)
                if edged:
                    _load_edges(programs.normals[at], starts[n], vectors, t, edge)
                own[MOST + t], own[BOTH + t], before[t] = most[n], 1.0, np.inf
                degree[t] = 2.0 * webs + vectors + 1.0 if sized else 1.0 * (webs + vectors)
                for k in range(programs.normals.shape[2]):
                    degree[t] += 2.0 * programs.normals[at, 4, k]
                waiting += 1
        if edged:
            look_at_webs(sized, webs, web, edge, own)
        else:
            look_at_webs(sized, webs, web, None, own)
        look_at_peaks(least_mass, budgeted, terms, basis, peak, own)
        if budgeted:
            if edged:
                share_budget(webs, web, edge, own)
            else:
                share_budget(webs, web, None, own)
        eliminate(least_mass, budgeted, terms, basis, peak, own, matrix)
        for t in range(LANES):
            own[KEEP + t] = 1.0
        # predictor, then corrector
        for turn in range(2):
            if turn > 0:
                for t in range(LANES):
                    gap, change = own[GAP + t], own[CHANGE + t] if least_mass else own[RISE + t]
                    # both changes of the objectives together would close the gap
                    left = gap + min(own[PRIMAL + t], 1.0) * change - min(own[DUAL + t], 1.0) * (gap + change)
                    sigma = min(max(left / gap, 0.0), 1.0) ** 3
                    if target[t] > 0.0 and gap * sigma < 0.3 * target[t]:
                        # not past the middle of the optima in one step
                        sigma = 0.5 * target[t] / gap
                    if own[BOTH + t] == 0.0:
                        sigma = max(sigma, _CAUTIOUS)
                    own[AIM + t], own[KEEP + t] = sigma * gap / degree[t], 1.0 - sigma
                if edged:
                    correct_webs(sized, webs, web, edge, own)
                else:
                    correct_webs(sized, webs, web, None, own)
                correct_peaks(least_mass, budgeted, peak, own)
            if budgeted and edged:
                add_own_mass(webs, web, edge, own)
            solve_peaks(least_mass, budgeted, terms, basis, peak, own, matrix, step)
            if edged:
                step_webs(sized, webs, web, edge, own)
            else:
                step_webs(sized, webs, web, None, own)
            step_peaks(least_mass, budgeted, terms, basis, peak, own)
        for t in range(LANES):
            share = min(max(_STEP, 1.0 - own[GAP + t]), longest)
            own[PRIMAL + t] = min(share * own[PRIMAL + t], 1.0)
            own[DUAL + t] = min(share * own[DUAL + t], 1.0)
            # after a short step, or one for nothing, back to the middle without the second order
            well = min(own[PRIMAL + t], own[DUAL + t]) >= _SHORT and own[GAP + t] < 0.9 * before[t]
            own[BOTH + t], stalls[t] = (1.0, 0) if well else (0.0, stalls[t] + 1)
            before[t] = own[GAP + t]
        move_webs(sized, webs, web, own)
        if edged:
            move_edges(webs, edge, own)
        move_peaks(least_mass, budgeted, terms, peak, own)
        # what has ended gives way to another before the next step, which it would take for nothing
        for t in range(LANES):
            n, gap = program[t], own[GAP + t]
            if n < 0:
                continue
            over = 0.0
            for j in range(terms, vectors):
                over = max(over, abs(peak[j, OVER + t]))
            if target[t] > 0.0 and gap + over <= target[t]:
                target[t] = 0.0
                _save(webs, t, web, peak, own, starts[n])
                if edged:
                    _save_edges(webs, vectors, t, edge, starts[n])
            if least_mass:
                gap /= max(own[MASS + t], 1e-3)
            gap += over
            steps[t] += 1
            # rounding may hold up the last steps: where a norm vanishes that few webs are free to change
            enough = tolerance[n] * (1.0 if stalls[t] == 0 else _NEARLY if stalls[t] == 1 else loosest)
            if gap <= enough or steps[t] > _MOST_STEPS or not np.isfinite(gap):
                reached[n] = gap if gap <= enough else np.inf
                _save(webs, t, web, peak, own, ends[n])
                program[t], solved = -1, solved + 1
        if solved == number:
            return


@kernel
def solve(  # type: ignore[no-untyped-def]
    basis,
    multiple,
    constant,
    influence,
    mass,
    budget,
    cap,
    normals,
    numbers,
    budgeted,
    least_mass,
    share,
    tolerance,
    mass_tolerance,
):
    """Both stages of N of some programs, all with a budget that can bind or none, all with sectors or none.

    Parameters
    ----------
    basis, multiple, constant, influence, mass, budget, cap, normals, numbers : as of
        :class:`optimizer.program.kernel.disc_starts.Discs`.
    budgeted : whether they have a budget.

    share, tolerance : (N,) of these N.

    Others are those of :func:`optimizer.program.kernel.interior_point.solve`.

    Returns
    -------
    v (2, N, K, 2), multipliers of the vectors (2, N, Q, 2) and of the row (2, N, 1), for the first and for the second
    stage; and the unit of mass of the second stage (N,). Of a stage that did not end well all is 0.
    """
    programs = Discs(basis, multiple, constant, influence, mass, budget, cap, normals, numbers)
    number, vectors, webs = numbers.size, basis.size, mass.shape[1]
    v = np.zeros(4 * number * webs).reshape((2, number, webs, 2))
    p = np.zeros(4 * number * vectors).reshape((2, number, vectors, 2))
    prices, mass_unit = np.zeros(2 * number).reshape((2, number, 1)), np.ones(number)
    edged = programs.normals.shape[2] > 0
    size, edge = 6 * webs + 4 * vectors + 2 + 2 * programs.normals.shape[2], np.ones(webs * EDGE)
    for begin in range(0, number, AT_A_TIME):
        count = min(AT_A_TIME, number - begin)
        cost, most, starts, ends = (
            np.zeros((count, webs)),
            np.zeros(count),
            np.zeros((count, size)),
            np.zeros((count, size)),
        )
        middle, ending, reached = np.zeros(count), np.zeros(count), np.zeros(count)
        for stage in range(2 if least_mass else 1):
            for n in range(count):
                at = begin + n
                if stage == 0:
                    begin_first(programs, numbers[at], budgeted, cost[n], starts[n])
                    ending[n], middle[n] = tolerance[at], 0.5 * share[at] if least_mass else 0.0
                else:
                    mass_unit[at], most[n] = begin_second(
                        programs, numbers[at], budgeted, share[at], reached[n], ends[n], cost[n], starts[n]
                    )
                    ending[n], middle[n] = mass_tolerance, 0.0
            own = budgeted and stage == 0
            run(stage > 0, own, edged, programs, begin, edge, cost, most, ending, middle, starts, ends, reached)
            for n in range(count):
                if np.isfinite(reached[n]):
                    _keep(ends[n], v[stage, begin + n], p[stage, begin + n], prices[stage, begin + n])
    return v, p, prices, mass_unit


@inner
def _keep(where, v, p, price):  # type: ignore[no-untyped-def]
    """Webs (K, 2), multipliers of the vectors (Q, 2) and of the row (1,)."""
    webs, vectors = v.shape[0], p.shape[0]
    for c in range(2):
        for k in range(webs):
            v[k, c] = where[c * webs + k]
        for j in range(vectors):
            p[j, c] = -where[6 * webs + 4 * j + c]
    price[0] = where[6 * webs + 4 * vectors]
