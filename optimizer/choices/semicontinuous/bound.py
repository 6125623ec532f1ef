"""What multipliers prove of nodes, and better multipliers for that.

Whatever they are, P >= constant + sum_k min Re(conj(slope_k) u_k) over what is left of every web, with a price for the
budget (docs/mathematics.md section 20).
"""

from dataclasses import dataclass, replace

import numpy as np

from optimizer.choices.semicontinuous.places import Places
from optimizer.numerics.arrays import Real
from optimizer.program.certificate import Multipliers, affine_minorant, normalised
from optimizer.program.statement import Statement

#: steps in which the price of the budget is halved in on, and steps uphill
_HALVINGS, _STEPS = 24, 12
_EPS = float(np.finfo(float).eps)


@dataclass(frozen=True)
class Proven:
    """What is proven of N nodes."""

    bound: Real  # (N,) of all that is left
    without: Real  # (N, K) if nothing is on a web that is undecided
    fitted: Real  # (N, K) if something is
    price: Real  # (N,) of a kilogram, where there is a budget


def proven(statement: Statement, places: Places, multipliers: Multipliers) -> Proven:
    """What multipliers (N,) prove of N nodes of one program (no leading axes)."""
    limits = statement.limits
    constant, slope, rounding = affine_minorant(statement, multipliers)
    slope = places.slopes(slope)
    budget, price = float(limits.max_total_mass), np.zeros(constant.shape)
    charged = budget if np.isfinite(budget) else 0.0

    def least(price: Real) -> tuple[Real, Real]:
        """The sums at a price, and the masses that they take (N,)."""
        value, u = places.lowest(slope, price[:, None] / limits.radius - rounding)
        return np.sum(value, axis=-1) - price * charged, np.sum(np.abs(u) / limits.radius, axis=-1)

    best, mass = least(price)
    if np.any(mass > budget):
        # concave in the price: its slope is what the mass is above the budget
        taken, low = price, price
        high = 2.0 * np.max(limits.radius * (np.abs(slope) + rounding), axis=-1)
        for _ in range(_HALVINGS):
            price = 0.5 * (low + high)
            value, mass = least(price)
            taken, best = np.where(value > best, price, taken), np.maximum(best, value)
            low, high = np.where(mass > budget, price, low), np.where(mass > budget, high, price)
        price = taken
    each = price[:, None] / limits.radius - rounding
    value, _ = places.lowest(slope, each)
    total = np.sum(value, axis=-1)
    size = np.abs(constant) + np.sum(np.abs(slope) * places.most, axis=-1) + price * charged
    lowest = constant - _EPS * (64 + 8 * limits.radius.size) * size
    bound = lowest + best
    value = places.together(value)
    apart = (lowest + total - price * charged)[:, None] - value
    nothing = ~np.isfinite(bound)
    return Proven(
        np.where(nothing, -np.inf, bound),
        np.where(nothing[:, None], -np.inf, apart),
        np.where(nothing[:, None], -np.inf, apart + places.together(places.when_fitted(slope, each))),
        price,
    )


def uphill(statement: Statement, places: Places, multipliers: Multipliers, price: Real, target: float) -> Multipliers:
    """Multipliers of the terms that prove more, as far as ``target``, those of rows and ceilings and the price kept.

    The bound is concave in them, with the terms at what it takes as its slope: steps of Polyak (1969).
    """
    usable, _ = normalised(statement, multipliers)
    if not np.isfinite(target):
        return usable
    norms, allowed, limits = statement.norms, usable.row[..., statement.row], statement.limits
    y, each = usable.term, price[:, None] / limits.radius
    constant, slope, _ = affine_minorant(statement, usable)
    still_slope = slope - y @ norms.influence
    still = constant - np.sum((np.conj(y) * norms.constant).real, axis=-1)
    still = still - (price * limits.max_total_mass if np.isfinite(limits.max_total_mass) else 0.0)
    best, value = y, np.full(y.shape[0], -np.inf)
    for _ in range(_STEPS):
        of_webs, u = places.lowest(places.slopes(still_slope + y @ norms.influence), each)
        found = still + np.sum((np.conj(y) * norms.constant).real, axis=-1) + np.sum(of_webs, axis=-1)
        better = found > value
        value, best = np.where(better, found, value), np.where(better[:, None], y, best)
        up = norms.constant + u @ norms.influence.T
        step = np.maximum(target - found, 0.0) / np.maximum(np.sum(np.abs(up) ** 2, axis=-1), 1e-300)
        y = y + step[:, None] * up
        size = np.abs(y)
        y = np.where(size > allowed, y * (allowed / np.where(size > 0, size, 1.0)), y)
    return replace(usable, term=best)
