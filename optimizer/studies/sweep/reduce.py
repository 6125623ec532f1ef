"""Reducers of the result, chunk by chunk: the best rows, or the rows that no other beats.

Both keep only what may still be in the result, give the same whatever the chunks and their order, and leave out
rows that have no value to compare.
"""

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from optimizer.numerics.arrays import Real
from optimizer.studies.sweep.table import result_schema
from schemas.sweep.request import SweepRequest, TopFilter

Mask = NDArray[np.bool_]
Places = NDArray[np.intp]
Proceed = Callable[[], None]

#: so many rows are collected before they are compared: a comparison costs as much as what is kept
_FEWEST = 1 << 16
#: pairs of points that are compared one by one
_PAIRS = 1 << 15


class TooManyRows(Exception):
    """More rows stay than may be kept."""


class Reducer(Protocol):
    """Takes rows in, chunk by chunk, and keeps some."""

    def add(self, table: pa.Table) -> None:
        """Take in more rows, each once."""

    def table(self) -> pa.Table:
        """The rows kept of those so far."""


class _Collecting:
    """Compares rows when at least as many have come as are kept, so that each takes part in few comparisons.

    Parameters
    ----------
    compared : columns without which a row takes no part.
    most : rows that may be kept; None is any number.
    """

    def __init__(self, compared: Sequence[str], schema: pa.Schema, most: int | None) -> None:
        self._compared = tuple(compared)
        self._best: pa.Table = schema.empty_table()
        self._fresh: list[pa.Table] = []
        self._waiting = 0
        self._most = most

    def add(self, table: pa.Table) -> None:
        """Take in more rows, each once.

        Raises
        ------
        TooManyRows
        """
        for name in self._compared:
            table = table.filter(pc.is_valid(table[name]))
        self._fresh.append(table)
        self._waiting += table.num_rows
        if self._waiting >= max(_FEWEST, self._best.num_rows):
            self._compare()

    def _compare(self) -> None:
        if self._fresh:
            # a copy, so that rows outside the selection leave memory
            self._best = self._selection(pa.concat_tables([self._best, *self._fresh])).combine_chunks()
            self._fresh, self._waiting = [], 0
        if self._most is not None and self._best.num_rows > self._most:
            raise TooManyRows(f"more than {self._most} rows")

    def _selection(self, table: pa.Table) -> pa.Table:
        raise NotImplementedError


class Top(_Collecting):
    """The rows with the smallest (or largest) values of a column; of equal ones those of the lower index."""

    def __init__(self, top_filter: TopFilter, schema: pa.Schema, most: int | None = None) -> None:
        super().__init__([top_filter.by], schema, most)
        self._filter = top_filter

    def _selection(self, table: pa.Table) -> pa.Table:
        order = "descending" if self._filter.largest else "ascending"
        places = pc.sort_indices(table, sort_keys=[(self._filter.by, order), ("index", "ascending")])
        return table.take(places[: self._filter.count])

    def table(self) -> pa.Table:
        """The rows kept, best first."""
        self._compare()
        return self._best


class ParetoFilter(_Collecting):
    """The rows that no other row beats: none is as small in all columns and smaller in one."""

    def __init__(
        self, columns: Sequence[str], schema: pa.Schema, most: int | None = None, proceed: Proceed = lambda: None
    ) -> None:
        super().__init__(columns, schema, most)
        self._proceed = proceed

    def _selection(self, table: pa.Table) -> pa.Table:
        points = np.stack([table[name].to_numpy() for name in self._compared], axis=-1)
        return table.filter(pa.array(unbeaten(points, self._proceed)))

    def table(self) -> pa.Table:
        """The rows kept, in order of their index."""
        self._compare()
        return self._best.sort_by("index")


def reducer(
    request: SweepRequest, schema: pa.Schema | None = None, most: int | None = None, proceed: Proceed = lambda: None
) -> Reducer:
    """The reducer that a request asks for.

    Parameters
    ----------
    schema : columns of the rows, if they are not all.
    most : rows that may be kept; None is any number.
    proceed : called again and again while rows are compared; what it raises ends that.

    Raises
    ------
    ValueError
        if the request keeps all rows.
    """
    if schema is None:
        schema = result_schema(request, request.model_dump_json().encode())
    if request.top is not None:
        return Top(request.top, schema, most)
    if request.pareto is not None:
        return ParetoFilter(request.pareto, schema, most, proceed)
    raise ValueError("the request keeps all rows")


def unbeaten(points: Real, proceed: Proceed = lambda: None) -> Mask:
    """Which points (n, d) no other beats: no other is <= in all coordinates and < in one. Equal points all stay.

    By halves, in some n log(n)^(d-1) steps (Kung, Luccio and Preparata 1975, On finding the maxima of a set of
    vectors, Journal of the ACM 22).
    """
    distinct, inverse = np.unique(points, axis=0, return_inverse=True)
    stays = np.zeros(len(distinct), dtype=bool)
    stays[_front(distinct, np.arange(len(distinct)), proceed)] = True
    return stays[inverse.reshape(-1)]


def _front(points: Real, places: Places, proceed: Proceed) -> Places:
    """The unbeaten of some places, which are in order; points (n, d) are distinct and in lexicographic order."""
    proceed()
    if points.shape[-1] == 2:
        lowest = np.minimum.accumulate(np.concatenate([[np.inf], points[places, 1]]))[:-1]
        return places[points[places, 1] < lowest]
    if len(places) ** 2 <= _PAIRS:
        subset = points[places]
        no_larger = np.all(subset[None, :, :] <= subset[:, None, :], axis=-1)
        # of distinct points the only one that is no larger and does not beat a point is the point itself
        return places[np.sum(no_larger, axis=-1) == 1]
    # no point is beaten by a later one; an earlier one is no larger in the first coordinate
    middle = len(places) // 2
    first, second = _front(points, places[:middle], proceed), _front(points, places[middle:], proceed)
    rest = ~_covered(points[second, 1:], points[first, 1:], proceed)
    return np.concatenate([first, second[rest]])


def _covered(points: Real, rivals: Real, proceed: Proceed) -> Mask:
    """Which points (n, d) are nowhere below one of the others (m, d)."""
    proceed()
    if len(points) == 0 or len(rivals) == 0:
        return np.zeros(len(points), dtype=bool)
    if points.shape[-1] == 1:
        return points[:, 0] >= np.min(rivals)
    if points.shape[-1] == 2:
        order = np.argsort(rivals[:, 0], kind="stable")
        lowest = np.minimum.accumulate(np.concatenate([[np.inf], rivals[order, 1]]))
        return points[:, 1] >= lowest[np.searchsorted(rivals[order, 0], points[:, 0], side="right")]
    if len(points) * len(rivals) <= _PAIRS:
        return np.any(np.all(rivals[None, :, :] <= points[:, None, :], axis=-1), axis=-1)
    own, their = points[:, 0], rivals[:, 0]
    if np.max(their) <= np.min(own):
        return _covered(points[:, 1:], rivals[:, 1:], proceed)
    # the values up to the cut, and those above it, of which there is at least one
    values = np.unique(np.concatenate([own, their]))
    cut = values[(len(values) - 1) // 2]
    low, above = own <= cut, their > cut
    covered = np.zeros(len(points), dtype=bool)
    covered[low] = _covered(points[low], rivals[~above], proceed)
    covered[~low] = _covered(points[~low, 1:], rivals[~above][:, 1:], proceed)
    left = ~low & ~covered
    covered[left] = _covered(points[left], rivals[above], proceed)
    return covered
