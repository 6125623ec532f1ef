"""Lighter sets of few part numbers: main sizes and a small one change together.

A main size of a step more or less leaves another residual, which small castings of another size cancel. So neither is
moved alone. Slots of the optimum take the options nearest to it, which are few; the others take any of the small size.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations, product
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.lightest import lighter
from optimizer.choices.discrete.options import Options
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.statement import Statement

#: options of a slot of the optimum that are tried, and steps of the main sizes
_NEAR, _STEPS = 7, (0, 1, -1, 2, -2)
#: smallest sizes that are tried beside them, and how many castings of these a set has, about and at least
_SMALL, _TRIMS, _FEWEST = 12, 4, 2
#: sums of a half, and pairs of them, that are compared
_SUMS, _PAIRS = 130_000, 60_000
#: main sizes of which every one has steps of its own
_APART = 2
#: ways to part masses in heaps up to which all are compared
_CUTS = 1_000


class Sizes(NamedTuple):
    """Main sizes and a small one, by their places in the order of masses."""

    main: tuple[int, ...]
    small: int


class LightSizes:
    """Sets of few part numbers near to an optimum of any masses, no worse than a limit."""

    def __init__(self, statement: Statement, options: Options, light: Complex, used: list[int]) -> None:
        """
        Parameters
        ----------
        light : (K,) kg m of first webs, the optimum.
        used : slots that it uses, one at least.
        """
        self.statement, self.options, self.light, self.used = statement, options, light, used
        # what is left of the choice by its sizes is not to be counted again
        self.loose = replace(options, most_parts=None)
        parts = np.unique(options.part[options.exists & (options.part >= 0)])
        mass = np.array([np.min(options.mass[options.part == part]) for part in parts])
        order = np.argsort(mass, kind="stable")
        self.parts, self.mass = parts[order], mass[order]
        near = options.nearest(light)
        self.own = np.sort([float(options.mass[k, near[k]]) for k in used])
        self.limit, self.clock = -np.inf, Clock(0.0)
        self.selection: np.ndarray | None = None
        self.history = set[Sizes]()

    def below(self, selection: np.ndarray | None, limit: float, clock: Clock) -> np.ndarray | None:
        """The lightest set (K,) so far; None where there is none.

        Parameters
        ----------
        selection : one that keeps the limit, if there is one.
        limit : of the objective. Sizes that were tried for no less are not tried again.
        """
        if self.selection is not None and self._value(self.selection) > limit:
            self.selection = None
        if limit > self.limit or self.selection is None:
            self.history.clear()
        self.limit, self.clock = limit, clock
        if self.selection is None or (selection is not None and self._mass(selection) < self._mass(self.selection)):
            self.selection = selection
        first = self._middles()
        middles, step = first, 1
        while not clock.spent():
            better = self._better(self._about(middles, step))
            if better is not None:
                # what was better may be better still farther on
                middles, step = {self._of(better)}, 2 * step
            elif step > 1:
                step = 1
            elif middles != first:
                middles = first
            else:
                break
        return self.selection

    def _better(self, several: list[Sizes]) -> np.ndarray | None:
        """A lighter set (K,) of some sizes, what is likely to be lightest first; None where there is none."""
        better: np.ndarray | None = None
        mass = np.inf if self.selection is None else self._mass(self.selection)
        for sizes in sorted((candidate for candidate in several if candidate not in self.history), key=self._likely):
            least = len(self.used) * float(self.mass[sizes.main[0]]) + _FEWEST * float(self.mass[sizes.small])
            for candidates in self._options(sizes) if least < mass else ():
                if self.clock.spent():
                    return better
                light = lighter(
                    self.statement, self.loose, candidates, self.limit, mass, self.clock, most_pairs=_PAIRS
                ).selection
                if light is not None:
                    self.selection, better, mass = light, light, self._mass(light)
            self.history.add(sizes)
            if better is not None:
                break
        return better

    def _likely(self, sizes: Sizes) -> float:
        """About what a set of some sizes weighs, kg: those nearest to the optimum, and some castings of a small one."""
        main = self.mass[list(sizes.main)]
        own = main[np.argmin(np.abs(self.own[:, None] - main), axis=-1)]
        return float(np.sum(own)) + _TRIMS * float(self.mass[sizes.small]) * (sizes.small < sizes.main[0])

    def _middles(self) -> set[tuple[int, ...]]:
        """Main sizes of slots of the optimum, in one heap fewer than there may be sizes, or in as many."""
        most, middles = self.options.most_parts or 0, set()
        for number in (most - 1, most):
            # of fewer slots than sizes a heap is left for trims; as many may keep the limit without any
            if number >= 1 and (number < most or self.own.size >= most):
                middles.add(tuple(sorted({self._nearest(float(np.mean(heap))) for heap in _heaps(self.own, number)})))
        return middles

    def _of(self, selection: np.ndarray) -> tuple[int, ...]:
        """Sizes of a set."""
        parts = self.options.of(self.options.part, selection)
        return tuple(np.flatnonzero(np.isin(self.parts, parts)).tolist())

    def _about(self, middles: set[tuple[int, ...]], far: int) -> list[Sizes]:
        """Main sizes so far from some, with a small one where there may be another."""
        neighbours = set[Sizes]()
        for middle in middles:
            apart = len(middle) <= _APART
            steps = product(_STEPS, repeat=len(middle)) if apart else ((step,) * len(middle) for step in _STEPS)
            for step in steps:
                main = tuple(sorted({size + far * more for size, more in zip(middle, step, strict=True)}))
                # of no castings there are no sizes
                if not main or not 0 <= main[0] <= main[-1] < self.mass.size:
                    continue
                fewer = len(main) < (self.options.most_parts or 0)
                neighbours.update(
                    Sizes(main, small) for small in (range(min(_SMALL, main[0])) if fewer else (main[0],))
                )
        return sorted(neighbours)

    def _options(self, sizes: Sizes) -> Iterator[list[np.ndarray]]:
        """Options of every slot (K): near ones of those of the optimum, small ones of as many others as can be."""
        main = {k: self._close(k, {*sizes.main, sizes.small}) for k in self.used}
        rest = [k for k in range(self.options.slots) if k not in main]
        small = {k: self._of_sizes(k, {sizes.small}) for k in rest}
        # every second first: trims on either end
        for order in (rest[::2] + rest[1::2], rest[1::2] + rest[::2]):
            candidates = [main.get(k, np.array([0])) for k in range(self.options.slots)]
            whole = True
            for k in order:
                if np.prod([float(entry.size) for entry in candidates]) * small[k].size <= float(_SUMS) ** 2:
                    candidates[k] = small[k]
                else:
                    whole = False
            yield candidates
            if whole:
                break

    def _close(self, slot: int, sizes: set[int]) -> np.ndarray:
        """Nothing, and of the options of a slot that have some sizes those nearest to the optimum."""
        places = self._of_sizes(slot, sizes)
        off = np.abs(self.options.unbalance[slot, places] - self.light[slot])
        return np.union1d([0], places[np.argsort(off, kind="stable")[:_NEAR]])

    def _of_sizes(self, slot: int, sizes: set[int]) -> np.ndarray:
        """Nothing, and the options of a slot that have some sizes."""
        options, parts = self.options, self.parts[list(sizes)]
        return np.union1d([0], np.flatnonzero(options.exists[slot] & np.isin(options.part[slot], parts)))

    def _mass(self, selection: np.ndarray) -> float:
        return float(np.sum(self.options.of(self.options.mass, selection)))

    def _value(self, selection: np.ndarray) -> float:
        return float(self.statement.objective(self.options.carried(selection)))

    def _nearest(self, mass: float) -> int:
        masses: Real = self.mass
        return int(np.argmin(np.abs(masses - mass)))


def _heaps(masses: Real, number: int) -> list[Real]:
    """Masses (n,) in order, in so many heaps at most, as near to their means as can be where ways are few."""
    if math.comb(masses.size - 1, min(number, masses.size) - 1) > _CUTS:
        return [heap for heap in np.array_split(masses, number) if heap.size]
    cuts = combinations(range(1, masses.size), min(number, masses.size) - 1)
    return min(
        (np.split(masses, cut) for cut in cuts),
        key=lambda heaps: sum(heap.size * float(np.var(heap)) for heap in heaps),
    )
