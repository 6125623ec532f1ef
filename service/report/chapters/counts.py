"""What one counterweight, or one part number, more is worth."""

from schemas.front.counts import CountFront, CountPoint
from service.report.blocks import Block, Cell, Number, table

_COUNT_NAMES = {
    "weights": "counterweights",
    "part_numbers": "part numbers",
    "pieces": "counterweights",
    "sizes": "part numbers",
}
_VALUE = {"objective": "#objective", "mass": "#minimum mass, kg"}


def count_table(front: CountFront) -> Block:
    """A row for every number."""
    heads = [f"#at most, {_COUNT_NAMES[front.of]}", _VALUE[front.least], "#proven at least", "#relative gap"]
    heads += ["#peak force, N", "#peak moment, N m"]
    heads += ["#mass on the crankshaft, kg", "#on balance shafts, kg"] if _geared(front) else ["#mass, kg"]
    heads += ["#counterweights", "#part numbers", ""]
    return table("", heads, [_row(point, _geared(front)) for point in front.points])


def _geared(front: CountFront) -> bool:
    """Whether there are balance shafts."""
    return any(point.balance_shafts for point in front.points)


def _row(point: CountPoint, geared: bool) -> tuple[Cell | float | None, ...]:
    gap = point.relative_gap
    fitted = (point.weights, point.part_numbers)
    return (
        Number(point.at_most, str(point.at_most)),
        point.value,
        point.lower_bound,
        None if gap is None else Number(gap, f"{gap:.1e}"),
        point.force_peak_N,
        point.moment_peak_Nm,
        point.total_mass_kg,
        *((point.balance_shafts_mass_kg,) if geared else ()),
        *(None if count is None else Number(count, str(count)) for count in fitted),
        "" if point.status == "optimal" else point.status,
    )
