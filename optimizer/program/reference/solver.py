"""Solve a program by clarabel, in as many attempts as it takes: smallest objective, least mass among the optima."""

import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.program.certificate import Multipliers, mass_lower_bound, objective_lower_bound, tolerance_allowance
from optimizer.program.multipliers import (
    mass_multipliers,
    objective_multipliers,
    resting_multipliers,
    supporting_multipliers,
)
from optimizer.program.reference.assembled import GroupLimit, NoPoint, solved
from optimizer.program.scaled_program import ScaledData
from optimizer.program.scaling import Scaling, cancelling, natural_reach, scale
from optimizer.program.solution import CONE_PROGRAM, NEGLIGIBLE, ConeSolution, evaluated
from optimizer.program.statement import Statement


class _SolverSetting(NamedTuple):
    """How one attempt is made; what one cannot certify the next may."""

    tolerance: float  # of the solver
    reach: float  # multiple of the natural reach beyond which limits are ignored
    ceiling_margin: float  # share by which ceilings are lowered, so that the answer keeps them
    target_margin: float  # least mass: share of the allowance above the optimum that is kept back

    def clip(self, natural: float, largest: float) -> float:
        """Largest reach worth considering, kg m; where nothing that counts can be changed any is."""
        return min(self.reach * natural, largest) if natural > 0.0 else largest


_ATTEMPTS = (
    _SolverSetting(1e-12, 10.0, 2e-11, 1e-5),
    _SolverSetting(1e-10, 10.0, 2e-10, 1e-4),
    _SolverSetting(1e-12, 10.0, 5e-10, 1e-5),
    _SolverSetting(1e-10, 10.0, 1e-9, 1e-3),
    _SolverSetting(1e-9, 10.0, 1e-9, 1e-3),
    _SolverSetting(1e-11, 10.0, 2e-11, 1e-6),
    _SolverSetting(1e-11, 1e4, 5e-10, 1e-4),
    _SolverSetting(1e-10, np.inf, 1e-9, 1e-4),
)
#: the least mass, which sits on a steeper edge, is more often certified by the second
_MASS_ATTEMPTS = (_ATTEMPTS[1], _ATTEMPTS[0], *_ATTEMPTS[2:])
_TARGET_MARGIN = 1e-7


def smallest_objective(
    statement: Statement,
    enough: float,
    start: ConeSolution | None = None,
    stop: Callable[[ConeSolution], bool] = lambda best: False,
) -> ConeSolution:
    """The smallest objective, with its bound.

    Tries harder until the certified gap is at most ``enough``. If no point that keeps the
    ceilings was reached, the one with the smallest excess is returned, and says so.

    Parameters
    ----------
    enough : gap that ends the search, in units of the objective.
    start : point and bounds so far.
    stop : whether the best so far is enough to end the search.
    """
    best = evaluated(statement, np.zeros(statement.limits.radius.shape, complex))
    best = proven(statement, best, resting_multipliers(statement))
    cancelled = evaluated(statement, statement.limits.into(cancelling(statement, passes=3)))
    if _better_objective(best, cancelled):
        best = cancelled.bounded(best.lower_bound, best.multipliers)
    if start is not None:
        better, worse = (start, best) if _better_objective(best, start) else (best, start)
        best = better.bounded(worse.lower_bound, worse.multipliers)
    if statement.limits.radius.size == 0 or (best.below_ceilings and best.gap <= enough):
        return best
    natural, largest = float(natural_reach(statement)), float(np.max(statement.limits.reach))
    for attempt in _ATTEMPTS:
        clip = attempt.clip(natural, largest)
        data, scaling = scale(statement, "objective", clip, attempt.ceiling_margin)
        best, point = _attempt(statement, best, data, scaling, attempt.tolerance, _better_objective)
        if point is not None:
            began = time.perf_counter()
            best = proven(statement, best, objective_multipliers(statement, *point))
            best = replace(best, certify_s=best.certify_s + time.perf_counter() - began)
        if stop(best) or (best.below_ceilings and best.gap <= enough):
            break
    return best


def least_mass(
    statement: Statement,
    first: ConeSolution,
    share: float,
    enough: float,
    start: ConeSolution | None = None,
    stop: Callable[[ConeSolution], bool] = lambda best: False,
) -> ConeSolution:
    """The least total mass among the optima, with its bound.

    Parameters
    ----------
    first : a solution whose objective is the smallest.
    share : how far above the smallest objective an optimum may be, in units of the objective.
    enough : relative gap of the mass that ends the search, besides what the tolerance of the ceilings is worth.
    start : point and bounds so far; its bound counts all objectives up to the share above its own first stage.
    stop : whether the best so far is enough to end the search.
    """
    rounding = float(statement.rounding(first.unbalance))
    target = max(first.objective, first.lower_bound + (1.0 - _TARGET_MARGIN) * share - rounding)
    nothing = first.with_point(statement, np.zeros_like(first.unbalance))
    if nothing.objective <= target and nothing.below_ceilings:
        return nothing
    # the smallest objective lies between first.lower_bound and first.objective: a bound for all
    # that are within the share of it must allow for the larger; rounding of ceilings may turn them round
    level = max(first.objective, first.lower_bound) + share
    best, natural = first, float(natural_reach(statement))
    needed, largest = float(np.max(np.abs(first.unbalance))), float(np.max(statement.limits.reach))

    def admit(old: ConeSolution, new: ConeSolution) -> bool:
        return new.below_ceilings and new.objective <= target and new.mass < old.mass

    if start is not None:
        base = first.weighed(start.mass_lower_bound, start.mass_multipliers, start.mass_target)
        best = base.with_point(statement, start.unbalance) if admit(best, start) else base
    for multiplier in supporting_multipliers(statement, best.unbalance):
        best = best.weighed(float(mass_lower_bound(statement, multiplier, np.asarray(level))), multiplier, level)
    for attempt in _MASS_ATTEMPTS:
        inner = max(target - attempt.target_margin * share, 0.5 * (target + first.lower_bound))
        clip = min(max(attempt.clip(natural, largest), needed), largest)
        data, scaling = scale(statement, "mass", clip, attempt.ceiling_margin, inner, first.mass)
        best, point = _attempt(statement, best, data, scaling, attempt.tolerance, admit, blend=(first, target))
        if point is not None:
            began = time.perf_counter()
            for multiplier in mass_multipliers(statement, *point):
                bound = float(mass_lower_bound(statement, multiplier, np.asarray(level)))
                best = best.weighed(bound, multiplier, level)
            best = replace(best, certify_s=best.certify_s + time.perf_counter() - began)
        proof = best.mass_multipliers
        allowance = 0.0 if proof is None else float(tolerance_allowance(statement, proof))
        if stop(best) or best.mass - best.mass_lower_bound - allowance <= enough * best.mass:
            break
    return best


def _attempt(
    statement: Statement,
    best: ConeSolution,
    data: ScaledData,
    scaling: Scaling,
    tolerance: float,
    better: Callable[[ConeSolution, ConeSolution], bool],
    blend: tuple[ConeSolution, float] | None = None,
) -> tuple[ConeSolution, tuple[Complex, Multipliers] | None]:
    """One solve: the better of the best so far and the new point, and what a bound can be made of."""
    best, targets = replace(best, method=CONE_PROGRAM), []
    if data.shape.stage == "mass":
        targets = [GroupLimit(np.ones(data.shape.groups[-1] + 1, bool), float(data.target[0]))]
    result = solved(data, tolerance, np.inf, targets=targets)
    if isinstance(result, NoPoint):
        return best, None
    u = statement.limits.into(scaling.unbalance(statement, result.solution))
    for point in _tidied(u):
        new = evaluated(statement, point if blend is None else _blended(statement, point, *blend))
        if better(best, new):
            best = replace(best, unbalance=new.unbalance, objective=new.objective, mass=new.mass, excess=new.excess)
    return best, (u, scaling.multipliers(statement, result.solution))


def _better_objective(old: ConeSolution, new: ConeSolution) -> bool:
    if old.below_ceilings and new.below_ceilings:
        return new.objective < old.objective
    return new.below_ceilings or (not old.below_ceilings and new.excess < old.excess)


def _tidied(u: Complex) -> tuple[Complex, ...]:
    """The point, and the point without its negligible counterweights."""
    small = np.abs(u) < NEGLIGIBLE * np.max(np.abs(u), initial=0.0)
    return (u, np.where(small, 0.0, u)) if np.any(small & (u != 0)) else (u,)


def _blended(statement: Statement, u: Complex, safe: ConeSolution, target: float) -> Complex:
    """The point moved towards a safe one just so far that the objective, which is convex, meets the target."""
    value = float(statement.objective(u))
    if value <= target or value <= safe.objective:
        return u
    step = min(1.0, (value - target) / (value - safe.objective) * (1.0 + 1e-12))
    # far from both of them the step is rounded by more than a thin sector is wide
    return statement.limits.into(u + step * (safe.unbalance - u))


def proven(statement: Statement, solution: ConeSolution, candidates: Iterable[Multipliers]) -> ConeSolution:
    """The same point with the best bound of several multipliers."""
    for multipliers in candidates:
        solution = solution.bounded(float(objective_lower_bound(statement, multipliers)), multipliers)
    return solution
