"""Certified counterweights of one request, whatever it asks for and however they may be chosen."""

from optimizer.formulation.demand import by_cuts
from optimizer.formulation.simulation import Prepared
from optimizer.program.reference.solver import Solver
from optimizer.solve.choice import certified_choice
from optimizer.solve.first_order import certified_first
from optimizer.solve.outcome import Outcome
from optimizer.solve.worst_case import certified_any_mass
from schemas.request.requests import OptimizeRequest


def solve(request: OptimizeRequest, scene: Prepared, solver: Solver, in_full: bool = True) -> Outcome:
    """The first order of the machine as it is given, or the whole turn, or the worst of several cases.

    Parameters
    ----------
    in_full : over the turn, with prices of the limits and what misplaced counterweights may cost.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    MissingInput
        if a machine lacks what the objective needs.
    """
    if not by_cuts(request):
        return certified_first(request, scene, solver)
    if request.machine.discrete or request.machine.semicontinuous:
        return certified_choice(request, scene, solver, in_full)
    return certified_any_mass(request, scene, in_full)
