"""The feasible set of a task: options, minimum masses, or both."""

import numpy as np

from optimizer.choices.castings_beside import CastingsBeside, with_castings
from optimizer.choices.catalogue import Catalogue
from optimizer.choices.catalogue_options import Castings, Stock, stock
from optimizer.choices.feasible_set import FeasibleSet
from optimizer.choices.minimum_masses import MinimumMasses
from optimizer.formulation.limits import least_fitted
from optimizer.formulation.task import Task
from optimizer.numerics.arrays import Real
from optimizer.program.cuts.optimum import semicontinuous_limits
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.limits import Limits


def feasible_set(task: Task, limits: Limits) -> FeasibleSet:
    """The feasible set: a catalogue, or any mass at any angle that is 0 or no less than a least one.

    With balance shafts some webs may take castings, and the others any mass.

    Parameters
    ----------
    limits : of the webs (K,).

    Raises
    ------
    OutOfRange
        where the options of a web are not determined, or webs of a group are unlike.
    """
    machine, lightest = task.space.machine, task.objective.least_mass
    if task.choice != "discrete":
        return MinimumMasses(machine, least_fitted(machine), limits, lightest)
    if machine is task.machine:
        return Catalogue(stock(machine), limits.radius)
    castings = Castings.of(task.machine, task.objective)
    inventory = stock(machine, castings)
    if np.all(castings.webs):
        return Catalogue(inventory, limits.radius)
    least = np.where(castings.webs, 0.0, least_fitted(machine))
    return CastingsBeside(machine, inventory, castings.webs, least, limits, lightest)


def options_of(task: Task) -> Stock:
    """What the webs can take that take options.

    Raises
    ------
    OutOfRange
        where the options of a web are not determined, or webs of a group are unlike.
    """
    if task.space.machine is task.machine:
        return stock(task.machine)
    return stock(task.space.machine, Castings.of(task.machine, task.objective))


def takes_options(task: Task) -> np.ndarray:
    """Which of the webs that a program chooses take options (K,) bool, where some do."""
    if task.space.machine is task.machine:
        return np.ones(len(task.machine.webs), bool)
    return Castings.of(task.machine, task.objective).webs


def limits_beside_castings(task: Task, program: Problem, most: Real) -> Limits:
    """Finite limits that hold some best choice of castings and of any masses beside them.

    Parameters
    ----------
    most : (goals,) values of the goals at some choice that keeps the ceilings; inf without such a choice.
    """
    castings, machine = Castings.of(task.machine, task.objective), task.space.machine
    limits = with_castings(program.limits, stock(machine, castings), castings.webs)
    least = np.where(castings.webs, 0.0, least_fitted(machine))
    return semicontinuous_limits(program.changed(limits=limits), least, most)
