"""One stage of a program over the turn, by cuts: the smallest last goal, or the least mass, under what is kept.

Finitely many cuts of every quantity make a statement that clarabel solves as matrices. Its multipliers prove a lower
bound for all angles, since no u makes a quantity smaller than its cuts; the upper figure comes from brackets of the
true peaks. Where the two differ, the cuts at the brackets' peaks are added, and slack ones removed. So the certified
gap tells when to stop, and not the solver.
"""

import time
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.cuts.attempts import FREELY, WITHIN, Attempt
from optimizer.program.cuts.cut import Evaluation, Pool
from optimizer.program.cuts.proof import Proof, proofs, resting_proof, times, units
from optimizer.program.cuts.semi_infinite import Problem, Values
from optimizer.program.plate_pieces import Pieces, Plates, first_nodes, nodes_about, pieces, tangents
from optimizer.program.reference.assembled import GroupLimit, NoPoint, solved
from optimizer.program.scaled_program import Stage
from optimizer.program.scaling import natural_reach, scale
from optimizer.program.solution import CEILING_ROUNDING, NEGLIGIBLE
from optimizer.program.statement import Statement

#: rounds of a stage before it ends with what is proven
_MOST_ROUNDS = 60
#: limits beyond this multiple of the natural reach cannot bind
_REACH = 10.0
#: for what has begun when time is up
_LAST_S = 1e-2
#: no bracket is left wider
_COARSE = 1e-4
#: share of a gap from which on it is the solver that leaves it open
_LOST = 0.5
#: share of the target gap that brackets may leave open
_OPEN = 0.1
#: by this share of their size ceilings are lowered, so that the answer keeps them; raised on the edge of what can be
_LOWERED, _RAISED = 2e-10, CEILING_TOLERANCE - 2e-10
#: so much more than points missed their levels by is aimed lower next time
_MISSED = 1.5
#: so far towards a point inside the ceilings a point is moved at least that exceeds them
_NARROWEST = 1e-12
#: share of a goal below which points do not keep what is aimed at
_LEAST_MARGIN = 1e-12
#: share of the mass of a plate that its tangents may lack: of a mass that is proven to 1e-5, and of one to be kept
_LIGHTER, _WITHIN_BUDGET = 1e-7, 1e-10
#: relative width of the brackets of a point that may be the answer, and of one that only just keeps what it has to
_JUDGED, _CLOSE = 5e-11, 1e-12


@record(frozen=True)
class Levels:
    """Levels of goals that come first, (goals,) each."""

    margin: Real  # by which the solver aims lower
    most: Real  # that the point keeps
    of_bound: Real  # that the bound counts with


@record(frozen=True)
class Point:
    """Counterweights and what they come to."""

    unbalance: Complex  # (K,) kg m
    values: Values
    mass: float  # kg


class _Promise(NamedTuple):
    """What a point comes to at least."""

    figure: float
    unbalance: Complex  # (K,) kg m


class StageEnd(NamedTuple):
    """What one stage came to."""

    point: Point
    proof: Proof | None  # None where nothing is proven, which can only be so of a mass
    rounds: int
    certify_s: float  # time spent on bounds
    timed_out: bool  # the time limit ended the search


class Search:
    """One stage: the last goal of a program, or the mass, under what is kept."""

    def __init__(self, program: Problem, pool: Pool, levels: Levels, inside: Point, raised: bool, until: float) -> None:
        """Prepare.

        Parameters
        ----------
        levels : those of all goals but the last, or of all where the mass is to be small.
        inside : a point that keeps all that has to be kept.
        raised : ceilings take up the tolerance that they have.
        until : time.thread_time() at which the search ends.
        """
        self.until = until
        self.program, self.pool, self.levels, self.inside = program, pool, levels, inside
        self.of_mass = levels.most.size == len(program.goals)
        self.raised = raised
        # nothing has to be kept, nor is it one that is measured by 1: an excess over ceilings, the trade of a front
        self.free = not (levels.most.size or program.ceilings or program.limited or program.goals[-1].unit)
        self.allowed = CEILING_TOLERANCE if raised else CEILING_ROUNDING
        #: of which tangents are laid: without a budget the mass counts where it is to be small
        budget = bool(np.isfinite(program.limits.max_total_mass))
        self.plates = program.plates if self.of_mass or budget else None
        self.lighter = _WITHIN_BUDGET if budget else _LIGHTER
        self.unit = units(program)
        statement = times(program.begun, 1.0 / self.unit[program.goal_of])
        needed = 2.0 * float(np.max(np.abs(inside.unbalance), initial=0.0))
        largest = float(np.max(program.limits.reach, initial=0.0))
        natural = float(natural_reach(statement))
        self.clip = min(max(_REACH * natural, needed), largest) if natural > 0 else largest
        self.certify_s = 0.0
        self.margin = levels.margin  # that is aimed at, no more than what is small can bear
        self.price = np.zeros(levels.margin.size)  # of what is kept, in units of what is small
        self.aimed = levels.most  # levels of the last program for the solver
        self.missed = np.zeros(levels.most.size)  # by what its points were above them
        self.about: Real | None = None  # variables of the last program
        self.near: Point | None = None  # the last one that kept all
        self.beyond: Point | None = None  # the last one that did not

    def run(self, enough: float, stop: Callable[[float, float], bool] = lambda value, bound: False) -> StageEnd:
        """Rounds until the gap is small enough, or nothing more is to be had.

        Parameters
        ----------
        enough : gap that ends the search, in the goal's unit; of a mass relative to it.
        stop : whether a value and its bound are enough to end the search.
        """
        statement = self._statement()
        best, proof = self.inside, self._closed(None, statement)
        attempts, gap = list(FREELY if self.free else WITHIN), np.inf
        rounds, timed_out = 0, False
        # the best sample without brackets: rounds that follow may wander off where optima are many
        promised = none = _Promise(np.inf, best.unbalance)
        while attempts and rounds < _MOST_ROUNDS and not self._late():
            rounds += 1
            solution = self._solved(statement, attempts[0])
            if solution is None:
                attempts = attempts[1:]
                continue
            u, proven = solution
            for candidate in proven:
                proof = candidate if proof is None or candidate.bound > proof.bound else proof
            self._spare(enough * (best.mass if self.of_mass else 1.0))
            bound = -np.inf if proof is None else proof.bound
            matters, mass = self._matters(statement, u), self._mass(u)
            # samples never exceed the true value: while they are above the level no bracket is computed
            lower_values, places = self.program.sample_values(u, matters)
            figure = self._promise(Point(u, lower_values, mass))
            promised = min(promised, _Promise(figure, u), key=lambda promise: promise.figure)
            gap = figure - bound
            lost = (
                self.free
                and self._stated_goals(statement, u)[-1] - max(candidate.bound for candidate in proven) > _LOST * gap
            )
            if (
                gap > self._gap_limit(enough, best)
                and not stop(figure, bound)
                and self._has_new_cut(places, u, matters)
            ):
                if lost:
                    # not cuts are missing but digits of the multipliers
                    attempts = [*attempts[1:], attempts[0]]
                statement = self._statement()
                continue
            # what may be the answer is judged once
            narrow = _COARSE
            if gap <= self._gap_limit(enough, best):
                narrow = _CLOSE if self.of_mass else _JUDGED
            point = self._evaluated(u, min(self._width(enough, gap), narrow))
            promised = none if promised.unbalance is u else promised
            best = min(best, self._feasible(point), key=self.figure)
            gap = self.figure(best) - bound
            if gap <= self._gap_limit(enough, best) or stop(self.figure(best), bound):
                break
            if not self._has_new_cut([(reached,) for reached in point.values.reached], u, matters):
                proof = self._closed(proof, statement)
                self.missed = _MISSED * np.maximum(point.values.goals[: self.aimed.size] - self.aimed, 0.0)
                attempts = attempts[1:]
                continue
            if lost:
                attempts = [*attempts[1:], attempts[0]]
            statement = self._statement()
        else:
            timed_out = self._late()
        if promised.figure < self.figure(best):
            width = self._width(enough, promised.figure - (-np.inf if proof is None else proof.bound))
            best = min(best, self._feasible(self._evaluated(promised.unbalance, width)), key=self.figure)
        return StageEnd(self._tidied(best), proof, rounds, self.certify_s, timed_out)

    def _gap_limit(self, enough: float, best: Point) -> float:
        """Gap that ends the search, in units of what is small.

        Of a mass no more is to be had than what is paid for the room between what the solver keeps and what the bound
        counts with. More rounds do not narrow it.
        """
        if not self.of_mass:
            return enough
        room = self.levels.of_bound - self.levels.most + self.margin
        return enough * best.mass + float(np.sum(self.price * np.maximum(room, 0.0)))

    def _late(self) -> bool:
        return time.thread_time() >= self.until

    def _statement(self) -> Statement:
        """The program with the cuts so far."""
        return self.program.outer(self.pool.cuts)

    def _closed(self, proof: Proof | None, statement: Statement) -> Proof | None:
        """The better of a proof and of that by the floors of all cuts so far, which takes no solver."""
        if self.of_mass:
            return proof
        began = time.perf_counter()
        resting = resting_proof(self.program, self.pool.cuts, statement)
        self.certify_s += time.perf_counter() - began
        return resting if proof is None or resting.bound > proof.bound else proof

    def _spare(self, enough: float) -> None:
        """Reduce the margin to one that costs no more than a share of the target gap."""
        least = _LEAST_MARGIN * self.program.units[: self.margin.size]
        worth = np.where(self.price > 0, _OPEN * enough / np.where(self.price > 0, self.price, 1.0), np.inf)
        self.margin = np.minimum(self.levels.margin, np.maximum(worth, least))

    def _has_new_cut(self, evaluations: Sequence[Sequence[Evaluation]], u: Complex, matters: Real) -> bool:
        """Whether a point has added a cut, or holds a plate that is heavier than its tangents."""
        new = self.pool.add(evaluations, u, matters)
        self.pool.forget(u)
        if self.plates is None:
            return new
        alike = self.program.limits.alike
        # webs of equal castings have the same nodes to the last digit
        sizes = u if alike is None else u[np.array(alike.leader)]
        nodes = nodes_about(self.plates, self._nodes(self.plates), sizes, self.lighter)
        heavier = nodes is not self.pool.nodes
        if heavier:
            # the next program has other variables
            self.pool.nodes, self.about = nodes, None
        return new or heavier

    def _nodes(self, plates: Plates) -> Real:
        if self.pool.nodes is None:
            self.pool.nodes = first_nodes(plates)
        return self.pool.nodes

    def _laid(self, statement: Statement) -> Pieces:
        """The statement with tangents in place of every plate whose mass counts."""
        if self.plates is None:
            webs = self.program.limits.radius.size
            return Pieces(statement, np.arange(webs), webs)
        mask = np.ones(self.program.limits.radius.size, bool)
        mask[self.plates.webs] = self.program.limits.max_mass[self.plates.webs] > 0.0
        return pieces(statement, self.plates, tangents(self.plates, self._nodes(self.plates)), mask)

    def _promise(self, point: Point) -> float:
        """What the best that is kept between a point and those inside comes to at least, and by convexity at most if
        the point comes to no more than its values."""
        over = self._excess(point.values)
        if np.all(over <= 0.0):
            return self.figure(point)
        figures = []
        for inside in (self.inside, self.near):
            if inside is not None:
                step = min(_step(over, self._excess(inside.values)), 1.0)
                figures.append(self.figure(point) + step * (self.figure(inside) - self.figure(point)))
        return min(figures)

    def _stated_goals(self, statement: Statement, u: Complex) -> Real:
        """(goals,) what a point comes to by its statement."""
        return self.program.of_goals(statement.largest(statement.rows(statement.norms.sizes(u))))

    def figure(self, point: Point) -> float:
        """What is minimised."""
        return point.mass if self.of_mass else float(point.values.goals[-1])

    def _width(self, enough: float, gap: float) -> float:
        """Width of brackets that leaves open a share of the target gap, or of the gap that is still open."""
        size = self.program.units
        # brackets must be narrower than the margin below the levels
        share = float(np.min(self.margin / size[: self.margin.size], initial=np.inf))
        if not self.of_mass:
            share = min(share, max(enough, _OPEN * gap if np.isfinite(gap) else 0.0) / float(size[-1]))
        if self.program.limited:
            share = min(share, _LOWERED)
        return min(_OPEN * share, _COARSE)

    def _solved(self, statement: Statement, attempt: Attempt) -> tuple[Complex, list[Proof]] | None:
        """The point of finitely many cuts, and what its multipliers prove."""
        program, goal_of, case_of = self.program, self.program.goal_of, self.program.case_of
        laid = self._laid(statement)
        program_in_units = times(laid.program, 1.0 / self.unit[goal_of])
        mass = (self.inside.mass or 1.0) if self.of_mass else 1.0
        lowered = -_RAISED if self.raised else attempt.margins * _LOWERED
        largest = float(np.max(np.abs(program_in_units.norms.constant)))
        stage: Stage = "mass" if self.of_mass else "objective"
        data, scaling = scale(program_in_units, stage, self.clip, lowered, mass_unit=mass, unit=largest)
        highest = program_in_units.largest(program_in_units.floor)
        aimed = self.aimed = self.levels.most - attempt.margins * self.margin - self.missed

        def sums(n: int, most: float) -> list[GroupLimit]:
            """The sums of a goal, none above a level."""
            cases = [case_of == case for case in np.flatnonzero(program.goal_of_case == n)]
            return [GroupLimit(case, (most - float(np.sum(highest[case]))) / scaling.objective) for case in cases]

        targets = [item for n, most in enumerate(aimed) for item in sums(n, most / self.unit[n])]
        of_target = program.goal_of_case[program.goal_of_case < aimed.size]
        last = len(program.goals) - 1
        left = max(self.until - time.thread_time(), _LAST_S)
        arguments = data, attempt.tolerance, left, goal_of == last, targets, sums(last, 0.0)
        about = self.about if attempt.boosted else None
        result = solved(*arguments, about, attempt.regularization)
        if isinstance(result, NoPoint) and about is not None:
            # what was boosted about another point may be worse than what was not
            result = solved(*arguments)
        if isinstance(result, NoPoint):
            self.about = None
            return None
        self.about = result.variables
        worth = scaling.value / scaling.objective * (1.0 if self.of_mass else float(self.unit[-1]))
        self.price = np.bincount(of_target, result.price, aimed.size) * worth / self.unit[: aimed.size]
        u = program_in_units.limits.into(scaling.unbalance(program_in_units, result.solution))
        began = time.perf_counter()
        multipliers = scaling.multipliers(program_in_units, result.solution)
        proven = list(proofs(program, self.pool.cuts, laid.program, u, multipliers, self.levels.of_bound))
        if self.plates is not None:
            u, proven = laid.carried(u), [item.of_webs(statement) for item in proven]
        self.certify_s += time.perf_counter() - began
        return u, proven

    def _matters(self, statement: Statement, u: Complex) -> Real:
        """(quantities,) above which a quantity changes anything."""
        program = self.program
        least = np.full(len(program.quantities), np.inf)
        level = statement.largest(statement.rows(statement.norms.sizes(u)))
        for group, reached in zip(program.groups, level.tolist(), strict=True):
            for member in group.weighed:
                least[member.quantity] = min(least[member.quantity], (reached - member.offset) / member.weight)
        for (q, cap), size in zip(program.limited, program.sizes[len(program.ceilings) :].tolist(), strict=True):
            least[q] = min(least[q], cap + (0.0 if self.raised else -_LOWERED) * size)
        return least

    def _tidied(self, point: Point) -> Point:
        """The point without its negligible counterweights, where it then still keeps all and is no worse."""
        u = point.unbalance
        small = np.abs(u) < NEGLIGIBLE * np.max(np.abs(u), initial=0.0)
        if not self.of_mass or not np.any(small & (u != 0)):
            return point
        tidy = self._evaluated(np.where(small, 0.0, u), _CLOSE)
        return point if np.any(self._excess(tidy.values) > 0) else tidy

    def _evaluated(self, u: Complex, width: float) -> Point:
        return Point(u, self.program.values(u, width), self._mass(u))

    def _mass(self, u: Complex) -> float:
        return self.program.mass(u)

    def _feasible(self, point: Point) -> Point:
        """The best that is kept between a point and those inside; later points are moved towards the nearest."""
        if np.all(self._excess(point.values) <= 0.0):
            self.near = point
            points = [point] if self.beyond is None else [point, self._interior_step(self.beyond, point)]
        else:
            self.beyond = point
            points = [self._interior_step(point, inside) for inside in (self.inside, self.near) if inside is not None]
        return min(points, key=self.figure)

    def _interior_step(self, point: Point, inside: Point) -> Point:
        """The point moved towards one inside just so far that all is kept; all of it is convex."""
        for _ in range(4):
            over, under = self._excess(point.values), self._excess(inside.values)
            step = _step(over, under)
            if step <= 0.0:
                return point
            step = min(1.0, step * (1.0 + 1e-9) + _NARROWEST)
            u = point.unbalance + step * (inside.unbalance - point.unbalance)
            point = self._evaluated(u, _CLOSE)
        return inside

    def _excess(self, values: Values) -> Real:
        """Over what has to be kept, each relative to its size (goals kept and ceilings,)."""
        levels = self.levels.most
        over = (values.goals[: levels.size] - levels) / self.program.units[: levels.size]
        return np.concatenate([over, values.over - self.allowed, [values.over_budget]])


def _step(over: Real, under: Real) -> float:
    """How far from a point towards one inside all is kept, by the excess of both; 1 where that is not inside."""
    worst = np.divide(over, np.maximum(over - under, over), out=np.zeros(over.shape), where=over > 0)
    return float(np.max(worst, initial=0.0))
