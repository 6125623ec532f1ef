"""The whole program for one machine: smallest objective, ceilings, least mass."""

import time
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from optimizer.arrays import Complex
from optimizer.program.certificate import (
    Multipliers,
    ceiling_allowance,
    mass_lower_bound,
    nothing_proven,
    objective_lower_bound,
)
from optimizer.program.fast import ENOUGH, ENOUGH_FOR_MASS, MASS_ENOUGH, Fast, fast, pulled
from optimizer.program.kernel.finer_numbers import PRECISIONS, Precision
from optimizer.program.polish import (
    mass_multipliers,
    objective_multipliers,
    resting_multipliers,
    supporting_multipliers,
)
from optimizer.program.reach import bounded, far_limits
from optimizer.program.reference.solver import Solver, proven
from optimizer.program.solution import CEILING_ROUNDING, INTERIOR_POINT, OPTIMUM_SHARE, Solution, evaluated
from optimizer.program.statement import CEILING_TOLERANCE, Statement
from optimizer.program.verdict import yardstick

#: the smallest objective is sought this much more sharply than optima are told apart
_SHARPNESS = 1e-4
#: relative gap of the least mass that ends the search
_MASS_GAP = 1e-6


#: room below the ceilings, as a share of their size, from which on they are kept as they are
_AMPLE = 1e-8
#: by which they are raised otherwise: what is left of their tolerance is for rounding
_RAISED = CEILING_TOLERANCE - CEILING_ROUNDING
#: gap of the smallest excess that is good enough
_TOLD = 1e-13


#: how often the least mass is sought again in units of the least so far, and what a web may carry of it then
_LIGHTENINGS, _ROOM_FOR_MASS = 8, 4.0
#: and the share of a limit below which that is another program
_WORTH_LESS = 0.1


class _Asked(NamedTuple):
    """What is asked of a program."""

    share: float  # how far above the smallest objective an optimum may be, in units of the objective
    demand: float  # certified gap
    least_mass: bool


@dataclass(frozen=True)
class Unreachable:
    """Proof that no counterweights keep the ceilings, and those that come closest."""

    closest: Complex  # (K,) kg m
    excess: float  # largest relative excess over a ceiling of the closest
    excess_lower_bound: float  # > 0
    certify_s: float  # time spent on bounds
    multipliers: Multipliers  # of the excess: rows and terms are those of the ceilings, each over its size


def suits_kernel(statement: Statement) -> bool:
    """Whether the compiled interior point takes such programs: one group, real influences. Others are cone programs."""
    influences = (statement.norms.influence, statement.ceilings.norms.influence)
    return bool(statement.group[-1] == 0 and not any(np.iscomplexobj(each) for each in influences))


def within_reach(statement: Statement, solver: Solver) -> Statement:
    """One program with a finite, proven limit where there is none, or one far beyond any need (reach.py)."""
    if not np.any(far_limits(statement)):
        return statement
    point = np.zeros(statement.limits.radius.shape, complex)
    if np.any(statement.ceilings.excess(point) > 0):
        excess = statement.excess()
        excess = bounded(excess, _above(excess, point))
        nearest = solver.smallest_objective(excess, 0.1 * CEILING_TOLERANCE)
        if nearest.lower_bound > 0:
            return replace(statement, limits=excess.limits)
        point = nearest.unbalance
        if nearest.objective > CEILING_TOLERANCE:
            return bounded(statement, np.inf)
    return bounded(statement, _above(statement, point))


def _above(statement: Statement, point: Complex) -> float:
    """A level that leaves room for all that counts as an optimum, if this point may be reached."""
    value = float(statement.objective(point))
    return value + (value - float(np.sum(-statement.largest(-statement.floor))))


def optimum(
    statement: Statement, relative_gap: float, least_mass: bool, solver: Solver, known: Fast | None = None
) -> Solution | Unreachable:
    """Certified optimum of a statement; webs that cannot carry anything are left out of the program.

    Parameters
    ----------
    statement : one whose limits are finite (:func:`within_reach`).
    relative_gap : asked gap, relative to the objective without counterweights.
    least_mass : take the least total mass among the optima.
    known : what the compiled method has found for this program, as the only one of a leading axis (1,).

    Returns
    -------
    Solution, whose gap tells how far it is certified and whose excess whether the ceilings are kept
    (if neither could be decided, on the very boundary, they are not); or the proof that they cannot be.
    """
    webs = statement.limits.reach > 0
    part = statement.only(webs)
    size = float(yardstick(part))
    asked = _Asked(min(OPTIMUM_SHARE, relative_gap) * size, relative_gap * size, least_mass)
    whole = webs.size > 0 and bool(np.all(webs))
    quick = _taken(part, asked, known) if known is not None and whole else _interior_point(part, asked)
    found: Solution | Unreachable = quick.lightest
    if not quick.certified and part.ceilings.names:
        found = _under_ceilings(part, asked, solver, quick)
    elif not quick.certified:
        found = _by_all(part, asked, solver, quick)
    if isinstance(found, Unreachable):
        return replace(found, closest=_everywhere(found.closest, webs))
    found = replace(found, unbalance=_everywhere(found.unbalance, webs))
    if least_mass and found.mass_multipliers is None:
        # nothing is proven about the mass but that it is not below 0
        found = replace(found, mass_multipliers=nothing_proven(part), mass_target=found.objective + asked.share)
    return found


def _under_ceilings(statement: Statement, asked: _Asked, solver: Solver, quick: "_Found") -> Solution | Unreachable:
    """With ceilings: first whether they can be kept, and with how much room (docs/mathematics.md section 9)."""
    nearest = _smallest_excess(statement, solver)
    if nearest.lower_bound > CEILING_ROUNDING:
        assert nearest.multipliers is not None  # they are what proves the bound
        return Unreachable(
            nearest.unbalance, nearest.objective, nearest.lower_bound, nearest.certify_s, nearest.multipliers
        )
    if asked.least_mass and (rest := _at_rest(statement, asked, quick.smallest)):
        return replace(rest, certify_s=rest.certify_s + nearest.certify_s)
    if nearest.objective <= -_AMPLE:
        found = _by_all(statement, asked, solver, quick, nearest.unbalance, precisions=())
        if _proven(found, asked):
            return replace(found, certify_s=found.certify_s + nearest.certify_s)
    # what stands on the edge, or is too steep to be proven, takes up the tolerance of its ceilings
    raised = replace(statement, ceilings=statement.ceilings.raised(_RAISED))
    quick = _interior_point(raised, asked)
    found = quick.lightest if quick.certified else _by_all(raised, asked, solver, quick, nearest.unbalance)
    return _proven_again(statement, replace(found, certify_s=found.certify_s + nearest.certify_s))


def _at_rest(statement: Statement, asked: _Asked, known: Solution) -> Solution | None:
    """No counterweights, where they are an optimum but for the tolerance of the ceilings: nothing is lighter."""
    rest = known.moved_to(statement, np.zeros_like(known.unbalance))
    if not rest.keeps_ceilings or rest.below_ceilings:
        return None
    rest = replace(rest, mass_lower_bound=0.0, mass_multipliers=nothing_proven(statement))
    rest = replace(rest, mass_target=rest.objective + asked.share)
    assert known.multipliers is not None  # those of rest, at least
    allowance = ceiling_allowance(statement, known.multipliers, statement.ceilings.excess(rest.unbalance))
    return rest if rest.gap + float(allowance) <= asked.share else None


def _proven_again(statement: Statement, found: Solution) -> Solution:
    """The same point with its bounds, both for the ceilings that were asked for."""
    found = found.moved_to(statement, found.unbalance)
    if found.multipliers is not None:
        found = replace(found, lower_bound=float(objective_lower_bound(statement, found.multipliers)))
    if found.mass_multipliers is not None:
        target = np.asarray(found.mass_target)
        found = replace(found, mass_lower_bound=float(mass_lower_bound(statement, found.mass_multipliers, target)))
    return found


def _smallest_excess(statement: Statement, solver: Solver) -> Solution:
    """The smallest largest excess over the ceilings, as far as its sign and the room below them are told."""
    program = statement.excess()
    asked = _Asked(CEILING_TOLERANCE, CEILING_TOLERANCE, False)
    found = _interior_point(program, asked).lightest
    return found if _tells(found) else solver.smallest_objective(program, _TOLD, found, _tells)


def _tells(excess: Solution) -> bool:
    return excess.lower_bound > CEILING_ROUNDING or excess.objective <= -_AMPLE or excess.gap <= _TOLD


def _by_all(
    statement: Statement,
    asked: _Asked,
    solver: Solver,
    quick: "_Found",
    inside: Complex | None = None,
    precisions: tuple[Precision, ...] = PRECISIONS,
) -> Solution:
    """One method after the other, each with what is known already.

    Parameters
    ----------
    inside : a point as far below the ceilings as there is.
    """
    quick = _lightened(statement, asked, _polished(statement, asked, quick, inside))
    if quick.certified:
        return quick.lightest
    first = solver.smallest_objective(statement, _SHARPNESS * asked.share, quick.smallest)
    if asked.least_mass and first.below_ceilings:
        first = solver.least_mass(statement, first, asked.share, _MASS_GAP, quick.lightest)
    found = first
    for precision in precisions:
        few = 0 < statement.limits.radius.size <= precision.most_webs
        if _proven(found, asked) or not few or not suits_kernel(statement):
            break
        fine = _polished(statement, asked, _interior_point(statement, asked, precision), inside)
        fine = _lightened(statement, asked, fine, precision)
        found = fine.lightest if fine.certified else _better_of(found, fine.lightest, asked.share)
    return found


def _polished(statement: Statement, asked: _Asked, found: "_Found", inside: Complex | None) -> "_Found":
    """The same with points below the ceilings and sharper multipliers, which is often all that is missing."""
    if statement.limits.radius.size == 0 or found.certified:
        return found
    began = time.perf_counter()
    smallest, lightest = (_pulled(statement, each, inside) for each in (found.smallest, found.lightest))
    assert smallest.multipliers is not None  # those of rest, at least
    for multipliers in objective_multipliers(statement, smallest.unbalance, smallest.multipliers):
        bound = float(objective_lower_bound(statement, multipliers))
        smallest, lightest = smallest.bounded(bound, multipliers), lightest.bounded(bound, multipliers)
    if asked.least_mass and smallest.below_ceilings:
        counted = np.asarray(smallest.objective + asked.share)
        candidates = [supporting_multipliers(statement, lightest.unbalance)] if np.any(lightest.unbalance) else []
        if lightest.mass_multipliers is not None:
            candidates += mass_multipliers(statement, lightest.unbalance, lightest.mass_multipliers)
        for multipliers in candidates:
            bound = float(mass_lower_bound(statement, multipliers, counted))
            lightest = lightest.weighed(bound, multipliers, float(counted))
    enough = (ENOUGH_FOR_MASS if asked.least_mass else ENOUGH) * asked.share
    certified = smallest.gap <= enough and lightest.below_ceilings and lightest.gap <= asked.share
    certified &= not asked.least_mass or _light(lightest)
    spent = time.perf_counter() - began
    smallest, lightest = (replace(each, certify_s=each.certify_s + spent) for each in (smallest, lightest))
    return _Found(smallest, lightest, certified)


def _lightened(statement: Statement, asked: _Asked, found: "_Found", precision: Precision | None = None) -> "_Found":
    """The least mass again, in units of the least so far: where next to nothing has to be fitted, all else is far away.

    No web carries more than all of them together in anything lighter.
    """
    if found.certified or not asked.least_mass or statement.limits.radius.size == 0:
        return found
    for _ in range(_LIGHTENINGS):
        before = found.lightest
        if not (before.below_ceilings and before.gap <= asked.share) or _light(before):
            break
        limits = statement.limits
        if not np.any(_ROOM_FOR_MASS * before.mass < _WORTH_LESS * np.minimum(limits.max_mass, limits.max_total_mass)):
            break
        near = replace(limits, max_mass=np.minimum(limits.max_mass, _ROOM_FOR_MASS * before.mass))
        again = _interior_point(replace(statement, limits=near), asked, precision).lightest
        if again.below_ceilings and again.objective <= before.lower_bound + asked.share and again.mass < before.mass:
            lightest = before.moved_to(statement, again.unbalance)
        else:
            lightest = before
        lightest = replace(lightest, mass_multipliers=again.mass_multipliers, mass_lower_bound=0.0)
        polished = _polished(statement, asked, _Found(found.smallest, lightest, False), None)
        weighed = polished.lightest.weighed(before.mass_lower_bound, before.mass_multipliers, before.mass_target)
        found = _Found(polished.smallest, weighed, polished.certified)
        if found.certified or weighed.mass > 0.5 * before.mass:
            break
    return found


def _pulled(statement: Statement, found: Solution, inside: Complex | None) -> Solution:
    """A point above a ceiling, moved towards one below it just so far; excesses are convex."""
    if inside is None or found.below_ceilings:
        return found
    return found.moved_to(statement, pulled(statement, found.unbalance, inside))


def _proven(found: Solution, asked: _Asked) -> bool:
    """Whether finer numbers are not worth their time."""
    proven = found.below_ceilings and found.gap <= asked.share
    return proven and (not asked.least_mass or _light(found))


def _light(found: Solution) -> bool:
    """Whether the mass is proven as well as is worth any time."""
    return found.mass - found.mass_lower_bound <= MASS_ENOUGH * found.mass


def _better_of(one: Solution, other: Solution, share: float) -> Solution:
    """The better point with the better bound on the objective; of two optima the lighter one."""
    one = one.bounded(other.lower_bound, other.multipliers)
    if not other.below_ceilings:
        return one
    bound = one.lower_bound
    both_optimal = max(one.objective, other.objective) - bound <= share
    lighter = other.mass < one.mass
    chosen = other if not one.below_ceilings or (lighter if both_optimal else other.objective < one.objective) else one
    # a bound on the mass holds for its own first stage only, unless that stage was the worse one
    heavier = other if other.mass_lower_bound > one.mass_lower_bound else one
    proof = heavier if both_optimal else chosen
    return replace(
        chosen.bounded(bound, one.multipliers),
        mass_lower_bound=proof.mass_lower_bound,
        mass_multipliers=proof.mass_multipliers,
        mass_target=proof.mass_target,
    )


class _Found(NamedTuple):
    """What the interior point found."""

    smallest: Solution
    lightest: Solution
    certified: bool


def _interior_point(statement: Statement, asked: _Asked, precision: Precision | None = None) -> _Found:
    radius = statement.limits.radius
    if radius.size == 0 or not suits_kernel(statement):
        resting = evaluated(statement, np.zeros(radius.shape, complex))
        resting = proven(statement, resting, resting_multipliers(statement))
        return _Found(resting, resting, False)
    found = fast(statement.alone(), np.array([asked.share]), np.array([asked.demand]), asked.least_mass, precision)
    return _taken(statement, asked, found, precision.name if precision else INTERIOR_POINT)


def _taken(statement: Statement, asked: _Asked, found: Fast, method: str = INTERIOR_POINT) -> _Found:
    """The only answer of a leading axis."""
    nothing = Solution(
        found.smallest[0],
        np.inf,
        float(found.lower_bound[0]),
        np.inf,
        0.0,
        np.inf,
        method,
        found.certify_s,
        found.multipliers.chosen(0),
    )
    smallest = nothing.moved_to(statement, found.smallest[0])
    lightest = smallest
    if asked.least_mass:
        lightest = replace(
            smallest,
            # what exceeds the ceilings has an objective below the smallest: too few would count as optima
            mass_lower_bound=float(found.mass_lower_bound[0]) if smallest.below_ceilings else 0.0,
            mass_multipliers=found.mass_multipliers.chosen(0),
            mass_target=float(found.mass_target[0]),
        )
    return _Found(smallest, lightest.moved_to(statement, found.unbalance[0]), bool(found.certified[0]))


def _everywhere(u: Complex, webs: np.ndarray) -> Complex:
    everywhere = np.zeros(webs.shape, complex)
    everywhere[webs] = u
    return everywhere
