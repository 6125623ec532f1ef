"""The best assignment with the counterweights that are best for it: minorants of what they reach, then candidates."""

import time
from collections.abc import Mapping
from typing import Any

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.solve.process_solver import own_solver
from optimizer.studies.matching.bound import best_plane
from optimizer.studies.matching.chosen import Chosen
from optimizer.studies.matching.exhaustion import candidates
from optimizer.studies.matching.fitted import Best, few
from optimizer.studies.matching.problem import Minorants, Problem
from optimizer.studies.matching.search import searched
from schemas.match.request import MatchRequest

#: rounds of a search with counterweights, and programs in one of them
_ROUNDS = 12
_PROGRAMS = 16
#: candidates that are solved to prove that none is better
_CANDIDATES = 2_000


def with_chosen(request: MatchRequest, problem: Problem, near: float) -> Best:
    """The best assignment with the counterweights that are best for it: planes below what they reach, one by one."""
    chosen, listed = Chosen(request, problem, own_solver()), problem.listed[None]
    until = time.thread_time() + request.accuracy.time_limit_s
    value, bound, below = chosen.at(listed)
    known = {_key(problem, listed[0]): (float(value[0]), float(bound[0]), listed[0])}
    cut = best_plane(problem, below, float(value[0]), near)
    for _ in range(_ROUNDS):
        if time.thread_time() >= until:
            break
        best, _, mass = min(known.values(), key=lambda one: one[0])
        tried = searched(problem, below, mass[None])
        new = _unknown(problem, known, tried[below.at(problem.vectors(tried)) < best])
        if not new.size:
            break
        below = _solved(problem, chosen, known, new, below)
    best, _, mass = min(known.values(), key=lambda one: one[0])
    cut = best_plane(problem, below, best, near)
    if (best - cut.least <= near and not few(problem)) or time.thread_time() >= until:
        return Best(mass, cut.least - problem.rounding, False, best - cut.least > near)
    return _proven(problem, chosen, known, below, cut.least, until)


def _proven(
    problem: Problem,
    chosen: Chosen,
    known: dict[bytes, tuple[float, float, Real]],
    below: Minorants,
    bound: float,
    until: float,
) -> Best:
    """The best of all assignments whose minorants leave room for a better one, where they are not too many.

    Parameters
    ----------
    bound : what is proven of all already.
    until : of this thread's own time, when no more are solved.
    """
    best, _, mass = min(known.values(), key=lambda one: one[0])
    cut = best_plane(problem, below, best, 0.0)
    left = candidates(problem, below, best, cut)
    if left is None or len(left[0]) > _CANDIDATES:
        return Best(mass, max(bound, cut.least) - problem.rounding, False)
    remaining = left[0]
    while len(remaining):
        best = min(one[0] for one in known.values())
        # what has been solved has cut off others
        open_still = remaining[below.at(problem.vectors(remaining)) < best]
        new = _unknown(problem, known, open_still)
        if not new.size:
            break
        if time.thread_time() >= until:
            _, _, mass = min(known.values(), key=lambda one: one[0])
            return Best(mass, max(bound, cut.least) - problem.rounding, False, True)
        below = _solved(problem, chosen, known, new, below)
        remaining = open_still
    best, _, mass = min(known.values(), key=lambda one: one[0])
    # every other assignment has a minorant that is no better than the best
    return Best(mass, min(best, *(one[1] for one in known.values())) - problem.rounding, True)


def _solved(
    problem: Problem, chosen: Chosen, known: dict[bytes, tuple[float, float, Real]], mass: Real, below: Minorants
) -> Minorants:
    """Solve some assignments, put them among the known ones, and add what they prove."""
    values, bounds, more = chosen.at(mass)
    for one, value, bound in zip(mass, values.tolist(), bounds.tolist(), strict=True):
        known[_key(problem, one)] = (value, bound, one)
    return below.plus(more)


def _unknown(problem: Problem, known: Mapping[bytes, Any], mass: Real) -> Real:
    """The first of some assignments (N, T) that are not known yet, each once."""
    new = {_key(problem, one): one for one in mass}
    return np.array([one for key, one in new.items() if key not in known][:_PROGRAMS])


def _key(problem: Problem, mass: Real) -> bytes:
    return problem.row_masses(mass).tobytes()
