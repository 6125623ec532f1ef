"""A primal-dual interior point for many scaled programs of one shape, compiled.

The program is that of :mod:`optimizer.program.reference.modelling`; about a dozen steps of Mehrotra's predictor and
corrector for each stage (:mod:`optimizer.program.kernel.newton`).

Several programs are solved side by side, one in each lane of the arrays, so that every loop runs over programs and
becomes vector instructions. A lane whose program is done takes the next one; no program knows its neighbours.

The least mass starts from the point of the first stage that lies in the middle of the optima: the
analytic centre of {P <= target} is on the path of the first stage, with multipliers in proportion.
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.program.kernel.compiling import in_place, inner
from optimizer.program.kernel.lanes import new_memory, parts_of, state_size, views
from optimizer.program.kernel.newton import (
    direction,
    factor,
    first_order,
    longest_step,
    residuals,
    second_order,
    take_step,
)
from optimizer.program.kernel.stages import BLOCK, OPEN, RESERVE
from optimizer.program.kernel.starts import restart, start

#: share of the way to the boundary that a step goes
_STEP = 0.99
_MOST_STEPS = 60
#: programs side by side
_LANES = 64


class Programs(NamedTuple):
    """N scaled programs of one shape: Q cones (J terms, then ceilings), R rows, K webs."""

    row: np.ndarray  # (J,) row of each term
    floor: Real  # (N, R)
    cap: Real  # (N, Q - J)
    constant: Real  # (N, Q, 2)
    influence: Real  # (N, Q, K)
    centre: Real  # (N, K, 2)
    sine: Real  # (N, K)
    cosine: Real  # (N, K)
    sector: Real  # (N, K) 1 where the web has a sector, else 0
    mass: Real  # (N, K) mass at full reach
    budget: Real  # (N, K) the same relative to the budget; 0 without one


class Task(NamedTuple):
    """A stage of some programs; S numbers make a state."""

    target: Real  # (N,) least mass: largest value of a row
    cost: Real  # (N, K) mass at full reach, in a unit; 0 in the first stage
    tolerance: Real  # (N,) gap at which the stage ends
    middle: Real  # (N,) first stage: gap at which the state is kept on the way; 0 for nowhere
    way: Real  # (N, S) the state there; where the second stage starts
    best: Real  # (stages, N, S) the state with the smallest gap and residual
    reached: Real  # (N,) its gap and residual
    mass_unit: Real  # (N,) of the second stage


@inner
def _to_lane(row, storage, t):  # type: ignore[no-untyped-def]
    for i in range(row.size):
        storage[i, t] = row[i]


@inner
def _from_lane(storage, t, row):  # type: ignore[no-untyped-def]
    for i in range(row.size):
        row[i] = storage[i, t]


@inner
def load(programs, task, n, batch, t):  # type: ignore[no-untyped-def]
    """Program n into lane t."""
    cones, webs = programs.influence.shape[1:]
    lanes = batch.target.size
    for r in range(programs.floor.shape[1]):
        batch.floor[r, t] = programs.floor[n, r]
    for i in range(programs.cap.shape[1]):
        batch.cap[i, t] = programs.cap[n, i]
    batch.target[t] = task.target[n]
    for i in range(cones):
        for c in range(2):
            batch.constant[c, i * lanes + t] = programs.constant[n, i, c]
        for k in range(webs):
            batch.influence[i, k * lanes + t] = programs.influence[n, i, k]
    for k in range(webs):
        at = k * lanes + t
        for c in range(2):
            batch.centre[c, at] = programs.centre[n, k, c]
        batch.sine[at], batch.cosine[at] = programs.sine[n, k], programs.cosine[n, k]
        batch.present[0, at] = 1.0
        batch.present[1, at] = batch.present[2, at] = programs.sector[n, k]
        batch.mass[at], batch.budget[at] = task.cost[n, k], programs.budget[n, k]


@inner
def _run_stage(least_mass, programs, task, ends, batch, course, storage, best, work):  # type: ignore[no-untyped-def]
    """A stage of every program: steps until the gap is at most the tolerance, or no longer falls; ends (N, S)."""
    number, cones, webs = programs.influence.shape
    rows = programs.floor.shape[1]
    size, lanes = storage.shape
    state = views(storage, webs, cones, rows)
    program, vacancy, better, cautious = course.program, course.vacancy, course.better, course.cautious
    barrier, costs, sigma, correction = course.barrier, course.costs, course.sigma, course.correction
    reached, tolerance, middle, steps = course.reached, course.tolerance, course.middle, course.steps
    stalled = course.stalled
    for t in range(lanes):
        program[t], vacancy[t] = -1, 1.0
    waiting, solved = 0, 0
    while True:
        for t in range(lanes):
            if vacancy[t] > 0.0 and program[t] >= 0:
                _from_lane(best, t, ends[program[t]])
                task.reached[program[t]] = reached[t]
                solved += 1
                program[t] = -1
            if program[t] < 0 and waiting < number:
                program[t] = waiting
                waiting += 1
                n = program[t]
                load(programs, task, n, batch, t)
                if least_mass:
                    _to_lane(task.way[n], storage, t)
                    restart(batch, state, t)
                else:
                    start(batch, state, t)
                    _from_lane(storage, t, task.way[n])
                barrier[t], costs[t] = 1.0 * webs * 2 + cones + rows + 1, 0.0
                for k in range(t, webs * lanes, lanes):
                    barrier[t] += 2.0 * batch.present[1, k]
                    costs[t] = max(costs[t], batch.mass[k])
                vacancy[t], cautious[t], steps[t], stalled[t], reached[t] = 0.0, 0.0, 0.0, 0.0, np.inf
                tolerance[t], middle[t] = task.tolerance[n], task.middle[n]
        if solved == number:
            return
        residuals(least_mass, batch, state, work)
        gap = work.gap
        for t in range(lanes):
            scale = 1.0
            if least_mass:
                scale = 0.0
                for k in range(t, webs * lanes, lanes):
                    scale += batch.mass[k] * state.v[0, k]
                scale = max(scale, 1e-3)
            merit = gap[t] / scale + work.primal[t]
            better[t] = 0.0
            # a gap means nothing before the multipliers have taken in the costs
            if steps[t] == 0.0 or (merit < reached[t] and work.dual[t] <= 0.1 * costs[t] + 0.1):
                stalled[t] = stalled[t] if merit > 0.9 * reached[t] else 0.0
                reached[t] = merit if steps[t] > 0.0 else np.inf
                better[t] = 1.0
            stalled[t] += 1.0
            if middle[t] > 0.0 and gap[t] <= middle[t] and program[t] >= 0:
                middle[t] = 0.0
                _from_lane(storage, t, task.way[program[t]])
            patience = 3.0 if reached[t] < 1e-6 else 20.0
            if reached[t] <= tolerance[t] or stalled[t] > patience or steps[t] >= _MOST_STEPS or not np.isfinite(merit):
                vacancy[t] = 1.0
        for i in range(size):
            for t in range(lanes):
                best[i, t] = storage[i, t] if better[t] > 0.0 else best[i, t]

        factor(least_mass, batch, state, work)
        # predictor, then corrector
        for turn in range(2):
            if turn == 0:
                work.nu[:] = 0.0
                work.keep[:] = 1.0
                first_order(work)
            else:
                for t in range(lanes):
                    sigma[t] = (1.0 - min(work.step[t], 1.0)) ** 3
                    if middle[t] > 0.0 and gap[t] * sigma[t] < 0.3 * middle[t]:
                        # not past the middle of the optima in one step
                        sigma[t] = 0.5 * middle[t] / gap[t]
                    # after a short step back to the middle: without the second-order part, towards the centre
                    correction[t] = 1.0 - cautious[t]
                    if cautious[t] > 0.0:
                        sigma[t] = max(sigma[t], 0.5)
                    work.nu[t], work.keep[t] = gap[t] / barrier[t] * sigma[t], 1.0 - sigma[t]
                second_order(correction, work)
            direction(least_mass, batch, state, work)
            longest_step(batch, state, work, 1.0 / _STEP)
        for t in range(lanes):
            work.step[t] *= _STEP
            cautious[t] = 1.0 if work.step[t] < 0.1 else 0.0
            total = 0.0
            for i in range(work.right.shape[0]):
                total += work.right[i, t]
            if not (np.isfinite(total) and work.step[t] > 1e-8):
                vacancy[t], work.step[t] = 1.0, 0.0
            steps[t] += 1.0
        take_step(batch, state, work)


def solve(
    programs: Programs, least_mass: bool, share: Real, tolerance: Real, mass_tolerance: float
) -> tuple[Real, Real, Real, Real]:
    """Both stages of N programs.

    Parameters
    ----------
    programs : Programs.
    least_mass : whether the second stage follows.
    share : (N,) how far above the smallest value an optimum may be, in units of the value.
    tolerance : (N,) gap at which the first stage ends.
    mass_tolerance : gap relative to the mass at which the second ends.

    Returns
    -------
    (x, a, b) (2, N, 3, K), multipliers of the cones (2, N, Q, 2) and of the rows (2, N, R), for the first
    and for the second stage; and the unit of mass of the second stage (N,), which is that of the first answer.
    """
    number, cones, webs = programs.influence.shape
    rows = programs.floor.shape[1]
    v, p = np.zeros((2, number, 3, webs)), np.zeros((2, number, cones, 2))
    prices, mass_unit = np.zeros((2, number, rows)), np.ones(number)
    size, lanes = state_size(webs, cones, rows), min(_LANES, number)
    memory = new_memory(programs.row, webs, cones, rows, lanes)
    storage, best = np.ones((size, lanes)), np.ones((size, lanes))
    stages = 2 if least_mass else 1
    for begin in range(0, number, BLOCK):
        end = min(begin + BLOCK, number)
        count = end - begin
        block = Programs(programs.row, *(array[begin:end] for array in programs[1:]))
        task = Task(
            np.zeros(count),
            np.zeros((count, webs)),
            tolerance[begin:end].copy(),
            0.5 * share[begin:end] if least_mass else np.zeros(count),
            np.zeros((count, size)),
            np.zeros((stages, count, size)),
            np.zeros(count),
            mass_unit[begin:end],
        )
        run(share[begin:end], mass_tolerance, block, task, memory, storage, best)
        for stage in range(stages):
            _keep(task.best[stage], v[stage, begin:end], p[stage, begin:end], prices[stage, begin:end])
    return v, p, prices, mass_unit


@in_place
def run(share, mass_tolerance, programs, task, memory, storage, best):  # type: ignore[no-untyped-def]
    """The stages of every program, one after the other.

    Parameters
    ----------
    share, mass_tolerance : as of :func:`solve`.
    storage, best : (S, L) states of the lanes, and the best of them so far.
    """
    batch, course, work = parts_of(memory)
    for stage in range(task.best.shape[0]):
        if stage > 0:
            _aim(programs, task, share, mass_tolerance)
        _run_stage(stage > 0, programs, task, task.best[stage], batch, course, storage, best, work)


@inner
def _aim(programs, task, share, mass_tolerance):  # type: ignore[no-untyped-def]
    """Targets of the second stage, from the result of the first."""
    number, cones, webs = programs.influence.shape
    rows, terms = programs.floor.shape[1], programs.row.size
    for n in range(number):
        best = views(task.best[0, n].reshape((-1, 1)), webs, cones, rows)
        total = 0.0
        for k in range(webs):
            total += programs.mass[n, k] * np.sqrt(best.s[1, k] ** 2 + best.s[2, k] ** 2)
        unit = total if total > 0.0 else 1.0
        for k in range(webs):
            task.cost[n, k] = programs.mass[n, k] / unit
        target = -np.inf
        for r in range(rows):
            value = programs.floor[n, r]
            for i in range(terms):
                if programs.row[i] == r:
                    value += np.sqrt(best.s[1, webs + i] ** 2 + best.s[2, webs + i] ** 2)
            target = max(target, value)
        # what the first stage leaves open is kept back, so that the lightest is an optimum for certain
        task.target[n] = target + share[n] * (1.0 - RESERVE) - OPEN * task.reached[n]
        task.mass_unit[n] = unit
    task.tolerance[:] = mass_tolerance
    task.middle[:] = 0.0


def _keep(best: Real, v: Real, p: Real, price: Real) -> None:
    """Points of the webs (N, 3, K), multipliers of the cones (N, Q, 2) and of the rows (N, R)."""
    webs, cones, rows = v.shape[2], p.shape[1], price.shape[1]
    every = webs + cones
    v[:] = best[:, : 3 * webs].reshape(v.shape)
    at_z = 9 * webs + 3 * every
    z = best[:, at_z : at_z + 3 * every].reshape((-1, 3, every))
    p[:] = -z[:, 1:, webs:].swapaxes(1, 2)
    at_price = at_z + 3 * every + rows
    price[:] = best[:, at_price : at_price + rows]
