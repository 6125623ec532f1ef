"""Certified counterweights of one machine, chosen from what there is."""

from collections.abc import Sequence

from optimizer.arrays import Real
from optimizer.certified import Certified, certified
from optimizer.discrete.search import search
from optimizer.program.reference.solver import Solver
from optimizer.response import Response
from optimizer.searched import continuous, searched
from optimizer.stock import stock
from schemas.requests import OptimizeRequest


def certified_discrete(
    request: OptimizeRequest, responses: Sequence[Response], omega_squared: Real, solver: Solver
) -> Certified:
    """Of the sets that can be chosen the one with the smallest objective, and the lightest of equal ones.

    Ceilings that no counterweights at all keep are proven out of reach without a search.

    Parameters
    ----------
    omega_squared : (1,) rad^2/s^2.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told.
    """
    held = stock(request.machine)
    best = certified(continuous(request), responses, omega_squared, solver)
    if best.found.unreachable[0]:
        return best
    statement, bound = best.program.chosen(0), float(best.found.lower_bound[0])
    size = float(best.certificate["yardstick"][0] / omega_squared[0])
    asked = request.accuracy
    found = search(
        statement, held.options, best.found.unbalance[0], bound, asked.relative_gap, size, asked.time_limit_s
    )
    mass, angle = (each[None] for each in held.fitted(found.chosen))
    return searched(best, found, mass, angle, asked.relative_gap)
