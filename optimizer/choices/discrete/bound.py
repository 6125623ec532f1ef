"""What multipliers prove of the options left of many nodes, and better multipliers for that.

Whatever they are, P >= constant + sum_k min over the options left of Re(conj(slope_k) u), with prices for the budget
and for the number of counterweights (docs/mathematics.md section 16). An option by which that minimum rises to what is
known already is worth no look: it is forced out.
"""

from dataclasses import dataclass, replace

import numpy as np

from optimizer.choices.discrete.options import Options
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import Multipliers, affine_minorant, normalised
from optimizer.program.statement import Statement

#: steps in which the price of the budget is halved in on
_HALVINGS = 24
#: steps uphill
_STEPS = 12


@dataclass(frozen=True)
class Proven:
    """What is proven of N nodes."""

    bound: Real  # (N,) of every set of what is left
    forced: Real  # (N, K, O) of every set that takes an option, at the same multipliers
    price: Real  # (N,) of a kilogram, where the budget counts


def proven(statement: Statement, options: Options, left: np.ndarray, multipliers: Multipliers) -> Proven:
    """What multipliers prove of the options left (N, K, O) of N nodes (N,)."""
    constant, slope, rounding = affine_minorant(statement, multipliers)
    size = np.abs(options.unbalance)
    each = _along(options.of_first(slope), options.unbalance) - options.together(rounding)[..., None] * size
    each = np.where(left, each, np.inf)
    budget = options.budget(statement)
    charged = budget if np.isfinite(budget) else 0.0

    def least(price: Real) -> tuple[Real, Real]:
        """The least sum at a price of the mass (N,), and the mass that it takes."""
        priced = each + price[:, None, None] * options.mass
        place = np.argmin(priced, axis=-1)[..., None]
        found = np.take_along_axis(priced, place, axis=-1)[..., 0]
        mass = np.take_along_axis(np.broadcast_to(options.mass, left.shape), place, axis=-1)[..., 0]
        if options.limits_fitted:
            can_stay = left[..., 0]
            gain = np.where(can_stay, np.minimum(found - priced[..., 0], 0.0), 0.0)
            # those that gain most for each of their webs, and of the last the share that there is room for
            room = (options.most_fitted or 0) - np.sum(np.where(can_stay, 0, options.webs), axis=-1)
            order = np.argsort(gain / options.webs, axis=-1, kind="stable")
            webs = np.where(np.take_along_axis(can_stay, order, axis=-1), options.webs[order], 0)
            share = np.clip((room[:, None] - np.cumsum(webs, axis=-1) + webs) / np.maximum(webs, 1), 0.0, 1.0)
            share = np.take_along_axis(share, np.argsort(order, axis=-1, kind="stable"), axis=-1)
            found = np.where(can_stay, priced[..., 0] + share * gain, found)
            mass = np.where(can_stay, share * mass, mass)
        return np.sum(found, axis=-1), np.sum(mass, axis=-1)

    price, taken = np.zeros(left.shape[0]), np.zeros(left.shape[0])
    best, mass = least(price)
    if np.any(mass > budget):
        # concave in the price: its slope is what the mass is above the budget
        lightest = np.where(left, options.mass, np.inf)
        step = np.max(np.where(left & (options.mass > 0), np.abs(each), 0.0), axis=(1, 2))
        step = step / np.maximum(np.min(np.where(lightest > 0, lightest, np.inf), axis=(1, 2)), 1e-300)
        low, high = price, np.where(np.isfinite(step), 2.0 * step, 0.0)
        for _ in range(_HALVINGS):
            price = 0.5 * (low + high)
            value, mass = least(price)
            value = value - price * charged
            taken, best = np.where(value > best, price, taken), np.maximum(best, value)
            low, high = np.where(mass > budget, price, low), np.where(mass > budget, high, price)
    magnitude = np.abs(constant) + np.sum(np.max(np.where(left, np.abs(each), 0.0), axis=-1), axis=-1)
    constant = constant - 1e-14 * (magnitude + options.slots * np.maximum(price, taken) * charged)
    bound = constant + best
    # of one option in place of the best of its slot, whatever number of counterweights
    priced = each + taken[:, None, None] * options.mass
    lowest = np.min(priced, axis=-1, keepdims=True)
    apart = constant + np.sum(lowest[..., 0], axis=-1) - taken * charged
    with np.errstate(invalid="ignore"):
        forced = apart[:, None, None] + (priced - lowest)
    return Proven(np.where(np.isnan(bound), -np.inf, bound), np.where(np.isnan(forced), -np.inf, forced), taken)


def uphill(
    statement: Statement, options: Options, left: np.ndarray, multipliers: Multipliers, price: Real, target: float
) -> Multipliers:
    """Multipliers of the terms that prove more, as far as ``target``, those of rows and ceilings and the price kept.

    The bound is concave in them, with the vectors at the options that it takes as its slope: steps of Polyak (1969).
    """
    usable, _ = normalised(statement, multipliers)
    if not np.isfinite(target):
        return usable
    norms, allowed = statement.norms, usable.row[..., statement.row]
    # only what is left, side by side
    most = int(np.max(np.sum(left, axis=-1)))
    place = np.argsort(~left, axis=-1, kind="stable")[..., :most]
    slots = np.arange(options.slots)[:, None]
    u = options.unbalance[slots, place]
    cost = np.where(np.take_along_axis(left, place, axis=-1), price[:, None, None] * options.mass[slots, place], np.inf)
    y = usable.term
    constant, slope, _ = affine_minorant(statement, usable)
    still_slope = slope - y @ norms.influence
    budget = options.budget(statement)
    still = constant - np.sum((np.conj(y) * norms.constant).real, axis=-1)
    still = still - (price * budget if np.isfinite(budget) else 0.0)
    best, value = y, np.full(y.shape[0], -np.inf)
    for _ in range(_STEPS):
        slope = options.of_first(still_slope + y @ norms.influence)
        each = _along(slope, u) + cost
        taken = np.argmin(each, axis=-1)[..., None]
        found = still + np.sum((np.conj(y) * norms.constant).real, axis=-1)
        found = found + np.sum(np.take_along_axis(each, taken, axis=-1)[..., 0], axis=-1)
        better = found > value
        value, best = np.where(better, found, value), np.where(better[:, None], y, best)
        there = np.take_along_axis(u, taken, axis=-1)[..., 0]
        webs = there if options.alike is None else options.alike.carried(there)
        uphill = norms.constant + webs @ norms.influence.T
        step = np.maximum(target - found, 0.0) / np.maximum(np.sum(np.abs(uphill) ** 2, axis=-1), 1e-300)
        y = y + step[:, None] * uphill
        size = np.abs(y)
        y = np.where(size > allowed, y * (allowed / np.where(size > 0, size, 1.0)), y)
    return replace(usable, term=best)


def _along(slope: Complex, u: Complex) -> Real:
    """Re(conj(slope_k) u_ko) (N, K, O), of unbalances (K, O) or (N, K, O)."""
    along: Real = slope.real[..., None] * u.real + slope.imag[..., None] * u.imag
    return along
