"""Of the sets that can be chosen and keep the ceilings the lightest, with a certified gap."""

from dataclasses import dataclass, replace

import numpy as np

from optimizer.choices.construction import feasible_set
from optimizer.choices.feasible_set import Choice, SearchResult, Subproblem
from optimizer.formulation.demand import demand
from optimizer.formulation.goals import cone_program
from optimizer.formulation.simulation import Prepared
from optimizer.numerics.arrays import Real
from optimizer.program.cuts.dominance import Group
from optimizer.program.cuts.optimum import METHOD, Unkept, over_turn
from optimizer.program.cuts.semi_infinite import Goal
from optimizer.program.limits import Limits
from optimizer.program.methods.implied_bounds import within_reach
from optimizer.program.methods.optima import optima
from optimizer.program.norms import Norms
from optimizer.program.reference.solver import Solver
from optimizer.program.rows import total_mass
from optimizer.program.statement import Names, Statement, Term
from optimizer.solve.cutting_plane_rounds import in_rounds
from optimizer.solve.search_claims import ended, told_ample
from optimizer.solve.uncertain_program import Robust
from schemas.request.requests import OptimizeRequest

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


def certified_light(request: OptimizeRequest, scene: Prepared, solver: Solver) -> Lightest:
    """The lightest set that can be chosen and keeps the ceilings, of the first order or over the turn.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told.
    """
    return (_over_turn if request.objective.over_the_turn else _of_first_order)(request, scene, solver)


def _of_first_order(request: OptimizeRequest, scene: Prepared, solver: Solver) -> Lightest:
    square = np.array([scene.omega_squared])
    program = within_reach(cone_program(request.machine, request.objective, scene.responses, square), solver)
    weighed = _weighed(program.chosen(0))
    choices = feasible_set(request, weighed.limits, solver)
    assert choices is not None  # else there would be nothing to search
    best = optima(weighed.alone(), _SHARP, False, solver)
    if best.unreachable[0]:
        return _none(weighed.limits, str(best.method[0]))
    least, wanted = float(best.lower_bound[0]), demand(request)
    size = max(float(best.objective[0]), least)
    subproblem = Subproblem(weighed, best.unbalance[:1], least, wanted.relative_gap, size, wanted.time_limit_s)
    choice = choices.best(subproblem)
    bound, reason = max(least, choice.found.lower_bound), ended(choice.found)
    return _lightest(choice, choice.found, bound, wanted.relative_gap, reason)


def _weighed(program: Statement) -> Statement:
    """The program that makes the total mass small under the same ceilings and limits: a term for each web, kg."""
    webs = program.limits.radius.size
    return replace(
        program,
        norms=Norms(np.zeros(webs, complex), np.diag(1.0 / program.limits.radius)),
        row=np.zeros(webs, int),
        group=np.zeros(1, int),
        floor=np.zeros(1),
        names=Names((Term("mass", "co"),) * webs, ("mass",)),
    )


def _over_turn(request: OptimizeRequest, scene: Prepared, solver: Solver) -> Lightest:
    gap = request.accuracy.relative_gap
    robust = Robust(request, scene, demand(request))
    program = robust.asked().program
    weighed = program.changed(goals=(Goal("mass", (Group((total_mass(program.limits),)),)),))
    best = over_turn(weighed, _SHARP, False, robust.left_s)
    if isinstance(best, Unkept):
        return _none(program.limits, METHOD)
    size = max(best.point.mass, best.proof.bound) or 1.0
    choices = feasible_set(request, best.limits, solver)
    assert choices is not None  # else there would be nothing to search
    choice, found = in_rounds(weighed, best, choices, gap, size, lambda: robust.left_s)
    reason = told_ample(ended(found), found, best.proof.bound)
    return _lightest(choice, found, found.lower_bound, gap, reason)


def _none(limits: Limits, method: str) -> Lightest:
    """Where no counterweights of any mass keep the ceilings."""
    nothing = np.zeros(limits.radius.shape)
    return Lightest(nothing, nothing, np.inf, "infeasible", ended(None), 0, method)


def _lightest(choice: Choice, found: SearchResult, bound: float, gap: float, reason: str) -> Lightest:
    """What may be said of a choice.

    Parameters
    ----------
    bound : kg, proven of all choices.
    gap : relative, that is wanted.
    """
    value = float(np.sum(choice.mass))
    status = "optimal" if found.kept and value - bound <= gap * value else "inaccurate"
    if not found.kept and bound == np.inf:
        status = "infeasible"
    return Lightest(choice.mass, choice.angle, bound, status, reason, found.nodes, found.method)
