"""All different arrangements of things of which some are alike."""

import numpy as np
from numpy.typing import NDArray


def arrangements(times: NDArray[np.int64], places: int, most: int) -> NDArray[np.int64] | None:
    """Numbers of kinds (N, places) of all arrangements, in rising order; None where there are more than ``most``.

    Parameters
    ----------
    times : (kinds,) how many there are of every kind, together at least as many as places.
    """
    left, chosen = np.asarray(times)[None, :], np.zeros((1, 0), dtype=np.int64)
    for _ in range(places):
        before, kind = np.nonzero(left)
        if before.size > most:
            return None
        left = left[before]
        left[np.arange(before.size), kind] -= 1
        chosen = np.concatenate([chosen[before], kind[:, None]], axis=1)
    return chosen
