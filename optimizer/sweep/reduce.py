"""Reducers of the result, chunk by chunk: the best rows, or the rows that no other beats.

Both keep only what may still be in the result, give the same whatever the chunks and their order, and leave out
rows that have no value to compare.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from optimizer.arrays import Real
from optimizer.sweep.table import result_schema
from schemas.sweep import SweepRequest, TopFilter

Mask = NDArray[np.bool_]
_BLOCK = 512


class Reducer(Protocol):
    """Takes rows in, chunk by chunk, and keeps some."""

    def add(self, table: pa.Table) -> None:
        """Take in more rows, each once."""

    def table(self) -> pa.Table:
        """The rows kept of those so far."""


class Top:
    """The rows with the smallest (or largest) values of a column; of equal ones those of the lower index."""

    def __init__(self, wanted: TopFilter, schema: pa.Schema) -> None:
        self._wanted = wanted
        self._best: pa.Table = schema.empty_table()

    def add(self, table: pa.Table) -> None:
        """Take in more rows, each once."""
        table = pa.concat_tables([self._best, table.filter(pc.is_valid(table[self._wanted.by]))])
        order = "descending" if self._wanted.largest else "ascending"
        places = pc.sort_indices(table, sort_keys=[(self._wanted.by, order), ("index", "ascending")])
        # copied, so that what is no longer wanted does not stay in memory with it
        self._best = table.take(places[: self._wanted.count]).combine_chunks()

    def table(self) -> pa.Table:
        """The rows kept, best first."""
        return self._best


class ParetoFilter:
    """The rows that no other row beats: none is as small in all columns and smaller in one."""

    def __init__(self, columns: Sequence[str], schema: pa.Schema) -> None:
        self._columns = tuple(columns)
        self._front: pa.Table = schema.empty_table()

    def add(self, table: pa.Table) -> None:
        """Take in more rows, each once."""
        for name in self._columns:
            table = table.filter(pc.is_valid(table[name]))
        table = pa.concat_tables([self._front, table])
        points = np.stack([table[name].to_numpy() for name in self._columns], axis=-1)
        self._front = table.filter(pa.array(unbeaten(points))).combine_chunks()

    def table(self) -> pa.Table:
        """The rows kept, in order of their index."""
        return self._front.sort_by("index")


def reducer(request: SweepRequest) -> Reducer:
    """The reducer that a request asks for.

    Raises
    ------
    ValueError
        if the request keeps all rows.
    """
    schema = result_schema(request, request.model_dump_json().encode())
    if request.top is not None:
        return Top(request.top, schema)
    if request.pareto is not None:
        return ParetoFilter(request.pareto, schema)
    raise ValueError("the request keeps all rows")


def unbeaten(points: Real) -> Mask:
    """Which points (n, d) no other beats: no other is <= in all coordinates and < in one. Equal points all stay."""
    distinct, which = np.unique(points, axis=0, return_inverse=True)
    return (_two(distinct) if points.shape[-1] == 2 else _many(distinct))[which.reshape(-1)]


def _two(points: Real) -> Mask:
    """The same for distinct points of two coordinates, in rising order of the first: those lower than all before."""
    before = np.minimum.accumulate(np.concatenate([[np.inf], points[:, 1]]))[:-1]
    return points[:, 1] < before


def _many(points: Real) -> Mask:
    """The same for distinct points in lexicographic order, in which none is beaten by a later one."""
    stays = np.zeros(len(points), dtype=bool)
    front = np.zeros((0, points.shape[-1]))
    for first in range(0, len(points), _BLOCK):
        block = points[first : first + _BLOCK]
        block = block[rest] if not np.all(rest := ~_beaten(block, front)) else block
        places = first + np.flatnonzero(rest)
        own = ~_beaten(block, block)
        stays[places[own]] = True
        front = np.concatenate([front, block[own]])
    return stays


def _beaten(points: Real, others: Real) -> Mask:
    """Which points (n, d) one of the others (m, d) beats; points and others are distinct or the same."""
    beaten = np.zeros(len(points), dtype=bool)
    for first in range(0, len(others), _BLOCK):
        rivals = others[first : first + _BLOCK]
        no_larger = np.all(rivals[None, :, :] <= points[:, None, :], axis=-1)
        smaller = np.any(rivals[None, :, :] < points[:, None, :], axis=-1)
        beaten |= np.any(no_larger & smaller, axis=-1)
    return beaten
