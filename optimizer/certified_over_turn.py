"""Certified counterweights of one request that asks for more than the first order of the machine as it is given: the
whole turn, or the worst of several cases; however they may be chosen."""

from optimizer.certified_choice import certified_choice
from optimizer.certified_robust import certified_any_mass
from optimizer.program.reference.solver import Solver
from optimizer.proven_turn import CertifiedTurn
from optimizer.scene import Prepared
from schemas.requests import OptimizeRequest


def certified_over_turn(
    request: OptimizeRequest, scene: Prepared, solver: Solver, in_full: bool = True
) -> CertifiedTurn:
    """Chosen from a catalogue, at least so heavy, or of any mass.

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
    if request.machine.discrete or request.machine.semicontinuous:
        return certified_choice(request, scene, solver, in_full)
    return certified_any_mass(request, scene, in_full)
