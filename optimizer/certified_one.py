"""Certified counterweights of one request of the first order, however they may be chosen."""

from collections.abc import Sequence

from optimizer.arrays import Real
from optimizer.certified import Certified
from optimizer.certified_discrete import certified_discrete
from optimizer.certified_fitted import certified_fitted
from optimizer.certified_shapes import certified_shapes
from optimizer.program.reference.solver import Solver
from optimizer.response import Response
from schemas.requests import OptimizeRequest


def certified_one(
    request: OptimizeRequest, responses: Sequence[Response], omega_squared: Real, solver: Solver
) -> tuple[OptimizeRequest, Certified]:
    """Chosen from a catalogue, at least so heavy, cut from plates, or of any mass; and the request with the radii.

    Parameters
    ----------
    omega_squared : (1,) rad^2/s^2.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    """
    if request.machine.discrete:
        return request, certified_discrete(request, responses, omega_squared, solver)
    if request.machine.semicontinuous:
        return request, certified_fitted(request, responses, omega_squared, solver)
    # of what is cut from a plate the radius follows
    return certified_shapes(request, responses, omega_squared, solver)
