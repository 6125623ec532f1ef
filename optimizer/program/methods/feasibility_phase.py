"""On the edge of what can be reached: whether ceilings can be kept, and with how much room."""

from contextlib import suppress
from dataclasses import replace

import numpy as np

from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.certificate import (
    ceiling_allowance,
    mass_lower_bound,
    nothing_proven,
    objective_lower_bound,
)
from optimizer.program.kernel.finer_numbers import EXTENDED, OutOfTime
from optimizer.program.methods.compiled import StageSolutions, stage_solutions
from optimizer.program.methods.single import Target, interior_point
from optimizer.program.reference.solver import smallest_objective
from optimizer.program.solution import CEILING_ROUNDING, ConeSolution
from optimizer.program.statement import Statement

#: room below the ceilings, as a share of their size, from which on they are kept as they are
AMPLE = 1e-8
#: by which they are raised otherwise: what is left of their tolerance is for rounding
_RAISED = CEILING_TOLERANCE - CEILING_ROUNDING
#: gap of the smallest excess that is good enough
_PRINTED = 1e-13


def smallest_excess(statement: Statement, until: float = np.inf) -> ConeSolution:
    """The smallest largest excess over the ceilings, closely enough for its sign and the room below them.

    Parameters
    ----------
    until : time.thread_time() after which the methods that have begun are the last.
    """
    program = statement.excess()
    target = Target(CEILING_TOLERANCE, CEILING_TOLERANCE, False, until)
    solution = interior_point(program, target).smallest
    if not _tells(solution) and statement.limits.radius.size <= EXTENDED.most_webs:
        # sharper than the reference solver, and less work than its tries
        with suppress(OutOfTime):
            finer = interior_point(program, target, EXTENDED).smallest
            better, worse = (finer, solution) if finer.objective < solution.objective else (solution, finer)
            solution = better.bounded(worse.lower_bound, worse.multipliers)
    if _tells(solution):
        return solution
    return smallest_objective(program, _PRINTED, solution, lambda best: _tells(best) or target.late)


def smallest_excesses(statement: Statement) -> StageSolutions:
    """The same of many programs at once, as far as the compiled interior point goes."""
    program, tolerance = statement.excess(), np.full(statement.floor.shape[:-1], CEILING_TOLERANCE)
    return stage_solutions(program, tolerance, tolerance, False)


def _tells(excess: ConeSolution) -> bool:
    return excess.lower_bound > CEILING_ROUNDING or excess.objective <= -AMPLE or excess.gap <= _PRINTED


def at_rest(statement: Statement, target: Target, solution: ConeSolution) -> ConeSolution | None:
    """No counterweights, where they are an optimum but for the tolerance of the ceilings: nothing is lighter."""
    rest = solution.with_point(statement, np.zeros_like(solution.unbalance))
    if not rest.keeps_ceilings or rest.below_ceilings:
        return None
    rest = replace(rest, mass_lower_bound=0.0, mass_multipliers=nothing_proven(statement))
    rest = replace(rest, mass_target=rest.objective + target.share)
    allowance = ceiling_allowance(statement, solution.multipliers, statement.ceilings.excess(rest.unbalance))
    return rest if rest.gap + float(allowance) <= target.share else None


def raised(statement: Statement) -> Statement:
    """The program with the ceilings raised by the tolerance that they have: there is always room below them."""
    return replace(statement, ceilings=statement.ceilings.raised(_RAISED))


def proven_again(statement: Statement, solution: ConeSolution) -> ConeSolution:
    """The same point with its bounds, both for the ceilings of the program."""
    solution = solution.with_point(statement, solution.unbalance)
    solution = replace(solution, lower_bound=float(objective_lower_bound(statement, solution.multipliers)))
    if solution.mass_multipliers is not None:
        target = np.asarray(solution.mass_target)
        solution = replace(
            solution, mass_lower_bound=float(mass_lower_bound(statement, solution.mass_multipliers, target))
        )
    return solution
