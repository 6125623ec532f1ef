"""Exhaustion in halves: all sums of half the slots beside those of the other half."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from optimizer.choices.discrete.clock import Clock, Pace
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.choices.discrete.pairs import Pairs
from optimizer.choices.discrete.sums import Sums, sums_of
from optimizer.numerics.arrays import Complex, Real

#: pairs up to which all are evaluated
_FEW = 20_000
#: part numbers that fit into the bits of a whole number
_BITS = 62


class Halves(NamedTuple):
    """All sums of the slots, those of one half of them beside those of the other."""

    one: Sums
    other: Sums
    lever: Real  # (J, s) what the coordinates of the sums do to the terms
    terms: Complex  # (J,) of slots that take one option
    fixed: np.ndarray  # (K,) the first option of every slot
    sides: tuple[list[int], list[int]]  # slots of either half, of more options than one
    which: Sequence[np.ndarray]  # (K) options of every slot

    def sets(self, i: np.ndarray, j: np.ndarray) -> np.ndarray:
        """The options (M, K) of pairs of sums, by their places (M,) in either half."""
        sets = np.tile(self.fixed, (i.size, 1))
        for side, sums, place in zip(self.sides, (self.one, self.other), (i, j), strict=True):
            code = sums.code[place]
            for k in reversed(side):
                code, digit = np.divmod(code, len(self.which[k]))
                sets[:, k] = self.which[k][digit]
        return sets


def halves(
    options: Options,
    which: Sequence[np.ndarray],
    incumbent: Incumbent,
    most_sums: int,
    clock: Clock,
    most_kg: float = np.inf,
) -> Halves | None:
    """The sums of either half; None where they are more than so many, or than there is time for.

    Parameters
    ----------
    which : (K) options of every slot, at least one each.
    most_kg : mass of a half, kg, beyond which its sums are left out.
    """
    if options.limits_parts and np.max(options.part) > _BITS:
        return None
    many = sorted((k for k, some in enumerate(which) if len(some) > 1), key=lambda k: -len(which[k]))
    sides = many[::2], many[1::2]
    lever, effect = incumbent.coordinates
    fixed = np.array([some[0] for some in which], dtype=int)
    single = np.ones(options.slots, bool)
    single[many] = False
    rest = np.sum(options.of(effect, fixed)[single], axis=0)
    pace = Pace(clock)
    one = sums_of(options, effect, which, sides[0], pace, most_sums, most_kg)
    other = None if one is None else sums_of(options, effect, which, sides[1], pace, most_sums, most_kg)
    if one is None or other is None:
        return None
    terms = incumbent.statement.norms.constant + lever @ rest
    return Halves(one, other, lever, terms, fixed, sides, which)


def exhaust(
    options: Options,
    which: Sequence[np.ndarray],
    incumbent: Incumbent,
    most_sums: int,
    most_pairs: int,
    clock: Clock,
) -> bool:
    """Offer all that can be best; whether all were offered.

    Parameters
    ----------
    which : (K) options of every slot that are to be tried, at least one each.
    most_sums, most_pairs : sums of a half, and pairs of them, beyond which it is given up.
    clock : what is left of the time; what there is not enough for is given up.
    """
    split = halves(options, which, incumbent, most_sums, clock)
    if split is None:
        return False
    one, other = split.one, split.other
    if not one.code.size or not other.code.size:
        return True

    def offered(i: np.ndarray, j: np.ndarray) -> None:
        incumbent.offer(split.sets(i, j))

    pairs = Pairs(incumbent.statement, one.z, other.z, split.lever, split.terms, incumbent, offered)
    # without coordinates all pairs are in one place, and none is nearer than another
    if not np.isfinite(incumbent.level) or pairs.count <= _FEW or not split.lever.shape[-1]:
        return pairs.count <= most_pairs and pairs.all(clock)
    pairs.nearest(clock)
    return pairs.near(most_pairs, clock)
