"""Rows as bytes: Parquet, Arrow, CSV, NDJSON and workbooks, a batch at a time, in full double precision."""

import json
from collections.abc import Callable, Generator, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from service.common.plain import FORMULA, SECOND_CELL, TEXT_CELL
from service.computations.computation import XLSX
from service.jobs.outbox import Outbox
from service.jobs.worksheet import worksheet

if TYPE_CHECKING:
    import pyarrow as pa

Name = Literal["ndjson", "csv", "parquet", "arrow", "xlsx"]
Batches = Iterable["pa.RecordBatch"]

#: of rows that are written together, before they are compressed. There are at least so many, or a share of those
#: before, which keeps the statistics of the groups small. There are at most so many, as they are held in memory
_GROUP_BYTES, _SHARE, _LARGEST = 1_000_000, 1 / 64, 16_000_000


@dataclass(frozen=True)
class Format:
    """How rows are written; ``encode`` takes a schema and batches of it."""

    media_type: str
    encode: Callable[["pa.Schema", Batches], Generator[bytes, None, None]]
    #: whether the metadata of the schema is in the file
    describes_itself: bool


def _parquet(schema: "pa.Schema", batches: Batches) -> Generator[bytes, None, None]:
    import pyarrow as pa
    import pyarrow.parquet as pq

    out = Outbox()
    with pq.ParquetWriter(out, schema, compression="zstd") as writer:
        for group in _groups(batches):
            writer.write_table(pa.Table.from_batches(group, schema))
            yield out.take()
    yield out.take()


def _groups(batches: Batches) -> "Iterable[list[pa.RecordBatch]]":
    """Batches that are written together: what is said of each group of rows takes room in a file, and in memory until
    its end."""
    group: list[pa.RecordBatch] = []
    size = before = 0
    for batch in batches:
        group.append(batch)
        size += batch.nbytes
        if size > min(max(_GROUP_BYTES, before * _SHARE), _LARGEST):
            yield group
            before += size
            group, size = [], 0
    if group:
        yield group


def _arrow_stream(schema: "pa.Schema", batches: Batches) -> Generator[bytes, None, None]:
    import pyarrow as pa

    return _arrow(pa.ipc.new_stream, schema, batches)


def _arrow_file(schema: "pa.Schema", batches: Batches) -> Generator[bytes, None, None]:
    import pyarrow as pa

    return _arrow(pa.ipc.new_file, schema, batches)


def _arrow(new: Callable[..., Any], schema: "pa.Schema", batches: Batches) -> Generator[bytes, None, None]:
    out = Outbox()
    with new(out, schema) as writer:
        for batch in batches:
            writer.write_batch(batch)
            yield out.take()
    yield out.take()


def _csv(schema: "pa.Schema", batches: Batches) -> Generator[bytes, None, None]:
    import pyarrow as pa
    import pyarrow.csv as pa_csv

    out = Outbox()
    names = [_harmless(pa.array([name]))[0].as_py() for name in schema.names]
    plain = pa.schema([pa.field(name, _plain(field.type)) for name, field in zip(names, schema, strict=True)])
    with pa_csv.CSVWriter(out, plain) as writer:
        for batch in batches:
            columns = [_cells(column) for column in batch.columns]
            writer.write_batch(pa.RecordBatch.from_arrays(columns, schema=plain))
            yield out.take()
    yield out.take()


def _plain(kind: "pa.DataType") -> "pa.DataType":
    import pyarrow as pa

    return kind.value_type if pa.types.is_dictionary(kind) else kind


def _cells(column: "pa.Array") -> "pa.Array":
    import pyarrow as pa

    plain = column.cast(_plain(column.type))
    # numbers stay numbers: a minus sign is harmless there
    return _harmless(plain) if pa.types.is_string(plain.type) else plain


def _harmless(texts: "pa.Array") -> "pa.Array":
    import pyarrow.compute as pc

    quoted = pc.replace_substring_regex(texts, SECOND_CELL, TEXT_CELL)
    return pc.if_else(pc.match_substring_regex(texts, FORMULA), pc.binary_join_element_wise("'", quoted, ""), quoted)


def _ndjson(schema: "pa.Schema", batches: Batches) -> Generator[bytes, None, None]:
    import pyarrow as pa
    import pyarrow.compute as pc

    names = [json.dumps(name, ensure_ascii=False) for name in schema.names]
    for batch in batches:
        # a row is joined from its cells by arrow, as objects of Python would take minutes for a million rows
        parts: list[pa.Array | str] = []
        for index, (name, column) in enumerate(zip(names, batch.columns, strict=True)):
            parts += [("{" if index == 0 else ",") + name + ":", _literals(column)]
        lines = pc.binary_join_element_wise(*parts, "}\n", "") if parts else pa.array(["{}\n"] * batch.num_rows)
        yield "".join(lines.to_pylist()).encode()


def _literals(column: "pa.Array") -> "pa.Array":
    """JSON of each value."""
    import pyarrow as pa
    import pyarrow.compute as pc

    if pa.types.is_floating(column.type):
        # JSON knows no NaN and no infinity
        column = pc.if_else(pc.is_finite(column), column, None)
    elif not (pa.types.is_integer(column.type) or pa.types.is_boolean(column.type)):
        encoded = column.cast(_plain(column.type)).dictionary_encode()
        quoted = [json.dumps(value, ensure_ascii=False) for value in encoded.dictionary.to_pylist()]
        column = pa.array(quoted, pa.string()).take(encoded.indices)
    return column.cast(pa.string()).fill_null("null")


FORMATS: Mapping[Name, Format] = {
    "ndjson": Format("application/x-ndjson", _ndjson, describes_itself=False),
    "csv": Format("text/csv; charset=utf-8; header=present", _csv, describes_itself=False),
    "parquet": Format("application/vnd.apache.parquet", _parquet, describes_itself=True),
    "arrow": Format("application/vnd.apache.arrow.stream", _arrow_stream, describes_itself=True),
    "xlsx": Format(XLSX, worksheet, describes_itself=False),
}

#: Arrow with its index at the end, as programs expect of a file
ARROW_FILE = Format("application/vnd.apache.arrow.file", _arrow_file, describes_itself=True)
