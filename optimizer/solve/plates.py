"""Certified counterweights that are cut from plates, whose mass is no multiple of their unbalance.

The mass m(U) of a plate is convex. Tangents of it are webs in one plane, each with a radius and a largest mass of its
own, which together are no heavier than what is cut. What is proven of them is proven of the plate. What they call for
is cut, and is the answer. Tangents are laid about a guess of the answer, and closer about what they call for, until the
gap is at its target. A budget holds of what is cut and not of its tangents: such programs are solved by cuts.
"""

from collections.abc import Sequence
from dataclasses import replace
from time import thread_time
from typing import NamedTuple

import numpy as np

from optimizer.choices.equal_plates import alike, emptied
from optimizer.choices.plate_guess import guessed
from optimizer.formulation.limits import limits
from optimizer.formulation.task import Demand
from optimizer.mechanics.plates import Plates
from optimizer.mechanics.shapes import fitted
from optimizer.numerics.arrays import Complex, Real, mapped
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.methods.implied_bounds import within_reach
from optimizer.program.methods.optima import Optima, optima
from optimizer.program.methods.plate_sizes import CutWeights, equal_sizes, total_mass, unlike
from optimizer.program.methods.rounding import dust
from optimizer.program.methods.symmetry import symmetric
from optimizer.program.optimum import solution
from optimizer.program.plate_pieces import Pieces, Webs, closer_nodes, first_nodes, pieces, tangents
from optimizer.program.solution import OPTIMUM_SHARE
from optimizer.program.statement import Statement
from optimizer.program.verdict import MASS_GAP, Verdict, mass_resolution, yardstick
from optimizer.solve.certify import judgement
from optimizer.solve.cut_plates import limits_of_cut, openings
from schemas.machine.machine import Machine

#: how often nodes are laid
_ROUNDS = 12
#: how often a point without some webs is sought, each time about the one before
_CLEARINGS = 4
#: of the way from one cut to another
_PARTS = np.linspace(0.0, 1.0, 17)[1:-1]
#: masses below the resolution are at most so many times as large with the radius of the cut as with the longest:
#: the centre of half a disc is at 0.42 of its radius
_NEARER = 2.5
#: share of what optima may differ by that is used where webs are left empty
_WITH_ROOM = 0.999
#: the same where plates are to be alike: the first that is enough
_ROOM_TO_BE_ALIKE = (0.999, 0.99, 0.9)


def cut_optimum(
    machine: Machine, cut: Plates, program: Problem, statement: Statement, demand: Demand
) -> CertifiedOptimum | Conflict:
    """Certified unbalances that are cut from plates, of a problem that is a cone program without a budget.

    Parameters
    ----------
    machine : with plates in place of some webs, that the problem is of.
    cut : these plates.
    statement : the cone program.
    """
    end = thread_time() + demand.time_limit_s
    stated, every = statement.alone(), np.ones(len(machine.webs), bool)
    whole = within_reach(stated)
    task = _CutSearch(machine, demand, program.symmetric, whole, cut, demand.relative_gap, every, end)
    outcome = task.optimum()
    if whole is not stated:
        statement = replace(statement, limits=mapped(whole.limits, lambda array: array[0]))
    return solution(program, statement, outcome, outcome.unbalance[0], demand.least_mass, thread_time() >= end)


class _JudgedCut(NamedTuple):
    """A cut with its optima, and the claims that hold for it."""

    optima: Optima
    verdict: Verdict

    @property
    def status(self) -> str:
        """That of an answer; what keeps no ceiling is the best there is."""
        return "infeasible" if self.optima.unreachable[0] else str(self.verdict.status[0])

    @property
    def gap(self) -> float:
        """What is left open of mass and objective, for rounds to be compared; inf where nothing is proven."""
        return float(np.nan_to_num(self.verdict.relative_gap[0] + self.verdict.mass_gap[0], nan=np.inf))


class _Round(NamedTuple):
    """One round: a cut, and the proof by tangents."""

    proven: Optima
    cut: CutWeights
    called_for: Complex  # (K,) unbalances that the tangents call for, kg m


@record(frozen=True)
class _CutSearch:
    machine: Machine  # with plates in place of some webs
    demand: Demand
    symmetric: bool  # whether what is alike is to be alike
    whole: Statement  # (1,), whose limits are how far the plates reach
    plates: Plates
    relative_gap: float  # target gap of webs in place of plates
    left: np.ndarray  # (K,) bool, webs that may carry something
    until: float  # of this thread's own time, after which no more nodes are laid, and no further method begins

    @cached_property
    def kinds(self) -> np.ndarray:
        """Webs (K,) with the same plate have the same number, those without one another."""
        kinds = np.full(len(self.machine.webs), -1)
        kinds[self.plates.webs] = self.plates.kinds
        return kinds

    @cached_property
    def size(self) -> Real:
        """Yardstick of the objective (1,)."""
        return yardstick(self.whole)

    @property
    def _late(self) -> bool:
        return thread_time() >= self.until

    def optimum(self) -> Optima:
        """The best cut with its proof."""
        nodes, rounds = self.guessed(first_nodes(self.plates)), list[_Round]()
        for _ in range(_ROUNDS):
            rounds.append(self.round(nodes))
            outcome = self.lightest(rounds)
            if not self.too_heavy(outcome):
                best = self.judged_alike(self.without_dust(outcome, nodes), nodes)
                if best.status != "inaccurate":
                    return best.optima
            if self._late:
                break
            nodes = closer_nodes(nodes, self.opened(rounds[-1].called_for))
        # of those that are equally near the last
        attempts = (*reversed(rounds), self.lightest(rounds))
        return min((self.judged(attempt.proven, attempt.cut) for attempt in attempts), key=lambda best: best.gap).optima

    def opened(self, u: Complex) -> Real:
        """Half-angles (P,) of what is cut for unbalances (K,), of alike webs alike, rad."""
        return openings(self.plates, u, self.whole.limits.alike)

    def guessed(self, nodes: Real) -> Real:
        """Nodes about what is guessed from those of tangents."""
        share = min(OPTIMUM_SHARE, self.demand.relative_gap) * self.size
        angle = guessed(self.whole, self.plates, nodes, share, self.demand.least_mass)
        return nodes if angle is None else closer_nodes(nodes, angle)

    def round(self, nodes: Real) -> _Round:
        """What tangents at half-angles (n, P) come to."""
        whole = self.whole
        of_tangents, proven = self._optimum(tangents(self.plates, nodes))
        called_for = u = of_tangents.carried(proven.unbalance[0])
        if self.symmetric:
            # no worse in any term, so that the proof of the optimum holds
            u = symmetric(whole, u[None], self.kinds)[0]
        angle = self.opened(u)
        mass = float(total_mass(whole, self.plates, u, angle))
        return _Round(proven, CutWeights(u, angle, mass), called_for)

    def lightest(self, rounds: Sequence[_Round]) -> _Round:
        """The last round, or the lightest of all cuts with the largest bound of the mass: proofs hold for all cuts."""
        *_, last = rounds
        if not self.demand.least_mass or last.proven.unreachable[0]:
            return last
        proven = max(
            (attempt.proven for attempt in reversed(rounds)), key=lambda attempt: float(attempt.mass_lower_bound[0])
        )
        optima = [attempt.cut for attempt in rounds if self._keeps(proven, attempt.cut)]
        return _Round(proven, self._between(optima), last.called_for) if optima else last

    def _between(self, optima: Sequence[CutWeights]) -> CutWeights:
        """The lightest of some cuts and of what lies between it and them: objective and mass are convex."""
        lightest = min(optima, key=lambda cut: cut.mass)
        for rival in optima:
            u = lightest.unbalance + _PARTS[:, None] * (rival.unbalance - lightest.unbalance)
            angle = self.plates.opened(np.abs(u[:, self.plates.webs]))
            mass = total_mass(self.whole, self.plates, u, angle)
            n = int(np.argmin(mass))
            if mass[n] < lightest.mass:
                lightest = CutWeights(u[n], angle[n], float(mass[n]))
        return lightest

    def _keeps(self, proven: Optima, cut: CutWeights) -> bool:
        """Whether a cut is an optimum by its objective."""
        objective, rounding = self.whole.objective(cut.unbalance)[0], self.whole.rounding(cut.unbalance)[0]
        return bool(not proven.unreachable[0] and objective <= self._largest(proven) + rounding)

    def _optimum(self, webs: Webs) -> tuple[Pieces, Optima]:
        laid = pieces(self.whole, self.plates, webs, self.left)
        return laid, optima(laid.program, self.relative_gap, self.demand.least_mass, self.until)

    def without_dust(self, outcome: _Round, nodes: Real) -> _Round:
        """The same with webs left empty that carry next to nothing, where what is proven of all holds for it."""
        left, allowed = self.left, min(self.relative_gap, OPTIMUM_SHARE)
        while not (outcome.proven.unreachable[0] or self._late):
            empty = dust(self._masses(outcome.cut))
            if not empty.any():
                break
            rounded = outcome._replace(cut=emptied(self.whole, self.plates, outcome.cut, empty))
            if self._optimal(outcome.proven, rounded.cut) is not None:
                outcome, left = rounded, left & ~empty
                continue
            left, share, laid = left & ~empty, _WITH_ROOM * allowed, nodes
            optima = list[CutWeights]()
            for _ in range(_CLEARINGS):
                attempt = replace(self, left=left, relative_gap=share).round(laid)
                optima += [attempt.cut] if self._keeps(outcome.proven, attempt.cut) else []
                cleared = outcome._replace(cut=self._between(optima) if optima else attempt.cut)
                if self._optimal(outcome.proven, cleared.cut) is not None:
                    outcome = cleared
                    break
                # the smallest objective of these webs is larger: what it is above is no longer to be spent on mass
                over = float(self.whole.objective(attempt.cut.unbalance)[0] - self._largest(outcome.proven))
                if over > 0.0:
                    share -= max(1.01 * over / float(self.size[0]), (1.0 - _WITH_ROOM) * allowed)
                if share <= 0.0 or self._late:
                    return outcome
                # what is too heavy is so because the nodes lie about other plates
                laid = closer_nodes(laid, self.opened(attempt.called_for))
            else:
                break
        return outcome

    def _masses(self, cut: CutWeights) -> Real:
        """(K,) kg."""
        mass = np.abs(cut.unbalance) / self.whole.limits.radius[0]
        mass[self.plates.webs] = self.plates.mass(cut.angle)
        return mass

    def too_heavy(self, outcome: _Round) -> bool:
        """Whether what would be cut is not the lightest, so that it need not be judged."""
        if not self.demand.least_mass or outcome.proven.unreachable[0]:
            return False
        mass = outcome.cut.mass
        size = np.maximum(mass, _NEARER * mass_resolution(self.whole, self.size[..., None])[0])
        return bool(mass - outcome.proven.mass_lower_bound[0] > MASS_GAP * size)

    def judged_alike(self, outcome: _Round, nodes: Real) -> _JudgedCut:
        """What is cut, with plates opened alike where what is proven still holds."""
        best = self._judged_alike(outcome, nodes)
        if best.status != "optimal" or not unlike(self.plates, self.opened(best.optima.unbalance[0])):
            return best
        for share in () if self._late else _ROOM_TO_BE_ALIKE:
            # the least mass spends all that an optimum may be off, so that none is left for plates to be alike
            task = replace(self, relative_gap=share * min(self.relative_gap, OPTIMUM_SHARE))
            attempt = self._judged_alike(outcome._replace(cut=task.round(nodes).cut), nodes)
            if attempt.status == "optimal" and not unlike(self.plates, self.opened(attempt.optima.unbalance[0])):
                return attempt
        return best

    def _judged_alike(self, outcome: _Round, nodes: Real) -> _JudgedCut:
        cut = outcome.cut if self._late else self._alike(outcome, nodes)
        # free counterweights beside equal plates may be negligible
        alike_first = cut is not outcome.cut and not dust(self._masses(cut)).any()
        for cut_of in (cut, outcome.cut) if alike_first else (outcome.cut,):
            for equal in equal_sizes(self.whole, self.plates, cut_of):
                optimum = self._optimal(outcome.proven, equal)
                if optimum is not None:
                    return optimum
        return self.judged(outcome.proven, outcome.cut)

    def _alike(self, outcome: _Round, nodes: Real) -> CutWeights:
        proven = outcome.proven
        if proven.unreachable[0]:
            return outcome.cut
        optimum = float(proven.lower_bound[0]), self._largest(proven)
        least_mass = float(proven.mass_lower_bound[0]) if self.demand.least_mass else np.inf
        return alike(self.whole, self.plates, nodes, outcome.cut, optimum, least_mass)

    def _largest(self, proven: Optima) -> float:
        """Largest objective of an optimum, of which what is proven of the mass holds."""
        largest = float(proven.lower_bound[0] + self.demand.relative_gap * self.size[0])
        return min(largest, float(proven.mass_target[0])) if self.demand.least_mass else largest

    def _optimal(self, proven: Optima, cut: CutWeights) -> _JudgedCut | None:
        """What may be claimed of another cut, None where that is not an optimum."""
        if not proven.unreachable[0] and not self._keeps(proven, cut):
            return None
        best = self.judged(proven, cut)
        return best if best.status == "optimal" else None

    def judged(self, proven: Optima, cut: CutWeights) -> _JudgedCut:
        """What may be claimed of what is cut."""
        machine = fitted(self.machine, cut.angle)
        stated = limits(machine, (1,))
        program = replace(self.whole, limits=limits_of_cut(stated, self.whole.limits, self.plates, cut.angle))
        outcome = replace(proven, unbalance=cut.unbalance[None])
        return _JudgedCut(outcome, judgement(machine, self.demand, program, outcome).verdict)
