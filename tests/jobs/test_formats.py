"""Rows as bytes and back: bitwise, harmless to spreadsheets, in flat memory."""

import csv
import io
import json
import math
import tracemalloc
from collections.abc import Iterator

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.common.plain import inert
from service.jobs.formats import ARROW_FILE, FORMATS, _groups
from tests.night import part

SCHEMA = pa.schema(
    [
        pa.field("index", pa.int64(), False),
        pa.field("force_peak_N", pa.float64(), metadata={"unit": "N"}),
        pa.field("status", pa.string()),
        pa.field("=cmd|' /C calc'!A0", pa.string()),
    ],
    {b"counterweight.seed": b"7"},
)
ROWS = [
    {"index": 0, "force_peak_N": 0.1, "status": "optimal", "=cmd|' /C calc'!A0": "=1+1"},
    {"index": 1, "force_peak_N": -5e-324, "status": None, "=cmd|' /C calc'!A0": '+"quoted"\n'},
    {"index": 2, "force_peak_N": 1.7976931348623157e308, "status": "@x", "=cmd|' /C calc'!A0": "\t1"},
    {"index": 3, "force_peak_N": 1 / 3, "status": "-x", "=cmd|' /C calc'!A0": "\r=1"},
    {"index": 4, "force_peak_N": None, "status": "a,b", "=cmd|' /C calc'!A0": "é = 1"},
]


def encoded(name: str, table: pa.Table) -> bytes:
    return b"".join(FORMATS[name].encode(table.schema, table.to_batches()))  # type: ignore[index]


def table(rows: list[dict[str, object]]) -> pa.Table:
    return pa.Table.from_pylist(rows, schema=SCHEMA)


def test_parquet_and_arrow_come_back_as_they_were_with_units_and_metadata() -> None:
    sheet = table(ROWS)
    for single_table in (
        pq.read_table(io.BytesIO(encoded("parquet", sheet))),
        pa.ipc.open_stream(encoded("arrow", sheet)).read_all(),
        pa.ipc.open_file(b"".join(ARROW_FILE.encode(SCHEMA, sheet.to_batches()))).read_all(),
    ):
        assert single_table.equals(sheet)
        assert single_table.schema.metadata[b"counterweight.seed"] == b"7"
        assert single_table.schema.field("force_peak_N").metadata[b"unit"] == b"N"


def test_ndjson_comes_back_as_it_was() -> None:
    assert [json.loads(line) for line in encoded("ndjson", table(ROWS)).decode().split("\n")[:-1]] == ROWS


def test_nothing_in_csv_is_a_formula_and_numbers_stay_numbers() -> None:
    header, *rows = csv.reader(io.StringIO(encoded("csv", table(ROWS)).decode(), newline=""))
    assert header == ["index", "force_peak_N", "status", "'=cmd|' /C calc'!A0"]
    assert [row[2:] for row in rows] == [
        ["optimal", "'=1+1"],
        ["", '\'+"quoted"\n'],
        ["'@x", "'\t1"],
        ["'-x", "'\r'=1"],
        ["a,b", "é = 1"],
    ]
    numbers = [float(row[1]) if row[1] else None for row in rows]
    assert numbers == [row["force_peak_N"] for row in ROWS]


#: what a text is made of that wants to be a formula: signs in several widths, blanks that show and that do not
_TEXTS = st.text(st.sampled_from("=+-@\uff1d\uff0b\uff0d\uff20 \t\r\n\xa0\u3000\ufeff\u200b\";,'a1"), max_size=8)
_SIGNS = tuple("=+-@\uff1d\uff0b\uff0d\uff20")


@given(st.lists(st.tuples(_TEXTS, _TEXTS), min_size=1, max_size=3))
def test_no_cell_of_csv_is_a_formula_whatever_the_separator_is_taken_for(rows: list[tuple[str, str]]) -> None:
    """Independent: a reader of CSV that knows nothing of it."""
    names = ["first", "second"]
    whole = pa.table([pa.array(column, pa.string()) for column in zip(*rows, strict=True)], names)
    written = encoded("csv", whole).decode()
    for separator in ",;\t":
        for line in csv.reader(io.StringIO(written, newline=""), delimiter=separator):
            for cell in line:
                assert not cell.strip(" \t\r\n\xa0\u3000\ufeff\u200b").startswith(_SIGNS), (separator, cell)
    # the bill of material says the same
    lines = [tuple(line) for line in csv.reader(io.StringIO(written, newline=""))]
    assert lines[1:] == [tuple(map(inert, row)) for row in rows]


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1))
def test_every_double_survives_as_text(values: list[float]) -> None:
    rows = table([{"index": i, "force_peak_N": peak} for i, peak in enumerate(values)])
    as_json = [json.loads(line)["force_peak_N"] for line in encoded("ndjson", rows).splitlines()]
    as_csv = [row["force_peak_N"] for row in csv.DictReader(io.StringIO(encoded("csv", rows).decode()))]
    for figure, first, second in zip(values, as_json, as_csv, strict=True):
        assert (float(first), float(second)) == (figure, figure)
        assert math.copysign(1, float(second)) == math.copysign(1, figure)


@pytest.mark.parametrize("name", ["ndjson", "csv", "parquet", "arrow"])
def test_no_rows(name: str) -> None:
    content = encoded(name, table([]))
    assert (content == b"") == (name == "ndjson")


@pytest.mark.parametrize("name", part(2, ["ndjson", "csv", "parquet", "arrow", "xlsx"]))
def test_memory_stays_flat(name: str) -> None:
    def batches(count: int) -> Iterator[pa.RecordBatch]:
        for k in range(count):
            index = pa.array(range(1000 * k, 1000 * k + 1000), pa.int64())
            peak = index.cast(pa.float64())
            texts = pa.array(["x"] * 1000)
            yield pa.RecordBatch.from_arrays([index, peak, texts, texts], schema=SCHEMA)

    def peak(count: int) -> int:
        arrow_before = pa.total_allocated_bytes()
        most = size = 0
        tracemalloc.start()
        for piece in FORMATS[name].encode(SCHEMA, batches(count)):  # type: ignore[index]
            size += len(piece)
            most = max(most, pa.total_allocated_bytes() - arrow_before)
        traced = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert size > 2000 * count
        return traced + most

    # ten times the rows, and nowhere near ten times the memory
    assert peak(200) < 2 * peak(20) + 1_000_000


def test_groups_of_parquet_grow_with_what_came_before() -> None:
    # 3 GB in batches of 100 kB, the same one again and again
    batch = pa.record_batch([pa.array([0.0] * 12_500)], names=["x"])
    groups = [len(group) for group in _groups(batch for _ in range(30_000))]
    assert sum(groups) == 30_000
    # analytic: the first 64 of a megabyte, then 64 ln 16 until a group has 16 MB, then so many of these
    assert groups[:64] == [11] * 64
    assert max(groups) == 161
    assert len(groups) < 64 + 64 * math.log(16) + 3000 / 16
