"""A whole sweep in this process; the service computes the same rows in many."""

import pyarrow as pa

from optimizer.studies.sweep.chunk import blocks, run_chunk
from optimizer.studies.sweep.plan import plan
from optimizer.studies.sweep.reduce import reducer
from schemas.base.mappings import or_mapping
from schemas.sweep.request import SweepRequest


@or_mapping(SweepRequest)
def sweep_table(request: SweepRequest) -> pa.Table:
    """The rows of a sweep, one for each design, or those that ``top`` or ``pareto`` keep.

    Columns carry unit and meaning in their metadata, the table the request and the versions.

    Raises
    ------
    MissingInput
        if the machine lacks what a requested output needs.
    """
    document = request.model_dump_json().encode()
    plan(request)
    tables = (run_chunk(document, start, stop) for start, stop in blocks(document, 0, request.total))
    if request.top is None and request.pareto is None:
        return pa.concat_tables(tables)
    collector = reducer(request)
    for table in tables:
        collector.add(table)
    return collector.table()
