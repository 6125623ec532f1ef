"""The rows of a job, read back from its files in the order of their index, a batch at a time."""

import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, BinaryIO

from service.jobs.job import Record

# a service without sweeps needs no Arrow, and is ready sooner
if TYPE_CHECKING:
    import pyarrow as pa

#: of a batch as text, of a number in it, and of a text, roughly [bytes]
_BATCH_BYTES = 1_000_000
_NUMBER_BYTES, _TEXT_BYTES = 24, 100


class UnknownColumn(ValueError):
    """The result has no column of this name."""


def schema_of(schema: "pa.Schema", columns: Sequence[str]) -> "pa.Schema":
    """The schema of some columns, in the order of the result; by default of all.

    Each of ``columns`` is a name, or several with commas between them.

    Raises
    ------
    UnknownColumn
    """
    import pyarrow as pa

    names = [name for part in columns for name in ([part] if part in schema.names else part.split(","))]
    for name in names:
        if name not in schema.names:
            raise UnknownColumn("the result has no such column" if len(name) > 100 else f"no column is named {name!r}")
    if not names:
        return schema
    return pa.schema([field for field in schema if field.name in names], metadata=schema.metadata)


def batches(
    pieces: Iterable[Record],
    opened: Callable[[Record], BinaryIO],
    schema: "pa.Schema",
    first: int = 0,
    last: int | None = None,
) -> "Iterator[pa.RecordBatch]":
    """Rows with first <= index < last of the pieces that are there, as ``schema`` says.

    Parameters
    ----------
    pieces : files of the chunks that are done, in order.
    opened : opens the file of a piece, which is closed here.
    """
    for piece in within(pieces, first, last):
        end = None if last is None else last - piece.start
        yield from rows_of(partial(opened, piece), schema, first - piece.start, end)


def within(pieces: Iterable[Record], first: int, last: int | None) -> list[Record]:
    """The pieces that hold some of the rows with first <= index < last."""
    return [piece for piece in pieces if piece.stop > first and (last is None or piece.start < last)]


def batch_rows(schema: "pa.Schema") -> int:
    """How many rows are read at a time: what is held of a stream is bounded, however many columns it has."""
    import pyarrow as pa

    sizes = (_TEXT_BYTES if pa.types.is_string(field.type) else _NUMBER_BYTES for field in schema)
    return max(1, _BATCH_BYTES // sum(len(field.name) + size for field, size in zip(schema, sizes, strict=True)))


def rows_of(
    opened: Callable[[], BinaryIO], schema: "pa.Schema", first: int = 0, last: int | None = None
) -> "Iterator[pa.RecordBatch]":
    """Rows first <= position < last of a file, as ``schema`` says; it is opened for the first, and closed after all."""
    import pyarrow.parquet as pq

    position = 0
    with opened() as file, pq.ParquetFile(file) as parquet:
        # without threads: one of Arrow's that lets go of Python's bytes while the interpreter ends aborts the process
        for batch in parquet.iter_batches(batch_rows(schema), columns=schema.names, use_threads=False):
            begin = max(first - position, 0)
            end = batch.num_rows if last is None else min(last - position, batch.num_rows)
            position += batch.num_rows
            if begin < end:
                yield fitted(batch.slice(begin, end - begin), schema)


def fitted(batch: "pa.RecordBatch", schema: "pa.Schema") -> "pa.RecordBatch":
    """A batch with the columns and the metadata of a schema."""
    import pyarrow as pa

    return pa.RecordBatch.from_arrays([batch.column(name) for name in schema.names], schema=schema)


def description(schema: "pa.Schema") -> dict[str, Any]:
    """What a file of Parquet or Arrow says about itself, for the formats that cannot."""
    from optimizer.studies.sweep.table import REQUEST, SEED, VERSIONS

    columns = [
        {
            "name": field.name,
            "type": str(field.type),
            **{key.decode(): value.decode() for key, value in field.metadata.items()},
        }
        for field in (field if field.metadata else field.with_metadata({}) for field in schema)
    ]
    about = schema.metadata
    return {
        "request": json.loads(about[REQUEST]),
        "seed": int(about[SEED]),
        "versions": json.loads(about[VERSIONS]),
        "columns": columns,
    }
