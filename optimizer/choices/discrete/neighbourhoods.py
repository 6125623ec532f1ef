"""Options of few slots that are looked at together: near to an optimum of any masses, or light."""

from collections.abc import Iterator
from itertools import combinations, islice

import numpy as np

from optimizer.choices.discrete.options import Options
from optimizer.numerics.arrays import Complex

#: pairs of slots that the optimum uses that are looked at
_MOVING = 6
#: share of the largest unbalance of the optimum from which on a slot is used by it
_USED = 1e-3


def near_options(options: Options, slot: int, about: complex, count: int) -> np.ndarray:
    """Nothing, and the options of a slot that are nearest to an unbalance."""
    off = np.where(options.exists[slot], np.abs(options.unbalance[slot] - about), np.inf)
    nearest = np.argsort(off, kind="stable")[: min(count, int(np.sum(options.exists[slot])))]
    return np.union1d([0], nearest)


def light_options(options: Options, slot: int, count: int) -> np.ndarray:
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
    trim_sets: list[tuple[int, ...]] = list(islice(combinations(rest, beside), several)) or [tuple(rest)]
    for slots in moving:
        for trims in trim_sets:
            candidates = [np.array([option]) for option in base]
            for k in slots:
                candidates[k] = near_options(options, k, light[k], near)
            for k in trims:
                candidates[k] = light_options(options, k, many)
            yield candidates


def used_slots(light: Complex) -> list[int]:
    """Slots that an optimum of any masses (K,) kg m uses."""
    return np.flatnonzero(np.abs(light) > _USED * np.max(np.abs(light), initial=0.0)).tolist()
