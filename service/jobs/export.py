"""The rows of a sweep as a file, complete or absent."""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path

import pyarrow as pa

from service.common.replacing import replaced
from service.jobs.formats import ARROW_FILE, FORMATS, Format
from service.jobs.results import description

#: formats by the end of the name
WRITERS: Mapping[str, Format] = {
    ".parquet": FORMATS["parquet"],
    ".arrow": ARROW_FILE,
    ".csv": FORMATS["csv"],
    ".ndjson": FORMATS["ndjson"],
    ".xlsx": FORMATS["xlsx"],
}


def export(path: Path, schema: pa.Schema, batches: Iterable[pa.RecordBatch]) -> None:
    """Write rows; a format without metadata gets a file ``path-metadata.json`` beside it, as CSV on the web has it.

    Raises
    ------
    OSError
        if it cannot be written; then nothing has changed.
    TooLargeForWorksheet
        if it is to be a workbook, and the rows are too many; likewise.
    """
    writer = WRITERS[path.suffix]
    if not writer.describes_itself:
        about = json.dumps(description(schema), indent=2).encode()
        _write(path.with_name(path.name + "-metadata.json"), lambda: iter([about]))
    _write(path, lambda: writer.encode(schema, batches))


def _write(path: Path, pieces: Callable[[], Iterator[bytes]]) -> None:
    with replaced(path) as file:
        for piece in pieces():
            file.write(piece)
