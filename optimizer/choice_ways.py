"""How choices of a machine are searched: from what there is, or at least so heavy where they are fitted."""

import numpy as np

from optimizer.certified_fitted import fitted_search
from optimizer.choice_rounds import Choice, Sought, Way
from optimizer.discrete.search import Known
from optimizer.discrete.search import search as discrete_search
from optimizer.figures.counterweights import unbalance
from optimizer.program.cuts import Found
from optimizer.program.reference.solver import Solver
from optimizer.stock import stock
from schemas.requests import OptimizeRequest


def way_of(request: OptimizeRequest, best: Found, size: float, solver: Solver) -> Way:
    """The search that a request calls for.

    Parameters
    ----------
    best : the optimum of any masses at any angles.
    size : what gaps are relative to.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    """
    return (_from_stock if request.machine.discrete else _fitted)(request, best, size, solver)


def _from_stock(request: OptimizeRequest, best: Found, size: float, solver: Solver) -> Way:
    held, radius = stock(request.machine), best.limits.radius

    def search(sought: Sought) -> Choice:
        relaxed, *known = sought.points
        found = discrete_search(
            sought.statement,
            held.options,
            relaxed,
            sought.at_least,
            sought.gap / size,
            size,
            sought.time_limit_s,
            Known(known, sought.below),
        )
        mass, angle = held.fitted(found.chosen)
        return Choice(mass, angle, unbalance(mass, angle, radius), found)

    return Way(search, solved=False, reach=np.max(np.abs(held.options.on_webs), axis=-1))


def _fitted(request: OptimizeRequest, best: Found, size: float, solver: Solver) -> Way:
    limits = best.limits

    def search(sought: Sought) -> Choice:
        relaxed, *known = sought.points
        accuracy = {"relative_gap": sought.gap / size, "time_limit_s": sought.time_limit_s}
        asked = request.model_copy(update={"accuracy": request.accuracy.model_copy(update=accuracy)})
        whole, below = sought.statement, sought.below
        mass, angle, found = fitted_search(asked, whole, relaxed, sought.at_least, size, solver, known, below)
        return Choice(mass, angle, unbalance(mass, angle, limits.radius), found)

    return Way(search, solved=True, reach=limits.reach)
