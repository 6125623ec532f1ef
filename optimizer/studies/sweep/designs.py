"""From the number of a design to the values of its axes, for any range of numbers, in memory of that range.

A value depends on the request and on the number of the design alone, so that the rows are the same
whatever the chunks, the workers and their order.
"""

from collections.abc import Sequence

import numpy as np
from numpy.random import Philox
from numpy.typing import NDArray

from optimizer.numerics.arrays import Real
from optimizer.studies.sweep.crank_orders import orders
from schemas.base.target import Target
from schemas.sweep.axes import Axis
from schemas.sweep.request import SweepRequest

Indices = NDArray[np.int64]

_ROUNDS = 8
#: bits of the smallest domain that is permuted; on fewer there are too few keyed permutations
_FEWEST_BITS = 6


def axis_values(request: SweepRequest, start: int, stop: int) -> list[Real]:
    """Values of each axis for the designs start..stop-1, (stop - start,) in the unit of the field; nan is null."""
    if request.crank_orders is not None:
        return list(orders(request.crank_orders)[start:stop].T)
    index = np.arange(start, stop, dtype=np.int64)
    if request.design == "latin_hypercube":
        return [
            _sampled(axis, target, index, request.samples or 1, request.seed, number)
            for number, (axis, target) in enumerate(zip(request.axes, request.targets, strict=True))
        ]
    if request.design == "paired":
        positions: Sequence[Indices] = [index] * len(request.axes)
    else:
        positions = np.unravel_index(index, [axis.levels or 1 for axis in request.axes])
    return [
        _level(axis, target, position)
        for axis, target, position in zip(request.axes, request.targets, positions, strict=True)
    ]


def permuted(index: Indices, count: int, seed: int, axis: int) -> Indices:
    """A pseudo-random permutation of 0..count-1 at some of its places (n,), without the others.

    As :mod:`optimizer.numerics.kernel.permutation`.
    """
    # the compiler is loaded at its first use
    from optimizer.numerics.kernel.permutation import permute

    bits = max((count - 1).bit_length(), _FEWEST_BITS)
    result = index.astype(np.uint64)
    work = np.empty(index.shape, np.int64), np.empty(index.shape, np.uint64)
    permute(result, np.uint64(count), bits, Philox(key=[seed, 2 * axis + 1]).random_raw(_ROUNDS), *work)
    return result.astype(np.int64)


def uniform(start: int, stop: int, seed: int, axis: int) -> Real:
    """Uniform numbers in [0, 1) that belong to the numbers start..stop-1, (stop - start,)."""
    # one count of Philox holds four numbers
    skipped = start % 4
    words = Philox(key=[seed, 2 * axis], counter=start // 4).random_raw(skipped + stop - start)[skipped:]
    return np.asarray(words >> np.uint64(11), dtype=float) * 2.0**-53


def _sampled(axis: Axis, target: Target, index: Indices, count: int, seed: int, number: int) -> Real:
    """One value from each of ``count`` equal strata of the axis, in pseudo-random order."""
    stratum = permuted(index, count, seed, number)
    jitter = uniform(int(index[0]), int(index[-1]) + 1, seed, number) if index.size else np.zeros(0)
    share = (stratum + jitter) / count
    if axis.levels is None:
        return _between(axis, target, share)
    return _level(axis, target, np.minimum((share * axis.levels).astype(np.int64), axis.levels - 1))


def _level(axis: Axis, target: Target, position: Indices) -> Real:
    if axis.values is not None:
        numbers = [target.number(value) for value in axis.values]
        return np.array([np.nan if number is None else number for number in numbers])[position]
    return _between(axis, target, position / max((axis.count or 1) - 1, 1))


def _between(axis: Axis, target: Target, share: Real) -> Real:
    """Values at shares of the way from start to stop; exactly these at 0 and 1."""
    ends = np.array([target.number(axis.start), target.number(axis.stop)], dtype=float)
    first, last = np.log(ends) if axis.spacing == "log" else ends
    value = (1.0 - share) * first + share * last
    if axis.spacing == "log":
        # the logarithm and back costs the last digits, which the ends keep
        value = np.where(share == 0.0, ends[0], np.where(share == 1.0, ends[1], np.exp(value)))
    return np.clip(value, np.min(ends), np.max(ends))
