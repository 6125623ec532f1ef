"""What is often all that is missing: points below the ceilings, sharper multipliers, finer units of mass."""

import time
from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.program.certificate import mass_lower_bound, objective_lower_bound
from optimizer.program.kernel.finer_numbers import FIFTY_DIGITS, Precision
from optimizer.program.methods.compiled import ENOUGH, ENOUGH_FOR_MASS
from optimizer.program.methods.single import StagePair, Target, interior_point, light
from optimizer.program.methods.stage_ends import pulled
from optimizer.program.multipliers import mass_multipliers, objective_multipliers, supporting_multipliers
from optimizer.program.solution import ConeSolution
from optimizer.program.statement import Statement

#: how often the least mass is sought again in units of the least so far, and what a web may carry of it then
_LIGHTENINGS, _ROOM_FOR_MASS = 8, 4.0
#: and the share of a limit below which that is another program, in so many digits that few units are too coarse too
_WORTH_LESS, _WORTH_LESS_IN_FIFTY = 0.1, 1e-3


def polished(statement: Statement, target: Target, stages: StagePair, inside: Complex | None) -> StagePair:
    """The same with points below the ceilings and sharper multipliers, which is often all that is missing."""
    if statement.limits.radius.size == 0 or stages.certified:
        return stages
    began = time.perf_counter()
    smallest, lightest = (_pulled(statement, solution, inside) for solution in (stages.smallest, stages.lightest))
    for multipliers in objective_multipliers(statement, smallest.unbalance, smallest.multipliers):
        bound = float(objective_lower_bound(statement, multipliers))
        smallest, lightest = smallest.bounded(bound, multipliers), lightest.bounded(bound, multipliers)
    if target.least_mass and smallest.below_ceilings:
        # a point that exceeds the ceilings by rounding is below what is proven of those that keep them
        level = np.asarray(max(smallest.objective, smallest.lower_bound) + target.share)
        candidates = list(supporting_multipliers(statement, lightest.unbalance))
        if lightest.mass_multipliers is not None:
            candidates += mass_multipliers(statement, lightest.unbalance, lightest.mass_multipliers)
        for multipliers in candidates:
            bound = float(mass_lower_bound(statement, multipliers, level))
            lightest = lightest.weighed(bound, multipliers, float(level))
    enough = (ENOUGH_FOR_MASS if target.least_mass else ENOUGH) * target.share
    certified = smallest.gap <= enough and lightest.below_ceilings and lightest.gap <= target.share
    certified &= not target.least_mass or light(lightest)
    spent = time.perf_counter() - began
    smallest, lightest = (replace(solution, certify_s=solution.certify_s + spent) for solution in (smallest, lightest))
    return StagePair(smallest, lightest, certified)


def lightened(statement: Statement, target: Target, stages: StagePair, precision: Precision | None = None) -> StagePair:
    """The least mass again, in units of the least so far: where next to nothing has to be fitted, all else is far away.

    No web carries more than all of them together in anything lighter.
    """
    if stages.certified or not target.least_mass or statement.limits.radius.size == 0:
        return stages
    worth_less = _WORTH_LESS_IN_FIFTY if precision is FIFTY_DIGITS else _WORTH_LESS
    for _ in range(_LIGHTENINGS):
        before = stages.lightest
        if not (before.below_ceilings and before.gap <= target.share) or light(before):
            break
        limits = statement.limits
        if not np.any(_ROOM_FOR_MASS * before.mass < worth_less * np.minimum(limits.max_mass, limits.max_total_mass)):
            break
        near = replace(limits, max_mass=np.minimum(limits.max_mass, _ROOM_FOR_MASS * before.mass))
        again = interior_point(replace(statement, limits=near), target, precision).lightest
        if again.below_ceilings and again.objective <= before.lower_bound + target.share and again.mass < before.mass:
            lightest = before.with_point(statement, again.unbalance)
        else:
            lightest = before
        lightest = replace(lightest, mass_multipliers=again.mass_multipliers, mass_lower_bound=0.0)
        sharper = polished(statement, target, StagePair(stages.smallest, lightest, False), None)
        weighed = sharper.lightest.weighed(before.mass_lower_bound, before.mass_multipliers, before.mass_target)
        stages = StagePair(sharper.smallest, weighed, sharper.certified)
        if stages.certified or weighed.mass > 0.5 * before.mass:
            break
    return stages


def _pulled(statement: Statement, solution: ConeSolution, inside: Complex | None) -> ConeSolution:
    """A point above a ceiling, moved towards one below it just so far; excesses are convex."""
    if inside is None or solution.below_ceilings:
        return solution
    return solution.with_point(statement, pulled(statement, solution.unbalance, inside))
