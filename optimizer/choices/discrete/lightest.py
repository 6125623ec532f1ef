"""The lightest set whose objective is no more than a level.

Light sets are few: of the sums of either half those below a mass are compared, then those below a larger one. The first
pair that keeps the level ends it, since all lighter ones were compared.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.halves import Halves, halves
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.choices.discrete.pairs import Pairs
from optimizer.program.statement import Statement

#: sums of a half, and pairs of them near enough to the level, that are compared
_SUMS, _PAIRS = 100_000, 3_000_000
#: sums of a half that are not listed
_UNLISTED = 1_000_000
#: steps of the mass
_STEP = 1.15
#: share of a mass by which another is lighter
_LIGHTER = 1e-9
#: by which sums of masses are rounded, relative
_ROUNDING = 1e-12


class Lightest(NamedTuple):
    """The lightest set, and its lower bound."""

    selection: np.ndarray | None  # (K,); None where the search has none of less than the largest mass
    lower_bound: float  # kg, no set that keeps the level is lighter; inf where none can be

    @property
    def whole(self) -> bool:
        """Whether all that can be lighter were compared."""
        return self.lower_bound > 0.0


def lightest(
    statement: Statement,
    options: Options,
    candidates: Sequence[np.ndarray],
    level: float,
    masses_kg: tuple[float, float],
    clock: Clock,
) -> Lightest:
    """The lightest of the sets whose objective is no more than a level, and of equal ones the one with the smallest.

    Parameters
    ----------
    candidates : (K) options of every slot that are compared, at least one each.
    masses_kg : lower bound of a set that keeps the level, and the mass that a result must be below.
    """
    least, most = masses_kg
    within = Incumbent(statement, options, 0.0)
    within.least = level
    cap = least
    while least < most and not clock.spent():
        cap = min(max(_STEP * cap, _next_mass(options, least)), most)
        split = halves(options, candidates, within, _SUMS, clock, cap * (1.0 + _ROUNDING))
        best = _LightestSet(statement, options, level)
        if split is None or not _compared(split, within, cap, best.offer, clock):
            return Lightest(best.selection, least)
        if best.selection is not None:
            return Lightest(best.selection, max(least, best.mass))
        least = cap
    return Lightest(None, least)


def lighter(
    statement: Statement,
    options: Options,
    candidates: Sequence[np.ndarray],
    level: float,
    below_kg: float,
    clock: Clock,
    fewer_than: int = 0,
    most_pairs: int = _PAIRS,
) -> Lightest:
    """The lightest of some sets that keep a level and are lighter than so much; no bound where not all were compared.

    Parameters
    ----------
    candidates : (K) options of every slot that are compared.
    fewer_than : or as heavy, on fewer slots than these.
    most_pairs : near enough to the level, after which the search ends without a result.
    """
    within = Incumbent(statement, options, 0.0)
    within.least = level
    cap = below_kg * (1.0 - (0.0 if fewer_than else _LIGHTER))
    best = _LightestSet(statement, options, level, cap, fewer_than or options.slots + 1)
    if cap <= 0:
        return Lightest(None, np.inf)
    has_counts = options.limits_fitted or options.limits_parts
    split = None if has_counts else halves(options, candidates, within, _UNLISTED, clock, cap, with_lists=False)
    split = split or halves(options, candidates, within, _SUMS, clock, cap)
    whole = split is not None and _compared(split, within, cap, best.offer, clock, most_pairs)
    return Lightest(best.selection, min(best.mass, below_kg) if whole else 0.0)


def _next_mass(options: Options, least: float) -> float:
    """The smallest mass of a set, kg, that is more than so much: a step of the mass may hold none."""
    masses = options.mass[options.exists & (options.mass > 0)]
    return least + float(np.min(masses, initial=np.inf)) if masses.size else np.inf


class _LightestSet:
    """The lightest set so far; of equal ones that on the fewest slots, and of these the one with the smallest value."""

    def __init__(
        self, statement: Statement, options: Options, level: float, mass: float = np.inf, slots: float = np.inf
    ) -> None:
        """``mass``, ``slots``: kg, and how many slots, of what it is to be better than."""
        self.statement, self.options, self.level = statement, options, level
        self.selection: np.ndarray | None = None
        self.mass, self.slots, self.value = mass, slots, -np.inf

    def offer(self, sets: np.ndarray) -> None:
        """Take the best of sets (M, K) that keep the level and all limits, or stay."""
        sets = sets[self.options.counts(self.statement, sets)]
        if not len(sets):
            return
        u = self.options.carried(sets)
        value = self.statement.objective(u)
        mask = (value <= self.level) & np.all(
            self.statement.ceilings.excess(u) <= self.statement.ceilings.tolerance, axis=-1
        )
        mass = np.sum(self.options.of(self.options.mass, sets), axis=-1)
        mask &= mass <= self.mass * (1.0 + _ROUNDING)
        if not mask.any():
            return
        sets, mass, value = sets[mask], mass[mask], value[mask]
        slots = np.count_nonzero(sets, axis=-1)
        steps = np.round(mass / (_LIGHTER * (np.max(mass) or 1.0)))
        n = int(np.lexsort((value, slots, steps))[0])
        lighter = mass[n] < self.mass * (1.0 - _ROUNDING)
        if lighter or (slots[n], value[n]) < (self.slots, self.value):
            self.selection, self.mass, self.slots, self.value = sets[n], float(mass[n]), int(slots[n]), float(value[n])


def _compared(
    split: Halves,
    within: Incumbent,
    cap: float,
    offer: Callable[[np.ndarray], None],
    clock: Clock,
    most_pairs: int = _PAIRS,
) -> bool:
    """Whether all pairs of sums that are no heavier than so much were offered where they are near the level."""
    half, second = split.first, split.second
    if not half.size or not second.size:
        return True

    def offered(i: np.ndarray, j: np.ndarray) -> None:
        light = half.mass(i) + second.mass(j) <= cap * (1.0 + _ROUNDING)
        if np.any(light):
            offer(split.sets(i[light], j[light]))

    pairs = Pairs(within.statement, half, second, split.lever, split.terms, within, offered)
    return pairs.near(most_pairs, clock)
