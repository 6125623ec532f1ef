"""The best assignment with the counterweights that are best for it: minorants of what they reach, then candidates."""

import time
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.solve.solution import Solution
from optimizer.studies.matching.bound import best_plane
from optimizer.studies.matching.counterweight_optima import CounterweightOptima
from optimizer.studies.matching.exhaustion import candidates
from optimizer.studies.matching.fitted import BestAssignment, few
from optimizer.studies.matching.problem import Minorants, Problem
from optimizer.studies.matching.search import searched
from schemas.match.request import MatchRequest

#: rounds of a search with counterweights, and programs in one of them
_ROUNDS = 12
_PROGRAMS = 16
#: candidates that are solved to prove that none is better
_CANDIDATES = 2_000


class _Assignment(NamedTuple):
    """An assignment with what it comes to."""

    value: float  # over omega squared; inf without an optimum
    bound: float
    mass: Real  # (T,)
    fitted: Solution | None  # its counterweights, where they are no optimum of any masses


class SearchOutcome(NamedTuple):
    """Where the search ended, and the counterweights of the best assignment and of the parts as they are listed."""

    best: BestAssignment
    fitted: Solution | None
    input_order: Solution | None


class _Search:
    """The assignments so far, and the minorants of all."""

    def __init__(self, problem: Problem, optima: CounterweightOptima) -> None:
        self.problem, self.optima, self._evaluations = problem, optima, dict[bytes, _Assignment]()
        self.below = Minorants(np.zeros(0), np.zeros((0, problem.start.size), complex), np.zeros((0, problem.row.size)))
        self.solve(problem.input_order[None])

    @property
    def best(self) -> _Assignment:
        return min(self._evaluations.values(), key=lambda evaluation: evaluation.value)

    @property
    def least(self) -> float:
        """The smallest bound of the assignments so far."""
        return min(evaluation.bound for evaluation in self._evaluations.values())

    @property
    def input_order(self) -> _Assignment:
        return self._evaluations[self._key(self.problem.input_order)]

    @property
    def late(self) -> bool:
        return time.thread_time() >= self.optima.until

    def solve(self, mass: Real) -> None:
        """Solve assignments (N, T), and add what they prove of all."""
        result = self.optima.at(mass, self.best.value if self._evaluations else np.inf)
        rows = zip(result.value.tolist(), result.lower_bound.tolist(), mass, result.fitted, strict=True)
        for row in rows:
            self._evaluations[self._key(row[2])] = _Assignment(*row)
        self.below = self.below.plus(result.below)

    def values(self, mass: Real) -> Real:
        """What assignments (N, T) come to at least."""
        return self.below.at(self.problem.vectors(mass))

    def unknown(self, mass: Real) -> Real:
        """Those of some assignments (N, T) that are new, each once."""
        new = {self._key(assignment): assignment for assignment in mass}
        return np.array([assignment for key, assignment in new.items() if key not in self._evaluations])

    def _key(self, mass: Real) -> bytes:
        return self.problem.row_masses(mass).tobytes()


def search_assignments(request: MatchRequest, problem: Problem, near: float) -> SearchOutcome:
    """The best assignment with the counterweights that are best for it: planes below what they reach, one by one."""
    until = time.thread_time() + request.accuracy.time_limit_s
    search = _Search(problem, CounterweightOptima(request, problem, near, until))
    result = _best(search, near)
    return SearchOutcome(result, search.best.fitted, search.input_order.fitted)


def _best(search: _Search, near: float) -> BestAssignment:
    problem = search.problem
    for _ in range(_ROUNDS):
        if search.late:
            break
        proposals = searched(problem, search.below, search.best.mass[None])
        new = search.unknown(proposals[search.values(proposals) < search.best.value])[:_PROGRAMS]
        if not new.size:
            break
        search.solve(new)
    best = search.best
    cut = best_plane(problem, search.below, best.value, near)
    if (best.value - cut.least <= near and not few(problem)) or search.late:
        return BestAssignment(best.mass, cut.least - problem.rounding, False, best.value - cut.least > near)
    return _proven(search, cut.least, near)


def _proven(search: _Search, bound: float, near: float) -> BestAssignment:
    """The best of all assignments whose minorants leave room for a better one, where they are not too many.

    Parameters
    ----------
    bound : what is proven of all already.
    near : what may be left open.
    """
    problem, best = search.problem, search.best
    cut = best_plane(problem, search.below, best.value, 0.0)
    left = candidates(problem, search.below, best.value, cut)
    if left is None or len(left[0]) > _CANDIDATES:
        return BestAssignment(best.mass, max(bound, cut.least) - problem.rounding, False)
    remaining = left[0]
    while len(remaining):
        # what has been solved has cut off others
        remaining = remaining[search.values(remaining) < search.best.value]
        new = search.unknown(remaining)
        if not new.size:
            break
        if search.late:
            best = search.best
            # of new assignments the smallest minorant, of the others their bounds, and no better is left out
            least = min(best.value, search.least, float(np.min(search.values(new))))
            bound = max(bound, cut.least, least)
            return BestAssignment(best.mass, bound - problem.rounding, False, best.value - bound > near)
        search.solve(new[:_PROGRAMS])
    best = search.best
    # every other assignment has a minorant that is no better than the best
    bound = min(best.value, search.least)
    return BestAssignment(best.mass, bound - problem.rounding, True, search.late and best.value - bound > near)
