"""What a limit costs: how much the smallest objective falls per unit by which a limit is raised.

The lower bound of the certificate is a function of the limits too, and a lower bound for all of them. At the optimum
it touches the smallest objective, so its slope is the shadow price (Boyd and Vandenberghe, Convex Optimization, 5.6).
Where several sets of multipliers prove the same optimum the prices to either side differ; each lies between them.
"""

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers
from optimizer.program.statement import Statement


@record(frozen=True)
class ShadowPrices:
    """Fall of the smallest objective per unit of each limit, >= 0; 0 where a limit does not hold it up."""

    max_mass: Real  # (..., K) per kg
    half_angle: Real  # (..., K) per rad
    max_total_mass: Real  # (...) per kg
    ceiling: Real  # (..., I) per unit of response


def shadow_prices(
    statement: Statement, u: Complex, multipliers: Multipliers, budget: Real | None = None
) -> ShadowPrices:
    """Prices of all limits, from the multipliers of the lower bound.

    Parameters
    ----------
    u : (..., K) kg m, an optimum.
    multipliers : admissible, with rows of sum 1.
    budget : (...) price of the budget where a closer one exists: of plates by the pieces in their place.
    """
    limits, ceilings = statement.limits, statement.ceilings
    norms = statement.norms
    influence = np.conj(norms.influence) if norms.is_complex else norms.influence
    slope = np.add.reduce(influence * multipliers.term[..., :, None], axis=-2)
    if ceilings.names:
        slope = slope + np.add.reduce(np.conj(ceilings.norms.influence) * multipliers.ceiling[..., :, None], axis=-2)
    # what a kilogram on a web is worth. The budget is spent in falling order of it. It costs what the last one is worth
    # that it does not pay in full (docs/mathematics.md section 5)
    support = limits.support(-slope)
    worth = support
    if budget is None and not np.count_nonzero(limits.budget_ends):
        budget = np.zeros(limits.budget_ends.shape)
    else:
        budget = limits.spent(limits.margin * support)[1] if budget is None else budget
        worth = support - budget[..., None] / limits.margin
    return ShadowPrices(
        max_mass=np.maximum(limits.radius * worth, 0.0),
        half_angle=np.zeros(u.shape) if limits.all_free else np.abs(u) * limits.opening(-slope),
        max_total_mass=budget,
        ceiling=np.abs(multipliers.ceiling),
    )
