"""Sums of four lists of points that come near to a point, among more than can be compared.

Pairs of two lists are kept whose sums are near a share of the target, and pairs of the other two whose sums are near
the rest. Of these the nearest to one another are the result (Schroeppel and Shamir 1981, Wagner 2002).
"""

from collections.abc import Sequence

import numpy as np

from optimizer.numerics.arrays import Real

#: pairs of points of two lists that are kept, and sums of all four that are taken
_PAIRS, _NEAREST = 300_000, 64
#: of two normal sums of deviation 1 that come together, density where they do: 1 / sqrt(2 pi)
_SPREAD = 2.51
#: sides of cells that are tried
_SIDES = 3


def nearest_sums(lists: Sequence[Real], about: Real, target: Real) -> np.ndarray:
    """Points of four lists, (n, d) each, whose sums are nearest to a target (d,): their numbers (4, M).

    Parameters
    ----------
    about : (d,) what points of the first two lists come to together, about.
    """
    points, two, three, four = lists
    first, second = _met(points, about - two), _met(three, target - about - four)
    left, right = points[first[0]] + two[first[1]], three[second[0]] + four[second[1]]
    i, j = _met(left, target - right)
    apart = np.sum((left[i] + right[j] - target) ** 2, axis=1)
    best = np.argpartition(apart, _NEAREST)[:_NEAREST] if apart.size > _NEAREST else np.arange(apart.size)
    return np.concatenate([first[:, i[best]], second[:, j[best]]])


def _met(left: Real, right: Real) -> np.ndarray:
    """Which points are near to one another (2, k): about as many as are kept, if they scatter as normal ones do."""
    # the compiler is loaded at its first use
    from optimizer.numerics.kernel.meeting import met

    if not (len(left) and len(right)):
        return np.zeros((2, 0), np.int64)
    # as if points were spread as normal ones, and then as they are
    scatter = _SPREAD * np.hypot(np.std(left, axis=0), np.std(right, axis=0))
    wide, most = scatter > 0, 2 * _PAIRS
    few = len(left) * len(right) <= most or not np.any(wide)
    share = 1.0 / max(np.sum(wide), 1)
    side = np.inf if few else float((_PAIRS / (len(left) * len(right)) * np.prod(scatter[wide])) ** share)
    left, right = np.ascontiguousarray(left), np.ascontiguousarray(right)
    for _ in range(_SIDES):
        pairs: np.ndarray = met(left, right, side, most)
        if few or most > pairs.shape[1] >= _PAIRS // 2:
            break
        side *= (_PAIRS / max(pairs.shape[1], 1)) ** share
    return pairs
