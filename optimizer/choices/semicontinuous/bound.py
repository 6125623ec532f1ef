"""What multipliers prove of nodes, and better multipliers for that: of a web nothing, or something, is what is left.

Docs/mathematics.md section 20.
"""

import numpy as np

from optimizer.choices.node_bounds import NodeBounds, price_of_budget
from optimizer.choices.node_bounds import uphill as uphill_by
from optimizer.choices.semicontinuous.places import Places
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import Multipliers, affine_minorant
from optimizer.program.statement import Statement

_EPS = float(np.finfo(float).eps)


def proven(statement: Statement, places: Places, multipliers: Multipliers) -> NodeBounds:
    """What multipliers (N,) prove of N nodes of one program (no leading axes): if nothing is on a web that is
    undecided, and if something is."""
    limits = statement.limits
    constant, slope, rounding = affine_minorant(statement, multipliers)
    slope = places.slopes(slope)
    budget = float(limits.max_total_mass)
    charged = budget if np.isfinite(budget) else 0.0

    def least(price: Real) -> tuple[Real, Real]:
        """The sums at a price, and the masses that they take (N,)."""
        value, u = places.lowest(slope, price[:, None] / limits.radius - rounding)
        return np.sum(value, axis=-1) - price * charged, np.sum(np.abs(u) / limits.radius, axis=-1)

    def high() -> Real:
        return 2.0 * np.max(limits.radius * (np.abs(slope) + rounding), axis=-1)

    price, best = price_of_budget(least, budget, constant.size, high)
    rate = price[:, None] / limits.radius - rounding
    value, _ = places.lowest(slope, rate)
    total = np.sum(value, axis=-1)
    size = np.abs(constant) + np.sum(np.abs(slope) * places.most, axis=-1) + price * charged
    lowest = constant - _EPS * (64 + 8 * limits.radius.size) * size
    bound = lowest + best
    value = places.together(value)
    apart = (lowest + total - price * charged)[:, None] - value
    forced = np.stack([apart, apart + places.together(places.when_fitted(slope, rate))], axis=-1)
    nothing = ~np.isfinite(bound)
    return NodeBounds(np.where(nothing, -np.inf, bound), np.where(nothing[:, None, None], -np.inf, forced), price)


def uphill(statement: Statement, places: Places, multipliers: Multipliers, price: Real, target: float) -> Multipliers:
    """Multipliers of the terms that prove more of what is left, as far as ``target``."""
    limits, rate = statement.limits, price[:, None] / statement.limits.radius

    def lowest(slope: Complex) -> tuple[Real, Complex]:
        of_webs, u = places.lowest(places.slopes(slope), rate)
        return np.sum(of_webs, axis=-1), u

    charge = price * limits.max_total_mass if np.isfinite(limits.max_total_mass) else np.zeros_like(price)
    return uphill_by(statement, multipliers, charge, lowest, target)
