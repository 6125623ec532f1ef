"""A sweep: what it would be, and how it ended."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from schemas.sweep.answers import SweepEstimate
from service.report.blocks import Chapter, Paragraph, facts, table

if TYPE_CHECKING:
    import pyarrow as pa

#: figures that are shown of the best designs, if the result has them
_FIGURES = ("force_peak_N", "moment_peak_Nm", "total_mass_kg")


def estimated(estimate: SweepEstimate) -> Iterator[Chapter]:
    """What a sweep would be."""
    size = [
        ("designs", estimate.total),
        ("chunks", estimate.chunks),
        ("designs a chunk", estimate.chunk_rows),
        ("result, about MB", estimate.bytes / 1e6),
        ("time of one core, about s", estimate.cpu_s),
        (f"until it is done, {estimate.workers} workers, about s", estimate.wall_s),
    ]
    yield Chapter("Sweep, not run", (facts("", size), Paragraph(f"The time assumes {estimate.assumption}.")))
    columns = [(column.name, column.unit or "", column.meaning) for column in estimate.columns]
    yield Chapter("Columns", (table("", ["name", "unit", "meaning"], columns),))


def swept(counts: Mapping[str, int], best: "pa.Table", axes: tuple[str, ...], title: str) -> Iterator[Chapter]:
    """How the designs ended, and some of them.

    Parameters
    ----------
    counts : number of designs by status.
    best : rows to show.
    axes : names of the columns that vary.
    """
    statuses = sorted(counts.items(), key=lambda pair: -pair[1])
    yield Chapter("Designs", (table("", ["status", "#count"], statuses),))
    if best.num_rows:
        columns = [name for name in ("index", *axes, "status", *_FIGURES) if name in best.schema.names]
        heads = [name if name == "status" else f"#{name}" for name in columns]
        rows = [tuple(row[name] for name in columns) for row in best.select(columns).to_pylist()]
        yield Chapter(title, (table("", heads, rows),))
