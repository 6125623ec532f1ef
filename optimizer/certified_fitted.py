"""Certified counterweights of one machine that are at least so heavy where they are fitted, or not there."""

from collections.abc import Sequence

import numpy as np

from optimizer.arrays import Real
from optimizer.certified import Certified, certified
from optimizer.figures.counterweights import masses_and_angles
from optimizer.formulate import formulate
from optimizer.mechanics.layout import stacked
from optimizer.program.reference.solver import Solver
from optimizer.program.solution import OPTIMUM_SHARE
from optimizer.response import Response
from optimizer.searched import continuous, searched
from optimizer.semicontinuous.search import Asked, search
from schemas.requests import Accuracy, OptimizeRequest

#: of a mass, relative: what is this near to the least is the least
_ROUNDING = 1e-11


def certified_fitted(
    request: OptimizeRequest, responses: Sequence[Response], omega_squared: Real, solver: Solver
) -> Certified:
    """Counterweights of one request; those of any mass, with all that is proven of them, where they are heavy enough.

    Ceilings that no counterweights at all keep are proven out of reach without a search.

    Parameters
    ----------
    omega_squared : (1,) rad^2/s^2.
    """
    machine, goal, asked = request.machine, request.objective, request.accuracy
    least = stacked([web.min_fitted_mass_kg or 0.0 for web in machine.webs])
    usual = Accuracy().relative_gap
    # as closely as is usual first, and any closer only where nothing is to be searched
    for gap in sorted({usual, min(asked.relative_gap, usual)}, reverse=True):
        closely = request.model_copy(update={"accuracy": asked.model_copy(update={"relative_gap": gap})})
        best = certified(closely, responses, omega_squared, solver)
        heavy_enough = bool(best.found.unreachable[0] or np.all((best.mass_kg == 0) | (best.mass_kg >= least)))
        if not heavy_enough:
            break
    if heavy_enough:
        return best
    best = certified(continuous(request), responses, omega_squared, solver)
    program = formulate(machine, goal, responses, omega_squared)
    statement, size = program.chosen(0), float(best.certificate["yardstick"][0] / omega_squared[0])
    found = search(
        statement,
        least * statement.limits.radius,
        best.found.unbalance[0],
        float(best.found.lower_bound[0]),
        Asked(
            asked.relative_gap * size,
            size,
            OPTIMUM_SHARE * size if goal.least_mass else 0.0,
            asked.time_limit_s,
        ),
        solver,
    )
    mass, angle = masses_and_angles(machine, found.unbalance[None], program.limits)
    mass = np.where(np.abs(mass - least) <= _ROUNDING * least, least, mass)
    return searched(best, found, mass, angle, asked.relative_gap)
