"""Certified counterweights of one request of the first order, however they may be chosen."""

from collections.abc import Sequence

from optimizer.choices.construction import feasible_set
from optimizer.choices.feasible_set import FeasibleSet, Subproblem
from optimizer.formulation.demand import demand, of_any_mass
from optimizer.formulation.limits import limits
from optimizer.numerics.arrays import Real
from optimizer.program.reference.solver import Solver
from optimizer.responses.response import Response
from optimizer.solve.certify import Certified, certified
from optimizer.solve.plates import certified_shapes
from optimizer.solve.search_claims import searched
from schemas.request.requests import OptimizeRequest


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
    choices = None
    if request.machine.discrete or request.machine.semicontinuous:
        choices = feasible_set(request, limits(request.machine), solver)
    if choices is None:
        # of what is cut from a plate the radius follows
        return certified_shapes(request, responses, omega_squared, solver)
    return request, _held(request, choices, responses, omega_squared, solver) or _best(
        request, choices, responses, omega_squared, solver
    )


def _held(
    request: OptimizeRequest, choices: FeasibleSet, responses: Sequence[Response], omega_squared: Real, solver: Solver
) -> Certified | None:
    """Counterweights of any mass, with all that is proven of them, where they are choices."""
    if not choices.solved:
        return None
    wanted, usual, best = demand(request), of_any_mass(request).relative_gap, None
    # as closely as is usual first, and any closer only where nothing is to be searched
    for gap in sorted({usual, min(wanted.relative_gap, usual)}, reverse=True):
        closely = wanted._replace(relative_gap=gap)
        best = certified(request.machine, request.objective, responses, omega_squared, closely, solver)
        if not (best.found.unreachable[0] or choices.holds(best.mass_kg[0])):
            return None
    return best


def _best(
    request: OptimizeRequest, choices: FeasibleSet, responses: Sequence[Response], omega_squared: Real, solver: Solver
) -> Certified:
    """Of the choices the one with the smallest objective, and the lightest of equal ones.

    Ceilings that no counterweights at all keep are proven out of reach without a search.
    """
    best = certified(request.machine, request.objective, responses, omega_squared, of_any_mass(request), solver)
    if best.found.unreachable[0]:
        return best
    program, asked = best.program.chosen(0), request.accuracy
    size = float(best.certificate["yardstick"][0] / omega_squared[0])
    bound = float(best.found.lower_bound[0])
    subproblem = Subproblem(
        choices.posed(program), best.found.unbalance[:1], bound, asked.relative_gap, size, asked.time_limit_s
    )
    choice = choices.best(subproblem)
    return searched(best, choice.found, choice.mass[None], choice.angle[None], asked.relative_gap)
