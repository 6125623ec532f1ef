"""A sweep as tables for the terminal."""

from collections.abc import Mapping

import pyarrow as pa
from rich.console import Group, RenderableType

from schemas.sweep import SweepEstimate
from service.cells import add, table

#: figures that are shown of the best designs, if the result has them
_FIGURES = ("force_peak_N", "moment_peak_Nm", "total_mass_kg")


def estimate_report(estimate: SweepEstimate) -> RenderableType:
    """What a sweep would be."""
    size = table("sweep, not run", "designs", "chunks", "designs a chunk", "result, about MB")
    add(size, estimate.total, estimate.chunks, estimate.chunk_rows, estimate.bytes / 1e6)
    columns = table("columns", "name", "unit", "meaning")
    for column in estimate.columns:
        add(columns, column.name, column.unit or "", column.meaning)
    return Group(size, columns)


def sweep_report(counts: Mapping[str, int], best: pa.Table, axes: tuple[str, ...], title: str) -> RenderableType:
    """How the designs ended, and some of them.

    Parameters
    ----------
    counts : number of designs by status.
    best : rows to show.
    axes : names of the columns that vary.
    """
    statuses = table("designs", "status", "count")
    for status, count in sorted(counts.items(), key=lambda one: -one[1]):
        add(statuses, status, count)
    shown = [name for name in ("index", *axes, "status", *_FIGURES) if name in best.schema.names]
    rows = table(title, *shown)
    for row in best.select(shown).to_pylist():
        add(rows, *(row[name] for name in shown))
    return Group(statuses, rows) if best.num_rows else Group(statuses)
