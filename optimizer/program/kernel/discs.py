"""A primal-dual interior point for webs that have neither sector nor budget, compiled: both stages.

Such webs are plain discs, |v_k| <= 1, and the objective is a sum of at most two terms. Every iterate is feasible in
both senses: with y_j the multipliers of the terms that of web k is p_k = -sum_j H_jk y_j, and its size z_k above |p_k|
is free; vectors of terms follow the webs. So no residuals are left but the products, and of a step what the programs
have in common is the 4 or 5 unknowns of the terms (:mod:`optimizer.program.kernel.disc_steps`). Slacks and multipliers
each go as far as they may.

It has one answer to all trouble, which is none: what does not reach its gap in a few steps is left at 0, which proves
nothing, and is for :mod:`optimizer.program.kernel.interior_point`. Notation as there.
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.program.kernel.compiling import inner, inner_with_arrays, kernel
from optimizer.program.kernel.disc_steps import (
    AIM,
    C1X,
    CHANGE,
    COST,
    DUAL,
    GAP,
    H1,
    H2,
    LANES,
    MASS,
    MOST,
    OWN,
    PRIMAL,
    VX,
    WEB,
    Y1X,
    correct,
    eliminate,
    find_step,
    go,
    look,
)
from optimizer.program.kernel.stages import BLOCK, CENTRALITY, OPEN, RESERVE

_MOST_STEPS = 25
#: least share of the way to the boundary that a step goes; the rest is the gap at most
_STEP = 0.99


@inner
def _load(program, where, t, web, own):  # type: ignore[no-untyped-def]
    """A program and where it stands, (4 K + 7,) numbers each, into lane t."""
    webs = (where.size - 7) // 4
    for k in range(webs):
        at = k * WEB + t
        web[at + H1], web[at + H2], web[at + COST] = program[k], program[webs + k], program[2 * webs + k]
        for i in range(4):
            web[at + VX + i * LANES] = where[i * webs + k]
    for i in range(4):
        own[C1X + i * LANES + t] = program[3 * webs + i]
    for i in range(7):
        own[Y1X + i * LANES + t] = where[4 * webs + i]
    own[MOST + t] = program[3 * webs + 4]


@inner
def _save(t, web, own, where):  # type: ignore[no-untyped-def]
    """Where lane t stands (4 K + 7,)."""
    webs = (where.size - 7) // 4
    for k in range(webs):
        for i in range(4):
            where[i * webs + k] = web[k * WEB + VX + i * LANES + t]
    for i in range(7):
        where[4 * webs + i] = own[Y1X + i * LANES + t]


@inner_with_arrays
def run(least_mass, programs, starts, tolerance, middle, ends, reached):  # type: ignore[no-untyped-def]
    """A stage of every program.

    Parameters
    ----------
    programs : (N, 3 K + 5) influences on both terms and cost of each web, constants, largest sum of the sizes.
    starts : (N, 4 K + 7) x and y of v, x and z of each web; y_1, y_2, sizes of the terms, price. Where ``middle`` is
        above 0, the state with a gap below it for the first time is left here.
    tolerance : (N,) gap at which the stage ends.
    ends, reached : (N, 4 K + 7) and (N,) where it ended, and the gap; inf where it did not end well.
    """
    number, webs = starts.shape[0], (starts.shape[1] - 7) // 4
    web, own, matrix, step = np.ones(webs * WEB), np.ones(OWN), np.ones(25 * LANES), np.zeros(5 * LANES)
    degree = 2.0 * webs + 3.0 if least_mass else webs + 2.0
    program, steps, wanted = np.zeros(LANES, np.int64) - 1, np.zeros(LANES, np.int64), np.zeros(LANES)
    waiting, solved = 0, 0
    while True:
        for t in range(LANES):
            if program[t] < 0 and waiting < number:
                program[t], steps[t], wanted[t] = waiting, 0, middle[waiting]
                _load(programs[waiting], starts[waiting], t, web, own)
                waiting += 1
        look(least_mass, webs, web, own)
        for t in range(LANES):
            n, gap = program[t], own[GAP + t]
            if n < 0:
                continue
            if wanted[t] > 0.0 and gap <= wanted[t]:
                wanted[t] = 0.0
                _save(t, web, own, starts[n])
            if least_mass:
                gap /= max(own[MASS + t], 1e-3)
            steps[t] += 1
            if gap <= tolerance[n] or steps[t] > _MOST_STEPS or not np.isfinite(gap):
                reached[n] = gap if gap <= tolerance[n] else np.inf
                _save(t, web, own, ends[n])
                program[t], solved = -1, solved + 1
        if solved == number:
            return
        eliminate(least_mass, own, matrix)
        # predictor
        find_step(least_mass, webs, web, own, matrix, step)
        for t in range(LANES):
            gap, change = own[GAP + t], own[CHANGE + t]
            # both changes of the objectives together would close the gap
            left = gap + min(own[PRIMAL + t], 1.0) * change - min(own[DUAL + t], 1.0) * (gap + change)
            sigma = min(max(left / gap, 0.0), 1.0) ** 3
            if wanted[t] > 0.0 and gap * sigma < 0.3 * wanted[t]:
                # not past the middle of the optima in one step
                sigma = 0.5 * wanted[t] / gap
            own[AIM + t] = sigma * gap / degree
        # corrector
        correct(least_mass, webs, web, own, step)
        find_step(least_mass, webs, web, own, matrix, step)
        for t in range(LANES):
            share = max(_STEP, 1.0 - own[GAP + t])
            own[PRIMAL + t] = min(share * own[PRIMAL + t], 1.0)
            own[DUAL + t] = min(share * own[DUAL + t], 1.0)
        go(webs, web, own, step)


class Discs(NamedTuple):
    """N scaled programs of one row of J terms, as in :class:`optimizer.program.kernel.interior_point.Programs`."""

    constant: Real  # (N, J, 2)
    influence: Real  # (N, J, K)
    mass: Real  # (N, K) mass at full reach


@kernel
def solve(programs, least_mass, share, tolerance, mass_tolerance):  # type: ignore[no-untyped-def]
    """Both stages of N programs, Discs, without ceilings, sectors and budgets.

    Other parameters, and results, are those of :func:`optimizer.program.kernel.interior_point.solve`; of a stage that
    did not end well all is 0.
    """
    number, terms, webs = programs.influence.shape
    v, p = np.zeros((2, number, 3, webs)), np.zeros((2, number, terms, 2))
    prices, mass_unit = np.zeros((2, number, 1)), np.ones(number)
    for begin in range(0, number, BLOCK):
        count = min(BLOCK, number - begin)
        data, starts = np.zeros((count, 3 * webs + 5)), np.zeros((count, 4 * webs + 7))
        ends, reached = np.zeros((count, 4 * webs + 7)), np.zeros(count)
        middle, ending = np.zeros(count), np.zeros(count)
        for stage in range(2 if least_mass else 1):
            for n in range(count):
                at = begin + n
                if stage == 0:
                    _begin(programs.influence[at], programs.constant[at], data[n], starts[n])
                    ending[n], middle[n] = tolerance[at], 0.5 * share[at] if least_mass else 0.0
                else:
                    mass_unit[at] = _aim(programs.mass[at], share[at], reached[n], ends[n], data[n], starts[n])
                    ending[n], middle[n] = mass_tolerance, 0.0
            run(stage > 0, data, starts, ending, middle, ends, reached)
            for n in range(count):
                if np.isfinite(reached[n]):
                    _keep(ends[n], v[stage, begin + n], p[stage, begin + n], prices[stage, begin + n])
    return v, p, prices, mass_unit


@inner
def _begin(influence, constant, program, where):  # type: ignore[no-untyped-def]
    """A program, and where the first stage starts: nothing on the webs, sizes above the terms."""
    terms, webs = influence.shape
    for k in range(webs):
        where[2 * webs + k], where[3 * webs + k] = 1.0, 0.5
    where[4 * webs + 4], where[4 * webs + 5], where[4 * webs + 6] = 0.5, 0.5, 1.0
    for j in range(terms):
        for k in range(webs):
            program[j * webs + k] = influence[j, k]
        x, y = constant[j, 0], constant[j, 1]
        program[3 * webs + 2 * j], program[3 * webs + 2 * j + 1] = x, y
        where[4 * webs + 4 + j] += np.sqrt(x * x + y * y)


@inner
def _aim(mass, share, gap, end, program, where):  # type: ignore[no-untyped-def]
    """The second stage, from where the first one ended and the middle of the optima; its unit of mass."""
    webs = mass.size
    total, value = 0.0, 0.0
    for k in range(webs):
        total += mass[k] * np.sqrt(end[k] ** 2 + end[webs + k] ** 2)
    unit = total if total > 0.0 else 1.0
    for j in range(2):
        x, y = program[3 * webs + 2 * j], program[3 * webs + 2 * j + 1]
        for k in range(webs):
            x += program[j * webs + k] * end[k]
            y += program[j * webs + k] * end[webs + k]
        value += np.sqrt(x * x + y * y)
    # what the first stage leaves open is kept back, so that the lightest is an optimum for certain
    most = value + share * (1.0 - RESERVE) - OPEN * gap
    program[3 * webs + 4] = most
    # every multiplier at the price of the objective
    price = CENTRALITY / max(most - where[4 * webs + 4] - where[4 * webs + 5], 1e-300)
    for i in (0, 1, 2, 3, 6):
        where[4 * webs + i] *= price
    for k in range(webs):
        vx, vy, cost = where[k], where[webs + k], mass[k] / unit
        px = program[k] * where[4 * webs] + program[webs + k] * where[4 * webs + 2]
        py = program[k] * where[4 * webs + 1] + program[webs + k] * where[4 * webs + 3]
        # in the middle between |v| and 1
        x = (1.0 + np.sqrt(1.0 + 3.0 * (vx * vx + vy * vy))) / 3.0
        z = max(np.sqrt(px * px + py * py), cost) + CENTRALITY
        z = max(z, (CENTRALITY + vx * px + vy * py) / x, cost + CENTRALITY / (1.0 - x))
        program[2 * webs + k], where[2 * webs + k], where[3 * webs + k] = cost, x, z
    return unit


@inner
def _keep(where, v, p, price):  # type: ignore[no-untyped-def]
    """Webs (3, K), multipliers of the terms (J, 2) and of the row (1,)."""
    webs = v.shape[1]
    for k in range(webs):
        v[0, k], v[1, k], v[2, k] = where[2 * webs + k], where[k], where[webs + k]
    for j in range(p.shape[0]):
        for c in range(2):
            p[j, c] = -where[4 * webs + 2 * j + c]
    price[0] = where[4 * webs + 6]
