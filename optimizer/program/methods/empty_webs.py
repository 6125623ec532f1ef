"""Webs left empty that carry next to nothing, in the answers of all methods.

A web that rounding cannot empty (:mod:`optimizer.program.methods.rounding`) is left out of a second search. Its point
is within the limits of all webs, so that the proof for these limits holds for it. The point is
taken where it is an optimum by that proof; a web that every optimum needs keeps its counterweight.
"""

import time
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real, all_true
from optimizer.program.methods.compiled import TARGET, ends, suits_kernel
from optimizer.program.methods.rounding import dust, has_dust, snap_to_limits
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
    """What points (N, K) have to keep to be optima by the proofs of their programs."""

    objective: Real  # (N,)
    mass: Real  # (N,) kg, inf where the mass does not count
    excess: Real  # (N,) relative excess over the ceilings
    mass_bound: Real | None  # (N,) kg

    def admits(self, points: Points) -> np.ndarray:
        """Whether each point is one (N,) bool."""
        close = points.objective <= self.objective + points.rounding
        return np.asarray(close & (points.mass <= self.mass) & (points.excess <= self.excess))

    def subset(self, programs: np.ndarray) -> "Optimum":
        bound = None if self.mass_bound is None else self.mass_bound[programs]
        return Optimum(self.objective[programs], self.mass[programs], self.excess[programs], bound)


def leave_empty(
    statement: Statement,
    solutions: Solutions,
    share: Real,
    least_mass: bool,
    unreachable: np.ndarray | None = None,
    until: float = np.inf,
) -> None:
    """Take dust away in place from answers of N programs, as far as they stay optima.

    Parameters
    ----------
    solutions : proven optima, or points of which less is proven, which get no worse then.
    share : (N,) how far above the smallest objective an optimum may be.
    unreachable : (N,) bool, programs that stay as they are: without any of the webs what comes closest to the ceilings
        is no closer. None is none.
    until : time.thread_time() after which no web is tried any more: each is a solve of its own.
    """
    if statement.limits.radius.shape[-1] < 2:
        return
    if all_true(solutions.clean) or time.thread_time() >= until:
        return
    unclean = np.flatnonzero(~solutions.clean if unreachable is None else ~(solutions.clean | unreachable))
    masses = np.abs(solutions.unbalance[unclean]) / statement.limits.radius[unclean]
    programs = unclean[np.logical_or.reduce(dust(masses), axis=-1)]
    if not programs.size:
        return
    dusty, part = statement.subset(programs), share[programs]
    old = points_at(dusty, solutions.unbalance[programs])
    close = solutions.lower_bound[programs] + TARGET * part - old.rounding
    bound = solutions.mass_lower_bound[programs]
    optimum = Optimum(
        # no further than what is proven of the mass holds, which is no limit where that does not count
        np.maximum(np.minimum(close, solutions.mass_target[programs]), old.objective),
        np.maximum(old.mass, bound / (1.0 - _HEAVIER)) if least_mass else np.full(programs.size, np.inf),
        np.maximum(old.excess, CEILING_ROUNDING),
        bound if least_mass else None,
    )
    # most can do without all their dust: so first all at once; of alike webs some may have dust, but not all
    empty = _dusty(dusty, old.unbalance)
    own = np.flatnonzero(np.logical_or.reduce(empty, axis=-1))
    if not own.size:
        return
    subset = dusty if own.size == programs.size else dusty.subset(own)
    new, success = _without(subset, empty[own], optimum.subset(own), part[own], least_mass)
    final = success & ~has_dust(subset.limits, new.unbalance)
    _put(solutions, programs[own[final]], new.subset(final))
    for k in (~final).nonzero()[0].tolist():
        place, n = np.array([k]), own[[k]]
        best = _emptied(
            subset.subset(place), old.subset(n), new.subset(place) if success[k] else None, empty[n],
            optimum.subset(n), part[n], least_mass, until,
        )  # fmt: skip
        _put(solutions, programs[n], best)


def _put(solutions: Solutions, programs: np.ndarray, points: Points) -> None:
    """Points as the answers of some of the programs."""
    solutions.unbalance[programs], solutions.objective[programs] = points.unbalance, points.objective
    solutions.mass[programs], solutions.excess[programs] = points.mass, points.excess
    solutions.clean[programs] = False


def _emptied(
    program: Statement,
    old: Points,
    new: Points | None,
    pattern: np.ndarray,
    optimum: Optimum,
    share: Real,
    least_mass: bool,
    until: float,
) -> Points:
    """One point with as many empty webs as an optimum allows, all at once or one by one.

    Parameters
    ----------
    new : the same without those of a pattern (1, K), the dust; None where it is no optimum.
    """
    best, empty = old, np.zeros(pattern.shape, bool)
    for number in range(_ROUNDS):
        if time.thread_time() >= until:
            return best
        nothing = pattern if number == 0 else _dusty(program, best.unbalance)
        if not nothing.any():
            return best
        if number:
            point, success = _without(program, empty | nothing, optimum, share, least_mass)
            new = point if success[0] else None
        if new is None:
            break
        best, empty = new, empty | nothing
    mass = np.abs(best.unbalance[0]) / program.limits.radius[0]
    for web in np.argsort(mass):
        if time.thread_time() >= until:
            break
        nothing = _dusty(program, best.unbalance)
        if nothing[0, web]:
            alone = nothing & _unit(program, int(web))
            point, success = _without(program, empty | alone, optimum, share, least_mass)
            if success[0]:
                best, empty = point, empty | alone
    return best


def _dusty(programs: Statement, u: Complex) -> np.ndarray:
    """Webs of N points that carry next to nothing (N, K) bool, of alike ones all or none."""
    nothing, alike = dust(np.abs(u) / programs.limits.radius), programs.limits.alike
    return nothing if alike is None else (alike.summed(1.0 * nothing) == alike.count)[..., alike.owner]


def _unit(program: Statement, web: int) -> np.ndarray:
    """Webs (K,) that are alike with one."""
    alike = program.limits.alike
    owner = np.arange(program.limits.radius.shape[-1]) if alike is None else alike.owner
    return np.asarray(owner == owner[web])


def _without(
    programs: Statement, empty: np.ndarray, optimum: Optimum, share: Real, least_mass: bool
) -> tuple[Points, np.ndarray]:
    """Points of N programs without some webs (N, K) bool, and whether they are optima (N,) bool.

    These webs stay in the programs, which have one shape then, and may carry nothing.
    """
    best, success = points_at(programs, np.zeros(empty.shape, complex)), np.zeros(share.size, bool)
    if not suits_kernel(programs):
        return best, success
    nothing = replace(programs.limits, max_mass=np.where(empty, 0.0, programs.limits.max_mass))
    part, left = replace(programs, limits=nothing), _WITH_ROOM * share
    bare, reference, whole, numbers = part, optimum, programs, np.arange(share.size)
    for _ in range(2):
        smallest, lightest = (points_at(bare, end) for end in ends(bare, left, least_mass))
        room = _WITH_ROOM * (reference.objective - smallest.objective)
        point = snap_to_limits(bare, lightest if least_mass else smallest, reference.objective, reference.mass_bound)
        new = points_at(whole, np.where(empty[numbers], 0.0, point.unbalance))
        admitted = reference.admits(new)
        best.put(numbers, new)
        success[numbers] = admitted
        # the smallest objective without these webs is larger, and what is left for the mass is less
        again = ~admitted & (room > 0.0) & least_mass
        numbers, left = numbers[again], room[again]
        if not numbers.size:
            break
        bare, reference, whole = part.subset(numbers), optimum.subset(numbers), programs.subset(numbers)
    return best, success
