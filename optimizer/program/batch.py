"""Optima of many programs of one shape at once; what is not certified goes to the reference solver."""

from dataclasses import dataclass

import numpy as np

from optimizer.program.optimum import Unreachable, optimum
from optimizer.program.solve import Solution, Solver
from optimizer.program.statement import Statement
from optimizer.response import Complex, Real


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


def optima(statement: Statement, relative_gap: float, least_mass: bool, solver: Solver) -> Optima:
    """Certified optima of N statements of one shape, one leading axis (N,).

    Parameters
    ----------
    relative_gap, least_mass : as in :func:`optimizer.program.optimum.optimum`.
    """
    found = [optimum(each, relative_gap, least_mass, solver) for each in statement.each()]
    points = [_point(each, one) for each, one in zip(statement.each(), found, strict=True)]

    def column(name: str) -> Real:
        return np.array([getattr(point, name) for point in points], dtype=float)

    return Optima(
        unbalance=np.array([point.unbalance for point in points]),
        objective=column("objective"),
        lower_bound=column("lower_bound"),
        mass=column("mass"),
        mass_lower_bound=column("mass_lower_bound"),
        excess=column("excess"),
        unreachable=np.array([isinstance(one, Unreachable) for one in found]),
        method=np.array([point.method for point in points]),
    )


def _point(statement: Statement, found: Solution | Unreachable) -> Solution:
    if isinstance(found, Solution):
        return found
    nowhere = Solution(found.closest, np.inf, -np.inf, np.inf, 0.0, np.inf)
    return nowhere.moved_to(statement, found.closest)
