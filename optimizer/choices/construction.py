"""The set that a request states."""

from optimizer.choices.catalogue import Catalogue
from optimizer.choices.catalogue_options import stock
from optimizer.choices.feasible_set import FeasibleSet
from optimizer.choices.minimum_masses import MinimumMasses
from optimizer.mechanics.layout import stacked
from optimizer.program.limits import Limits
from optimizer.program.reference.solver import Solver
from schemas.request.requests import OptimizeRequest


def feasible_set(request: OptimizeRequest, limits: Limits, solver: Solver) -> FeasibleSet:
    """What counterweights are chosen from: a catalogue, or any mass at any angle that is 0 or no less than a least one.

    Parameters
    ----------
    limits : of the webs (K,).

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    """
    machine = request.machine
    if machine.discrete:
        return Catalogue(stock(machine), limits.radius)
    least = stacked([web.min_fitted_mass_kg or 0.0 for web in machine.webs])
    return MinimumMasses(machine, least, limits, request.objective.least_mass, solver)
