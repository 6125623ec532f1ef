"""What a sweep is before it runs: how many designs, in which pieces, with which columns."""

from collections.abc import Iterator

import pyarrow as pa

from optimizer.errors import MissingInput
from optimizer.numerics.memoization import remembered
from optimizer.numerics.records import record
from optimizer.outputs.registry import missing_inputs
from optimizer.outputs.requirements import missing
from optimizer.studies.sweep.table import result_schema
from optimizer.studies.sweep.work import curves_over_turn, work_per_design, worked_out_alone
from schemas.answer.outputs import Column
from schemas.base.model import FieldProblem
from schemas.base.rules import Path
from schemas.base.variation import with_fields
from schemas.request.objective import OVER_THE_TURN
from schemas.request.requests import OptimizeRequest
from schemas.sweep.answers import SweepColumn, SweepEstimate
from schemas.sweep.request import SweepRequest

#: seconds of work in a chunk: long against the cost of handing it out, short against the patience of a client
_CHUNK_S = 1.0
#: seconds a design takes for each web, for its certified optimum: of the largest of peaks, and of their sum
_PROGRAM_S, _DISC_S = 1.5e-5, 1e-6
#: and for each row at each angle of the turn, in the outputs
_SAMPLE_S = 2.5e-7
_ROW_S = 2e-6
#: for what is worked out design by design among the columns in detail
_DETAIL_S = 0.005
#: for a program by itself, of plates or alike webs, and for a search among discrete choices
_ALONE_S, _SEARCH_S = 0.02, 0.5
#: for the program over the turn, and for each curve that it cuts
_TURN_S, _CUTS_S = 0.04, 0.01
#: cells of a chunk at most, which bounds the memory of who computes it, and of who reads it
_CELLS = 1_000_000
#: chunks of a sweep at most, if that makes them longer than they should be: each has a file and a row of a database
_MOST_CHUNKS = 10_000
#: seconds, and rows, of a block of a chunk: between blocks a worker sees that it is to stop
_BLOCK_S = 0.25
_BLOCK_ROWS = 30_000
#: a small sweep is cut into so many chunks, so that all workers have some
_FEWEST_CHUNKS = 16
_SMALLEST_CHUNK = 64
#: bytes of a cell in Parquet: numbers hardly compress, texts nearly vanish
_CELL_BYTES = {"number": 8.6, "integer": 1.5, "text": 0.2}
#: bytes of a file for itself, and for each of its columns besides their name, which stands there three times
_FILE_BYTES, _COLUMN_BYTES, _NAME_COPIES = 500, 220, 3
#: a file takes whole blocks of a disk
_BLOCK_BYTES = 4096


@record(frozen=True)
class Plan:
    """A sweep before it runs."""

    total: int
    chunk_rows: int
    seed: int
    columns: tuple[Column, ...]
    schema: pa.Schema
    cpu_s: float
    #: rows that are kept a second time; an estimate before the selection
    selected: int = 0

    @property
    def chunks(self) -> int:
        """Number of chunks; the last may be shorter."""
        return -(-self.total // self.chunk_rows)

    def chunk(self, number: int) -> tuple[int, int]:
        """First design of a chunk and the one after its last."""
        start = number * self.chunk_rows
        return start, min(start + self.chunk_rows, self.total)

    @property
    def estimate(self) -> SweepEstimate:
        """The answer to a dry run, for one worker."""
        return self.estimate_for(1)

    def estimate_for(self, workers: int) -> SweepEstimate:
        """The answer to a dry run, for as many workers; those beyond the chunks have nothing to do."""
        return SweepEstimate(
            total=self.total,
            chunks=self.chunks,
            chunk_rows=self.chunk_rows,
            seed=self.seed,
            bytes=self._bytes,
            cpu_s=self.cpu_s,
            workers=workers,
            wall_s=self.cpu_s * -(-self.chunks // workers) / self.chunks if self.chunks else 0.0,
            assumption=f"{workers} worker(s) with a core each and no other work, at measured rates: within a factor of"
            " three or so",
            columns=tuple(SweepColumn(**column._asdict()) for column in self.columns),
        )

    @property
    def _bytes(self) -> int:
        """On disk: the chunks, the selection as far as its size is predictable, and the request."""
        rows = sum(_CELL_BYTES[column.kind] for column in self.columns)
        columns = sum(_COLUMN_BYTES + _NAME_COPIES * len(column.name.encode()) for column in self.columns)
        size = self.chunk_rows * rows + _FILE_BYTES + columns
        return round(
            self.chunks * -(-size // _BLOCK_BYTES) * _BLOCK_BYTES
            + min(self.selected, self.total) * rows
            + len(self.schema.serialize())
        )


def plan(request: SweepRequest) -> Plan:
    """Plan a sweep.

    Raises
    ------
    MissingInput
        if the base and the axes together lack what an output needs, whichever the design.
    """
    _require_inputs(request)
    columns = request.column_selection
    return Plan(
        total=request.total,
        chunk_rows=_chunk_rows(request),
        seed=request.seed,
        cpu_s=request.total * _seconds_per_design(request),
        columns=columns,
        schema=result_schema(request, request.model_dump_json().encode()),
        selected=0 if request.top is None else request.top.count,
    )


def _require_inputs(request: SweepRequest) -> None:
    """Refuse what no design can give: a field that is null in the base and that no axis fills."""
    filled = with_fields(request.base, {target.path: 1.0 for target in request.targets} | dict(_idle_values(request)))
    problems: dict[Path, FieldProblem] = {}
    for path, message in missing_inputs(filled.machine, filled.outputs):
        problems.setdefault(path, FieldProblem(("base", *path), message))
    if isinstance(filled, OptimizeRequest):
        for path, message in missing(filled.machine, filled.objective):
            problems.setdefault(path, FieldProblem(("base", *path), message))
    if problems:
        raise MissingInput(problems.values())


def _idle_values(request: SweepRequest) -> Iterator[tuple[Path, float | None]]:
    """Fields that look at the whole turn, where an axis holds the value by which they ask for nothing."""
    # crank orders have targets without axes, and vary no objective
    for axis, target in zip(request.axes, request.targets, strict=False):
        if target.path[0] != "objective" or target.path[1] not in OVER_THE_TURN:
            continue
        ends = () if request.design == "latin_hypercube" else (axis.start, axis.stop)
        nothing = OVER_THE_TURN[str(target.path[1])]
        if any(target.number(value) == nothing for value in (ends if axis.values is None else axis.values)):
            yield target.path, nothing


@remembered
def block_rows(request: SweepRequest) -> int:
    """Rows that are computed at once: enough that calls cost little, few enough to stop soon."""
    return max(1, min(round(_BLOCK_S / _seconds_per_design(request)), _BLOCK_ROWS))


def _chunk_rows(request: SweepRequest) -> int:
    cells = max(len(request.all_columns), len(request.column_selection))
    largest = min(_CHUNK_S / _seconds_per_design(request), _CELLS / cells, 100_000)
    fair = max(-(-request.total // _FEWEST_CHUNKS), _SMALLEST_CHUNK)
    return max(1, min(round(largest), fair), -(-request.total // _MOST_CHUNKS))


def _seconds_per_design(request: SweepRequest) -> float:
    """Rough time of a design on one core."""
    seconds = _ROW_S + _SAMPLE_S * work_per_design(request.base, request.always, request.column_keys)
    seconds += _DETAIL_S * worked_out_alone(request)
    # the unchanged machine is one more, for what the worst case costs
    cases = 1 + len(request.base.cases) if isinstance(request.base, OptimizeRequest) else 1
    if request.over_the_turn:
        seconds += _TURN_S + _CUTS_S * curves_over_turn(request) * cases
    elif request.searched and isinstance(request.base, OptimizeRequest):
        seconds += min(_SEARCH_S, request.base.accuracy.time_limit_s)
    elif request.separate:
        seconds += _ALONE_S * cases
    elif isinstance(request.base, OptimizeRequest):
        per_web = _DISC_S if request.base.objective.combine == "sum" else _PROGRAM_S
        seconds += per_web * max(len(request.base.machine.every_web), 1)
    return seconds
