"""Webs left empty that carry next to nothing, in the answers of all methods.

What rounding cannot take away (:mod:`optimizer.program.methods.rounding`) is sought again without the webs that are to
be empty: what is found is within the limits of all webs, so that what is proven of these holds for it. The point is
taken where it is an optimum by that proof; a web without which no optimum is found keeps what it has.
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.methods.compiled import TARGET, ends, suits_kernel
from optimizer.program.methods.rounding import dust, has_dust, settled
from optimizer.program.points import Points, points_at
from optimizer.program.solution import CEILING_ROUNDING, Solutions
from optimizer.program.statement import Statement
from optimizer.program.verdict import MASS_GAP

#: share of what optima may differ by that is used, which leaves the rest for rounding
_WITH_ROOM = 0.999
#: relative gap of the mass that may be left, most of what an answer may claim
_HEAVIER = 0.9 * MASS_GAP
#: how often webs are left empty that only then carry next to nothing
_ROUNDS = 4


class Optimum(NamedTuple):
    """What a point (1, K) has to keep to be an optimum by the proof of its program."""

    objective: Real  # (1,)
    mass: Real  # (1,) kg, inf where the mass does not count
    excess: Real  # (1,) relative excess over the ceilings
    mass_bound: Real | None  # (1,) kg

    def admits(self, points: Points) -> bool:
        close = points.objective <= self.objective + points.rounding
        return bool(np.all(close & (points.mass <= self.mass) & (points.excess <= self.excess)))


def leave_empty(statement: Statement, solutions: Solutions, share: Real, least_mass: bool) -> None:
    """Take dust away in place from answers of N programs, as far as they stay optima.

    Parameters
    ----------
    solutions : proven optima, or points of which less is proven, which get no worse then.
    share : (N,) how far above the smallest objective an optimum may be.
    """
    if statement.limits.radius.shape[-1] < 2:
        return
    for n in has_dust(statement.limits, solutions.unbalance).nonzero()[0].tolist():
        some = slice(n, n + 1)
        program = statement.chosen(np.array([n]))
        old = points_at(program, solutions.unbalance[some])
        close = solutions.lower_bound[some] + TARGET * share[some] - old.rounding
        # no further than what is proven of the mass holds, which is no limit where that does not count
        largest = np.maximum(np.minimum(close, solutions.mass_target[some]), old.objective)
        optimum = Optimum(
            largest,
            np.maximum(old.mass, solutions.mass_lower_bound[some] / (1.0 - _HEAVIER))
            if least_mass
            else np.array([np.inf]),
            np.maximum(old.excess, CEILING_ROUNDING),
            solutions.mass_lower_bound[some] if least_mass else None,
        )
        new = _emptied(program, old, optimum, share[some], least_mass)
        solutions.unbalance[n], solutions.objective[n] = new.unbalance[0], new.objective[0]
        solutions.mass[n], solutions.excess[n] = new.mass[0], new.excess[0]


def _emptied(program: Statement, old: Points, optimum: Optimum, share: Real, least_mass: bool) -> Points:
    """The same with as many webs empty as an optimum can be found without, all at once or one by one."""
    best, empty = old, np.zeros(old.unbalance.shape[-1], bool)
    for _ in range(_ROUNDS):
        nothing = _dusty(program, best.unbalance)
        if not nothing.any():
            return best
        found = _without(program, empty | nothing, optimum, share, least_mass)
        if found is None:
            break
        best, empty = found, empty | nothing
    mass = np.abs(best.unbalance[0]) / program.limits.radius[0]
    for web in np.argsort(mass):
        nothing = _dusty(program, best.unbalance)
        if nothing[web]:
            alone = nothing & _unit(program, int(web))
            found = _without(program, empty | alone, optimum, share, least_mass)
            if found is not None:
                best, empty = found, empty | alone
    return best


def _dusty(program: Statement, u: Complex) -> np.ndarray:
    """Webs (K,) that carry next to nothing, of alike ones all or none."""
    nothing: np.ndarray = dust(np.abs(u) / program.limits.radius)[0]
    alike = program.limits.alike
    return nothing if alike is None else (alike.summed(1.0 * nothing) == alike.count)[alike.owner]


def _unit(program: Statement, web: int) -> np.ndarray:
    """Webs (K,) that are alike with one."""
    alike = program.limits.alike
    owner = np.arange(program.limits.radius.shape[-1]) if alike is None else alike.owner
    return np.asarray(owner == owner[web])


def _without(program: Statement, empty: np.ndarray, optimum: Optimum, share: Real, least_mass: bool) -> Points | None:
    """An optimum that needs none of these webs (K,) bool, None where none is found."""
    part, left = program.only(~empty), _WITH_ROOM * share
    if not suits_kernel(part):
        return None
    for _ in range(2):
        smallest, lightest = (points_at(part, end) for end in ends(part, left, least_mass))
        room = _WITH_ROOM * (optimum.objective - smallest.objective)
        point = settled(part, lightest if least_mass else smallest, optimum.objective, optimum.mass_bound)
        u = np.zeros(empty.shape, complex)
        u[~empty] = point.unbalance[0]
        found = points_at(program, u[None])
        if optimum.admits(found):
            return found
        # the smallest objective without these webs is larger, and what is left for the mass is less
        if not (least_mass and room > 0.0):
            return None
        left = room
    return None
