"""Certified choices over the turn and in the worst of several scenarios: from a catalogue, or at least so heavy where
they are fitted.

The searches of one machine take the statement with finitely many cuts, and begin with what is proven of any masses.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.choices.construction import feasible_set
from optimizer.choices.discrete.options import EQUAL
from optimizer.choices.feasible_set import Choice
from optimizer.formulation.balance_shafts import chosen
from optimizer.formulation.demand import demand, of_any_mass
from optimizer.formulation.goals import Goals
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.layout import stacked
from optimizer.numerics.arrays import Complex
from optimizer.program.cuts.optimum import Found, Reached, Unkept, next_goal, over_turn, semicontinuous_limits
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.limits import Limits
from optimizer.program.reference.solver import Solver
from optimizer.solve.cutting_plane_rounds import Ended, in_rounds
from optimizer.solve.design import certified_one
from optimizer.solve.infeasibility import out_of_reach, unreachable
from optimizer.solve.outcome import Outcome
from optimizer.solve.search_claims import told_status
from optimizer.solve.uncertain_program import MOST_ROUNDS, Robust
from optimizer.solve.whole_turn import Candidate, SearchProof, told
from optimizer.solve.worst_case import certified_any_mass, with_worst_case
from schemas.request.requests import OptimizeRequest

#: width of the brackets by which choices are told apart, as a share of goals
_CLOSE = 1e-10


def certified_choice(request: OptimizeRequest, scene: Prepared, solver: Solver, in_full: bool = True) -> Outcome:
    """Of what can be chosen the best, over the turn and in the worst of all scenarios.

    Parameters
    ----------
    in_full : with what misplaced counterweights may cost.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    MissingInput
        if a machine lacks what the objective needs.
    """
    if request.machine.semicontinuous:
        free = certified_any_mass(request, scene, in_full)
        if free.chosen is None or _heavy_enough(request, free.chosen):
            return free
    any_mass = of_any_mass(request)
    robust = Robust(request, scene, any_mass)
    for _ in range(MOST_ROUNDS):
        asked = robust.asked()
        first = _of_any_mass(asked.program, any_mass.relative_gap, robust)
        if isinstance(first, Unkept):
            return out_of_reach(request, scene, asked, first)
        stages = _in_order(request, robust, asked, first, solver)
        if not robust.learnt(stages[-1].picked.unbalance) or robust.left_s == 0.0:
            break
    # judged by all changes of masses that are known, of which those before have proven no less
    asked = robust.asked()
    last, picked = stages[-1], stages[-1].picked
    found = last.found
    best = replace(last.best, contradicted=last.best.contradicted or any(stage.contradicted for stage in stages))
    if not found.kept and found.lower_bound == np.inf:
        shown = chosen(request, picked.mass, picked.angle)
        status, reason = told_status(found, "infeasible", "", True)
        answer = unreachable(request, scene, asked, shown, best.limits, None)
        return replace(answer, status=status, reason=reason, method=found.method, nodes=_nodes(stages))
    judged = demand(request)._replace(least_mass=False)
    if len(stages) < len(asked.program.goals):
        # nothing is proven of what goals come to in their order
        asked, of_any = robust.solved()
        if isinstance(of_any, Unkept):
            return out_of_reach(request, scene, asked, of_any)
        nothing = SearchProof(found, found.nodes, found.rounds, None, True)
        return told(request, scene, asked, Candidate(picked.mass, picked.angle, of_any), judged, nothing, in_full)
    proof = SearchProof(
        found,
        _nodes(stages),
        sum(stage.found.rounds for stage in stages),
        [stage.found.lower_bound for stage in stages[:-1]],
        all(stage.closed for stage in stages),
    )
    answer = told(request, scene, asked, Candidate(picked.mass, picked.angle, best), judged, proof, in_full)
    if request.robust:
        answer = with_worst_case(robust, answer, *_nominal_choice(request, scene, robust.left_s, solver))
    return answer


class _Stage(NamedTuple):
    """A goal, the best choice for it under the goals before, and what is proven of all choices."""

    best: Found  # of any masses at any angles, under the same
    picked: Choice
    found: Ended
    closed: bool  # the gap is the asked one
    contradicted: bool  # the choice comes to less than any is proven to


def _of_any_mass(program: Problem, gap: float, robust: Robust) -> Found | Unkept:
    """The first goal by itself."""
    return over_turn(program.changed(goals=program.goals[:1]), gap, False, robust.left_s)


def _in_order(request: OptimizeRequest, robust: Robust, asked: Goals, best: Found, solver: Solver) -> list[_Stage]:
    """The goals one after the other, each with the most that those before it may come to."""
    program, gap, stages = asked.program, robust.wanted.relative_gap, list[_Stage]()
    reached: list[Reached] = []
    for n, goal in enumerate(program.goals):
        so_far = program.changed(goals=program.goals[: n + 1])
        if stages:
            best = next_goal(so_far, reached, stages[-1].picked.unbalance, gap, robust.left_s)
        size, later = float(program.units[n]), len(program.goals) - n - 1
        kept_back = robust.left_s * later / (later + 1)
        known = stages[-1].picked if stages else None
        limits = _limits(request, so_far, best, reached, known)
        choices, asked_gap = feasible_set(request, limits, solver), request.accuracy.relative_gap
        assert choices is not None  # else there would be nothing to search
        closed = asked_gap * size
        left_s = _left(robust, kept_back)
        picked, found = in_rounds(so_far, replace(best, limits=limits), choices, asked_gap, size, left_s, known)
        value = float(so_far.values(picked.unbalance, _CLOSE).goals[-1])
        left = value - found.lower_bound
        contradicted = found.kept and left < -EQUAL * size
        stages.append(_Stage(best, picked, found, left <= max(closed, EQUAL * size), contradicted))
        if later and not found.kept:
            # counterweights that keep no ceilings are told by what any masses come to
            break
        # choices that are this near are equal, which leaves room for the brackets by which they are judged
        most = max(value, found.lower_bound + goal.allowance * size) + EQUAL * size if later else value
        reached.append(Reached(goal.name, value, best.proof, most))
    return stages


def _limits(
    request: OptimizeRequest, program: Problem, best: Found, before: Sequence[Reached], known: Choice | None
) -> Limits:
    """Limits that hold some best choice for the last goal.

    Parameters
    ----------
    before : the goals before it.
    known : a choice that keeps these and the ceilings, if there is one.
    """
    if not request.machine.semicontinuous:
        # what is chosen from a catalogue is what it holds
        return best.limits
    if known is not None:
        value = float(program.values(known.unbalance, _CLOSE).goals[-1])
    else:
        rest = program.at_rest
        value = float(rest.goals[-1]) if rest.excess <= 0.0 else np.inf
    least = stacked([web.min_fitted_mass_kg or 0.0 for web in request.machine.webs])
    most = np.array([*(goal.most for goal in before), value])
    return semicontinuous_limits(program, least, most)


def _left(robust: Robust, kept_back: float) -> Callable[[], float]:
    """What is left of the time limit for a goal, for those after it some kept back."""
    return lambda: max(robust.left_s - kept_back, 0.0)


def _nodes(stages: list[_Stage]) -> int:
    """Nodes of the trees of all goals."""
    return sum(stage.found.nodes for stage in stages)


def _heavy_enough(request: OptimizeRequest, u: Complex) -> bool:
    webs = request.machine.webs
    mass = np.abs(u) / stacked([web.radius_m for web in webs])
    return bool(np.all((mass == 0) | (mass >= stacked([web.min_fitted_mass_kg or 0.0 for web in webs]))))


def _nominal_choice(
    request: OptimizeRequest, scene: Prepared, left_s: float, solver: Solver
) -> tuple[Complex | None, bool]:
    """The best choice for the machine as it is given, if it is found; whether the limit of time left it open."""
    if left_s == 0.0:
        return None, True
    accuracy = request.accuracy.model_copy(update={"time_limit_s": left_s})
    alone = request.model_copy(update={"scenarios": (), "tolerances": None, "accuracy": accuracy})
    if alone.objective.over_the_turn:
        of_turn = certified_choice(alone, scene, solver, in_full=False)
        return of_turn.chosen if of_turn.status == "optimal" else None, of_turn.status == "inaccurate"
    _, best = certified_one(alone, scene.responses, np.array([scene.omega_squared]), solver)
    status = str(best.status[0])
    return best.unbalance[0] if status == "optimal" else None, status == "inaccurate"
