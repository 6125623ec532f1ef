"""Of the sets that can be chosen and keep the ceilings the lightest, with a certified gap."""

from dataclasses import dataclass

import numpy as np

from optimizer.choices.construction import feasible_set
from optimizer.choices.feasible_set import Choice, SearchResult
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.numerics.arrays import Real
from optimizer.program.cuts.dominance import Group
from optimizer.program.cuts.optimum import Unkept
from optimizer.program.cuts.semi_infinite import Goal
from optimizer.program.limits import Limits
from optimizer.program.optimum import optimum
from optimizer.program.reference.solver import Solver
from optimizer.program.rows import total_mass
from optimizer.solve.cutting_plane_rounds import in_rounds
from optimizer.solve.statuses import ample_reason, ended
from optimizer.solve.uncertain_program import Robust

#: gap of the least mass of any masses at any angles, which the search begins with
_SHARP = 1e-6


@dataclass(frozen=True)
class Lightest:
    """The lightest set that was found, and what is proven; of those that keep the ceilings."""

    mass_kg: Real  # (K,), those that are chosen
    angle_deg: Real  # (K,)
    lower_bound: float  # kg, inf where it is proven that none keeps the ceilings
    status: str
    reason: str
    nodes: int
    method: str


def minimum_mass(task: Task, scene: Prepared, solver: Solver) -> Lightest:
    """The lightest set that can be chosen and keeps the ceilings, of the first order or over the turn.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told.
    """
    gap, robust = task.relative_gap, Robust(task, scene, task.demand)
    program = robust.goals().program
    weighed = program.changed(goals=(Goal("mass", (Group((total_mass(program.limits),)),)),))
    best = optimum(weighed, _SHARP, False, solver, robust.left_s)
    if isinstance(best, Unkept):
        return _none(program.limits, best.method)
    size = max(best.point.mass, best.proof.bound) or 1.0
    choices = feasible_set(task, best.limits, solver)
    choice, result = in_rounds(weighed, best, choices, gap, size, lambda: robust.left_s)
    reason = ample_reason(ended(result), result, best.proof.bound)
    return _lightest(choice, result, result.lower_bound, gap, reason)


def _none(limits: Limits, method: str) -> Lightest:
    """Where no counterweights of any mass keep the ceilings."""
    nothing = np.zeros(limits.radius.shape)
    return Lightest(nothing, nothing, np.inf, "infeasible", ended(None), 0, method)


def _lightest(choice: Choice, result: SearchResult, bound: float, gap: float, reason: str) -> Lightest:
    """What may be said of a choice.

    Parameters
    ----------
    bound : kg, proven of all choices.
    gap : relative, that is wanted.
    """
    value = float(np.sum(choice.mass))
    status = "optimal" if result.feasible and value - bound <= gap * value else "inaccurate"
    if not result.feasible and bound == np.inf:
        status = "infeasible"
    return Lightest(choice.mass, choice.angle, bound, status, reason, result.nodes, result.method)
