"""Programs of nodes, side by side in the batch kernel; where webs are alike and it does not take that, one by one."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.certificate import Multipliers, nothing_proven
from optimizer.program.equal_castings import Alike
from optimizer.program.equal_unknowns import apart, united
from optimizer.program.methods.cascade import cascade
from optimizer.program.methods.compiled import stage_solutions, suits_kernel
from optimizer.program.methods.single import Target, interior_point
from optimizer.program.statement import Statement

#: of an objective at rest: any closer takes a cone program many attempts, and bounds are made of multipliers anyway
_CLOSE = 1e-7


class Relaxations(NamedTuple):
    """Points of N programs with their bounds."""

    unbalance: Complex  # (N, K) kg m
    multipliers: Multipliers  # (N, ...), of their bounds
    nowhere: np.ndarray  # (N,) bool: proven that nothing keeps their ceilings


def solved(
    program: Statement, alike: Alike | None, share: Real, gap: Real, least_mass: bool, clock: Clock | None = None
) -> Relaxations:
    """Optima of N programs whose webs are alike.

    Parameters
    ----------
    share, gap : (N,) how far above the smallest objective an optimum may be, and the target gap.
    least_mass : the lightest of the optima, in place of any.
    clock : ends what is done one by one; of programs after that the point is 0, and nothing is proven.
    """
    nowhere = np.zeros(gap.shape, bool)
    whole = program if alike is None else united(program, alike) if alike.plain else None
    if whole is not None and suits_kernel(whole):
        result = stage_solutions(whole, share, gap, least_mass)
        u = result.unbalance if least_mass else result.smallest
        return Relaxations(np.nan_to_num(u if alike is None else apart(u, alike)), result.multipliers, nowhere)
    points, multipliers = np.zeros(program.limits.radius.shape, complex), nothing_proven(program)
    for n in range(len(points)):
        if clock is not None and clock.spent():
            break
        statement = program.subset(n)
        statement = replace(statement, limits=replace(statement.limits, alike=alike))
        near = max(float(share[n]), _CLOSE * float(statement.at_rest))
        target = Target(near, max(float(gap[n]), near), least_mass, np.inf if clock is None else clock.until)
        answer = cascade(statement, target, interior_point(statement, target))
        points[n] = answer.unbalance
        if answer.conflict is None:
            multipliers.put(n, answer.multipliers)
        else:
            nowhere[n] = answer.excess > CEILING_TOLERANCE
    return Relaxations(points, multipliers, nowhere)
