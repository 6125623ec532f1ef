"""Optima of many programs of one shape at once; what is not certified goes to the reference solver."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.program.certificate import Multipliers, nothing_proven
from optimizer.program.fast import fast
from optimizer.program.optimum import Unreachable, optimum, suits_kernel, within_reach
from optimizer.program.reach import far_limits
from optimizer.program.reference.solver import Solver
from optimizer.program.solution import CONE_PROGRAM, INTERIOR_POINT, OPTIMUM_SHARE, Solution
from optimizer.program.statement import Statement
from optimizer.program.verdict import yardstick


@dataclass(frozen=True)
class Optima:
    """Counterweights of N programs with their proofs; figures are evaluated from ``unbalance``."""

    unbalance: Complex  # (N, K) kg m; of an unreachable program those that come closest to its ceilings
    objective: Real  # (N,)
    lower_bound: Real  # (N,)
    mass: Real  # (N,) kg
    mass_lower_bound: Real  # (N,) kg
    excess: Real  # (N,) largest relative excess over a ceiling, -inf without ceilings
    unreachable: np.ndarray  # (N,) bool: proven that no counterweights keep the ceilings
    method: np.ndarray  # (N,) str
    multipliers: Multipliers  # (N, ...), those of the lower bound
    mass_multipliers: Multipliers  # (N, ...), those of the lower bound of the mass
    mass_target: Real  # (N,) largest objective that this bound counts as an optimum
    conflict: Multipliers  # (N, ...), those of the excess over the ceilings where they are unreachable, 0 elsewhere


def optima(statement: Statement, relative_gap: float, least_mass: bool, solver: Solver) -> Optima:
    """Certified optima of N statements of one shape, one leading axis (N,); each as if it were alone.

    Parameters
    ----------
    relative_gap, least_mass : as in :func:`optimizer.program.optimum.optimum`.
    """
    size = yardstick(statement)
    share, demand = min(OPTIMUM_SHARE, relative_gap) * size, relative_gap * size
    found = fast(statement, share, demand, least_mass) if suits_kernel(statement) else None
    if found is None:
        answer, open_ones = _nothing(statement), np.arange(size.size)
    else:
        open_ones = np.flatnonzero(~found.certified)
        answer = replace(
            _nothing(statement),
            unbalance=found.unbalance,
            objective=found.objective,
            lower_bound=found.lower_bound,
            mass=found.mass,
            mass_lower_bound=found.mass_lower_bound,
            excess=found.excess,
            method=np.full(size.shape, INTERIOR_POINT, dtype=object),
            multipliers=found.multipliers,
            mass_multipliers=found.mass_multipliers,
            mass_target=found.mass_target,
        )
    for n in map(int, open_ones):
        program, known = statement.chosen(n), None if found is None else found.chosen(np.array([n]))
        _put(answer, n, program, optimum(program, relative_gap, least_mass, solver, known))
    return answer


def all_within_reach(statement: Statement, solver: Solver) -> Statement:
    """N programs with finite, proven limits (:func:`optimizer.program.optimum.within_reach`)."""
    far = np.flatnonzero(np.any(far_limits(statement), axis=-1))
    if not far.size:
        return statement
    most = statement.limits.max_mass.copy()
    for n in map(int, far):
        most[n] = within_reach(statement.chosen(n), solver).limits.max_mass
    return replace(statement, limits=replace(statement.limits, max_mass=most))


def joined(parts: Sequence[Optima], order: np.ndarray) -> Optima:
    """Optima side by side, then in an order of all programs."""

    def join(pieces: Sequence[Any]) -> Any:
        if isinstance(pieces[0], np.ndarray):
            return np.concatenate(pieces)[order]
        names = [field.name for field in fields(pieces[0])]
        return type(pieces[0])(*(join([getattr(piece, name) for piece in pieces]) for name in names))

    whole: Optima = join(parts)
    return whole


def _nothing(statement: Statement) -> Optima:
    """Nothing found, nothing proven."""
    webs, ceilings = statement.limits.radius.shape, statement.ceilings.cap.shape
    endless = np.full(webs[:-1], np.inf)
    return Optima(
        unbalance=np.zeros(webs, complex),
        objective=endless,
        lower_bound=-endless,
        mass=endless.copy(),
        mass_lower_bound=np.zeros(webs[:-1]),
        excess=endless.copy(),
        unreachable=np.zeros(webs[:-1], bool),
        method=np.full(webs[:-1], CONE_PROGRAM, dtype=object),
        multipliers=nothing_proven(statement),
        mass_multipliers=nothing_proven(statement),
        mass_target=endless.copy(),
        conflict=Multipliers(np.zeros(ceilings, complex), np.zeros(ceilings), np.zeros((*ceilings[:-1], 0), complex)),
    )


def _put(answer: Optima, n: int, statement: Statement, found: Solution | Unreachable) -> None:
    point = found
    if isinstance(point, Unreachable):
        answer.unreachable[n] = True
        answer.conflict.put(n, point.multipliers)
        nowhere = Solution(point.closest, np.inf, -np.inf, np.inf, 0.0, np.inf)
        point = nowhere.moved_to(statement, point.closest)
    answer.unbalance[n], answer.objective[n], answer.lower_bound[n] = (
        point.unbalance,
        point.objective,
        point.lower_bound,
    )
    answer.mass[n], answer.mass_lower_bound[n] = point.mass, point.mass_lower_bound
    answer.excess[n], answer.method[n] = point.excess, point.method
    if point.multipliers is not None:
        answer.multipliers.put(n, point.multipliers)
    if point.mass_multipliers is not None:
        answer.mass_multipliers.put(n, point.mass_multipliers)
        answer.mass_target[n] = point.mass_target
