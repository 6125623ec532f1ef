"""Which part numbers to use, where fewer may be used than there are."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.few_slots import SUMS, Nearer, improve
from optimizer.choices.discrete.options import Incumbent
from optimizer.numerics.arrays import Complex, Real

#: sums of a half where sizes are tried, and of those that are best
_TRIAL_SUMS, _WIDE = 4_000, 500_000
#: slots beside those of the optimum where few part numbers may be used
_TRIMS = 4
#: slots of the optimum that may take any angle
_MAIN = 3
#: further sizes, as shares of those of the optimum, and steps by which sizes are moved
_SHARES, _STEPS = (0.025, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3, 0.5), (1, -1, 2, -2, 4, -4)

Sizes = tuple[int, ...]


def _half_of(candidates: Sequence[np.ndarray]) -> float:
    """Sums of a half, about."""
    return float(np.sqrt(np.prod([float(options.size) for options in candidates])))


class PartSizes:
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
        self.better, self.climb = Nearer(incumbent, clock), clock
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
        starts: list[Sizes] = list(dict.fromkeys(tuple(choice.tolist()) for choice in (main, several) if choice.size))
        for n, sizes in enumerate(starts):
            self._climb(sizes, Clock(self.clock.left_s / (len(starts) - n)))
        improve(self.incumbent, self.loose, self._in_use, self.enough, self.clock)

    def _climb(self, sizes: Sizes, clock: Clock) -> None:
        """Move sizes until no move is better. The incumbent of other sizes ends no climb."""
        own = Incumbent(self.incumbent.statement, self.incumbent.options, self.incumbent.resolution)
        own.offer(np.zeros((1, own.options.slots), int))
        self.better, self.climb = Nearer(self.incumbent if own.selection is None else own, clock), clock
        small = sizes[0] if len(sizes) == self.most else sizes[-1]
        self._better(sizes, small)
        if len(sizes) < self.most:
            for size in dict.fromkeys(self._nearest(share * float(self.mass[sizes[-1]])) for share in _SHARES):
                small = size if self._better(sizes, size) else small
        for trims, sums in ((_TRIMS, _TRIAL_SUMS), (self.incumbent.options.slots, _WIDE)):
            self._better(sizes, small, trims, sums)
            move: tuple[Sizes, int] | None = (sizes, small)
            while move is not None and not self._over():
                sizes, small = move
                move = self._move(sizes, small, trims, sums)

    def _in_use(self, slot: int, selection: np.ndarray) -> np.ndarray:
        """Nothing, and the options of a slot of the sizes that a set (K,) has."""
        options = self.incumbent.options
        parts = options.of(options.part, selection)
        return np.union1d([0], np.flatnonzero(options.exists[slot] & np.isin(options.part[slot], parts[parts >= 0])))

    def _over(self) -> bool:
        return self.enough() or self.climb.spent()

    def _move(self, main: Sizes, small: int, trims: int, sums: int) -> tuple[Sizes, int] | None:
        """Sizes after some steps up or down of one, if these hold a better set; None otherwise."""
        for step in _STEPS:
            for n in range(len(main) + 1):
                sizes = main if n == len(main) else (*main[:n], main[n] + step, *main[n + 1 :])
                trim_size = small + step if n == len(main) else small
                inside = all(0 <= size < self.mass.size for size in (*sizes, trim_size))
                if inside and not self._over() and self._better(sizes, trim_size, trims, sums):
                    return sizes, trim_size
        return None

    def _better(self, main: Sizes, small: int, most_trims: int = _TRIMS, sums: int = _TRIAL_SUMS) -> bool:
        """Whether slots of the optimum with the main sizes, and others with the small one, make a better set."""
        better = False
        for trims in self.trims:
            candidates = [np.array([0]) for _ in range(self.incumbent.options.slots)]
            for k in self.used:
                candidates[k] = self._of_sizes(k, main)
            for k in self.used[_MAIN:]:
                candidates[k] = self._closest(k, candidates[k])
            for k in trims[:most_trims]:
                choices = self._of_sizes(k, (small,))
                if _half_of(candidates) * np.sqrt(choices.size) <= sums:
                    candidates[k] = choices
            if not self._over():
                better |= self.better.improves(self.loose, candidates, max(SUMS, sums))
        best = self.better.incumbent.selection
        if better and best is not None:
            self.incumbent.offer(best[None])
        return better

    def _closest(self, slot: int, choices: np.ndarray) -> np.ndarray:
        """Of some options of a slot the one nearest to the optimum."""
        options = self.incumbent.options
        off = np.abs(options.unbalance[slot, choices] - self.light[slot])
        return choices[[int(np.argmin(off))]]

    def _of_sizes(self, slot: int, sizes: Sizes) -> np.ndarray:
        """Nothing, and the options of a slot that have these sizes."""
        parts: Real = self.parts[list(sizes)]
        options = self.incumbent.options
        return np.union1d([0], np.flatnonzero(options.exists[slot] & np.isin(options.part[slot], parts)))

    def _mass_of(self, slot: int) -> float:
        return float(self.incumbent.options.mass[slot, self.near[slot]])

    def _nearest(self, mass: float) -> int:
        return int(np.argmin(np.abs(self.mass - mass)))
