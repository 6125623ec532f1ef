"""One chunk of a sweep: a pure function of bytes and two numbers, for any executor."""

from collections.abc import Iterator
from functools import lru_cache

import numpy as np
import pyarrow as pa

from optimizer.studies.sweep.plan import block_rows
from optimizer.studies.sweep.rows import rows
from optimizer.studies.sweep.table import result_schema, result_table
from schemas.sweep.request import SweepRequest


def run_chunk(request_json: bytes, start: int, stop: int) -> pa.Table:
    """The rows start..stop-1 of a sweep, one for each design.

    The same rows whatever the chunks they come in. Top and Pareto filters are not applied here.

    Parameters
    ----------
    request_json : a valid :class:`schemas.sweep.request.SweepRequest`.

    Raises
    ------
    ValueError
        if the range lies outside the sweep.
    """
    request, schema = _prepared(request_json)
    if not 0 <= start <= stop <= request.total:
        raise ValueError(f"the sweep has the designs 0 to {request.total}, not {start} to {stop}")
    return result_table(rows(request, start, stop), schema)


def blocks(request_json: bytes, start: int, stop: int) -> Iterator[tuple[int, int]]:
    """A range of designs in parts that take a fraction of a second each: first design, and the one after the last."""
    many = stop - start
    count = -(-many // block_rows(_prepared(request_json)[0]))
    # all of one size, as a short one makes as many calls
    for k in range(count):
        yield start + k * many // count, start + (k + 1) * many // count


@lru_cache(maxsize=4)
def _prepared(request_json: bytes) -> tuple[SweepRequest, pa.Schema]:
    """A request is read once in a process, not once a chunk."""
    _keep_pages()
    request = SweepRequest.model_validate_json(request_json)
    return request, result_schema(request, request_json)


def _keep_pages() -> None:
    """Let the allocator keep what a chunk has freed for the next one.

    The C library of Linux hands freed memory back page by page, and takes a fifth of a chunk's time to get it again.
    It stops once one block of nearly 32 MB has been freed, and keeps up to twice that (mallopt(3), M_MMAP_THRESHOLD).
    The block is never touched and so takes no memory.
    """
    np.empty(31 * 2**20, dtype=np.uint8)
