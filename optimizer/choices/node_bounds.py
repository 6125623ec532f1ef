"""What multipliers prove of the nodes of a tree, whatever its nodes leave, and better multipliers for that.

Whatever they are, P >= constant + sum_k min Re(conj(slope_k) u_k) over what is left of every web, with a price for the
budget (docs/mathematics.md sections 16 and 20).
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers, affine_minorant, normalised
from optimizer.program.statement import Statement

#: steps in which the price of the budget is halved in on, and steps uphill
_HALVINGS, _STEPS = 24, 12


@record(frozen=True)
class NodeBounds:
    """What is proven of N nodes."""

    bound: Real  # (N,) of all that is left
    forced: Real  # (N, K, O) of all that takes one of the options of a web or slot, at the same multipliers
    price: Real  # (N,) of a kilogram, where the budget counts


def price_of_budget(
    least: Callable[[Real], tuple[Real, Real]], budget: float, count: int, high: Callable[[], Real]
) -> tuple[Real, Real]:
    """Prices of a kilogram (N,) by which the bounds of N nodes under a budget [kg] are largest, and the sums there.

    Parameters
    ----------
    least : price (N,) -> the sums at that price, and the masses that they take (N,).
    high : prices (N,) that are certainly too high.
    """
    price = np.zeros(count)
    best, mass = least(price)
    if not np.any(mass > budget):
        return price, best
    # concave in the price: its slope is what the mass is above the budget
    highest, low, top = price, price, high()
    for _ in range(_HALVINGS):
        price = 0.5 * (low + top)
        value, mass = least(price)
        highest, best = np.where(value > best, price, highest), np.maximum(best, value)
        low, top = np.where(mass > budget, price, low), np.where(mass > budget, top, price)
    return highest, best


def uphill(
    statement: Statement,
    multipliers: Multipliers,
    charge: Real,
    lowest: Callable[[Complex], tuple[Real, Complex]],
    target: float,
) -> Multipliers:
    """Multipliers of the terms that prove more, as far as ``target``, those of rows and ceilings and the price kept.

    The bound is concave in them, with the vectors at what it takes as its slope: steps of Polyak (1969).

    Parameters
    ----------
    charge : (N,) what the budget costs at the price; 0 without a budget.
    lowest : slopes of the webs (N, W) -> the least of what is left of all (N,), and the unbalances there (N, W) kg m.
    """
    usable, _ = normalised(statement, multipliers)
    if not np.isfinite(target):
        return usable
    norms, allowed = statement.norms, usable.row[..., statement.row]
    y = usable.term
    constant, slope, _ = affine_minorant(statement, usable)
    still_slope = slope - y @ norms.influence
    still = constant - np.sum((np.conj(y) * norms.constant).real, axis=-1) - charge
    best, value = y, np.full(y.shape[0], -np.inf)
    for _ in range(_STEPS):
        of_webs, u = lowest(still_slope + y @ norms.influence)
        result = still + np.sum((np.conj(y) * norms.constant).real, axis=-1) + of_webs
        better = result > value
        value, best = np.where(better, result, value), np.where(better[:, None], y, best)
        up = norms.constant + u @ norms.influence.T
        # rows whose multipliers are all 0 prove nothing, whatever their terms
        rise = np.where(np.isfinite(result), np.maximum(target - result, 0.0), 0.0)
        step = rise / np.maximum(np.sum(np.abs(up) ** 2, axis=-1), 1e-300)
        y = y + step[:, None] * up
        size = np.abs(y)
        y = np.where(size > allowed, y * (allowed / np.where(size > 0, size, 1.0)), y)
    return replace(usable, term=best)
