"""Certified counterweights of one task, of any objective and of any feasible set."""

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
    worst_case : with the cost of the worst case beside the best of the unchanged machine, which is another search.

    Raises
    ------
    OutOfRange
        where the options of a web are not determined, or webs of a group are unlike.
    MissingInput
        if a machine lacks what the objective needs.
    """
    return (best_of_any_mass if task.choice is None else best_choice)(task, scene, in_full, worst_case)
