"""The lower bounds that multipliers prove, compiled: :mod:`optimizer.program.certificate`, which says why they hold.

For objectives of one group whose influences are real and whose webs each carry what they like.
"""

import numpy as np

from optimizer.numerics.kernel.knapsack import fill
from optimizer.program.kernel.compiling import in_place

_EPS = float(np.finfo(float).eps)
#: roundings, as in :mod:`optimizer.program.certificate`
PER_PRODUCT, DEAR = 16, 1e-10


@in_place
def bounds(  # type: ignore[no-untyped-def]
    mass_cost,
    target,
    cap,
    term,
    row,
    ceiling,
    owner,
    constant,
    influence,
    floor,
    radius,
    max_mass,
    budget,
    free,
    centre,
    cosine,
    sine,
    row_work,
    term_work,
    web_work,
    order,
    result,
    dear,
):
    """Bounds of N programs from M = P N proofs, proof m of program m % N.

    Parameters
    ----------
    mass_cost : 0 in bounds on the objective, for which rows are made to sum to 1; 1 in bounds on the mass.
    target : (N,) largest objective that counts; not read in bounds on the objective.
    cap : (N, I) of the ceilings.
    term, row, ceiling : (M, J), (M, R), (M, I) multipliers.
    owner : (J,) row of a term.
    constant, influence, floor : (N, J + I), (N, J + I, K), (N, R).
    row_work, term_work, web_work, order : (R,), (J + I,) complex, (2, K) and (2, K) integers, to be written to.
    result, dear : (M,) the bound, and whether its slopes call for a finer sum than this one.
    """
    number, terms, webs = influence.shape
    rows, own, lam, y, gain, masses = floor.shape[1], owner.size, row_work, term_work, web_work[0], web_work[1]
    for m in range(result.size):
        n = m % number
        price = 0.0
        for r in range(rows):
            lam[r] = 0.0 if row[m, r] < 0.0 else row[m, r]
            price += lam[r]
        finite = price > 0.0 and price < np.inf
        factor = 1.0 / price if finite and mass_cost == 0.0 else 1.0
        for j in range(own):
            size, most = abs(term[m, j]), lam[owner[j]]
            shrink = most / size if size > most else 1.0
            y[j] = complex(term[m, j].real * shrink * factor, term[m, j].imag * shrink * factor)
        for i in range(terms - own):
            y[own + i] = complex(ceiling[m, i].real * factor, ceiling[m, i].imag * factor)
        # the constant of the minorant, and the size of what it is a sum of
        fixed, size = 0.0, 0.0
        for r in range(rows):
            part = lam[r] * factor * floor[n, r]
            fixed, size = fixed + part, size + abs(part)
        for j in range(terms):
            part = y[j].real * constant[n, j].real + y[j].imag * constant[n, j].imag
            fixed, size = fixed + part, size + abs(part)
        for i in range(terms - own):
            part = abs(y[own + i]) * cap[n, i]
            fixed, size = fixed - part, size + abs(part)
        # its slopes, and what a kilogram gains by them
        off = 0.0
        for k in range(webs):
            slope, large = 0.0j, 0.0
            for j in range(terms):
                slope += complex(influence[n, j, k] * y[j].real, influence[n, j, k] * y[j].imag)
                large += abs(influence[n, j, k]) * abs(y[j])
            rounding = _EPS * (PER_PRODUCT + terms) * large
            off += radius[n, k] * min(max_mass[n, k], budget[n]) * rounding
            support = abs(slope)
            if not free[n, k]:
                along = -slope.real * centre[n, k].real - slope.imag * centre[n, k].imag
                across = abs(slope.real * centre[n, k].imag - slope.imag * centre[n, k].real)
                if across * cosine[n, k] > along * sine[n, k]:
                    # below 0 it is where this is dear: in full (limits.support)
                    support = max(along * cosine[n, k] + across * sine[n, k], 0.0)
            gain[k] = max(radius[n, k] * (support + rounding) - mass_cost, 0.0)
        dear[m] = off > DEAR * size
        fill(gain, max_mass[n], budget[n], order[0], order[1], masses)
        gained = 0.0
        for k in range(webs):
            gained += gain[k] * masses[k]
        charge = price * target[n] if mass_cost > 0.0 else 0.0
        off = _EPS * (PER_PRODUCT + own + 2 * (terms - own) + rows) * (size + abs(charge))
        bound = fixed - charge - gained * (1.0 + _EPS * (PER_PRODUCT + 2 * webs)) - off
        if mass_cost > 0.0:
            result[m] = max(bound, 0.0)
        else:
            result[m] = bound if finite else -np.inf
