"""The designs that a sweep is asked to keep, found while it runs: the best ones, or those that none beats."""

import threading
from collections import OrderedDict
from collections.abc import Callable, Sequence
from pathlib import Path

import pyarrow as pa

from optimizer.sweep.reduce import Reducer, reducer
from schemas.sweep import SweepRequest
from service.jobs.results import Piece, batches

_REMEMBERED = 16


class Selection:
    """Takes in each piece of a sweep once."""

    def __init__(self, request: SweepRequest) -> None:
        self._reducer: Reducer = reducer(request)
        self._seen: set[Piece] = set()
        self._lock = threading.Lock()

    def table(self, pieces: Sequence[Piece], path: Callable[[int, int], Path], schema: pa.Schema) -> pa.Table:
        """The rows kept of these pieces, all columns."""
        with self._lock:
            for piece in pieces:
                if piece not in self._seen:
                    for batch in batches([piece], path, schema):
                        self._reducer.add(pa.Table.from_batches([batch]))
                    self._seen.add(piece)
            return self._reducer.table()


class Selections:
    """The selections of the sweeps that were asked for last."""

    def __init__(self) -> None:
        self._known: OrderedDict[str, Selection] = OrderedDict()
        self._lock = threading.Lock()

    def of(self, job: str, request: SweepRequest) -> Selection:
        with self._lock:
            found = self._known.setdefault(job, Selection(request))
            self._known.move_to_end(job)
            while len(self._known) > _REMEMBERED:
                self._known.popitem(last=False)
            return found
