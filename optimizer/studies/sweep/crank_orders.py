"""Orders of crank angles along a shaft, one of those that are the same machine."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from optimizer.numerics.arrangements import arrangements
from optimizer.numerics.arrays import Real
from schemas.sweep.crank_orders import CrankOrders


@lru_cache(maxsize=4)
def orders(request: CrankOrders) -> Real:
    """Angles (N, throws) deg of the first of all orders that are one machine, in rising order.

    How many there may be is a rule of the request.
    """
    times = np.array(request.times)
    if request.alike:
        # the first of them begins with the first angle
        rest = arrangements(times - np.eye(times.size, dtype=np.int64)[0], int(np.sum(times)) - 1)
        result = np.concatenate([np.zeros((len(rest), 1), dtype=np.int64), rest], axis=1)
    else:
        result = arrangements(times, int(np.sum(times)))
    own = _code(result, times.size)
    for symmetry in request.symmetries:
        image = np.array(symmetry.image)[result]
        first = own <= _code(image[:, ::-1] if symmetry.reversed else image, times.size)
        result, own = result[first], own[first]
    angles: Real = np.array(request.angles_deg)[result]
    return angles


def _code(sequences: NDArray[np.int64], kinds: int) -> NDArray[np.int64]:
    """A number for each sequence (N, throws) by which they are ordered."""
    places: NDArray[np.int64] = kinds ** np.arange(sequences.shape[1] - 1, -1, -1, dtype=np.int64)
    return sequences @ places
