"""What is left of a node set by set, where what its options cost leaves few sets.

A set comes to no less than what multipliers prove of all of them and what each of its options costs above the best of
its slot (``bound.py``). Those that may be worth a look are far fewer than all: of sixteen slots one in ten thousand.
"""

import numpy as np

from optimizer.choices.discrete.options import Incumbent
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.statement import Statement

#: of an objective that is evaluated from sums, in units of the sum of the magnitudes of what is summed
_ROUNDING = 1e-14
#: exponents that are tried, of the share of what sets may cost
_EXPONENTS = (0.0, 2.0, 4.0, 8.0, 16.0)
#: share from which on a set is not worth a look at any of them
_MANY = 10.0
#: sets that are offered at once
_AT_ONCE = 1_000


def costs(left: np.ndarray, forced: Real) -> tuple[Real, Real]:
    """What all sets come to at least (N,), and what options cost above the best of their slots (N, K, O).

    Parameters
    ----------
    left, forced : (N, K, O) what is left, and what is proven of all sets with an option.
    """
    least = np.min(np.where(left, forced, np.inf), axis=-1, keepdims=True)
    lowest = np.min(least, axis=(1, 2))
    with np.errstate(invalid="ignore"):
        cost = np.nan_to_num(forced - least)
    return lowest - _ROUNDING * np.abs(lowest), np.where(left, cost, np.inf)


def at_most(cost: Real, may_cost: Real) -> Real:
    """How many sets there are at most that cost no more than they may (N,): the bound of Chernoff (1952)."""
    left, may = np.isfinite(cost), may_cost[:, None, None]
    # what costs nothing is no share of it, be that nothing or without end
    share = np.where(cost > 0.0, _MANY, 0.0)
    np.divide(cost, may, out=share, where=left & (cost > 0.0) & (may != 0.0))
    share = np.minimum(share, _MANY)
    logs = [x + np.sum(np.log(np.sum(np.exp(-x * share), axis=-1, where=left)), axis=-1) for x in _EXPONENTS]
    count: Real = np.exp(np.min(logs, axis=0))
    return count


def offer_few(statement: Statement, incumbent: Incumbent, cost: Real, may_cost: float) -> float:
    """Offer the sets that cost no more than they may and are no worse than the best; what all others cost at least.

    Parameters
    ----------
    statement : nowhere above the incumbent's.
    cost : (K, O), infinite where an option is not left.
    """
    options = incumbent.options
    left, norms, least_outside = np.isfinite(cost), statement.norms, np.inf
    count = np.sum(left, axis=-1)
    # the widest first: the last ones hardly make more of what is at hand
    several = [k for k in np.argsort(-count, kind="stable").tolist() if count[k] > 1]
    fixed = np.argmax(left, axis=-1)
    # the first option is nothing
    rest = fixed.copy()
    rest[several] = 0
    terms: Complex = norms.at(options.carried(rest))[None]
    totals, steps = np.zeros(1), []
    for k in several:
        numbers = np.flatnonzero(left[k])
        sums = totals[:, None] + cost[k, numbers]
        within = sums <= may_cost
        least_outside = min(least_outside, float(np.min(sums, where=~within, initial=np.inf)))
        before, digit = np.nonzero(within)
        totals = sums[before, digit]
        terms = terms[before] + options.effect(k, numbers, norms.influence)[digit]
        steps.append((k, before, numbers[digit]))
    value = statement.objective_of(np.abs(terms))
    rounding = _ROUNDING * float(np.max(np.sum(np.abs(terms), axis=-1), initial=0.0) + np.max(statement.floor))
    near = np.flatnonzero(value <= incumbent.level + rounding)
    near = near[np.argsort(value[near], kind="stable")]
    while near.size:
        # the best of them first, by which most of the others are ruled out
        place, near = near[:_AT_ONCE], near[_AT_ONCE:]
        sets = np.tile(fixed, (place.size, 1))
        for k, before, option in reversed(steps):
            sets[:, k], place = option[place], before[place]
        incumbent.offer(sets)
        near = near[value[near] <= incumbent.level + rounding]
    return least_outside
