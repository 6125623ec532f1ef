"""Of the points where both stages ended the ones to take, with their proofs, compiled:
:mod:`optimizer.program.methods.compiled`."""

from typing import Any

import numpy as np

from optimizer.program.kernel.bounds import bound
from optimizer.program.kernel.compiling import folded, in_place
from optimizer.program.kernel.lengths import length
from optimizer.program.kernel.settling import copy, settle_point
from optimizer.program.kernel.values import programs_of, value

#: of what optima may differ by, a gap in which no other proof is worth its time
_SHARP = 1e-4
#: of the smallest mass that counts, above all rounding
_ABOVE = 1.0 + 1e-9
#: of the proofs, as numpy's integer like all that is handed on
_FIRST: Any = np.int64(0)
#: objective, mass, excess, rounding, before their evaluation
_NONE = 0.0, 0.0, 0.0, 0.0


@folded
def largest_rows(programs, n, sizes, at_rest, row):  # type: ignore[no-untyped-def]
    """1 at the first of the largest rows of each group (R,), 0 elsewhere.

    Parameters
    ----------
    sizes : (J,) of the constants of the terms.
    at_rest : whether rows are what they come to without counterweights; else their floors.
    """
    rows, group, sums = row.size, programs.group, programs.numbers[0]
    for r in range(rows):
        sums[r] = 0.0
    if at_rest:
        for j in range(programs.owner.size):
            sums[programs.owner[j]] += sizes[j]
    highest = 0
    for r in range(rows):
        row[r], sums[r] = 0.0, programs.floor[n, r] + sums[r]
        highest = r if r == 0 or group[r] != group[r - 1] or sums[r] > sums[highest] else highest
        if r == rows - 1 or group[r + 1] != group[r]:
            row[highest] = 1.0


@folded
def candidate(kind, programs, n, sizes, solver, term, row, ceiling):  # type: ignore[no-untyped-def]
    """Multipliers, in place: the solver's, those that prove the floor, and those that prove that rest is optimal.

    As :func:`optimizer.program.multipliers.resting_multipliers`; the last two need no solver.

    Parameters
    ----------
    kind : 0, 1 or 2.
    sizes : (J,) of the constants of the terms.
    solver : three arrays as the ones that are written to, (J,), (R,) and (I,).
    """
    if kind == 0:
        copy(solver[0], term)
        copy(solver[1], row)
        copy(solver[2], ceiling)
        return
    largest_rows(programs, n, sizes, kind == 2, row)
    for j in range(term.size):
        scale = row[programs.owner[j]] / (sizes[j] if sizes[j] > 0.0 else 1.0) if kind == 2 else 0.0
        term[j] = complex(programs.constant[n, j].real * scale, programs.constant[n, j].imag * scale)
    for i in range(ceiling.size):
        ceiling[i] = 0.0


@folded
def proof_of(programs, n, sizes, solver, share, objective, rest, term, row, ceiling):  # type: ignore[no-untyped-def]
    """The highest lower bound of the objective, and the multipliers that prove it, in place: the first of equal ones.

    Parameters
    ----------
    sizes, solver : as of :func:`candidate`.
    share : how far above the smallest objective an optimum may be.
    objective, rest : of a point, and of rest.
    """
    best, highest, first = _FIRST, -np.inf, 0.0
    for kind in range(3):
        candidate(kind, programs, n, sizes, solver, term, row, ceiling)
        lower = bound(0.0, 0.0, term, row, ceiling, programs, n, programs.cap)
        if lower > highest:
            best, highest = kind, lower
        if kind == 0:
            first = lower
            # no floor proves more than itself, nor rest anything that counts where it is far from an optimum
            above = programs.floor.shape[1] == 1 and lower > programs.floor[n, 0]
            if above and objective - lower <= _SHARP * share and rest - lower > share:
                return lower
    if best < 2:
        candidate(best, programs, n, sizes, solver, term, row, ceiling)
    # where none proves anything that is what the solver's are said to
    return highest if highest > -np.inf else first


@folded
def larger(first, second):  # type: ignore[no-untyped-def]
    """The larger of two numbers; of what is none that."""
    return second if second > first or second != second else first


@folded
def is_better(old, new, tolerance):  # type: ignore[no-untyped-def]
    """Whether another point has the smaller objective, or the smaller excess where one breaks a ceiling.

    Parameters
    ----------
    old, new : objective, mass, excess, rounding.
    tolerance : up to which ceilings count as kept.
    """
    if old[2] <= tolerance and new[2] <= tolerance:
        return new[0] < old[0]
    return new[2] <= tolerance or (not old[2] <= tolerance and new[2] < old[2])


@folded
def step_towards(light, smallest, target):  # type: ignore[no-untyped-def]
    """How far the lightest is to be moved towards the smallest for the objective, which is convex, to meet a target.

    0 where it meets it, or where that is not enough.

    Parameters
    ----------
    light, smallest : objective, mass, excess, rounding.
    """
    over, fall = light[0] - target + smallest[3], light[0] - smallest[0]
    return over / fall if over > 0.0 and fall > over else 0.0


@folded
def is_clean(u, radius, dust):  # type: ignore[no-untyped-def]
    """Whether all masses of unbalances (K,) that are not 0 are above a share of the largest by more than rounding."""
    most, clean = 0.0, True
    for k in range(u.size):
        most = max(most, length(u[k]) / radius[k])
    for k in range(u.size):
        mass = length(u[k]) / radius[k]
        clean = clean and (mass == 0.0 or mass > _ABOVE * dust * most)
    return clean


@in_place
def judge(  # type: ignore[no-untyped-def]
    share,
    demand,
    least_mass,
    ample,
    enough,
    mass_enough,
    heavier,
    rounding,
    tolerance,
    smallest,
    lightest,
    term,
    row,
    ceiling,
    mass_term,
    mass_row,
    mass_ceiling,
    sizes,
    rungs,
    work,
    complex_work,
    scaled,
    unbalance,
    figures,
    proven_term,
    proven_row,
    proven_ceiling,
    bounds,
    certified,
    clean,
    *parts,
):
    """Of the ends of both stages of N programs the points to take, with their proofs.

    Parameters
    ----------
    share, demand : (N,) as of :func:`optimizer.program.methods.compiled.stage_solutions`.
    ample, enough, mass_enough, heavier, rounding, tolerance : as of
        :class:`optimizer.program.compiled_evaluation.Shares`.
    smallest, lightest : (N, K) the ends; the first is written to: the smallest objective, rest among them.
    term, row, ceiling : (N, J), (N, R), (N, I) multipliers; those of the mass likewise.
    sizes : (N, J + I) of the constants of the terms, and of more.
    rungs, work, complex_work, scaled : as of :func:`optimizer.program.kernel.settling.settle`.
    unbalance, figures : (N, K), and (4, N) as of :func:`optimizer.program.kernel.values.values`, to be written to.
    proven_term, proven_row, proven_ceiling : of the objective, to be written to.
    bounds : (3, N) of the objective, of the mass, and the largest objective that this one counts as an optimum.
    certified, clean : (N,) bool, the second whether all counterweights are well above dust.
    parts : of :func:`optimizer.program.kernel.values.programs_of`.
    """
    programs = programs_of(parts)
    number, _, webs = programs.influence.shape
    for n in range(number):
        u, best, light = unbalance[n], smallest[n], lightest[n]
        u[:] = 0.0
        first, light_figures, rest = _NONE, _NONE, _NONE
        # in a loop, as it would be compiled once for each
        for kind in range(3):
            of_point = value(best if kind == 0 else light if kind == 1 else u, programs, n)
            first = of_point if kind == 0 else first
            light_figures = of_point if kind == 1 else light_figures
            rest = of_point
        own, proof = (term[n], row[n], ceiling[n]), (proven_term[n], proven_row[n], proven_ceiling[n])
        lower = proof_of(programs, n, sizes[n], own, share[n], first[0], rest[0], proof[0], proof[1], proof[2])
        result = rest
        if is_better(rest, first, tolerance):
            result = first
        else:
            best[:] = 0.0
        smallest_figures = result
        copy(best, u)
        # the lightest by its room below the largest objective of an optimum
        target = larger(result[0], lower + ample * share[n] - result[3])
        level, mass_bound = larger(result[0], lower) + share[n], 0.0
        if least_mass:
            # what can be kept up to rounding is not traded for their tolerance
            allowance = rounding if light_figures[2] < rounding else light_figures[2]
            allowance = tolerance if allowance > tolerance else allowance
            if light_figures[1] < result[1] and light_figures[0] <= target and light_figures[2] <= allowance:
                result = light_figures
                copy(light, u)
            # moved towards the smallest just so far that the objective, which is convex, meets the target
            step = step_towards(light_figures, smallest_figures, target)
            if step > 0.0:
                nearer = work[4, :webs]
                for k in range(webs):
                    nearer[k] = light[k] + complex(
                        step * (best[k].real - light[k].real), step * (best[k].imag - light[k].imag)
                    )
                near = value(nearer, programs, n)
                if near[1] < result[1] and near[0] <= target and near[2] <= allowance:
                    result = near
                    copy(nearer, u)
            if rest[1] < result[1] and rest[0] <= target and rest[2] <= allowance:
                result = rest
                u[:] = 0.0
            mass_bound = bound(
                1.0, level, mass_term[n], mass_row[n], mass_ceiling[n], programs, n, programs.tolerant_cap
            )
        loose = demand[n] > share[n] and result[0] - lower <= demand[n]
        is_enough = (loose or smallest_figures[0] - lower <= enough * share[n]) and result[2] <= rounding
        heaviest = np.inf
        if least_mass:
            # an optimum must keep the ceilings exactly, not within their tolerance
            is_enough = is_enough and smallest_figures[2] <= rounding
            is_enough = is_enough and result[1] - mass_bound <= mass_enough * result[1]
            heaviest = mass_bound / (1.0 - heavier)
        else:
            target = lower + enough * share[n]
        figures[0, n], figures[1, n], figures[2, n], figures[3, n] = result
        settle_point(u, figures, target, heaviest, rounding, rungs, programs, n, work, complex_work, scaled)
        bounds[0, n], bounds[1, n], bounds[2, n], certified[n] = lower, mass_bound, level, is_enough
        clean[n] = is_clean(u, programs.region.radius[n], rungs[0, 0])
