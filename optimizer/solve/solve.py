"""Certified counterweights of one request, whatever it asks for and however they may be chosen."""

from optimizer.formulation.simulation import Prepared
from optimizer.program.reference.solver import Solver
from optimizer.solve.choice import best_choice
from optimizer.solve.solution import Infeasible, Solution
from optimizer.solve.worst_case import best_of_any_mass
from schemas.request.requests import OptimizeRequest


def solve(request: OptimizeRequest, scene: Prepared, solver: Solver, in_full: bool = True) -> Solution | Infeasible:
    """The best counterweights, in the worst of all cases where there are several.

    Parameters
    ----------
    in_full : with prices of the limits and what misplaced counterweights may cost.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    MissingInput
        if a machine lacks what the objective needs.
    """
    of_choices = request.machine.discrete or request.machine.semicontinuous
    return (best_choice if of_choices else best_of_any_mass)(request, scene, solver, in_full)
