"""Exhaustion in halves: all sums of half the slots beside those of the other half."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock, Pace
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.choices.discrete.pairs import Pairs
from optimizer.choices.discrete.sums import SHORTER, Half, sums_of
from optimizer.numerics.arrays import Complex, Real

#: slots of the outer and of the inner sums of a half
Sides = tuple[list[int], list[int]]

#: sums of a half up to which they are listed, and at most where those of its quarters did not do
_LIST_SIZE, _LARGEST_LIST = 20_000, 300_000
#: pairs up to which all are evaluated
_FEW = 20_000
#: part numbers that fit into the bits of a whole number
_BITS = 62


class Halves(NamedTuple):
    """All sums of the slots, those of one half of them beside those of the other."""

    first: Half
    second: Half
    lever: Real  # (J, s) what the coordinates of the sums do to the terms
    terms: Complex  # (J,) of slots that take one option
    fixed: np.ndarray  # (K,) the first option of every slot
    sides: tuple[Sides, Sides]  # slots of either half, of more options than one
    candidates: Sequence[np.ndarray]  # (K) options of every slot

    def sets(self, i: np.ndarray, j: np.ndarray) -> np.ndarray:
        """The options (M, K) of pairs of sums, by their places (M,) in either half."""
        sets = np.tile(self.fixed, (i.size, 1))
        for sides, half, place in zip(self.sides, (self.first, self.second), (i, j), strict=True):
            for side, codes in zip(sides, half.codes(place), strict=True):
                code = codes
                for k in reversed(side):
                    code, digit = np.divmod(code, len(self.candidates[k]))
                    sets[:, k] = self.candidates[k][digit]
        return sets


def halves(
    options: Options,
    candidates: Sequence[np.ndarray],
    incumbent: Incumbent,
    most_sums: int,
    clock: Clock,
    most_kg: float = np.inf,
    with_lists: bool = True,
) -> Halves | None:
    """The sums of either half; None where they are more than so many, or than there is time for.

    Parameters
    ----------
    candidates : (K) options of every slot, at least one each.
    most_kg : mass of a half, kg, beyond which its sums are left out.
    with_lists : sums of a half are listed, once each, without those that counts leave out; else those of its quarters.
    """
    if options.limits_parts and np.max(options.part) > _BITS:
        return None
    many = sorted((k for k, entry in enumerate(candidates) if len(entry) > 1), key=lambda k: -len(candidates[k]))
    lever, effect = incumbent.coordinates
    fixed = np.array([entry[0] for entry in candidates], dtype=int)
    single = np.ones(options.slots, bool)
    single[many] = False
    rest = np.sum(options.of(effect, fixed)[single], axis=0)
    pace, results, sides = Pace(clock), list[Half](), list[Sides]()
    split_sides = many[::2], many[1::2]
    if not np.isfinite(most_kg):
        # a search that will end at its limits is not begun: lists are shorter by equal sums, but not by more
        lists = 1 if with_lists else 2
        if any(np.prod([float(len(candidates[k])) for k in side]) > SHORTER**lists * most_sums for side in split_sides):
            return None
    for side in split_sides:
        # those of a half are not listed where there is nothing to be left out
        apart = not with_lists and len(side) > 1
        split: Sides = (side[::2], side[1::2]) if apart else (side, [])
        outer = sums_of(options, effect, candidates, split[0], pace, most_sums, most_kg)
        inner = None if outer is None else sums_of(options, effect, candidates, split[1], pace, most_sums, most_kg)
        if outer is None or inner is None or outer.code.size * inner.code.size > most_sums:
            return None
        results.append(Half(outer, inner))
        sides.append(split)
    terms = incumbent.statement.norms.constant + lever @ rest
    return Halves(results[0], results[1], lever, terms, fixed, (sides[0], sides[1]), candidates)


def exhaust(
    options: Options,
    candidates: Sequence[np.ndarray],
    incumbent: Incumbent,
    most_sums: int,
    most_pairs: int,
    clock: Clock,
) -> bool:
    """Offer all that can be best; whether all were offered.

    Parameters
    ----------
    candidates : (K) options of every slot that are to be tried, at least one each.
    most_sums, most_pairs : sums of a half, and pairs of them, beyond which the search ends without a result.
    clock : what is left of the time; a search that would take longer does not begin.
    """
    has_counts = options.limits_fitted or options.limits_parts
    several = np.sort([float(len(entry)) for entry in candidates])[::-1]
    if not has_counts and np.prod(several[::2]) > _LIST_SIZE and np.isfinite(incumbent.level):
        split = halves(options, candidates, incumbent, most_sums, clock, with_lists=False)
        if split is not None and _compared(split, incumbent, most_pairs, clock):
            return True
    # sums that are the same are listed once
    split = halves(options, candidates, incumbent, min(most_sums, _LARGEST_LIST), clock)
    return split is not None and _compared(split, incumbent, most_pairs, clock)


def _compared(split: Halves, incumbent: Incumbent, most_pairs: int, clock: Clock) -> bool:
    """Whether all pairs that can be best were offered."""

    def offered(i: np.ndarray, j: np.ndarray) -> None:
        incumbent.offer(split.sets(i, j))

    pairs = Pairs(incumbent.statement, split.first, split.second, split.lever, split.terms, incumbent, offered)
    if pairs.count <= _FEW:
        return pairs.count <= most_pairs and pairs.all(clock)
    return pairs.near(most_pairs, clock)
