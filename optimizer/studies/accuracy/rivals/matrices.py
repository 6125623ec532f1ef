"""The exact cone program as matrices, without a modelling layer, and what the programs of the ladder share."""

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers
from optimizer.program.reference.assembled import Assembly, NoPoint, dense, solved
from optimizer.program.scaled_program import ScaledData, ScaledSolution
from optimizer.program.scaling import Scaling, natural_reach, scale
from optimizer.program.statement import Statement

#: limits beyond this multiple of the natural reach cannot bind
_REACH = 10.0


@record(frozen=True)
class RivalPoint:
    """What a program found, unjudged: the certificate decides what it is worth."""

    unbalance: Complex  # (K,) kg m, within the limits
    multipliers: Multipliers
    claimed: float | None  # objective that the program itself sees, where it shows it


def scaled(statement: Statement, ceiling_margin: float, outline: Statement | None = None) -> tuple[ScaledData, Scaling]:
    """The scaled first stage of a statement, as the reference solver poses it in its first attempt.

    Parameters
    ----------
    ceiling_margin : share of their size by which ceilings are lowered.
    outline : with fewer rows, that stands for a large statement where its natural reach is sought.
    """
    natural = float(natural_reach(statement if outline is None else outline))
    clip = min(_REACH * natural, float(np.max(statement.limits.reach)))
    return scale(statement, "objective", clip, ceiling_margin)


def add_rows(program: Assembly, statement: Statement, data: ScaledData, norms: int, value: int) -> slice:
    """Rows value >= floor + sum of the norms of the row, from the columns of norms and value."""
    above = np.ones((data.floor.size, 1))
    return program.nonnegative(-data.floor, dense(norms, -statement.membership), dense(value, above))


def point(
    statement: Statement, scaling: Scaling, v: Real, claimed: float, row: Real, term: Complex, ceiling: Complex
) -> RivalPoint:
    """Scaled variables and multipliers in physical units; the point is brought into the limits.

    Parameters
    ----------
    claimed : objective that the program sees, scaled.
    """
    webs = scaling.reach.size
    result = ScaledSolution(v[:webs], v[webs : 2 * webs], row, term, ceiling, "")
    unbalance = statement.limits.into(scaling.unbalance(statement, result))
    return RivalPoint(unbalance, scaling.multipliers(statement, result), claimed * scaling.objective)


def exact(statement: Statement, tolerance: float, time_limit_s: float) -> RivalPoint | NoPoint:
    """The exact cone program of :class:`optimizer.program.reference.modelling.ConeProgram`, first stage, as matrices.

    Parameters
    ----------
    tolerance : of the solver; ceilings are lowered by the same share.
    """
    data, scaling = scaled(statement, tolerance)
    result = solved(data, tolerance, time_limit_s)
    if isinstance(result, NoPoint):
        return result
    claimed = float(np.sum(result.level) + np.sum(statement.largest(statement.floor)) / scaling.objective)
    unbalance = statement.limits.into(scaling.unbalance(statement, result.solution))
    return RivalPoint(unbalance, scaling.multipliers(statement, result.solution), claimed * scaling.objective)
