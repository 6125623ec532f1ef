"""The best assignment with the counterweights as they are: search, bound, exhaustion, as far as the time goes."""

import time
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.studies.matching.bound import best_plane
from optimizer.studies.matching.exhaustion import candidates
from optimizer.studies.matching.four_lists import near_to_nothing
from optimizer.studies.matching.problem import Problem
from optimizer.studies.matching.row_halves import all_sets, exhausted, single_class
from optimizer.studies.matching.search import searched

#: share of the time that is spent on parts without nuts
_BARE = 0.25


class BestAssignment(NamedTuple):
    """The assignment that a search ended with."""

    mass: Real  # (T,) masses at places
    lower_bound: float  # over omega squared
    exhausted: bool
    late: bool = False  # its time was over before the target gap was reached


def as_fitted(problem: Problem, near: float, seconds: float, has_nuts: bool) -> BestAssignment:
    """The best assignment with the counterweights as they are.

    Parameters
    ----------
    near : a bound so near to its value is good enough.
    seconds : of this thread's own time, after which it ends with what it has.
    has_nuts : the last class is that of nuts.
    """
    until = time.thread_time() + seconds
    peaks, input_order = problem.peaks, problem.input_order
    # not as they are listed, so that the order of the list changes nothing
    begun = np.concatenate([np.sort(input_order[part]) for part in problem.slices])
    starts = [begun]
    if has_nuts and len(problem.classes) > 1:
        bare = as_fitted(replace(problem, classes=problem.classes[:-1]), near, _BARE * seconds, False)
        starts.append(np.concatenate([bare.mass, problem.classes[-1].mass]))
    mass = min([searched(problem, peaks, np.array(starts))[0], input_order], key=lambda start: _value(problem, start))
    value = _value(problem, mass)
    cut = best_plane(problem, peaks, value, near)
    bound, is_complete = cut.least, False

    def spent() -> bool:
        return time.thread_time() >= until

    if value - bound > near or few(problem):
        better = candidates(problem, peaks, value, cut)
        if better is not None:
            result, values = better
            mass, value = (result[0], float(values[0])) if values.size else (mass, value)
            bound, is_complete = value, True
        else:
            if bound <= problem.rounding and not all_sets(problem):
                mass = near_to_nothing(problem, mass, bound + near, spent)
                value = _value(problem, mass)
            if single_class(problem):
                ended = exhausted(problem, cut, value, near, spent)
                mass, value = (mass, value) if ended.mass is None else (ended.mass, ended.value)
                bound, is_complete = max(bound, ended.lower_bound), ended.complete
    return BestAssignment(mass, bound - problem.rounding, is_complete, value - bound > near and spent())


def few(problem: Problem) -> bool:
    """So few assignments that all are looked at in no time."""
    return problem.rows <= 5 and len(problem.classes) <= 2


def _value(problem: Problem, mass: Real) -> float:
    return float(problem.peaks.at(problem.vectors(mass)))
