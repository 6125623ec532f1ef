"""Certified counterweights of one machine, chosen from what there is."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from optimizer.arrays import Real
from optimizer.certified import Certified, certified
from optimizer.discrete.search import EXHAUSTED, Found, search
from optimizer.figures.counterweights import unbalance
from optimizer.program.reference.solver import Solver
from optimizer.program.verdict import claim, verdict
from optimizer.response import Response
from optimizer.stock import stock
from schemas.requests import Accuracy, OptimizeRequest

_ALL = (
    "Every set of counterweights that can be chosen was compared: none within the limits has a smaller objective, and"
    " of those with the same one none is lighter."
)
_TREE = "The gap to the proven lower bound of all sets that can be chosen is within the asked one."
_TIME = "The search ended at accuracy.time_limit_s: the gap to the proven lower bound is what was reached by then."
_SIZE = "The search ended because its tree had grown too large: the gap to the proven lower bound is what was reached."
_NONE = "No set of counterweights that can be chosen keeps the ceilings: {proof}."
_BY = {True: "all were compared", False: "a tree of bounds over all of them proves it"}
_NONE_FOUND = (
    "No set of counterweights that keeps the ceilings was found before the search ended, nor is it proven that there"
    " is none: the one closest to them is shown."
)


def continuous(request: OptimizeRequest) -> OptimizeRequest:
    """The request without its catalogue: any mass at any angle within the limits of the webs."""
    goal = request.objective.model_copy(update={"least_mass": False})
    return request.model_copy(update={"objective": goal, "accuracy": Accuracy()})


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
    u = unbalance(mass, angle, best.program.limits.radius)
    # what any counterweights are held above holds for those that exceed ceilings by no more than these
    free = claim(best.program, u, np.sum(mass, axis=-1), best.found.lower_bound, best.found.multipliers, None)
    of_sets = np.array([[found.lower_bound if np.isfinite(found.lower_bound) else -np.inf]])
    claimed = replace(free, lower_bound=np.maximum(free.lower_bound, of_sets))
    judged = verdict(claimed, asked.relative_gap)
    proven = ~np.isnan(judged.relative_gap)
    certificate = best.certificate | {
        "objective": claimed.value[:, 0] * omega_squared,
        "lower_bound": judged.lower_bound[:, 0] * omega_squared,
        "gap": judged.gap[:, 0] * omega_squared,
        "relative_gap": judged.relative_gap,
        "continuous_lower_bound": np.where(proven, free.lower_bound[:, 0], np.nan) * omega_squared,
        "nodes": np.array([found.nodes]),
        "method": np.array([found.method], dtype=object),
    }
    status, reason = _status(found, str(judged.status[0]), str(judged.reason[0]), bool(proven[0]))
    return replace(
        best,
        mass_kg=mass,
        angle_deg=angle,
        unbalance=u,
        verdict=judged,
        certificate=certificate,
        status=np.array([status], dtype=object),
        reason=np.array([reason], dtype=object),
    )


def _status(found: Found, status: str, reason: str, proven: bool) -> tuple[str, str]:
    """What may be said of a set, from what the search and the verdict say."""
    if not proven:
        return status, reason
    if not found.kept:
        if found.lower_bound == np.inf:
            return "infeasible", _NONE.format(proof=_BY[found.method == EXHAUSTED])
        return "inaccurate", _NONE_FOUND
    if status == "optimal":
        return status, _ALL if found.proven else _TREE
    if found.ended is not None:
        return status, _TIME if found.ended == "time" else _SIZE
    return status, reason
