"""Search without proof: rounded sets, and then the best of the neighbourhoods of a set, some slots at a time."""

from collections.abc import Callable

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.halves import exhaust
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.numerics.arrays import Complex

#: sums of a half of a neighbourhood, and pairs of them that are evaluated
_SUMS, _PAIRS = 900, 20_000
#: slots that change together, one after the other
_SIZES = (2, 4, 6)
_SEED = 20_240_229


def start(incumbent: Incumbent, u: Complex) -> None:
    """Offer nothing on any slot, and the nearest options to unbalances of first webs (M, K) as they are and partly."""
    options = incumbent.options
    near = options.nearest(u)
    incumbent.offer(np.concatenate([np.zeros((1, options.slots), int), near]))
    for every in range(u.shape[0]):
        # the largest first, as far as budget and counts allow
        order = np.argsort(-np.abs(u[every]), kind="stable")
        rank = np.argsort(order, kind="stable")
        incumbent.offer(np.where(rank[None] < np.arange(1, options.slots)[:, None], near[every], 0))


def neighbourhoods(incumbent: Incumbent, u: Complex, patience: int, enough: Callable[[], bool], clock: Clock) -> None:
    """Make the set better, a few slots at a time, until many attempts in a row fail.

    Parameters
    ----------
    u : (K,) kg m, what the options that are tried are near to, beside what is on the slots.
    patience : neighbourhoods in a row, for every slot, without a better set, after which it ends.
    enough : whether the set is within the target gap.
    """
    options, chance = incumbent.options, np.random.default_rng(_SEED)
    useful = np.flatnonzero(np.sum(options.exists, axis=-1) > 1)
    left = patience * useful.size
    while left > 0 and incumbent.selection is not None and not enough() and not clock.spent():
        size = min(int(chance.choice(_SIZES)), useful.size)
        slots = chance.choice(useful, size, replace=False)
        before, target = (incumbent.least, tuple(incumbent.selection)), u if chance.random() < 0.5 else None
        candidates = [np.array([option]) for option in incumbent.selection]
        most = max(2, int(_SUMS ** (1.0 / (-(-size // 2)))))
        for k in slots:
            about = options.unbalance[k, incumbent.selection[k]] if target is None else target[k]
            candidates[k] = _about(options, k, about, int(incumbent.selection[k]), most)
        exhaust(options, candidates, incumbent, _SUMS, _PAIRS, clock)
        left = left - 1 if (incumbent.least, tuple(incumbent.selection)) == before else patience * useful.size


def _about(options: Options, slot: int, about: complex, current: int, most: int) -> np.ndarray:
    """Nothing, what is taken, and the options of a slot that are nearest to an unbalance: at most so many."""
    count = int(np.sum(options.exists[slot]))
    if count <= most:
        return np.arange(count)
    nearest = np.argsort(np.abs(options.unbalance[slot, :count] - about), kind="stable")[: max(most - 2, 1)]
    return np.unique(np.concatenate([[0, current], nearest]))
