"""The trade-off of peak force and peak moment, front by front."""

from collections.abc import Iterator

from schemas.answer.counterweights import every_counterweight
from schemas.front.pareto import ParetoAnswer, ParetoFront, ParetoPoint, ParetoRequest, Reason
from schemas.front.trade import TradedFront, TradedPoint
from service.common.figures import digits
from service.report.blocks import Block, Cell, Chapter, Number, Paragraph, Table, table
from service.report.chapters.counts import count_table
from service.report.chapters.limits import limits
from service.report.chapters.verdict import reachable
from service.report.chapters.worst_case import stated_cases

_REASONS: dict[Reason, str] = {
    "reached_together": "Force and moment are both smallest at the same counterweights: nothing has to be traded.",
    "resolution": "Points that rounding could not separate were left out.",
    "undecided": "The ceilings are on the very boundary of what can be reached; the point comes closest to them.",
    "complete": "These are all: no set that can be chosen is better by more than the asked gap.",
    "time": "The time limit ended the search: there may be further points between these.",
}

_WORST = (
    "Weighted peaks are those of the worst case of all scenarios, with everything off that may be: they are traded."
    " Peak force and moment are those of the unchanged machine."
)


def traded(request: ParetoRequest, answer: ParetoAnswer) -> Iterator[Chapter]:
    """The points of every front, what is proven of its ends, and its knee; or why there are none."""
    yield Chapter("Machine", (_bounds(answer),))
    cases = tuple(stated_cases(request, "response"))
    if cases:
        yield Chapter("What the counterweights are to suit", cases)
    for front in answer.fronts:
        budget = front.max_total_mass_kg
        limit = "no limit of the total mass" if budget is None else f"total mass up to {digits(budget)} kg"
        yield Chapter(f"Front, {limit}: {front.status}", tuple(_front(request, front)))
    for trade in answer.trades:
        budget = trade.max_total_mass_kg
        limit = "no limit of the total mass" if budget is None else f"total mass up to {digits(budget)} kg"
        yield Chapter(f"Trade-off, {limit}: {trade.status}", tuple(_trade(request, trade)))
    for count in answer.counts:
        budget = count.max_total_mass_kg
        limit = "no limit of the total mass" if budget is None else f"total mass up to {digits(budget)} kg"
        yield Chapter(f"Numbers, {limit}: {count.status}", (count_table(count),))


def _bounds(answer: ParetoAnswer) -> Table:
    before, floor = answer.without_counterweights, answer.floor
    return table(
        "",
        ["", "#peak force, N", "#peak moment, N m"],
        [
            ("without counterweights", before.force.peak_N, before.moment.peak_Nm),
            ("floor of any counterweights", floor.force_N, floor.moment_Nm),
        ],
    )


def _front(request: ParetoRequest, front: ParetoFront) -> Iterator[Block]:
    if front.infeasibility is not None:
        yield from reachable(request, front.infeasibility)
    if front.points:
        across, off = request.objective.direction_weights, any(point.worst_case is not None for point in front.points)
        yield _points(front, off or (across.x, across.y) != (1.0, 1.0))
        if off:
            yield Paragraph(_WORST)
    if front.reason is not None:
        yield Paragraph(_REASONS[front.reason])
    if front.ends is not None:
        yield Paragraph(
            f"Proven: no counterweights reach below {digits(front.ends.smallest_force_lower_bound_N)} N"
            f" or below {digits(front.ends.smallest_moment_lower_bound_Nm)} N m."
        )


def _trade(request: ParetoRequest, trade: TradedFront) -> Iterator[Block]:
    """Any two or three responses: what each comes to alone, and the points between."""
    if trade.infeasibility is not None:
        yield from reachable(request, trade.infeasibility)
        return
    heads = [f"#{response.response}, {response.unit}" for response in trade.responses]
    geared = any(point.balance_shafts for point in trade.points)
    bounds: list[tuple[Cell | float | None, ...]] = [
        ("without counterweights", *(response.without_counterweights for response in trade.responses)),
        ("smallest by itself", *(response.smallest for response in trade.responses)),
        ("proven at least", *(response.lower_bound for response in trade.responses)),
    ]
    yield table("", ["", *heads], bounds)
    rows: list[tuple[Cell | float | None, ...]] = [
        (str(index), *point.values, *_mass(point), _gap(point), "" if beaten is None else f"beaten by {beaten}")
        for index, (point, beaten) in enumerate((point, point.beaten_by) for point in trade.points)
    ]
    yield table("", ["point", *heads, *_mass_heads(geared), "#relative gap", ""], rows)
    if any(point.nominal_values is not None for point in trade.points):
        nominal: list[tuple[Cell | float | None, ...]] = [
            (str(index), *(point.nominal_values or ())) for index, point in enumerate(trade.points)
        ]
        yield Paragraph("The values above are those of the worst case.")
        yield table("Unchanged machine, nothing off", ["point", *heads], nominal)
    if trade.reason is not None:
        yield Paragraph("All are smallest at the same counterweights: nothing has to be traded.")


def _points(front: ParetoFront, weighted: bool) -> Table:
    heads = ["point", "#peak force, N", "#peak moment, N m"]
    heads += ["#weighted force, N", "#weighted moment, N m"] if weighted else []
    heads += _mass_heads(any(point.balance_shafts for point in front.points))
    heads += ["#relative gap", "limits reached", ""]
    return table("", heads, [_point(front, index, point, weighted) for index, point in enumerate(front.points)])


def _point(front: ParetoFront, index: int, point: ParetoPoint, weighted: bool) -> tuple[Cell | float | None, ...]:
    return (
        str(index),
        point.force_peak_N,
        point.moment_peak_Nm,
        *((point.weighted_force_peak_N, point.weighted_moment_peak_Nm) if weighted else ()),
        *_mass(point),
        _gap(point),
        _reached(point),
        "knee" if index == front.knee else "",
    )


def _mass_heads(geared: bool) -> list[str]:
    """Heads of the masses, where there are balance shafts apart."""
    return ["#mass on the crankshaft, kg", "#on balance shafts, kg"] if geared else ["#mass, kg"]


def _mass(point: ParetoPoint | TradedPoint) -> tuple[float | None, ...]:
    return (point.total_mass_kg, point.balance_shafts_mass_kg) if point.balance_shafts else (point.total_mass_kg,)


def _gap(point: ParetoPoint | TradedPoint) -> Cell:
    gap, note = point.certificate.relative_gap, "" if point.status == "optimal" else " inaccurate"
    return f"none{note}" if gap is None else Number(gap, f"{gap:.1e}{note}")


def _reached(point: ParetoPoint) -> str:
    """Limits of the machine, and those of webs with their names."""
    webs: dict[str, list[str]] = {}
    for counterweight in every_counterweight(point):
        for limit in counterweight.active_limits:
            webs.setdefault(limits([limit]), []).append(counterweight.web)
    machine = [limits([limit]) for limit in point.active_limits]
    return "; ".join([*machine, *(f"{name} of {', '.join(of)}" for name, of in webs.items())])
