"""Certified counterweights of one machine that are at least so heavy where they are fitted, or not there."""

from collections.abc import Sequence

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.certified import Certified, certified
from optimizer.figures.counterweights import masses_and_angles
from optimizer.formulate import formulate
from optimizer.mechanics.layout import stacked
from optimizer.program.reference.solver import Solver
from optimizer.program.solution import OPTIMUM_SHARE
from optimizer.program.statement import Statement
from optimizer.response import Response
from optimizer.searched import continuous, searched
from optimizer.semicontinuous.search import Asked, Found, search
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
    bound = float(best.found.lower_bound[0])
    mass, angle, found = fitted_search(request, statement, best.found.unbalance[0], bound, size, solver)
    return searched(best, found, mass[None], angle[None], asked.relative_gap)


def fitted_search(
    request: OptimizeRequest,
    statement: Statement,
    continuous: Complex,
    at_least: float,
    size: float,
    solver: Solver,
    known: Sequence[Complex] = (),
    below: Statement | None = None,
) -> tuple[Real, Real, Found]:
    """Masses [kg] and angles [deg] (K,) of the best that are heavy enough, and where the search for them ended.

    Parameters
    ----------
    statement : one program (no leading axes).
    continuous : (K,) kg m, its optimum whatever the least, and ``at_least`` the bound of that.
    size : what gaps are relative to.
    known : (K,) kg m each, points to begin with.
    below : what bounds are of, nowhere above the statement; by default that one.
    """
    machine, asked = request.machine, request.accuracy
    least = stacked([web.min_fitted_mass_kg or 0.0 for web in machine.webs])
    share = OPTIMUM_SHARE * size if request.objective.least_mass else 0.0
    sought = Asked(asked.relative_gap * size, size, share, asked.time_limit_s)
    found = search(statement, least * statement.limits.radius, continuous, at_least, sought, solver, known, below)
    mass, angle = masses_and_angles(machine, found.unbalance, statement.limits)
    return np.where(np.abs(mass - least) <= _ROUNDING * least, least, mass), angle, found
