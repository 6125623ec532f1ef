"""The goals before the last of several: what is proven of them, and how far methods are off in each."""

import numpy as np

from optimizer.program.cuts.proof import Proof
from optimizer.studies.accuracy.ladder import Trial
from optimizer.studies.accuracy.methods import LadderProgram
from schemas.request.accuracy import GoalBefore, GoalError


def level_prices(program: LadderProgram, proof: Proof) -> float:
    """What an excess over the levels of the goals before the last costs, by the multipliers of a proof."""
    problem = program.problem
    if problem is None or not program.earlier or proof.scale is None:
        return 0.0
    first = np.searchsorted(problem.case_of, np.arange(problem.goal_of_case.size))
    earlier = problem.goal_of_case < len(program.earlier)
    return float(np.sum((proof.scale[first] * problem.units[problem.goal_of_case])[earlier]))


def goals_before(task: LadderProgram, square: float) -> tuple[GoalBefore, ...]:
    """The goals before the last, with what is proven of them."""
    if task.problem is None:
        return ()
    rest = task.problem.at_rest.goals.tolist()
    return tuple(
        GoalBefore(
            goal=goal.goal,
            value=goal.value * square,
            # above what it comes to by no more than rounding
            lower_bound=min(goal.lower_bound, goal.value) * square,
            limit=goal.most * square,
            without_counterweights=still * square,
        )
        for goal, still in zip(task.earlier, rest, strict=False)
    )


def goal_errors(task: LadderProgram, trial: Trial) -> tuple[GoalError, ...]:
    """How far the worst run of a method is off in the goals before the last."""
    if task.problem is None or trial.skipped is not None:
        return ()
    figures = zip(task.earlier, trial.worst.goals, task.problem.units.tolist(), strict=False)
    return tuple(
        GoalError(goal=goal.goal, relative_error=(value - min(goal.lower_bound, goal.value)) / unit)
        for goal, value, unit in figures
    )
