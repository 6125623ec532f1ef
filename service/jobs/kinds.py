"""What a job can be: how a chunk of it is computed, and what stands for a row that cannot be."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from service.common.answer_bytes import json_bytes
from service.computations.computation import Computation
from service.computations.table import COMPUTATIONS
from service.jobs.piece import ChunkResult, Unanswerable

if TYPE_CHECKING:
    import pyarrow as pa
    from pydantic import BaseModel

Proceed = Callable[[], None]

#: errors of a request that has fields, or values of them, which a version does not know
_UNKNOWN = ("extra_forbidden", "literal_error", "union_tag_invalid")
#: rows with these statuses do not count as failed, nor do those of invalid designs
_ANSWERED = ("optimal", "analyzed")
_INVALID = ("invalid",)
#: rows without counterweights that are counted by themselves too: that there are none is proven
_INFEASIBLE = ("infeasible",)
_GROUP_CELLS = 750_000
#: so many numbers tell whether a column compresses, and so large a share of them differs where it does not
_SAMPLE, _DIFFERENT = 512, 0.95


@dataclass(frozen=True)
class Kind:
    """A kind of job.

    compute : request, start and stop of the rows, and what to call between blocks of rows -> piece.
    failed : request, start and stop, and the reason -> piece; None if such a job fails as a whole.
    later : whether a request says what this version does not know, and so is one of a later version.
    """

    compute: Callable[[bytes, int, int, Proceed], ChunkResult]
    failed: Callable[[bytes, int, int, str], ChunkResult] | None = None
    later: Callable[[bytes], bool] = lambda _: False


def _later(model: "Callable[[], type[BaseModel]]") -> Callable[[bytes], bool]:
    """Whether a model lacks fields or values of a request, which some version has taken."""

    def later(request: bytes) -> bool:
        from pydantic import ValidationError

        try:
            model().model_validate_json(request)
        except ValidationError as error:
            return any(detail["type"] in _UNKNOWN for detail in error.errors(include_url=False, include_input=False))
        return False

    return later


def _sweep_request() -> "type[BaseModel]":
    from schemas.sweep.request import SweepRequest

    return SweepRequest


def _sweep(request: bytes, start: int, stop: int, proceed: Proceed) -> ChunkResult:
    import pyarrow as pa

    from optimizer.studies.sweep.chunk import blocks, run_chunk

    tables = []
    for first, last in blocks(request, start, stop):
        proceed()
        tables.append(run_chunk(request, first, last))
    return _piece(pa.concat_tables(tables))


def _failed_rows(request: bytes, start: int, stop: int, reason: str) -> ChunkResult:
    import pyarrow as pa

    from optimizer.studies.sweep.designs import axis_values
    from optimizer.studies.sweep.table import result_schema
    from schemas.base.target import pointer
    from schemas.sweep.request import SweepRequest

    sweep = SweepRequest.model_validate_json(request)
    cells = {
        "index": range(start, stop),
        "status": ["failed"] * (stop - start),
        "message": [reason] * (stop - start),
        **{
            pointer(target.path): values
            for target, values in zip(sweep.targets, axis_values(sweep, start, stop), strict=True)
        },
    }
    nothing = [None] * (stop - start)
    schema = result_schema(sweep, request)
    columns = [pa.array(cells.get(field.name, nothing), field.type) for field in schema]
    return _piece(pa.Table.from_arrays(columns, schema=schema))


def table_bytes(table: "pa.Table") -> bytes:
    """A table as a Parquet file, without what is the same in every chunk: it is kept with the job."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    fields = [field.remove_metadata() for field in table.schema]
    table = pa.Table.from_arrays(table.columns, schema=pa.schema(fields))
    out, schema = pa.BufferOutputStream(), table.schema
    # numbers byte by byte would be smaller by 1 %, and take a fifth longer; texts are few
    texts = [field.name for field in schema if field.type == pa.string()]
    # smallest and largest values lead to designs by what varies in an order, which results do not
    statistics = [field.name for field in schema if field.name == "index" or field.name.startswith("/")]
    plain = {field.name for field in schema if field.type == pa.float64() and not _repeats(table[field.name])}
    compression = {name: "none" if name in plain else "zstd" for name in schema.names}
    how = {"compression": compression, "use_dictionary": texts, "write_statistics": statistics, "store_schema": False}
    # a group of rows is what must be held to read some of them
    rows = max(1, _GROUP_CELLS // max(1, len(schema)))
    pq.write_table(table, out, row_group_size=rows, **how)
    return bytes(out.getvalue().to_pybytes())


def _repeats(column: "pa.ChunkedArray") -> bool:
    """Whether enough of a column's first numbers are equal; others are hardly smaller when compressed, by 7 %."""
    first = column[:_SAMPLE]
    return len(first.unique()) < _DIFFERENT * len(first)


def _piece(table: "pa.Table") -> ChunkResult:
    import pyarrow as pa
    import pyarrow.compute as pc

    def count(statuses: tuple[str, ...]) -> int:
        return int(pc.sum(pc.is_in(table["status"], value_set=pa.array(statuses))).as_py() or 0)

    invalid = count(_INVALID)
    failed = table.num_rows - count(_ANSWERED) - invalid
    return ChunkResult(table_bytes(table), failed, invalid=invalid, infeasible=count(_INFEASIBLE))


def _answer(computation: Computation) -> Callable[[bytes, int, int, Proceed], ChunkResult]:
    def answer(request: bytes, start: int, stop: int, proceed: Proceed) -> ChunkResult:
        from optimizer.errors import NotComputable
        from service.common.validation import pointer, read_request

        try:
            result = computation.function(read_request(computation.request_model, request))
        except NotComputable as error:
            raise Unanswerable("; ".join(f"{pointer(path)}: {message}" for path, message in error.problems)) from None
        return ChunkResult(json_bytes(result), 0)

    return answer


def _answered_later(computation: Computation) -> Kind:
    """A job that answers one request."""
    return Kind(_answer(computation), later=_later(lambda: computation.request_model))


KINDS: Mapping[str, Kind] = {
    "sweep": Kind(_sweep, _failed_rows, _later(_sweep_request)),
    **{computation.name: _answered_later(computation) for computation in COMPUTATIONS.values() if computation.later},
}
