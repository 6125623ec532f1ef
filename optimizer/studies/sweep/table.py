"""The result as an Arrow table: units in the fields' metadata, the request and versions in the table's."""

import json
import platform
from collections.abc import Mapping
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np
import pyarrow as pa

from schemas.base.version import package_version
from schemas.sweep.request import SweepRequest

#: keys of the table's metadata
REQUEST, VERSIONS, SEED = b"counterweight.request", b"counterweight.versions", b"counterweight.seed"

_TYPES = {"integer": pa.int64(), "number": pa.float64(), "text": pa.string()}
_PACKAGES = ("numpy", "scipy", "cvxpy", "clarabel", "pyarrow")


def result_schema(request: SweepRequest, request_json: bytes) -> pa.Schema:
    """Columns of the result with unit, meaning and source; request, versions and seed for the whole.

    Parameters
    ----------
    request_json : the request as it is to be kept with the result.
    """
    fields = []
    for column in request.column_selection:
        notes = {"unit": column.unit, "meaning": column.meaning, "pointer": column.source}
        metadata = {key: value for key, value in notes.items() if value is not None}
        fields.append(pa.field(column.name, _TYPES[column.kind], column.name != "index", metadata))
    return pa.schema(
        fields, {REQUEST: request_json, VERSIONS: json.dumps(versions()).encode(), SEED: str(request.seed).encode()}
    )


def result_table(columns: Mapping[str, Any], schema: pa.Schema) -> pa.Table:
    """The columns that the schema names; numbers that are not finite and empty texts are null."""
    return pa.Table.from_arrays([_array(columns[field.name], field.type) for field in schema], schema=schema)


@cache
def versions() -> dict[str, str]:
    """Versions of what computes the rows."""
    results = {"python": platform.python_version(), "counterweight": package_version()}
    for package in _PACKAGES:
        try:
            results[package] = version(package)
        except PackageNotFoundError:
            results[package] = "not installed as a package"
    return results


def _array(column: Any, kind: pa.DataType) -> pa.Array:
    if isinstance(column, np.ndarray) and column.size > 1 and _uniform(column, kind):
        return pa.repeat(_array(column[:1], kind)[0], column.size)
    if kind == pa.float64():
        finite = np.isfinite(column)
        return pa.array(column, kind) if finite.all() else pa.array(column, kind, mask=~finite)
    if kind == pa.string():
        # few different texts, mostly the first: Arrow repeats them faster than Python does
        texts = column if isinstance(column, np.ndarray) else np.array(column, dtype=object)
        (places,) = (texts != texts[:1]).nonzero()
        rest = texts[places].tolist()
        number = {text: k for k, text in enumerate(dict.fromkeys((*texts[:1].tolist(), *rest)))}
        codes = np.zeros(texts.size, np.int32)
        codes[places] = np.fromiter(map(number.__getitem__, rest), dtype=np.int32, count=len(rest))
        dictionary = pa.array([text or None for text in number], kind)
        return pa.DictionaryArray.from_arrays(pa.array(codes), dictionary).cast(kind)
    return pa.array(column, kind)


def _uniform(column: np.ndarray, kind: pa.DataType) -> bool:
    """Whether a column is seen at a glance to be of one value."""
    return column.strides == (0,) or (kind == pa.string() and bool(np.all(column == column[0])))
