"""One program as a batch of one: where the interior point ended, and whether that is enough."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.program.kernel.finer_numbers import Precision
from optimizer.program.methods.compiled import MASS_ENOUGH, BothStages, both_stages, suits_kernel
from optimizer.program.multipliers import resting_multipliers
from optimizer.program.reference.solver import proven
from optimizer.program.solution import INTERIOR_POINT, Solution, evaluated
from optimizer.program.statement import Statement


class Asked(NamedTuple):
    """What is asked of a program."""

    share: float  # how far above the smallest objective an optimum may be, in units of the objective
    demand: float  # certified gap
    least_mass: bool


class Found(NamedTuple):
    """The ends of both stages."""

    smallest: Solution
    lightest: Solution
    certified: bool


def interior_point(
    statement: Statement, asked: Asked, precision: Precision | None = None, inside: Complex | None = None
) -> Found:
    """What the interior point finds, compiled or in finer numbers; rest, where the program is none for it.

    Parameters
    ----------
    inside : a point that keeps the ceilings, or nearly so.
    """
    radius = statement.limits.radius
    if radius.size == 0 or not suits_kernel(statement):
        resting = evaluated(statement, np.zeros(radius.shape, complex))
        resting = proven(statement, resting, resting_multipliers(statement))
        return Found(resting, resting, False)
    share, demand = np.array([asked.share]), np.array([asked.demand])
    at_least = 0.0 if inside is None else float(statement.objective(inside))
    found = both_stages(statement.alone(), share, demand, asked.least_mass, precision, at_least)
    return only(statement, asked, found, precision.name if precision else INTERIOR_POINT)


def only(statement: Statement, asked: Asked, found: BothStages, method: str = INTERIOR_POINT) -> Found:
    """The only answer of a leading axis (1,)."""
    nothing = Solution(
        found.smallest[0],
        np.inf,
        float(found.lower_bound[0]),
        np.inf,
        0.0,
        np.inf,
        method,
        float(found.certify_s[0]),
        found.multipliers.chosen(0),
    )
    smallest = nothing.moved_to(statement, found.smallest[0])
    lightest = smallest
    if asked.least_mass:
        lightest = replace(
            smallest,
            # what exceeds the ceilings has an objective below the smallest: too few would count as optima
            mass_lower_bound=float(found.mass_lower_bound[0]) if smallest.below_ceilings else 0.0,
            mass_multipliers=found.mass_multipliers.chosen(0),
            mass_target=float(found.mass_target[0]),
        )
    return Found(smallest, lightest.moved_to(statement, found.unbalance[0]), bool(found.certified[0]))


def enough(found: Solution, asked: Asked) -> bool:
    """Whether finer numbers are not worth their time."""
    optimal = found.below_ceilings and found.gap <= asked.share
    return optimal and (not asked.least_mass or light(found))


def light(found: Solution) -> bool:
    """Whether the mass is proven as well as is worth any time."""
    return found.mass - found.mass_lower_bound <= MASS_ENOUGH * found.mass
