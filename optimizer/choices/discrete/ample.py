"""Light sets near the optimum of any masses, of slots with many options.

The lightest optimum of any masses is on few webs. Of their options those that are near to it, beside light ones on two
or four other slots, are compared in halves: some ten thousand sums on either side, of each the nearest of the other.
Force and moment have four real dimensions, in which so many sums lie close together.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations, islice
from typing import NamedTuple

import numpy as np

from optimizer.choices.discrete.clock import Clock
from optimizer.choices.discrete.halves import exhaust
from optimizer.choices.discrete.light_sizes import LightSizes
from optimizer.choices.discrete.lightest import lighter
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.methods.compiled import both_stages, suits_kernel
from optimizer.program.solution import OPTIMUM_SHARE
from optimizer.program.statement import Statement

#: sums of a half, and pairs of them, that are compared
_SUMS, _PAIRS = 20_000, 60_000
#: sums of a half where sizes are tried, and of those that are best
_TRIED, _WIDE = 4_000, 500_000
#: pairs of slots that the optimum uses that are looked at
_MOVING = 6
#: part numbers that are tried where any number may be used
_SIZES = 2
#: slots beside those of the optimum where few part numbers may be used
_TRIMS = 4
#: slots of the optimum that may take any angle
_MAIN = 3
#: further sizes, as shares of those of the optimum, and steps by which sizes are moved
_SHARES, _STEPS = (0.025, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3, 0.5), (1, -1, 2, -2, 4, -4)
#: options near to what a slot takes and to the optimum, where four slots change; changes in a row that lead nowhere
_CLOSE, _PATIENCE = 30, 40
#: share of the time of few part numbers in which sizes are tried for a light set that is as good as asked
_FIRST = 0.4
#: times that some slots change for less mass
_LIGHTER = 24
_SEED = 20_261_123
#: share of the largest unbalance of the optimum from which on a slot is used by it
_USED = 1e-3

Sizes = tuple[int, ...]


class Pass(NamedTuple):
    """How many options of how many slots are tried together."""

    near: int  # options of each of two slots that are near to the optimum
    many: int  # light options of each other one
    others: int  # of those
    several: int  # sets of others that are looked at
    sums: int  # of a half, at most


#: the sets of each are hundreds to thousands of times as many as those of the one before
_PASSES = (Pass(40, 200, 2, 28, _SUMS), Pass(40, 100, 4, 4, 500_000), Pass(20, 50, 6, 2, 4_000_000))


def light_sizes(statement: Statement, options: Options, relaxed: Complex) -> LightSizes | None:
    """Sets of few part numbers near to the lightest optimum of any masses; None where these are not few.

    Parameters
    ----------
    relaxed : (K,) kg m of first webs, an optimum of any masses.
    """
    if not options.limits_parts:
        return None
    light = _lightest(statement, relaxed)
    used = used_slots(light)
    return LightSizes(statement, options, light, used) if used else None


def offer_light_sets(
    incumbent: Incumbent,
    below: Statement,
    relaxed: Complex,
    enough: Callable[[], bool],
    clock: Clock,
    sizes: LightSizes | None,
    limit: float,
) -> None:
    """Offer the sets that are found so.

    Parameters
    ----------
    below : the incumbent's program, or one of fewer rows that is nowhere above it.
    relaxed : (K,) kg m of first webs, an optimum of any masses.
    enough : whether the best set is as good as asked.
    sizes : of few part numbers, what is tried first for a set that is as good.
    limit : of the objective of such a set.
    """
    light = _lightest(below, relaxed)
    used = used_slots(light)
    if not used:
        return
    if incumbent.options.limits_parts:
        chosen = None if sizes is None else sizes.below(None, limit, Clock(_FIRST * clock.left_s))
        if chosen is not None:
            incumbent.offer(chosen[None])
        _PartSizes(incumbent, light, used, incumbent.options.most_parts or 0, enough, clock).run()
        return
    for one in _PASSES:
        for which in neighbourhoods(incumbent.options, light, one.near, one.many, one.others, one.several):
            if enough() or clock.spent():
                return
            exhaust(incumbent.options, which, incumbent, one.sums, _PAIRS, clock)

    # few sizes are few sums, and where any may be used they are among them
    _PartSizes(incumbent, light, used, _SIZES, enough, clock).run()

    def close(slot: int) -> np.ndarray:
        options, chosen = incumbent.options, incumbent.chosen
        assert chosen is not None
        about = (options.unbalance[slot, chosen[slot]], light[slot])
        near = [near_options(options, slot, complex(each), _CLOSE) for each in about]
        return np.unique(np.concatenate([*near, _light(options, slot, _CLOSE // 2)]))

    _improve(incumbent, incumbent.options, close, enough, clock)


class _Nearer(NamedTuple):
    """Sets that come nearer to what no masses undercut."""

    incumbent: Incumbent
    clock: Clock

    def found(self, options: Options, which: list[np.ndarray], sums: int) -> bool:
        """Whether one of some options of every slot (K) does."""
        before = self.incumbent.least
        exhaust(options, which, self.incumbent, sums, _PAIRS, self.clock)
        return self.incumbent.least < before - self.incumbent.resolution


def _improve(
    incumbent: Incumbent,
    options: Options,
    some: Callable[[int], np.ndarray],
    enough: Callable[[], bool],
    clock: Clock,
) -> None:
    """Change four slots of the best set at a time, until a while nothing is better.

    Parameters
    ----------
    options : without limits that every choice keeps anyway.
    some : options of a slot that are tried.
    """
    chance, free = np.random.default_rng(_SEED), np.flatnonzero(np.sum(options.exists, axis=-1) > 1)
    left = min(math.comb(free.size, 4) + 1, _PATIENCE)
    while left > 0 and not (enough() or clock.spent()):
        assert incumbent.chosen is not None
        which = [np.array([option]) for option in incumbent.chosen]
        for k in chance.choice(free, min(free.size, 4), replace=False).tolist():
            which[k] = np.union1d(which[k], some(k))
        before = incumbent.least
        exhaust(options, which, incumbent, _SUMS, _PAIRS, clock)
        left = _PATIENCE if incumbent.least < before - incumbent.resolution else left - 1


def lightest_near(incumbent: Incumbent, limit: float, clock: Clock, sizes: LightSizes | None) -> np.ndarray:
    """A light set (K,) near to the best one, no worse than a limit: some slots change at a time, and each by itself.

    Parameters
    ----------
    limit : of the objective.
    sizes : of few part numbers, what is tried before.
    """
    options, statement = incumbent.options, incumbent.statement
    assert incumbent.chosen is not None
    chosen, chance = _lightened(incumbent, incumbent.chosen, limit), np.random.default_rng(_SEED)
    light = None if sizes is None else sizes.below(chosen, limit, clock)
    chosen = chosen if light is None else _lightened(incumbent, light, limit)
    free, several = np.flatnonzero(np.sum(options.exists, axis=-1) > 1), 4 if options.limits_parts else 6
    # slots of which no lighter options are beside this set
    settled: list[set[int]] = []
    for _ in range(_LIGHTER if free.size else 0):
        if clock.spent():
            break
        slots = chance.choice(free, min(free.size, several), replace=False).tolist()
        if any(whole.issuperset(slots) for whole in settled):
            continue
        loose, which = options, [np.array([option]) for option in chosen]
        parts = options.of(options.part, chosen)
        for k in slots:
            if options.limits_parts:
                # of the sizes that there are
                loose = replace(options, most_parts=None)
                which[k] = np.flatnonzero(options.exists[k] & np.isin(options.part[k], [-1, *parts[parts >= 0]]))
            else:
                near = near_options(options, k, complex(options.unbalance[k, chosen[k]]), _CLOSE)
                which[k] = np.unique(np.concatenate([near, [chosen[k]], _light(options, k, _CLOSE)]))
        mass = float(np.sum(options.of(options.mass, chosen)))
        found = lighter(statement, loose, which, limit, mass, clock, int(np.count_nonzero(chosen)), _PAIRS)
        if not found.whole:
            # where hardly any set is ruled out by the limit, fewer slots at a time
            several = max(several - 2, 2)
        if found.chosen is not None:
            chosen, settled = _lightened(incumbent, found.chosen, limit), []
        elif found.whole:
            settled.append(set(slots))
    return chosen


def _lightened(incumbent: Incumbent, chosen: np.ndarray, limit: float) -> np.ndarray:
    """A set (K,), and as long as one is there a lighter one that differs on one slot, no worse than a limit."""
    options, statement = incumbent.options, incumbent.statement
    while True:
        lighter = [
            (float(options.mass[k, option] - options.mass[k, chosen[k]]), k, int(option))
            for k in range(options.slots)
            for option in np.flatnonzero(options.exists[k] & (options.mass[k] < options.mass[k, chosen[k]]))
        ]
        if not lighter:
            return chosen
        lighter.sort()
        sets = np.repeat(chosen[None], len(lighter), axis=0)
        sets[np.arange(len(lighter)), [k for _, k, _ in lighter]] = [option for _, _, option in lighter]
        u = options.carried(sets)
        kept = options.counts(statement, sets) & (statement.objective(u) <= limit)
        kept &= np.all(statement.ceilings.excess(u) <= statement.ceilings.tolerance, axis=-1)
        if not kept.any():
            return chosen
        chosen = sets[int(np.argmax(kept))]


def _lightest(statement: Statement, relaxed: Complex) -> Complex:
    """(K,) kg m: the lightest optimum of any masses, or the one that is known."""
    if not suits_kernel(statement) or not statement.at_rest > 0:
        return relaxed
    share = np.array([OPTIMUM_SHARE * float(statement.at_rest)])
    stages = both_stages(statement.alone(), share, share, True)
    return stages.unbalance[0] if stages.certified[0] else relaxed


def near_options(options: Options, slot: int, about: complex, count: int) -> np.ndarray:
    """Nothing, and the options of a slot that are nearest to an unbalance."""
    off = np.where(options.exists[slot], np.abs(options.unbalance[slot] - about), np.inf)
    nearest = np.argsort(off, kind="stable")[: min(count, int(np.sum(options.exists[slot])))]
    return np.union1d([0], nearest)


def _light(options: Options, slot: int, count: int) -> np.ndarray:
    """The lightest options of a slot, nothing first."""
    mass = np.where(options.exists[slot], options.mass[slot], np.inf)
    return np.argsort(mass, kind="stable")[: min(count, int(np.sum(options.exists[slot])))]


def neighbourhoods(
    options: Options, light: Complex, near: int, many: int, beside: int = 2, several: int = 28
) -> Iterator[list[np.ndarray]]:
    """Options of every slot: near ones of two that the optimum uses, light ones of some others, and of the rest one.

    Parameters
    ----------
    light : (K,) kg m of first webs, an optimum of any masses on few webs.
    near, many : how many near ones, and how many light ones.
    beside, several : how many others, and sets of these.
    """
    used = used_slots(light)
    base = options.nearest(light)
    largest = sorted(used, key=lambda k: -abs(light[k]))
    moving: list[tuple[int, ...]] = list(islice(combinations(largest, 2), _MOVING)) or [tuple(largest)]
    rest = [k for k in range(options.slots) if k not in used]
    others: list[tuple[int, ...]] = list(islice(combinations(rest, beside), several)) or [tuple(rest)]
    for slots in moving:
        for trims in others:
            which = [np.array([option]) for option in base]
            for k in slots:
                which[k] = near_options(options, k, light[k], near)
            for k in trims:
                which[k] = _light(options, k, many)
            yield which


def used_slots(light: Complex) -> list[int]:
    """Slots that an optimum of any masses (K,) kg m uses."""
    return np.flatnonzero(np.abs(light) > _USED * np.max(np.abs(light), initial=0.0)).tolist()


def _half_of(which: Sequence[np.ndarray]) -> float:
    """Sums of a half, about."""
    return float(np.sqrt(np.prod([float(each.size) for each in which])))


class _PartSizes:
    """Which part numbers to use, where fewer may be used than there are: sizes moved up and down, one at a time."""

    def __init__(
        self,
        incumbent: Incumbent,
        light: Complex,
        used: list[int],
        most: int,
        enough: Callable[[], bool],
        clock: Clock,
    ) -> None:
        self.incumbent, self.most, self.enough, self.clock = incumbent, most, enough, clock
        self.better, self.climb = _Nearer(incumbent, clock), clock
        options = incumbent.options
        self.used = sorted(used, key=lambda k: -abs(light[k]))
        self.light, self.near = light, options.nearest(light)
        # what is left of the choice by its sizes is not to be counted again
        self.loose = replace(options, most_parts=None)
        parts = np.unique(options.part[options.exists & (options.part >= 0)])
        mass = np.array([np.min(options.mass[options.part == part]) for part in parts])
        order = np.argsort(mass, kind="stable")
        self.parts, self.mass = parts[order], mass[order]
        rest = [k for k in range(options.slots) if k not in used]
        # every second first: trims on either end
        self.trims = [rest[::2] + rest[1::2], rest[1::2] + rest[::2]]

    def run(self) -> None:
        """Offer the best sets of so few sizes."""
        most = self.most
        if not most or not self.mass.size:
            return
        own = np.array([self._nearest(self._mass_of(k)) for k in self.used])
        main = (
            np.unique(own) if np.unique(own).size < most else np.unique([self._nearest(float(np.mean(self.mass[own])))])
        )
        # sizes in as many heaps, where nothing is left for a small one
        heaps = np.array_split(np.sort(self.mass[own]), most) if own.size >= most > 1 else []
        several = np.unique(np.array([self._nearest(float(np.mean(heap))) for heap in heaps], int))
        starts: list[Sizes] = list(dict.fromkeys(tuple(each.tolist()) for each in (main, several) if each.size))
        for n, sizes in enumerate(starts):
            self._climb(sizes, Clock(self.clock.left_s / (len(starts) - n)))
        _improve(self.incumbent, self.loose, self._in_use, self.enough, self.clock)

    def _climb(self, sizes: Sizes, clock: Clock) -> None:
        """Move sizes until no move is better. What is known of other sizes ends no climb."""
        own = Incumbent(self.incumbent.statement, self.incumbent.options, self.incumbent.resolution)
        own.offer(np.zeros((1, own.options.slots), int))
        self.better, self.climb = _Nearer(self.incumbent if own.chosen is None else own, clock), clock
        small = sizes[0] if len(sizes) == self.most else sizes[-1]
        self._better(sizes, small)
        if len(sizes) < self.most:
            for size in dict.fromkeys(self._nearest(share * float(self.mass[sizes[-1]])) for share in _SHARES):
                small = size if self._better(sizes, size) else small
        for trims, sums in ((_TRIMS, _TRIED), (self.incumbent.options.slots, _WIDE)):
            self._better(sizes, small, trims, sums)
            moved: tuple[Sizes, int] | None = (sizes, small)
            while moved is not None and not self._over():
                sizes, small = moved
                moved = self._moved(sizes, small, trims, sums)

    def _in_use(self, slot: int) -> np.ndarray:
        """Nothing, and the options of a slot of the sizes that the best set has."""
        options, chosen = self.incumbent.options, self.incumbent.chosen
        assert chosen is not None
        parts = options.of(options.part, chosen)
        return np.union1d([0], np.flatnonzero(options.exists[slot] & np.isin(options.part[slot], parts[parts >= 0])))

    def _over(self) -> bool:
        return self.enough() or self.climb.spent()

    def _moved(self, main: Sizes, small: int, trims: int, sums: int) -> tuple[Sizes, int] | None:
        """Sizes of which one is some steps up or down, with which a better set was found; None where there are none."""
        for step in _STEPS:
            for n in range(len(main) + 1):
                moved = main if n == len(main) else (*main[:n], main[n] + step, *main[n + 1 :])
                other = small + step if n == len(main) else small
                inside = all(0 <= size < self.mass.size for size in (*moved, other))
                if inside and not self._over() and self._better(moved, other, trims, sums):
                    return moved, other
        return None

    def _better(self, main: Sizes, small: int, most_trims: int = _TRIMS, sums: int = _TRIED) -> bool:
        """Whether slots of the optimum with the main sizes, and others with the small one, make a better set."""
        found = False
        for trims in self.trims:
            which = [np.array([0]) for _ in range(self.incumbent.options.slots)]
            for k in self.used:
                which[k] = self._of_sizes(k, main)
            for k in self.used[_MAIN:]:
                which[k] = self._closest(k, which[k])
            for k in trims[:most_trims]:
                some = self._of_sizes(k, (small,))
                if _half_of(which) * np.sqrt(some.size) <= sums:
                    which[k] = some
            if not self._over():
                found |= self.better.found(self.loose, which, max(_SUMS, sums))
        best = self.better.incumbent.chosen
        if found and best is not None:
            self.incumbent.offer(best[None])
        return found

    def _closest(self, slot: int, some: np.ndarray) -> np.ndarray:
        """Of some options of a slot the one nearest to the optimum."""
        options = self.incumbent.options
        off = np.abs(options.unbalance[slot, some] - self.light[slot])
        return some[[int(np.argmin(off))]]

    def _of_sizes(self, slot: int, sizes: Sizes) -> np.ndarray:
        """Nothing, and the options of a slot that have these sizes."""
        parts: Real = self.parts[list(sizes)]
        options = self.incumbent.options
        return np.union1d([0], np.flatnonzero(options.exists[slot] & np.isin(options.part[slot], parts)))

    def _mass_of(self, slot: int) -> float:
        return float(self.incumbent.options.mass[slot, self.near[slot]])

    def _nearest(self, mass: float) -> int:
        return int(np.argmin(np.abs(self.mass - mass)))
