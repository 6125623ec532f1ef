"""The lower bounds that multipliers prove, compiled: :mod:`optimizer.program.certificate`, which says why they hold.

Programs are :class:`optimizer.program.kernel.programs.Programs`, whose work is written to.
"""

import numpy as np

from optimizer.numerics.kernel.knapsack import fill
from optimizer.program.kernel.compiling import folded, in_place
from optimizer.program.kernel.finer_sums import add_product
from optimizer.program.kernel.lengths import length
from optimizer.program.kernel.regions import nearest, support

_EPS = float(np.finfo(float).eps)
#: roundings of one product of a bound with its data (responses, sectors, multipliers of sum 1), in eps; a sum of n
#: such products is off by less than n + this times eps of the sum of their magnitudes (Higham 2002, section 3.1)
_PER_PRODUCT = 16
#: of these, those of influences (arms, weights) and of multipliers as they are printed, which no finer sum mends
_DATA = 6
#: a slope is summed in finer numbers where its rounding would cost the bound this share of its constant
_DEAR = 1e-10


@folded
def admissible_rows(row, group, floor, n, lam):  # type: ignore[no-untyped-def]
    """Multipliers of rows (R,), no less than 0 and of one sum in every group, and that sum, the price.

    What a group lacks it gets at its highest floor, which is true of any u.
    """
    price, rows = 0.0, row.size
    for r in range(rows):
        lam[r] = 0.0 if row[r] < 0.0 else row[r]
        price += lam[r]
    if group[rows - 1] == 0:
        return price
    most, price = -np.inf, 0.0
    for r in range(rows):
        price = lam[r] + (price if r > 0 and group[r] == group[r - 1] else 0.0)
        if r == rows - 1 or group[r + 1] != group[r]:
            most = price if price > most or price != price else most
    price, highest = 0.0, 0
    for r in range(rows):
        new = r == 0 or group[r] != group[r - 1]
        price = lam[r] + (0.0 if new else price)
        highest = r if new or floor[n, r] > floor[n, highest] else highest
        if r == rows - 1 or group[r + 1] != group[r]:
            lam[highest] += most - price
    price = 0.0
    for r in range(rows):
        price += lam[r] if group[r] == 0 else 0.0
    return price


@folded
def minorant(term, row, ceiling, programs, n, cap, normal):  # type: ignore[no-untyped-def]
    """The affine minorant of the Lagrangian of program n.

    Parameters
    ----------
    term, row, ceiling : (J,), (R,), (I,) multipliers, made admissible here.
    cap : (N, I) of the ceilings.
    normal : whether rows are made to sum to 1.

    Returns
    -------
    The price; whether it proves anything; the constant and the sum of magnitudes that its rounding is a share of;
    whether slopes called for finer sums. In the work of the programs: slopes of the minorant in ``vectors[1]``, those
    of webs that are alike in ``vectors[2]``; their roundings and spreads in ``numbers[2]`` and ``numbers[3]``.
    """
    _, terms, webs = programs.influence.shape
    own, rows, region = programs.owner.size, programs.floor.shape[1], programs.region
    influence, across, magnitude = programs.influence, programs.across, programs.magnitude
    lam, size_of, rounding, spread = programs.numbers[0], programs.numbers[1], programs.numbers[2], programs.numbers[3]
    y, slopes, is_complex = programs.vectors[0], programs.vectors[1], programs.across.shape[2] > 0
    price = admissible_rows(row, programs.group, programs.floor, n, lam)
    finite = price > 0.0 and price < np.inf
    factor = 1.0 / price if finite and normal else 1.0
    for j in range(terms):
        if j < own:
            size, most = length(term[j]), lam[programs.owner[j]]
            shrink = most / size if size > most else 1.0
            y[j] = complex(term[j].real * shrink * factor, term[j].imag * shrink * factor)
        else:
            y[j] = complex(ceiling[j - own].real * factor, ceiling[j - own].imag * factor)
        if programs.scalar[j]:
            y[j] = y[j].real
        size_of[j] = length(y[j])
    # the constant, and the size of what it is a sum of
    fixed, size = 0.0, 0.0
    for r in range(rows):
        part = lam[r] * factor * programs.floor[n, r]
        fixed, size = fixed + part, size + abs(part)
    for j in range(terms):
        part = y[j].real * programs.constant[n, j].real + y[j].imag * programs.constant[n, j].imag
        fixed, size = fixed + part, size + abs(part)
    for i in range(terms - own):
        part = size_of[own + i] * cap[n, i]
        fixed, size = fixed - part, size + abs(part)
    # the slopes sum_j conj(H_jk) y_j; most ceilings prove nothing, and what is 0 changes no sum
    off, last = 0.0, terms
    while last > own and size_of[last - 1] == 0.0:
        last -= 1
    for k in range(webs):
        x, z, large = 0.0, 0.0, 0.0
        if is_complex:
            for j in range(last):
                x += influence[n, j, k] * y[j].real + across[n, j, k] * y[j].imag
                z += influence[n, j, k] * y[j].imag - across[n, j, k] * y[j].real
                large += magnitude[n, j, k] * size_of[j]
        else:
            for j in range(last):
                x, z = x + influence[n, j, k] * y[j].real, z + influence[n, j, k] * y[j].imag
                large += abs(influence[n, j, k]) * size_of[j]
        slopes[k] = complex(x, z)
        # size of the terms of the sum, until a second look decides between them and finer sums
        spread[k] = large
        rounding[k] = _EPS * (_PER_PRODUCT + terms) * large
        off += region.radius[n, k] * min(region.max_mass[n, k], region.budget[n]) * rounding[k]
    dear = off > _DEAR * size
    if dear:
        # webs of almost equal influence, with limits that are far away: the rest of the data, no more
        for k in range(webs):
            x, x_rest, z, z_rest = 0.0, 0.0, 0.0, 0.0
            for j in range(terms):
                x, x_rest = add_product(x, x_rest, influence[n, j, k], y[j].real)
                z, z_rest = add_product(z, z_rest, influence[n, j, k], y[j].imag)
                if is_complex:
                    x, x_rest = add_product(x, x_rest, across[n, j, k], y[j].imag)
                    z, z_rest = add_product(z, z_rest, -across[n, j, k], y[j].real)
            slopes[k] = complex(x + x_rest, z + z_rest)
            # of 2 terms products in either part
            rest = 2.0 * (_EPS * (2 + 2 * terms)) ** 2 * spread[k]
            rounding[k] = _EPS * (_DATA * spread[k] + _PER_PRODUCT * length(slopes[k])) + rest
    for k in range(webs):
        spread[k] = 0.0
    if programs.scatter[0] > 0.0 or programs.scatter[1] > 0.0:
        _spread(programs, n, factor)
    if region.leader.size:
        nearest(slopes, region, n, programs.vectors[3], programs.vectors[2])
    return price, finite, fixed, size, dear


@folded
def _spread(programs, n, factor):  # type: ignore[no-untyped-def]
    """What a bound rises by, or less, for a kilogram metre on each web because counterweights scatter."""
    _, terms, webs = programs.influence.shape
    own, is_complex, region = programs.owner.size, programs.across.shape[2] > 0, programs.region
    lam, size_of, spread, mean = programs.numbers[0], programs.numbers[1], programs.numbers[3], programs.numbers[4]
    for k in range(webs):
        mean[k] = 0.0
    for k in range(webs):
        for j in range(terms):
            large = programs.magnitude[n, j, k] if is_complex else abs(programs.influence[n, j, k])
            worth = lam[programs.owner[j]] * factor if j < own else size_of[j]
            spread[k] += programs.scatter[0 if j < own else 1] * worth * large
        if region.leader.size:
            mean[region.leader[k]] += spread[k]
    for k in range(webs):
        if region.leader.size:
            # webs that carry as much as one another share what it is
            spread[k] = mean[region.leader[k]] / region.members[k]
        spread[k] *= 1.0 - _EPS * (_PER_PRODUCT + terms)


@folded
def support_of(programs, n, k, dear):  # type: ignore[no-untyped-def]
    """What a kilogram metre on web k can lower the minorant by, or more; below 0 it only raises it."""
    slope = programs.vectors[2 if programs.region.leader.size else 1][k]
    reach = support(-slope, programs.region, n, k)
    if not dear:
        # below 0 where that is dear
        reach = 0.0 if reach < 0.0 else reach
    return reach + programs.numbers[2, k] - programs.numbers[3, k]


@folded
def rounding_of(size, programs):  # type: ignore[no-untyped-def]
    """Rounding of a sum over terms, rows and ceilings whose magnitudes sum to ``size``."""
    terms, own = programs.influence.shape[1], programs.owner.size
    return _EPS * (_PER_PRODUCT + own + 2 * (terms - own) + programs.floor.shape[1]) * size


@folded
def bound(mass_cost, target, term, row, ceiling, programs, n, cap):  # type: ignore[no-untyped-def]
    """The bound of one proof of program n, parameters as of :func:`bounds`."""
    region, webs = programs.region, programs.influence.shape[2]
    gain, masses = programs.numbers[4], programs.numbers[5]
    price, finite, fixed, size, dear = minorant(term, row, ceiling, programs, n, cap, mass_cost == 0.0)
    for k in range(webs):
        # one kilogram gains at best R_k sigma_k - cost; the rounding of the slope is a gain too, so that it counts as
        # far as the limits let the web reach
        more = region.radius[n, k] * support_of(programs, n, k, dear) - mass_cost
        # what is no number is no less
        gain[k] = 0.0 if more <= 0.0 else more
    places = programs.places
    fill(gain[:webs], region.max_mass[n], region.budget[n], places[0], places[1], masses)
    gained = 0.0
    for k in range(webs):
        gained += gain[k] * masses[k]
    charge = price * target if mass_cost > 0.0 else 0.0
    off = rounding_of(size + abs(charge), programs)
    lowest = fixed - charge - gained * (1.0 + _EPS * (_PER_PRODUCT + 2 * webs)) - off
    if mass_cost > 0.0:
        return lowest if lowest > 0.0 else 0.0
    return lowest if finite else -np.inf


@in_place
def bounds(mass_cost, target, term, row, ceiling, programs, cap, result):  # type: ignore[no-untyped-def]
    """Bounds of N programs from M = P N proofs, proof m of program m % N.

    Parameters
    ----------
    mass_cost : 0 in bounds on the objective, for which rows are made to sum to 1; 1 in bounds on the mass.
    target : (T,) largest objective that counts, of proof m that of m % T; not read in bounds on the objective.
    term, row, ceiling : (M, J), (M, R), (M, I) multipliers.
    cap : (N, I) of the ceilings.
    result : (M,).
    """
    number = programs.floor.shape[0]
    for m in range(result.size):
        at = target[m % target.size]
        result[m] = bound(mass_cost, at, term[m], row[m], ceiling[m], programs, m % number, cap)


@in_place
def minorants(normal, term, row, ceiling, programs, cap, constant, slope, of_webs):  # type: ignore[no-untyped-def]
    """The minorants themselves.

    Parameters
    ----------
    normal : whether rows are made to sum to 1.
    constant : (M,) less what it may be off by, -inf where nothing is proven.
    slope : (M, K).
    of_webs : (3, M, K) what the slopes may be off by, spreads, and what a kilogram metre can lower the minorant by.
    """
    number, _, webs = programs.influence.shape
    for m in range(constant.size):
        n = m % number
        _, finite, fixed, size, dear = minorant(term[m], row[m], ceiling[m], programs, n, cap, normal)
        constant[m] = fixed - rounding_of(size, programs) if finite else -np.inf
        for k in range(webs):
            slope[m, k] = programs.vectors[1, k]
            of_webs[0, m, k], of_webs[1, m, k] = programs.numbers[2, k], programs.numbers[3, k]
            of_webs[2, m, k] = support_of(programs, n, k, dear)
