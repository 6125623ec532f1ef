"""One program as a batch of one: where the interior point ended, and whether that is enough."""

import time
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.program.kernel.finer_numbers import Precision
from optimizer.program.methods.compiled import MASS_ENOUGH, StageSolutions, stage_solutions, suits_kernel
from optimizer.program.multipliers import resting_multipliers
from optimizer.program.reference.solver import proven
from optimizer.program.solution import INTERIOR_POINT, ConeSolution, evaluated
from optimizer.program.statement import Statement


class Target(NamedTuple):
    """How close to its optimum a program is to be solved."""

    share: float  # how far above the smallest objective an optimum may be, in units of the objective
    demand: float  # certified gap
    least_mass: bool
    until: float = np.inf  # time.thread_time() after which no further method begins

    @property
    def late(self) -> bool:
        """Whether what has been found has to do."""
        return time.thread_time() >= self.until


class StagePair(NamedTuple):
    """The ends of both stages."""

    smallest: ConeSolution
    lightest: ConeSolution
    certified: bool


def interior_point(
    statement: Statement, target: Target, precision: Precision | None = None, inside: Complex | None = None
) -> StagePair:
    """What the interior point finds, compiled or in finer numbers; rest, where the program is none for it.

    Parameters
    ----------
    inside : a point that keeps the ceilings, or nearly so.

    Raises
    ------
    OutOfTime
        if finer numbers take longer than there is time.
    """
    radius = statement.limits.radius
    if radius.size == 0 or not suits_kernel(statement):
        resting = evaluated(statement, np.zeros(radius.shape, complex))
        resting = proven(statement, resting, resting_multipliers(statement))
        return StagePair(resting, resting, False)
    share, demand = np.array([target.share]), np.array([target.demand])
    at_least = 0.0 if inside is None else float(statement.objective(inside))
    stages = stage_solutions(statement.alone(), share, demand, target.least_mass, precision, at_least, target.until)
    return only(statement, target, stages, precision.name if precision else INTERIOR_POINT)


def only(statement: Statement, target: Target, stages: StageSolutions, method: str = INTERIOR_POINT) -> StagePair:
    """The only answer of a leading axis (1,)."""
    nothing = ConeSolution(
        stages.smallest[0],
        np.inf,
        float(stages.lower_bound[0]),
        np.inf,
        0.0,
        np.inf,
        stages.multipliers.subset(0),
        method,
        float(stages.certify_s[0]),
    )
    smallest = nothing.with_point(statement, stages.smallest[0])
    lightest = smallest
    if target.least_mass:
        lightest = replace(
            smallest,
            # what exceeds the ceilings has an objective below the smallest: too few would count as optima
            mass_lower_bound=float(stages.mass_lower_bound[0]) if smallest.below_ceilings else 0.0,
            mass_multipliers=stages.mass_multipliers.subset(0),
            mass_target=float(stages.mass_target[0]),
        )
    return StagePair(smallest, lightest.with_point(statement, stages.unbalance[0]), bool(stages.certified[0]))


def enough(solution: ConeSolution, target: Target) -> bool:
    """Whether finer numbers are not worth their time."""
    optimal = solution.below_ceilings and solution.gap <= target.share
    return optimal and (not target.least_mass or light(solution))


def light(solution: ConeSolution) -> bool:
    """Whether the mass is proven as well as is worth any time."""
    return solution.mass - solution.mass_lower_bound <= MASS_ENOUGH * solution.mass
