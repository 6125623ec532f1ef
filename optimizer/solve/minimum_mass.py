"""The lightest of all sets that keep the ceilings, with a certified gap."""

import numpy as np

from optimizer.choices.construction import feasible_set, takes_options
from optimizer.choices.feasible_set import Choice, SearchResult
from optimizer.formulation.balance_shafts import in_drawing
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.mechanics.fixed_weights import fixed_masses
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from optimizer.program.cuts.dominance import Group
from optimizer.program.cuts.optimum import Conflict
from optimizer.program.cuts.semi_infinite import Goal
from optimizer.program.optimum import optimum
from optimizer.program.rows import total_mass
from optimizer.program.verdict import CONTRADICTED
from optimizer.solve.cutting_plane_rounds import in_rounds
from optimizer.solve.statuses import ample_reason, ended
from optimizer.solve.uncertain_program import Robust
from schemas.machine.machine import Machine

#: of a mass, relative: by which sums of masses are rounded
_ROUNDING = 1e-12
#: the same where some have any mass: what keeps a ceiling to its tolerance may be lighter than all that keep it
_SLACK = 1e-7
#: gap of the least mass of any masses at any angles, which the search begins with
_SHARP = 1e-6


@record(frozen=True)
class BestSet:
    """The best of all sets, by its objective or its mass, and what is proven of all."""

    mass_kg: Real  # (K + S,) as drawn, with the weights that are fixed, those on balance shafts behind the others
    angle_deg: Real  # (K + S,)
    value: float
    lower_bound: float  # nan where nothing is proven, inf where it is proven that none keeps the ceilings
    relative_gap: float  # nan where nothing is proven
    status: str
    reason: str
    nodes: int
    method: str


def none_of(machine: Machine, status: str, reason: str, nodes: int, method: str) -> BestSet:
    """Nothing on any web, where there is no set to show."""
    nothing = np.zeros(len(machine.every_web))
    return BestSet(nothing, nothing, np.nan, np.nan, np.nan, status, reason, nodes, method)


def minimum_mass(task: Task, scene: Prepared) -> BestSet:
    """The lightest of all sets that keep the ceilings, of the first order or over the turn.

    Raises
    ------
    OutOfRange
        where the options of a web are not determined.
    """
    gap, robust = task.relative_gap, Robust(task, scene, task.demand)
    program = robust.goals().anywhere
    weighed = program.changed(goals=(Goal("mass", (Group((total_mass(program.limits, *program.scatter),)),)),))
    best = optimum(weighed, _SHARP, False, robust.left_s)
    if isinstance(best, Conflict):
        return none_of(task.machine, "infeasible", ended(None), 0, best.method)
    size = max(best.point.mass, best.proof.bound) or 1.0
    choices = feasible_set(task, best.limits)
    choice, result = in_rounds(weighed, best, choices, gap, size, lambda: robust.left_s)
    reason = ample_reason(ended(result), result, best.proof.bound)
    return _of_choice(task, choice, result, gap, reason)


def _of_choice(task: Task, choice: Choice, result: SearchResult, gap: float, reason: str) -> BestSet:
    """What may be said of a choice.

    Parameters
    ----------
    gap : relative target gap.
    """
    lightest, bound = float(np.sum(choice.mass)), result.lower_bound
    status = "optimal" if result.feasible and lightest - bound <= gap * lightest else "inaccurate"
    if not result.feasible and bound == np.inf:
        status = "infeasible"
    mass, angle = in_drawing(task.machine, task.objective, choice.mass, choice.angle)
    value, fixed = float(np.sum(mass)), float(np.sum(fixed_masses(task.machine)))
    bound = bound + fixed
    if np.isfinite(bound) and bound > value * (1.0 + (_ROUNDING if np.all(takes_options(task)) else _SLACK)):
        bound, status, reason = np.nan, "inaccurate", CONTRADICTED
    bound = min(bound, value)
    of_value = (value - bound) / value if value > 0 else 0.0
    return BestSet(mass, angle, value, bound, of_value, status, reason, result.nodes, result.method)
