"""Sets of which some slots change at a time: for a better one, and for a lighter one within the target gap."""

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import combinations
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.halves import exhaust
from optimizer.choices.discrete.light_sizes import LightSizes
from optimizer.choices.discrete.lightest import lighter
from optimizer.choices.discrete.neighbourhoods import light_options, near_options
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.program.methods.compiled import suits_kernel, unproven

#: sums of a half, and pairs of them, that are compared
SUMS, PAIRS = 20_000, 60_000
#: options near to what a slot takes and to the optimum, where four slots change; changes in a row that lead nowhere
CLOSE, _PATIENCE = 30, 40
#: times that some slots change for less mass
_LIGHTER = 24
#: of what an objective may be above its bound, spent on any masses, so that options near to them keep the rest
_PARTS = (0.3, 0.7)
#: times that every two slots change until a limit is kept
_SWEEPS = 4
_SEED = 20_261_123


class Nearer(NamedTuple):
    """Sets that come nearer to what no masses undercut."""

    incumbent: Incumbent
    clock: Clock

    def improves(self, options: Options, candidates: list[np.ndarray], sums: int) -> bool:
        """Whether one of some options of every slot (K) does."""
        before = self.incumbent.least
        exhaust(options, candidates, self.incumbent, sums, PAIRS, self.clock)
        return self.incumbent.least < before - self.incumbent.resolution


def improve(
    incumbent: Incumbent,
    options: Options,
    neighbours: Callable[[int, np.ndarray], np.ndarray],
    enough: Callable[[], bool],
    clock: Clock,
) -> None:
    """Change four slots of the best set at a time, until a while nothing is better.

    Parameters
    ----------
    options : without limits that every choice keeps anyway.
    neighbours : options of a slot that are tried, beside what a set (K,) has.
    """
    chance, free = np.random.default_rng(_SEED), np.flatnonzero(np.sum(options.exists, axis=-1) > 1)
    left = min(math.comb(free.size, 4) + 1, _PATIENCE)
    while left > 0 and incumbent.selection is not None and not (enough() or clock.spent()):
        selection = incumbent.selection
        candidates = [np.array([option]) for option in selection]
        for k in chance.choice(free, min(free.size, 4), replace=False).tolist():
            candidates[k] = np.union1d(candidates[k], neighbours(k, selection))
        before = incumbent.least
        exhaust(options, candidates, incumbent, SUMS, PAIRS, clock)
        left = _PATIENCE if incumbent.least < before - incumbent.resolution else left - 1


def lightest_near(
    incumbent: Incumbent, best: np.ndarray, levels: tuple[float, float], clock: Clock, sizes: LightSizes | None
) -> np.ndarray:
    """A light set (K,) near to the best one, no worse than a limit: some slots change at a time, and each by itself.

    Parameters
    ----------
    best : (K,) the set that is made lighter.
    levels : of the objective, a lower bound and a limit.
    sizes : of few part numbers, what is tried before.
    """
    options, statement, limit = incumbent.options, incumbent.statement, levels[1]
    selection, chance = lightened(incumbent, best, limit), np.random.default_rng(_SEED)
    light = None if sizes is None else sizes.below(selection, limit, clock)
    selection = selection if light is None else lightened(incumbent, light, limit)
    selection = _near_masses(incumbent, selection, levels, clock)
    free, several = np.flatnonzero(np.sum(options.exists, axis=-1) > 1), 4 if options.limits_parts else 6
    # slots of which no lighter options are beside this set
    closed: list[set[int]] = []
    for _ in range(_LIGHTER if free.size else 0):
        if clock.spent():
            break
        slots = chance.choice(free, min(free.size, several), replace=False).tolist()
        if any(whole.issuperset(slots) for whole in closed):
            continue
        loose, candidates = options, [np.array([option]) for option in selection]
        parts = options.of(options.part, selection)
        for k in slots:
            if options.limits_parts:
                # of the sizes that there are
                loose = replace(options, most_parts=None)
                candidates[k] = np.flatnonzero(options.exists[k] & np.isin(options.part[k], [-1, *parts[parts >= 0]]))
            else:
                near = near_options(options, k, complex(options.unbalance[k, selection[k]]), CLOSE)
                candidates[k] = np.unique(np.concatenate([near, [selection[k]], light_options(options, k, CLOSE)]))
        mass = float(np.sum(options.of(options.mass, selection)))
        light_set = lighter(statement, loose, candidates, limit, mass, clock, int(np.count_nonzero(selection)), PAIRS)
        if not light_set.whole:
            # where hardly any set is ruled out by the limit, fewer slots at a time
            several = max(several - 2, 2)
        if light_set.selection is not None:
            selection, closed = lightened(incumbent, light_set.selection, limit), []
        elif light_set.whole:
            closed.append(set(slots))
    return selection


def _near_masses(incumbent: Incumbent, selection: np.ndarray, levels: tuple[float, float], clock: Clock) -> np.ndarray:
    """A set (K,), or a lighter one from the least of any masses that spend a part of what is between two levels.

    These are rounded, and two slots change at a time until the set keeps the upper level.
    """
    options, statement, (least, limit) = incumbent.options, incumbent.statement, levels
    if options.limits_parts or not suits_kernel(statement):
        return selection

    def mass(combination: np.ndarray) -> float:
        return float(np.sum(options.of(options.mass, combination)))

    for part in _PARTS:
        if clock.spent():
            break
        (about,), _ = unproven(statement.alone(), np.array([part * (limit - least)]), True)
        rival = Incumbent(statement, options, incumbent.resolution)
        rival.offer(options.nearest(about)[None])
        for slots in list(combinations(range(options.slots), 2)) * _SWEEPS:
            if rival.selection is None or rival.least <= limit or clock.spent():
                break
            candidates = [np.array([option]) for option in rival.selection]
            for k in slots:
                candidates[k] = np.flatnonzero(options.exists[k])
            exhaust(options, candidates, rival, SUMS, PAIRS, clock)
        if rival.selection is not None and rival.least <= limit:
            light = lightened(incumbent, rival.selection, limit)
            if mass(light) < mass(selection):
                selection = light
    return selection


def lightened(incumbent: Incumbent, selection: np.ndarray, limit: float) -> np.ndarray:
    """A set (K,), and as long as one is there a lighter one that differs on one slot, no worse than a limit."""
    options, statement = incumbent.options, incumbent.statement
    while True:
        lighter = [
            (float(options.mass[k, option] - options.mass[k, selection[k]]), k, int(option))
            for k in range(options.slots)
            for option in np.flatnonzero(options.exists[k] & (options.mass[k] < options.mass[k, selection[k]]))
        ]
        if not lighter:
            return selection
        lighter.sort()
        sets = np.repeat(selection[None], len(lighter), axis=0)
        sets[np.arange(len(lighter)), [k for _, k, _ in lighter]] = [option for _, _, option in lighter]
        u = options.carried(sets)
        mask = options.counts(statement, sets) & (statement.objective(u) <= limit)
        mask &= np.all(statement.ceilings.excess(u) <= statement.ceilings.tolerance, axis=-1)
        if not mask.any():
            return selection
        selection = sets[int(np.argmax(mask))]
