"""The whole program for one machine: smallest objective, ceilings, least mass."""

from dataclasses import dataclass, replace

import numpy as np

from optimizer.program.scaling import natural_reach
from optimizer.program.solve import OPTIMUM_SHARE, Solution, Solver
from optimizer.program.statement import Statement
from optimizer.response import Complex

#: the smallest objective is sought this much more sharply than optima are told apart
_SHARPNESS = 1e-4
#: relative gap of the least mass that ends the search
_MASS_GAP = 1e-6


@dataclass(frozen=True)
class Unreachable:
    """Proof that no counterweights keep the ceilings, and those that come closest."""

    closest: Complex  # (K,) kg m
    excess: float  # largest relative excess over a ceiling of the closest
    excess_lower_bound: float  # > 0
    certify_s: float  # time spent on bounds


def optimum(statement: Statement, relative_gap: float, least_mass: bool, solver: Solver) -> Solution | Unreachable:
    """Certified optimum of a statement; webs that cannot carry anything are left out of the program.

    Parameters
    ----------
    relative_gap : asked gap, relative to the objective without counterweights.
    least_mass : take the least total mass among the optima.

    Returns
    -------
    Solution, whose gap tells how far it is certified and whose excess whether the ceilings are kept
    (if neither could be decided, on the very boundary, they are not); or the proof that they cannot be.
    """
    webs = statement.limits.reach > 0
    part = statement.only(webs)
    share = min(OPTIMUM_SHARE, relative_gap) * _yardstick(part)
    first = solver.smallest_objective(part, _SHARPNESS * share)
    if first.excess > 0:
        # perhaps only by rounding: the sign of the smallest excess decides
        nearest = solver.smallest_excess(part.ceilings, part.limits)
        certify_s = first.certify_s + nearest.certify_s
        if nearest.lower_bound > 0:
            closest = _everywhere(nearest.unbalance, webs)
            return Unreachable(closest, nearest.objective, nearest.lower_bound, certify_s)
        first = replace(first, certify_s=certify_s)
        if not first.keeps_ceilings:
            first = first.moved_to(part, nearest.unbalance)
    if least_mass and first.keeps_ceilings:
        first = solver.least_mass(part, first, share, _MASS_GAP)
    return replace(first, unbalance=_everywhere(first.unbalance, webs))


def _yardstick(statement: Statement) -> float:
    """What gaps are relative to: the objective without counterweights, or what they could change."""
    rest = float(statement.objective(np.zeros(statement.limits.radius.shape, complex)))
    if rest > 0:
        return rest
    reach = np.minimum(statement.limits.reach, natural_reach(statement))
    return float(np.sum(np.abs(statement.norms.influence) * reach))


def _everywhere(u: Complex, webs: np.ndarray) -> Complex:
    everywhere = np.zeros(webs.shape, complex)
    everywhere[webs] = u
    return everywhere
