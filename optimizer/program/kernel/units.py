"""Points and multipliers in physical units, and what programs are the size of, compiled.

Arrays are handed on one by one: a program has two dozen, and to look at each takes longer than most of these loops.
"""

import numpy as np

from optimizer.program.kernel.bounds import admissible_rows
from optimizer.program.kernel.compiling import in_place
from optimizer.program.kernel.lengths import length
from optimizer.program.kernel.programs import Region
from optimizer.program.kernel.regions import into


@in_place
def physical(v, cone, row, mass_unit, reach, unit, size, mean, points, term, price, ceiling, *region):  # type: ignore[no-untyped-def]
    """Where the two stages of N programs ended, from units of their own.

    Parameters
    ----------
    v : (2, N, K) complex, shares of the reach.
    cone, row : (2, N, J + I, 2) and (2, N, R) multipliers.
    mass_unit : (N,) kg, of what the second stage minimises.
    reach, unit : (N, K) kg m of webs, and (N,) of the objective.
    size : (N, I) of the ceilings.
    mean : (K,) complex, to be written to.
    points : (2, N, K) kg m within the region, to be written to.
    term, price, ceiling : multipliers (2, N, J), (2, N, R) and (2, N, I) per unit of objective or response, likewise.
    region : arrays of :class:`optimizer.program.kernel.programs.Region`.
    """
    (_, number, webs), within = v.shape, Region(*region)
    for stage in range(2):
        for n in range(number):
            value = mass_unit[n] if stage else 1.0
            worth = value / unit[n]
            for k in range(webs):
                points[stage, n, k] = complex(reach[n, k] * v[stage, n, k].real, reach[n, k] * v[stage, n, k].imag)
            into(points[stage, n], within, n, mean)
            for j in range(term.shape[2]):
                term[stage, n, j] = complex(cone[stage, n, j, 0] * worth, cone[stage, n, j, 1] * worth)
            for r in range(price.shape[2]):
                price[stage, n, r] = row[stage, n, r] * worth
            for i in range(ceiling.shape[2]):
                # as numpy divides what is complex
                inverse, q = 1.0 / size[n, i], term.shape[2] + i
                ceiling[stage, n, i] = complex(
                    cone[stage, n, q, 0] * value * inverse, cone[stage, n, q, 1] * value * inverse
                )


@in_place
def printed(priced, factor, inside, owner, group, floor, scalar, lam, term, row, ceiling):  # type: ignore[no-untyped-def]
    """Multipliers of M = P N bounds of N programs as they are printed, in place: admissible, and times a factor.

    Parameters
    ----------
    priced : (M,) bool, whether rows are made to sum to 1 in place of the factor.
    factor : (M,).
    inside : share of its row that a term may have at most.
    owner, group, floor : (J,), (R,) and (N, R) of :class:`optimizer.program.kernel.programs.Programs`.
    scalar : (J + I,) bool.
    lam : (R,) or more, to be written to.
    term, row, ceiling : (M, J), (M, R) and (M, I).
    """
    number = floor.shape[0]
    for m in range(factor.size):
        price = admissible_rows(row[m], group, floor, m % number, lam)
        own = factor[m]
        if priced[m]:
            own = 1.0 / price if price > 0.0 and price < np.inf else 1.0
        for r in range(row.shape[1]):
            row[m, r] = lam[r] * own
        for j in range(term.shape[1]):
            y = complex(term[m, j].real * own, term[m, j].imag * own)
            size, most = length(y), row[m, owner[j]] * inside
            shrink = most / size if size > most else 1.0
            term[m, j] = complex(y.real * shrink, 0.0 if scalar[j] else y.imag * shrink)
        for i in range(ceiling.shape[1]):
            across = 0.0 if scalar[term.shape[1] + i] else ceiling[m, i].imag * own
            ceiling[m, i] = complex(ceiling[m, i].real * own, across)


@in_place
def least_masses(owner, rows, influence, radius, largest, budget, objective, size, least):  # type: ignore[no-untyped-def]
    """Least mass that could cancel a row of the objective, or a response under a ceiling, at the web where a kilogram
    does most, of N programs; 0 where none does anything.

    Parameters
    ----------
    owner, rows : (J,) row of a term, and how many there are.
    influence : (N, J + I, K) magnitudes, or real.
    radius, largest, budget : (N, K) radius and (N, K) largest mass of the webs, and (N,) budget.
    objective : (N, 1) size of the objective, or (N, R) of its rows.
    size : (N, I) of the ceilings.
    least : (N,) kg, to be written to.
    """
    number, terms, webs = influence.shape
    own = owner.size
    for n in range(number):
        smallest = np.inf
        for r in range(rows + terms - own):
            most = 0.0
            for k in range(webs):
                arm = radius[n, k] if min(largest[n, k], budget[n]) > 0.0 else 0.0
                does = 0.0
                for j in range(terms):
                    if (owner[j] if j < own else rows + j - own) == r:
                        does += abs(influence[n, j, k]) * arm
                most = max(most, does)
            if most > 0.0:
                magnitude = objective[n, min(r, objective.shape[1] - 1)] if r < rows else size[n, r - rows]
                smallest = min(smallest, magnitude / most)
        least[n] = smallest if smallest < np.inf else 0.0


@in_place
def single_reaches(sizes, influence, radius, largest, budget, far, reach):  # type: ignore[no-untyped-def]
    """The largest unbalance that one vector calls for by itself, of N programs.

    And whether some web has no limit, or one that is far beyond that, and whether some can carry nothing.

    Parameters
    ----------
    sizes : (N, Q) of the vectors without counterweights.
    influence : (N, Q, K) magnitudes, or real.
    radius, largest, budget : (N, K) radius and (N, K) largest mass of the webs, and (N,) budget.
    far : multiple of that unbalance which is far beyond it.
    reach : (N,) kg m, to be written to.
    """
    number, vectors, webs = influence.shape
    beyond, idle = False, False
    for n in range(number):
        reach[n] = 0.0
        for q in range(vectors):
            most = 0.0
            for k in range(webs):
                most = max(most, abs(influence[n, q, k]))
            if most > 0.0:
                reach[n] = max(reach[n], sizes[n, q] / most)
        for k in range(webs):
            most = min(largest[n, k], budget[n])
            beyond = beyond or largest[n, k] == np.inf or most > far * reach[n] / radius[n, k]
            idle = idle or not radius[n, k] * most > 0.0
    return beyond, idle
