"""The set that counterweights are chosen from."""

from optimizer.choices.castings_beside import CastingsBeside
from optimizer.choices.catalogue import Catalogue
from optimizer.choices.catalogue_options import stock
from optimizer.choices.feasible_set import FeasibleSet
from optimizer.choices.minimum_masses import MinimumMasses
from optimizer.formulation.limits import least_fitted
from optimizer.formulation.task import Task
from optimizer.program.limits import Limits


def feasible_set(task: Task, limits: Limits) -> FeasibleSet:
    """What counterweights are chosen from: a catalogue, or any mass at any angle that is 0 or no less than a least one.

    Beside castings on the crankshaft what is on balance shafts has any mass.

    Parameters
    ----------
    limits : of the webs (K,).

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    """
    machine = task.space.machine
    if task.choice == "discrete" and not task.all_discrete:
        return CastingsBeside(machine, stock(task.machine), least_fitted(machine), limits, task.objective.least_mass)
    if task.choice == "discrete":
        return Catalogue(stock(machine), limits.radius)
    return MinimumMasses(machine, least_fitted(machine), limits, task.objective.least_mass)
