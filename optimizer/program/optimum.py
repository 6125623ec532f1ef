"""Certified optimum of a problem: by the cone program that it is, or by cuts where it is none."""

import time

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.program.certificate import objective_lower_bound
from optimizer.program.cuts.optimum import TIME_LIMIT_S, CertifiedOptimum, Conflict, GoalLevel, over_turn
from optimizer.program.cuts.proof import Proof
from optimizer.program.cuts.semi_infinite import Problem, Values
from optimizer.program.cuts.stage import Point
from optimizer.program.methods.implied_bounds import within_reach
from optimizer.program.methods.optima import Optima, optima
from optimizer.program.methods.symmetry import symmetric
from optimizer.program.statement import Statement
from optimizer.program.verdict import claim, verdict


def optimum(
    program: Problem,
    relative_gap: float,
    least_mass: bool,
    time_limit_s: float = TIME_LIMIT_S,
) -> CertifiedOptimum | Conflict:
    """Certified optimum of one problem: its goals one after the other, then the least mass.

    Parameters
    ----------
    relative_gap : target gap of the last goal, relative to its yardstick.
    least_mass : take the least total mass among the optima.
    time_limit_s : of this thread's own time, after which a search ends with what it has: by cuts at the next round,
        of a cone program at the next method.
    """
    stated = cone_program(program, least_mass)
    if stated is None or (program.plates is not None and (least_mass or program.limits.max_total_mass < np.inf)):
        # the program has the mass of plates by tangents, which cuts refine
        return over_turn(program, relative_gap, least_mass, time_limit_s)
    until = time.thread_time() + time_limit_s
    statement = within_reach(stated)
    whole = statement.alone()
    answer = optima(whole, relative_gap, least_mass, until)
    late = time.thread_time() >= until
    u = symmetric(whole, answer.unbalance) if program.symmetric else answer.unbalance
    return solution(
        program, statement, answer, u[0], least_mass, late and _is_open(whole, answer, relative_gap, least_mass)
    )


def _is_open(statement: Statement, answer: Optima, relative_gap: float, least_mass: bool) -> bool:
    """Whether less is proven of the only program than was to be."""
    of_mass = answer.mass_lower_bound if least_mass else None
    claimed = claim(statement, answer.unbalance, answer.mass, answer.lower_bound, answer.multipliers, of_mass)
    return not bool(np.all(verdict(claimed, relative_gap).status == "optimal"))


def cone_program(program: Problem, least_mass: bool) -> Statement | None:
    """The program that is solved in place of a problem; None where cuts are quicker or none is the same.

    The compiled interior point takes one group. A last goal that gives way for the mass is two problems.
    """
    statement = program.finite
    if statement is None or statement.group[-1] > 0 or (least_mass and program.goals[-1].allowance > 0.0):
        return None
    return statement


def solution(
    program: Problem, statement: Statement, optima: Optima, u: Complex, least_mass: bool, late: bool = False
) -> CertifiedOptimum | Conflict:
    """The optimum of a problem that is a cone program, from a batch of one.

    Parameters
    ----------
    statement : that is solved, no leading axes.
    u : (K,) kg m, no worse than the optimum of the batch.
    least_mass : whether the least mass was sought.
    late : whether time was up before all was proven.
    """
    method, spent = str(optima.method[0]), float(optima.certify_s[0])
    over = statement.ceilings.excess(u) if program.ceilings else np.zeros(0)
    point = Point(u, Values(optima.objective, over, ()), float(optima.mass[0]))
    if optima.unreachable[0]:
        excess, conflict = statement.excess(), optima.conflict.subset(0)
        proof = Proof(float(objective_lower_bound(excess, conflict)), excess, conflict)
        return Conflict(point, proof, statement.limits, spent, method)
    value, of_mass, target = float(point.values.goals[-1]), None, float(optima.mass_target[0])
    if least_mass:
        of_mass = Proof(float(optima.mass_lower_bound[0]), statement, optima.mass_multipliers.subset(0))
    of_goal = Proof(float(optima.lower_bound[0]), statement, optima.multipliers.subset(0))
    goals = (GoalLevel(program.goals[-1].name, value, of_goal, value, u),)
    return CertifiedOptimum(point, goals, of_mass, target, statement.limits, spent, method, timed_out=late)
