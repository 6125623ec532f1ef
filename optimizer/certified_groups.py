"""Certified counterweights of many designs whose webs get identical castings; nothing else is chosen differently."""

from collections.abc import Sequence
from dataclasses import replace

from optimizer.arrays import Real
from optimizer.certified import Certified, certified, judged
from optimizer.formulate import formulate
from optimizer.groups import units
from optimizer.program.optima import optima
from optimizer.program.reach import within_reach
from optimizer.program.reference.solver import Solver
from optimizer.program.symmetry import symmetric
from optimizer.response import Response
from schemas.requests import OptimizeRequest


def certified_groups(
    request: OptimizeRequest, responses: Sequence[Response], omega_squared: Real, solver: Solver
) -> Certified:
    """Counterweights of one request, alike within every group.

    Values are those of the webs, bounds those of the program whose unknowns are the groups.

    Parameters
    ----------
    omega_squared : (1,) rad^2/s^2.

    Raises
    ------
    OutOfRange
        where webs of a group are not alike.
    """
    if not request.machine.web_groups:
        return certified(request, responses, omega_squared, solver)
    goal, known = request.objective, units(request.machine)
    whole = formulate(request.machine, goal, responses, omega_squared)
    program = within_reach(known.united(whole), solver)
    found = optima(program, request.accuracy.relative_gap, goal.least_mass, solver)
    if goal.symmetric:
        found = replace(found, unbalance=symmetric(program, found.unbalance))
    webs = replace(whole, limits=known.limits_apart(program.limits, whole.limits))
    told = judged(request, webs, replace(found, unbalance=known.apart(found.unbalance)), omega_squared, known.alike)
    return replace(told, proven=program)
