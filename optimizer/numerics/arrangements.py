"""All different arrangements of things of which some are alike."""

from math import comb

import numpy as np
from numpy.typing import NDArray


def few_arrangements(times: NDArray[np.int64], places: int, most: int) -> NDArray[np.int64] | None:
    """The same as :func:`arrangements`; None where there are more than ``most``."""
    return None if _number(times, places) > most else arrangements(times, places)


def arrangements(times: NDArray[np.int64], places: int) -> NDArray[np.int64]:
    """Numbers of kinds (N, places) of all arrangements, in rising order.

    Parameters
    ----------
    times : (kinds,) how many there are of every kind, together at least as many as places.
    """
    left, kinds = np.asarray(times)[None, :], np.zeros((1, 0), dtype=np.int64)
    for _ in range(places):
        before, kind = np.nonzero(left)
        left = left[before]
        left[np.arange(before.size), kind] -= 1
        kinds = np.concatenate([kinds[before], kind[:, None]], axis=1)
    return kinds


def _number(times: NDArray[np.int64], places: int) -> int:
    """How many arrangements there are: kind by kind, of the places that are left some for it."""
    ways = [1, *(0 for _ in range(places))]
    for most in np.asarray(times).tolist():
        ways = [sum(comb(p, j) * ways[p - j] for j in range(min(most, p) + 1)) for p in range(places + 1)]
    return ways[-1]
