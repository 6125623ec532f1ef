"""A finite reach for webs without a limit whose counterweights have a least mass where they are fitted, proven.

Of all points with the same responses take the lightest. Of its webs without a limit some carry nothing or their least.
Those that carry more could carry a little less. So together they are no heavier than the lightest that changes the
responses as they do, whatever the least masses. What they change is bounded by what the responses may come to and what
the least masses of the others do (docs/mathematics.md section 5).
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain, combinations

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.program.limits import Limits
from optimizer.program.methods.implied_bounds import LARGEST, carrying_mass, far_limits, level_above, responses
from optimizer.program.statement import Statement

#: what masses are raised by for their rounding
_MARGIN = 1.0 + 1e-9
#: webs with sectors of which every subset is looked at
_FEW = 4


def within_semicontinuous_reach(statement: Statement, least: Real, level: float | None = None) -> Statement:
    """One program with finite limits; some best choice, and the lightest of equal ones, is within them.

    Parameters
    ----------
    least : (K,) kg, of what is fitted; 0 where there is none.
    level : value of the objective at some choice within the ceilings, or more; inf without such a choice.
        By default its value without counterweights, if these ceilings allow that.
    """
    limits, far = statement.limits, far_limits(statement)
    if not far.any():
        return statement
    if level is None:
        nothing = np.zeros(far.shape, complex)
        feasibility = bool(np.all(statement.ceilings.excess(nothing) <= 0))
        level = float(level_above(statement, nothing)) if feasibility else np.inf
    while far.any():
        mass = np.minimum(np.maximum(_mass(statement, far, least, level), least), limits.max_total_mass)
        near = far & (limits.max_mass < mass)
        if not near.any():
            return replace(statement, limits=replace(limits, max_mass=np.where(far, mass, limits.max_mass)))
        far = far & ~near
    return statement


def _mass(statement: Statement, far: np.ndarray, least: Real, level: float) -> float:
    """What far webs that carry more than their least weigh together, kg."""
    limits = statement.limits.only(far)
    if limits.alike is not None or statement.norms.scatter or statement.ceilings.norms.scatter:
        return LARGEST
    (every,) = responses(statement.alone(), far, np.array([level]))
    if not every.most.size:
        return 0.0
    influence, scalar = every.influence[0] * limits.radius, every.scalar
    most = every.most[0] + np.abs(influence) @ least[far]
    masses = (_subset_mass(influence, limits, list(webs), most, scalar) for webs in _subsets(influence, limits, scalar))
    mass = _MARGIN * max(masses, default=np.inf)
    return mass if np.isfinite(mass) else LARGEST


def _subset_mass(influence: Real, limits: Limits, webs: list[int], most: Real, scalar: np.ndarray) -> float:
    """Mass with which some webs carry whatever they can with |c_s| <= most_s, kg."""
    if len(webs) == 1 and not np.any(scalar):
        does = np.abs(influence[:, webs[0]])
        return float(np.min(most[does > 0] / does[does > 0]))
    if not np.any(most):
        return 0.0
    part = limits.only(np.isin(np.arange(limits.radius.size), webs)).mapped(lambda array: array[None])
    return float(carrying_mass(influence[None, :, webs], part, most[None], scalar)[0])


def _subsets(influence: Real, limits: Limits, scalar: np.ndarray) -> Iterator[tuple[int, ...]]:
    """Sets of webs of which every other set, where it changes anything, holds one that changes all that it does.

    None where these would be too many.
    """
    webs = np.flatnonzero(np.any(influence != 0, axis=0)).tolist()
    if np.all(limits.free) and len(influence) <= 2 and not np.any(scalar):
        plane = (influence / limits.radius).T
        apart = [pair for pair in combinations(webs, 2) if np.any(plane[pair[0]] != plane[pair[1]])]
        return chain(((web,) for web in webs), apart if len(influence) == 2 else ())
    if len(webs) > _FEW:
        return iter(())
    return chain.from_iterable(combinations(webs, size + 1) for size in range(len(webs)))
