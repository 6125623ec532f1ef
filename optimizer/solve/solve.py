"""Certified counterweights of one task, whatever it asks for and however they may be chosen."""

from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.solve.choice import best_choice
from optimizer.solve.solution import Infeasible, Solution
from optimizer.solve.worst_case import best_of_any_mass


def solve(task: Task, scene: Prepared, in_full: bool = True, worst_case: bool = True) -> Solution | Infeasible:
    """The best counterweights, in the worst of all cases where there are several.

    Parameters
    ----------
    in_full : with prices of the limits and what misplaced counterweights may cost.
    worst_case : with what the worst case costs beside the best of the machine as it is given, which is another search.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    MissingInput
        if a machine lacks what the objective needs.
    """
    return (best_of_any_mass if task.choice is None else best_choice)(task, scene, in_full, worst_case)
