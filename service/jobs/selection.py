"""What runs in a worker to select rows: the best ones, or those that none beats, of all that are there."""

import time
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from service.jobs.files import verified
from service.jobs.job import Record
from service.jobs.piece import ChunkResult, Stopped, Unanswerable

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

#: cells that are kept at most, which bounds memory and the file
_CELLS = 10_000_000
#: of one worker
_LONGEST_S = 60.0


def select(
    request: bytes, columns: bytes, pieces: Sequence[tuple[Path, Record]], flag: str, longest_s: float = _LONGEST_S
) -> ChunkResult:
    """Select rows of a sweep: first by the columns that are compared, then the rows that stay are read whole.

    Parameters
    ----------
    columns : Arrow schema of the rows.
    pieces : files of the rows that are there, in order.

    Raises
    ------
    Stopped
        if there is a file at ``flag``.
    Damaged
        if a file is not what was written.
    Unanswerable
        if too many rows stay, or comparing them takes too long.
    """
    import pyarrow as pa
    import pyarrow.compute as pc

    from optimizer.studies.sweep.reduce import TooManyRows, reducer
    from schemas.sweep.request import SweepRequest
    from service.jobs.kinds import table_bytes
    from service.jobs.results import rows_of

    sweep, schema = SweepRequest.model_validate_json(request), pa.ipc.read_schema(pa.py_buffer(columns))
    where, until = Path(flag), time.monotonic() + longest_s
    most = max(1, _CELLS // len(schema))

    def proceed() -> None:
        if where.exists():
            raise Stopped
        if time.monotonic() > until:
            raise Unanswerable(f"selecting rows takes longer than {longest_s:g} s; read all of them")

    compared = {"index", *(sweep.pareto or ()), *(() if sweep.top is None else (sweep.top.by,))}
    narrow = pa.schema([field for field in schema if field.name in compared])
    tool = reducer(sweep, narrow, most, proceed)
    try:
        for path, record in pieces:
            proceed()
            tool.add(pa.Table.from_batches(rows_of(partial(verified, path, record), narrow), narrow))
        index = tool.table()["index"]
    except TooManyRows:
        raise Unanswerable(f"more than {most} rows would be kept; read all of them, or ask for fewer columns") from None

    tables = [schema.empty_table()]
    for path, record in _holding(pieces, index.to_numpy()):
        proceed()
        whole = pa.Table.from_batches(rows_of(partial(verified, path, record), schema), schema)
        tables.append(whole.filter(pc.is_in(whole["index"], value_set=index)))
    rows = pa.concat_tables(tables)
    # in the order of the selection
    rows = rows.take(pc.index_in(index, value_set=rows["index"].combine_chunks()))
    return ChunkResult(table_bytes(rows), 0, rows.num_rows)


def _holding(pieces: Sequence[tuple[Path, Record]], index: "NDArray[np.int64]") -> list[tuple[Path, Record]]:
    """The pieces that hold some of the rows of an index."""
    import numpy as np

    order = np.sort(index)
    firsts, lasts = (np.searchsorted(order, [getattr(piece, end) for _, piece in pieces]) for end in ("start", "stop"))
    return [piece for piece, first, last in zip(pieces, firsts, lasts, strict=True) if first < last]
