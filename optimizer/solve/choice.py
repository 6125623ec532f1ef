"""Certified choices over the turn and in the worst of several scenarios: from a catalogue, or at least so heavy where
they are fitted.

The searches of one machine take the statement with finitely many cuts, and begin with what is proven of any masses.
"""

import logging
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from optimizer.choices.construction import feasible_set, limits_beside_castings, takes_options
from optimizer.choices.discrete.options import EQUAL
from optimizer.choices.feasible_set import Choice, FeasibleSet, SearchResult
from optimizer.formulation.balance_shafts import placement_of
from optimizer.formulation.goals import Goals
from optimizer.formulation.limits import least_fitted
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.mechanics.fixed_weights import fixed_masses
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict, GoalLevel, next_goal, semicontinuous_limits
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.limits import Limits
from optimizer.program.optimum import optimum
from optimizer.solve.answer_fields import Candidate, solution_of
from optimizer.solve.caps import NO_CAPS, Caps, cost
from optimizer.solve.costs import Costs
from optimizer.solve.cutting_plane_rounds import Start, in_rounds
from optimizer.solve.infeasibility import out_of_reach, unreachable
from optimizer.solve.solution import Infeasible, Solution, finite_or_null
from optimizer.solve.statuses import SearchProof, search_status
from optimizer.solve.uncertain_program import MOST_ROUNDS, Robust
from optimizer.solve.worst_case import best_of_any_mass, with_worst_case
from schemas.answer.answers import GoalReached
from schemas.request.objective import COSTS, Cost

_LOG = logging.getLogger(__name__)
#: width of the brackets that compare choices, as a share of goals
_CLOSE = 1e-10
#: share of the target gap that a search for the lightest may leave where castings are not all
_OF_GAP = 0.5
#: by which products of shares are rounded, relative
_ROUNDING = 1e-12


def best_choice(task: Task, scene: Prepared, in_full: bool = True, worst_case: bool = True) -> Solution | Infeasible:
    """The best of all choices, over the turn and in the worst of all scenarios.

    Parameters
    ----------
    in_full : with what misplaced counterweights may cost.
    worst_case : with what the worst case costs.

    Raises
    ------
    OutOfRange
        where the options of a web are not determined, or webs of a group are unlike.
    MissingInput
        if a machine lacks what the objective needs.
    """
    if task.choice == "semicontinuous":
        free = best_of_any_mass(task, scene, in_full, worst_case)
        if isinstance(free, Infeasible) or _heavy_enough(task, free.mass):
            return free
    any_mass = task.of_any_mass
    robust = Robust(task, scene, any_mass)
    for _ in range(MOST_ROUNDS):
        goals = robust.goals()
        first = _of_any_mass(goals.program, any_mass.relative_gap, robust)
        if isinstance(first, Conflict):
            return out_of_reach(task, scene, goals, first)
        course = _in_order(task, robust, goals, first)
        stages, picked = course.stages, course.incumbent
        if picked is None or not robust.learnt(*course.unbalances) or robust.left_s == 0.0:
            break
    # judged by all changes of masses so far, of which those before have proven no less
    goals = robust.goals() if robust.scatters else goals
    assert picked is not None  # a choice is there after the first goal
    last = stages[-1]
    outcome = last.outcome
    best = replace(last.best, contradicted=last.best.contradicted or any(stage.contradicted for stage in stages))
    if not outcome.feasible and outcome.lower_bound == np.inf:
        placement = placement_of(task.machine, task.objective, picked.mass, picked.angle)
        status, reason = search_status(outcome, "infeasible", "", True)
        none = unreachable(task, scene, goals, placement, best.limits, None)
        return replace(none, status=status, reason=reason, method=outcome.method, nodes=_nodes(stages))
    judged = task.demand._replace(least_mass=False)
    if len(stages) < len(goals.program.goals):
        # nothing is proven of what goals come to in their order
        goals, of_any = robust.solved()
        if isinstance(of_any, Conflict):
            return out_of_reach(task, scene, goals, of_any)
        nothing = SearchProof(outcome, outcome.nodes, outcome.rounds, None, True)
        return solution_of(task, scene, goals, Candidate(picked.mass, picked.angle, of_any), judged, nothing, in_full)
    proof = SearchProof(
        outcome,
        _nodes(stages),
        sum(stage.outcome.rounds for stage in stages),
        [stage.outcome.lower_bound for stage in stages[:-1]],
        course.closed,
        _levels_of(course, goals.program, picked, scene.omega_squared),
    )
    answer = solution_of(task, scene, goals, Candidate(picked.mass, picked.angle, best), judged, proof, in_full)
    if task.robust and worst_case:
        answer = with_worst_case(robust, answer, *_nominal_choice(task, scene, robust.left_s))
    return answer


def _levels_of(course: "_GoalOrder", program: Problem, choice: Choice, omega_squared: float) -> list[GoalReached]:
    """Levels of goals, no lower than their own choices come to and the last one keeps them.

    Time may end before all worse changes of masses are in, with which goals are made small.
    """
    names = [goal.name for goal in program.goals]

    def judged(unbalance: Complex) -> dict[str, float]:
        values = (program.values(unbalance, _CLOSE).goals * omega_squared).tolist()
        return dict(zip(names, values, strict=True))

    levels, there = list[GoalReached](), judged(choice.unbalance) if course.levels else {}
    # of a goal that nothing keeps there is no level
    for level, unbalance in zip(course.levels, course.unbalances, strict=False):
        value, most = level.value, level.limit
        if level.goal in there:
            own, last = judged(unbalance)[level.goal], there[level.goal]
            value = own if own > value * (1.0 + _ROUNDING) else value
            most = max(most, value, last if last > most * (1.0 + _ROUNDING) else most)
        levels.append(level.model_copy(update={"value": value, "limit": most}))
    return levels


class _GoalChoice(NamedTuple):
    """A goal, the best choice for it under the goals before, and what is proven of all choices."""

    best: CertifiedOptimum  # of any masses at any angles, under the same
    picked: Choice
    outcome: SearchResult
    contradicted: bool  # the choice comes to less than any is proven to


def _of_any_mass(program: Problem, gap: float, robust: Robust) -> CertifiedOptimum | Conflict:
    """The first goal by itself."""
    return optimum(program.changed(goals=program.goals[:1]), gap, False, robust.left_s)


def _in_order(task: Task, robust: Robust, goals: Goals, best: CertifiedOptimum) -> "_GoalOrder":
    """The goals one after the other, each with the most that those before it may come to."""
    course = _GoalOrder(task, robust, goals.program, best)
    order = list(task.objective.priorities)
    if order and order[-1].goal == "mass" and goals.program.goals[-1].allowance == 0.0:
        # of equal choices the lightest is taken anyhow
        order.pop()
    costs = any(priority.goal in COSTS for priority in order)
    for i, priority in enumerate(order or [None]):
        later = max(len(order), 1) - i - 1
        reserve_s = robust.left_s * later / (later + 1)
        if priority is not None and priority.goal in COSTS:
            course.cheapest(priority.goal, priority.allowance, reserve_s)
        elif not course.smallest(later, reserve_s):
            # the goals after this one of counterweights that keep no ceilings are those of any masses
            break
    return course if costs else replace(course, levels=[])


@dataclass
class _GoalOrder:
    """Goals one after the other."""

    task: Task
    robust: Robust
    program: Problem
    first: CertifiedOptimum  # of any masses, the first goal that is no cost by itself
    stages: list[_GoalChoice] = field(default_factory=list)
    levels: list[GoalReached] = field(default_factory=list)
    caps: Caps = NO_CAPS
    incumbent: Choice | None = None  # that keeps all so far
    closed: bool = True  # the gaps of all goals are at most the target gap
    unbalances: list[Complex] = field(default_factory=list)  # (K,) kg m, of the choice of every goal
    _reached: list[GoalLevel] = field(default_factory=list)

    def smallest(self, later: int, reserve_s: float) -> bool:
        """Make the next goal small that is no cost; whether some choice keeps the ceilings."""
        n, program, gap = len(self.stages), self.program, self.robust.demand.relative_gap
        goal, incumbent = program.goals[n], self.incumbent
        so_far = self._so_far(n + 1)
        best = self.first
        if n > 0:
            assert incumbent is not None  # else it would have ended
            best = next_goal(so_far, self._reached, incumbent.unbalance, gap, self.robust.left_s)
        size = float(program.units[n])
        limits = self.caps.within(_limits(self.task, so_far, best, self._reached, incumbent))
        choice_gap, left_s = self.task.relative_gap, _left(self.robust, reserve_s)
        choices = self.caps.of(self._choices(limits))
        picked, outcome = in_rounds(
            so_far, replace(best, limits=limits), choices, choice_gap, size, left_s, Start(incumbent)
        )
        value = float(so_far.values(picked.unbalance, _CLOSE).goals[-1])
        left = value - outcome.lower_bound
        contradicted = outcome.feasible and left < -EQUAL * size
        self.stages.append(_GoalChoice(best, picked, outcome, contradicted))
        self.closed &= left <= max(choice_gap * size, EQUAL * size)
        # choices that are this near are equal, which leaves room for the brackets by which they are judged
        most = max(value, outcome.lower_bound + goal.allowance * size) + EQUAL * size if later else value
        self._reached.append(GoalLevel(goal.name, value, best.proof, most, picked.unbalance))
        if self.task.objective.priorities and outcome.feasible:
            square = self.robust.scene.omega_squared
            least = finite_or_null(self._bound(outcome.lower_bound, value, EQUAL * size) * square)
            self.levels.append(
                GoalReached(goal=goal.name, value=value * square, lower_bound=least, limit=most * square)
            )
        self.incumbent = picked
        self.unbalances.append(picked.unbalance)
        return outcome.feasible

    def _bound(self, bound: float, value: float, rounding: float) -> float:
        """A bound as it is shown beside a value; one above it by more than rounding proves nothing, and is shown so."""
        if bound <= value + rounding:
            return min(bound, value)
        _LOG.error("a lower bound of %g is above the value of %g", bound, value)
        self.closed = False
        return bound

    def cheapest(self, kind: Cost, allowance: float, reserve_s: float) -> None:
        """Make a cost small."""
        n = max(len(self.stages) - 1, 0)
        best, size = self.stages[n].best if self.stages else self.first, float(self.program.units[n])
        program = self._so_far(n + 1)
        whole = self.task.choice != "discrete" or bool(np.all(takes_options(self.task)))
        if not whole:
            levels = np.array([goal.most for goal in self._reached] or [np.inf])
            best = replace(best, limits=limits_beside_castings(self.task, program, levels))
        costs = Costs(program, best, self._reached[:-1], self._choices, self.caps, size, whole)
        if not whole:
            # any masses beside castings are the lightest but for a gap
            costs.light = _OF_GAP * self.task.relative_gap
        if self.incumbent is not None:
            costs.offer(self.incumbent)
        level = self._reached[-1].most if self._reached else np.inf
        choice, bound = costs.least(kind, level, max(self.robust.left_s - reserve_s, 0.0))
        if choice is None:
            # the goal after it says that there is none
            self.closed = False
            return
        value = cost(choice, kind)
        most = value * (1.0 + allowance) if kind == "mass" else np.floor(value * (1.0 + allowance) * (1.0 + _ROUNDING))
        gap = self.task.relative_gap * value if kind == "mass" else 0.0
        self.closed &= value - bound <= gap
        self.caps, self.incumbent = self.caps.lower(kind, most), choice
        self.unbalances.append(choice.unbalance)
        fixed = float(np.sum(fixed_masses(self.task.machine))) if kind == "mass" else 0.0
        limits = {
            "value": value + fixed,
            "lower_bound": self._bound(bound, value, _ROUNDING * value) + fixed,
            "limit": most + fixed,
        }
        self.levels.append(GoalReached(goal=kind, **limits))

    def _so_far(self, count: int) -> Problem:
        """The program of so many goals under what costs may come to."""
        limits = self.caps.within(self.program.limits)
        return self.program.changed(goals=self.program.goals[:count], limits=limits)

    def _choices(self, limits: Limits) -> FeasibleSet:
        return feasible_set(self.task, limits)


def _limits(
    task: Task, program: Problem, best: CertifiedOptimum, before: Sequence[GoalLevel], incumbent: Choice | None
) -> Limits:
    """Limits that hold some best choice for the last goal.

    Parameters
    ----------
    before : the goals before it.
    incumbent : a choice that keeps these and the ceilings, if there is one.
    """
    discrete = task.choice == "discrete"
    if discrete and np.all(takes_options(task)):
        # the limits of a catalogue are its options
        return best.limits
    if incumbent is not None:
        value = float(program.values(incumbent.unbalance, _CLOSE).goals[-1])
    else:
        rest = program.at_rest
        value = float(rest.goals[-1]) if rest.excess <= 0.0 else np.inf
    most = np.array([*(goal.most for goal in before), value])
    if discrete:
        return limits_beside_castings(task, program, most)
    return semicontinuous_limits(program, least_fitted(task.space.machine), most)


def _left(robust: Robust, reserve_s: float) -> Callable[[], float]:
    """What is left of the time limit for a goal, for those after it some kept back."""
    return lambda: max(robust.left_s - reserve_s, 0.0)


def _nodes(stages: list[_GoalChoice]) -> int:
    """Nodes of the trees of all goals."""
    return sum(stage.outcome.nodes for stage in stages)


def _heavy_enough(task: Task, mass: Real) -> bool:
    least = least_fitted(task.space.machine)
    return bool(np.all((mass == 0) | (mass >= least)))


def _nominal_choice(task: Task, scene: Prepared, left_s: float) -> tuple[Complex | None, bool]:
    """The best choice for the unchanged machine, if any; whether the limit of time left it open."""
    if left_s == 0.0:
        return None, True
    of_machine = best_choice(task.nominal(left_s), scene, in_full=False)
    late = of_machine.status == "inaccurate"
    return of_machine.unbalance if isinstance(of_machine, Solution) and not late else None, late
