"""Certified optimum of a program over the turn by cuts: its goals one after the other, then the least mass."""

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.cuts.cut import Pool
from optimizer.program.cuts.empty_webs import EmptyWebs
from optimizer.program.cuts.proof import Proof, times
from optimizer.program.cuts.rounding import snap_turn_to_limits
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.cuts.stage import Levels, Point, Search, StageEnd
from optimizer.program.limits import Limits
from optimizer.program.methods.implied_bounds import bounded, far_limits
from optimizer.program.methods.semicontinuous_bounds import within_semicontinuous_reach
from optimizer.program.solution import CEILING_ROUNDING, OPTIMUM_SHARE
from optimizer.program.statement import Statement

METHOD = "cuts, clarabel"
#: of a search without a time limit in the request
TIME_LIMIT_S = 5.0

#: room below the ceilings, as a share of their size, that lets them be kept as they are
_AMPLE = 1e-8
#: room that makes a point without counterweights one to start from
_ROOMY = 1e-3
#: gap of the smallest excess that is good enough
_PRINTED = 1e-12
#: the smallest objective is sought this much more sharply than the tolerance between optima, before another stage;
#: the second where the mass is so steep that the first leaves it open
_SHARPNESS = (1e-2, 1e-4)
#: share of the target gap that the last stage aims at
_ENOUGH = 0.5
#: share of what optima may differ by that is kept for the figures of the answer
_RESERVE = 5e-3
#: of a goal that is kept, what is left for the rounding of masses and angles and for the brackets by which it is judged
_RESERVED = 1e-11
#: of what the stage before has left open, what a later stage leaves unused so that its point is an optimum
_TARGET_MARGIN = 0.2
#: relative gap of the mass that ends the search, and that is good enough
_MASS_GAP, _LIGHT = 1e-5, 5e-5


class GoalLevel(NamedTuple):
    """What a goal came to, and what is proven of it."""

    goal: str
    value: float
    proof: Proof
    most: float  # that it may come to for what follows
    unbalance: Complex  # (K,) kg m, of the counterweights that come to the value

    @property
    def lower_bound(self) -> float:
        return self.proof.bound


@record(frozen=True)
class CertifiedOptimum:
    """Counterweights with their proof; the last goal is the objective."""

    point: Point
    goals: tuple[GoalLevel, ...]
    mass_proof: Proof | None  # None where the least mass was not sought
    mass_target: float  # largest objective that the proof of the mass counts as an optimum
    limits: Limits  # that the proofs count with
    certify_s: float  # time spent on bounds
    method: str = METHOD
    rounds: int = 0
    cuts: int = 0
    contradicted: bool = False  # a point exceeds the ceilings by less than any is proven to
    timed_out: bool = False  # the time limit ended a search

    @property
    def proof(self) -> Proof:
        """Of the objective."""
        return self.goals[-1].proof

    @property
    def every_unbalance(self) -> tuple[Complex, ...]:
        """Of the counterweights themselves, and of those that a goal came to its value with."""
        return (self.point.unbalance, *(goal.unbalance for goal in self.goals))

    def certain(self) -> "CertifiedOptimum":
        """This one, where there has to be one."""
        return self

    def counting(self, value: float) -> "CertifiedOptimum":
        """With the mass proven for all that come to no more than this value: that of counterweights which rounding has
        put above what was counted as an optimum, or with which the time has ended."""
        if value <= self.mass_target:
            return self
        # that no mass is below 0 holds of all
        of_mass = None if self.mass_proof is None else self.mass_proof.up_to(value - self.mass_target)
        return replace(self, mass_proof=of_mass, mass_target=value)

    def within(self, limits: Limits) -> "CertifiedOptimum":
        """With limits that say the same by other radii: those of what is cut from plates."""
        goals = tuple(goal._replace(proof=goal.proof.within(limits)) for goal in self.goals)
        of_mass = self.mass_proof
        if of_mass is not None:
            # one statement stays one: both bounds refer to it
            same = of_mass.statement is self.proof.statement
            of_mass = of_mass.within(limits)
            of_mass = replace(of_mass, statement=goals[-1].proof.statement) if same else of_mass
        return replace(self, goals=goals, mass_proof=of_mass, limits=limits)

    @property
    def mass_gap(self) -> float:
        """Of the mass above its bound, relative to it; inf where nothing is proven."""
        if self.mass_proof is None:
            return np.inf
        return (self.point.mass - self.mass_proof.bound) / self.point.mass if self.point.mass > 0 else 0.0


@record(frozen=True)
class Conflict:
    """Proof that no counterweights keep the ceilings, and those that come closest."""

    closest: Point
    proof: Proof  # of the smallest largest excess, relative to the sizes
    limits: Limits
    certify_s: float
    method: str = METHOD

    def certain(self) -> CertifiedOptimum:
        """Nothing, where there has to be an optimum: without ceilings, or where some counterweights keep them.

        Raises
        ------
        ArithmeticError
            in all cases: the proof contradicts the point.
        """
        raise ArithmeticError(f"an excess of {self.proof.bound:g} is proven where the ceilings are kept")


def over_turn(
    program: Problem,
    relative_gap: float,
    least_mass: bool,
    time_limit_s: float = TIME_LIMIT_S,
) -> CertifiedOptimum | Conflict:
    """Certified optimum of a program over the turn: its goals one after the other, then the least mass.

    Parameters
    ----------
    relative_gap : target gap of the last goal, relative to its yardstick.
    least_mass : take the least total mass among the optima.
    time_limit_s : of this thread's own time, after which the search ends with what it has: what else a machine does
        changes no answer.
    """
    until = time.thread_time() + time_limit_s
    pool = Pool(program.first, program.scatter)
    nearest = _nearest(program, pool, until)
    excess = nearest.point.values.excess
    contradicted = nearest.proof is not None and nearest.proof.bound > excess + CEILING_ROUNDING
    if nearest.proof is not None and nearest.proof.bound > CEILING_ROUNDING and not contradicted:
        return Conflict(nearest.point, nearest.proof, nearest.proof.statement.limits, nearest.certify_s)
    course = _Course(program, pool, nearest, raised=excess > -_AMPLE, contradicted=contradicted, until=until)
    for n, goal in enumerate(program.goals[:-1]):
        size, share = float(program.units[n]), max(goal.allowance, OPTIMUM_SHARE)
        course.keep(n, course.smallest(n, _SHARPNESS[0] * OPTIMUM_SHARE * size), share * size)
    last = len(program.goals) - 1
    size = float(program.units[last])
    if not least_mass:
        course.keep(last, course.smallest(last, _ENOUGH * relative_gap * size), 0.0)
        course.margin[-1] = _TARGET_MARGIN * _SHARPNESS[0] * relative_gap * size
        return course.optimum(None, np.inf, course.goals[last].lower_bound + (1.0 - _RESERVE) * relative_gap * size)
    allowed = program.goals[last].allowance * size
    # a little is kept for the rounding of masses and angles
    share = (1.0 - _RESERVE) * min(OPTIMUM_SHARE, relative_gap) * size
    proof: Proof | None = None
    attempts: list[CertifiedOptimum] = []
    for sharpness in _SHARPNESS:
        proof = course.smallest(last, sharpness * share, proof)
        course.keep(last, proof, max(share, allowed))
        reached = course.goals[last]
        target = (max(reached.value, reached.most) if allowed > share else reached.value) + share
        mass_proof = course.lightest(target, _TARGET_MARGIN * sharpness * share)
        attempts.append(course.optimum(mass_proof, target))
        if attempts[-1].mass_gap <= _LIGHT or course.timed_out or allowed > share:
            break
    # a sharper target can end in a wider gap
    best = min(attempts, key=lambda optimum: optimum.mass_gap)
    return replace(best, rounds=course.rounds, certify_s=course.certify_s, timed_out=course.timed_out)


def next_goal(
    program: Problem, before: Sequence[GoalLevel], u: Complex, relative_gap: float, time_limit_s: float
) -> CertifiedOptimum:
    """Certified optimum of the last goal of a program under levels of the goals before it.

    Parameters
    ----------
    before : all goals but the last, with the most that they may come to.
    u : (K,) kg m, within the limits, that keeps these levels and the ceilings.
    """
    inside = Point(u, program.values(u, _PRINTED), program.mass(u))
    nearest = StageEnd(inside, None, 0, 0.0, False)
    raised, until = inside.values.excess > -_AMPLE, time.thread_time() + time_limit_s
    course = _Course(program, Pool(program.first, program.scatter), nearest, raised, False, until)
    course.goals = list(before)
    last = len(before)
    course.keep(last, course.smallest(last, _ENOUGH * relative_gap * float(program.units[last])), 0.0)
    return course.optimum(None, np.inf)


class _Course:
    """Stages one after the other; each starts from the results of those before."""

    def __init__(
        self, program: Problem, pool: Pool, nearest: StageEnd, raised: bool, contradicted: bool, until: float
    ) -> None:
        self.program, self.pool, self.raised, self.contradicted = program, pool, raised, contradicted
        self.inside, self.so_far, self.until, self.timed_out = nearest.point, program, until, nearest.timed_out
        self.rounds, self.certify_s = nearest.rounds, nearest.certify_s
        self.goals: list[GoalLevel] = []
        self.margin = _TARGET_MARGIN * _SHARPNESS[0] * OPTIMUM_SHARE * program.units

    def smallest(self, n: int, enough: float, proof: Proof | None = None) -> Proof:
        """Make a goal small under those before it."""
        so_far = self.program.changed(goals=self.program.goals[: n + 1])
        self.inside, most = _again(so_far, self.inside), self._most(n)
        # the least mass after the last goal may be where that comes to more
        last = n + 1 == len(self.program.goals)
        room = self.program.goals[n].allowance * float(self.program.units[n]) if last else 0.0
        self.so_far = _bounded(so_far, self.inside, most, room)
        margin = _TARGET_MARGIN * _SHARPNESS[0] * OPTIMUM_SHARE * self.program.units[:n]
        result = self._run(Levels(margin, most - _RESERVED * self.program.units[:n], most), enough)
        assert result is not None  # rest proves something of every objective
        return result if proof is None or result.bound > proof.bound else proof

    def keep(self, n: int, proof: Proof, share: float) -> None:
        """What a goal may come to from now on: so much above its bound."""
        value = float(self.inside.values.goals[n])
        most = max(value, proof.bound + share)
        if n + 1 < len(self.program.goals):
            most += _RESERVED * float(self.program.units[n])
        self.goals[n:] = [GoalLevel(self.program.goals[n].name, value, proof, most, self.inside.unbalance)]

    def lightest(self, target: float, margin: float) -> Proof | None:
        """The least mass under all goals.

        Parameters
        ----------
        target : of the last goal, what the bound counts as an optimum.
        margin : by which the solver aims below what the last goal may come to.
        """
        most = self._most(len(self.goals))
        margins = _TARGET_MARGIN * _SHARPNESS[0] * OPTIMUM_SHARE * self.program.units
        margins[-1] = margin
        self.margin = margins
        reserved = _RESERVED * self.program.units
        reserved[-1] = 0.0
        return self._run(Levels(margins, most - reserved, np.append(most[:-1], target)), _MASS_GAP)

    def optimum(self, mass_proof: Proof | None, target: float, loosest: float = -np.inf) -> CertifiedOptimum:
        """What the course has come to.

        Parameters
        ----------
        target : largest objective that the proof of the mass counts as an optimum.
        loosest : what the last goal may come to where webs are left empty for it.
        """
        most = self._most(len(self.goals))
        bound = None if mass_proof is None else mass_proof.bound
        point = snap_turn_to_limits(self.program, self.so_far.begun, self.inside, most, bound, _PRINTED)
        most[-1] = max(most[-1], loosest)
        empty_webs = EmptyWebs(
            self.so_far,
            self.so_far.begun,
            self.pool,
            most,
            self.margin,
            bound,
            self.raised,
            self.until,
            _MASS_GAP,
            _PRINTED,
        )
        return CertifiedOptimum(
            empty_webs.leave(point),
            tuple(self.goals),
            mass_proof,
            target,
            self.so_far.limits,
            self.certify_s,
            rounds=self.rounds,
            cuts=self.pool.count(),
            contradicted=self.contradicted,
            timed_out=self.timed_out,
        )

    def _most(self, n: int) -> Real:
        return np.array([goal.most for goal in self.goals[:n]])

    def _run(self, levels: Levels, enough: float) -> Proof | None:
        stage = Search(self.so_far, self.pool, levels, self.inside, self.raised, self.until).run(enough)
        self.timed_out |= stage.timed_out
        self.inside, self.rounds = stage.point, self.rounds + stage.rounds
        self.certify_s += stage.certify_s
        return stage.proof


def _rest(program: Problem) -> Point:
    return Point(np.zeros(program.limits.radius.shape, complex), program.at_rest, 0.0)


def _nearest(program: Problem, pool: Pool, until: float) -> StageEnd:
    """A point with room below the ceilings, or the one that comes closest to keeping them with the proof of that."""
    rest = _rest(program)
    if not (program.ceilings or program.limited) or rest.values.excess <= -_ROOMY:
        return StageEnd(rest, None, 0, 0.0, False)
    excess = program.excess()
    still = _rest(excess)
    excess = _bounded(excess, still, np.zeros(0))
    none = np.zeros(0)
    end = Search(excess, pool, Levels(none, none, none), still, False, until).run(
        _PRINTED, lambda value, bound: bound > CEILING_ROUNDING or value <= -max(_AMPLE, 0.5 * -bound)
    )
    return end._replace(point=_again(program, end.point))


def _again(program: Problem, point: Point) -> Point:
    """A point with what it comes to in another program."""
    values = None if np.any(point.unbalance) else program.at_rest
    return replace(point, values=values or program.values(point.unbalance, _PRINTED))


def semicontinuous_limits(program: Problem, least: Real, most: Real) -> Limits:
    """Finite limits that hold some best choice of counterweights that are at least so heavy where they are fitted.

    What no optimum of any masses needs, those may: limits of :func:`over_turn` are not theirs.

    Parameters
    ----------
    least : (K,) kg, of what is fitted; 0 where there is none.
    most : (goals,) values of the goals at some choice that keeps the ceilings; inf without such a choice.
    """
    statement = _telling(program)
    return within_semicontinuous_reach(statement, least, _level(program, most)).limits


def _telling(program: Problem) -> Statement:
    """What tells all that counterweights change, in units of the goals."""
    telling = program.begun if program.telling is program.first else program.outer(program.telling)
    return times(telling, 1.0 / program.units[program.goal_of])


def _level(program: Problem, most: Real) -> float:
    """What the objective of that comes to at most where the goals come to no more."""
    # no point that is no larger has a larger sum in any case
    return 2.0 * float(np.sum((most / program.units)[program.goal_of_case]))


def _bounded(program: Problem, inside: Point, most: Real, room: float = 0.0) -> Problem:
    """The program with a finite limit for every web (reach.py), proven for all that is no larger than a point, or by so
    much in the last goal."""
    statement = _telling(program)
    if not np.any(far_limits(statement)):
        return program
    levels = np.append(most, inside.values.goals[most.size] + room)
    reached = bounded(statement, _level(program, levels)).limits
    if program.plates is not None:
        # of these the reach is stated, and speaks of the mass as if it were a multiple
        max_mass = reached.max_mass.copy()
        max_mass[program.plates.webs] = program.limits.max_mass[program.plates.webs]
        reached = replace(reached, max_mass=max_mass)
    return program.changed(limits=reached)
