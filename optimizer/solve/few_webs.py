"""What any masses on few webs come to of one goal of the first order, and sets of options compared near them."""

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import combinations
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.halves import exhaust
from optimizer.choices.discrete.lightest import lighter
from optimizer.choices.discrete.neighbourhoods import near_options
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.limits import Limits
from optimizer.program.methods.optima import optima
from optimizer.program.statement import Statement

#: gap of an optimum
_GAP = 1e-4
#: sets of webs whose optima are looked at together
_SUBSETS = 300
#: of them those whose options near them are compared, how many near each, sets of them, and sums and pairs of halves
_COMPARISONS, _NEAR, _SETS, _SUMS, _PAIRS = 12, 400, 2_000_000, 200_000, 400_000
#: sets of a few webs up to which all are compared
_EVERY = 1e9
#: sums of a half where a set is made lighter
_BESIDE = 60_000


class FewWebs(NamedTuple):
    """Bounds and points of any masses on few webs."""

    lower_bound: Real  # (M,) of the last goal, on some webs each, the best first
    points: Complex  # (M, K) kg m, their optima
    webs: np.ndarray  # (M, K) bool, these webs

    @property
    def least(self) -> float:
        """Of the last goal, on any of them; -inf without a bound."""
        return float(np.min(self.lower_bound)) if self.lower_bound.size else -np.inf


UNKNOWN = FewWebs(np.zeros(0), np.zeros((0, 0), complex), np.zeros((0, 0), bool))


def few_webs(program: Problem, limits: Limits, number: int) -> FewWebs:
    """The optima on every set of so many webs; unknown where those are many, and of more than one goal."""
    statement, webs = program.finite, limits.radius.size
    if statement is None or limits.alike is not None or math.comb(webs, number) > _SUBSETS:
        return UNKNOWN
    subsets = np.zeros((math.comb(webs, number), webs), bool)
    for n, subset in enumerate(combinations(range(webs), number)):
        subsets[n, list(subset)] = True
    programs = replace(statement, limits=limits).alone().subset(np.zeros(len(subsets), int))
    programs = replace(programs, limits=replace(programs.limits, max_mass=subsets * limits.max_mass))
    answer = optima(programs, _GAP, False)
    lower_bound = np.where(answer.unreachable, np.inf, answer.lower_bound)
    best = np.argsort(np.where(answer.unreachable, np.inf, answer.objective), kind="stable")
    return FewWebs(lower_bound[best], answer.unbalance[best], subsets[best])


def compare_on_few_webs(
    few: FewWebs,
    statement: Statement,
    options: Options,
    level: float,
    resolution: float,
    offer: Callable[[np.ndarray], None],
    clock: Clock,
) -> float:
    """Compare the options near the optima on few webs, all of them where they are few: the last goal at least.

    Parameters
    ----------
    statement : of that goal, within limits that hold every option.
    level : of the goal, from which on a set is not worth a look.
    resolution : objectives that differ by no more are equal.
    offer : takes sets (K,) that are better than those before.
    """
    incumbent, above = Incumbent(statement, options, resolution), True
    # what comes to more is not worth a look
    incumbent.least = min(level, float(statement.at_rest))
    number = int(np.max(np.sum(few.webs, axis=-1), initial=0))
    count = min(_NEAR, int(_SETS ** (1.0 / max(number, 1))))
    for n in np.flatnonzero(few.lower_bound <= level).tolist():
        webs = np.flatnonzero(few.webs[n]).tolist()
        every = np.prod(np.sum(options.exists[webs], axis=-1, dtype=float)) <= _EVERY
        if clock.spent() or not (every or n < _COMPARISONS):
            return few.least
        candidates = [np.array([0]) for _ in range(options.slots)]
        for k in webs:
            own = int(np.sum(options.exists[k])) if every else count
            candidates[k] = near_options(options, k, complex(few.points[n, k]), own)
        before = incumbent.selection
        above &= exhaust(options, candidates, incumbent, _SUMS, _PAIRS, clock) and every
        if incumbent.selection is not before and incumbent.selection is not None:
            above = False
            offer(incumbent.selection)
            mass = float(np.sum(options.of(options.mass, incumbent.selection)))
            light = lighter(statement, options, candidates, min(level, float(statement.at_rest)), mass, clock).selection
            if light is not None:
                offer(light)
    # the search has compared all that are no more than the level
    return float(np.nextafter(level, np.inf)) if above and level <= incumbent.least else few.least


def lightened(statement: Statement, options: Options, selection: np.ndarray, level: float, clock: Clock) -> np.ndarray:
    """A set (K,), and as long as there is one a lighter one near to it on its slots, no worse than a level."""
    fitted = np.flatnonzero(selection)
    count = int(_BESIDE ** (1.0 / max(math.ceil(fitted.size / 2), 1)))
    while not clock.spent():
        candidates = [np.array([option]) for option in selection]
        for k in fitted.tolist():
            candidates[k] = near_options(options, k, complex(options.unbalance[k, selection[k]]), count)
        mass = float(np.sum(options.of(options.mass, selection)))
        result = lighter(statement, options, candidates, level, mass, clock, most_pairs=_PAIRS)
        if result.selection is None:
            break
        selection = result.selection
    return selection
