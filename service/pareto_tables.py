"""Fronts of peak force and peak moment as readable tables."""

from collections.abc import Iterator

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from schemas.answers import Infeasibility
from schemas.pareto import Ends, ParetoAnswer, ParetoFront, ParetoPoint, Reason
from schemas.requests import Objective
from service.cells import Cell, add, number, table

_STYLES = {"optimal": "bold green", "inaccurate": "bold yellow", "infeasible": "bold red"}
_REASONS: dict[Reason, str] = {
    "reached_together": "Force and moment are both smallest at the same counterweights: nothing has to be traded.",
    "resolution": "Points that rounding could not tell apart were left out.",
    "undecided": "The ceilings are on the very boundary of what can be reached; the point comes closest to them.",
}


def pareto_report(title: str, objective: Objective, answer: ParetoAnswer) -> Group:
    """The points of every front, what is proven of its ends, and its knee; or why there are none."""
    return Group(*_parts(title, objective, answer))


def _parts(title: str, objective: Objective, answer: ParetoAnswer) -> Iterator[RenderableType]:
    yield Text.assemble(title, ": ", (answer.status, _STYLES[answer.status]))
    yield _bounds(answer)
    weighted = (objective.direction_weights.x, objective.direction_weights.y) != (1.0, 1.0)
    for front in answer.fronts:
        yield from _front(objective, front, weighted)


def _bounds(answer: ParetoAnswer) -> Table:
    before, floor = answer.without_counterweights, answer.floor
    rows = table("machine", "", "peak force, N", "peak moment, N m")
    add(rows, "without counterweights", before.force.peak_N, before.moment.peak_Nm)
    add(rows, "floor of any counterweights", floor.force_N, floor.moment_Nm)
    return rows


def _front(objective: Objective, front: ParetoFront, weighted: bool) -> Iterator[RenderableType]:
    budget = front.max_total_mass_kg
    limit = "no limit of the total mass" if budget is None else f"total mass up to {number(budget)} kg"
    yield Text.assemble(f"front, {limit}: ", (front.status, _STYLES[front.status]))
    if front.infeasibility is not None:
        yield _conflict(objective, front.infeasibility)
    if front.points:
        yield _points(front, weighted)
    if front.reason is not None:
        yield Text(_REASONS[front.reason])
    if front.ends is not None:
        yield Text(_proven(front.ends))


def _conflict(objective: Objective, why: Infeasibility) -> Table:
    title = "no counterweights within the limits satisfy: " + ", ".join(why.conflict)
    rows = table(title, "", "peak force, N", "peak moment, N m")
    add(rows, "ceiling", objective.force_ceiling_N, objective.moment_ceiling_Nm)
    add(rows, "smallest, the other left free", why.smallest_force_N, why.smallest_moment_Nm)
    closest = why.closest.first_order
    add(rows, "best compromise", closest.force.peak_N, closest.moment.peak_Nm)
    return rows


def _points(front: ParetoFront, weighted: bool) -> Table:
    columns = ["point", "peak force, N", "peak moment, N m"]
    columns += ["weighted force, N", "weighted moment, N m"] if weighted else []
    rows = table("points", *columns, "mass, kg", "relative gap", "limits reached", "")
    for index, point in enumerate(front.points):
        cells: list[Cell] = [str(index), point.force_peak_N, point.moment_peak_Nm]
        cells += [point.weighted_force_peak_N, point.weighted_moment_peak_Nm] if weighted else []
        proven = point.certificate.relative_gap
        gap = ("none" if proven is None else f"{proven:.1e}") + ("" if point.status == "optimal" else " inaccurate")
        add(rows, *cells, point.total_mass_kg, gap, _reached(point), "knee" if index == front.knee else "")
    return rows


def _reached(point: ParetoPoint) -> str:
    """Limits of the machine, and of the webs by their names."""
    machine = [limit.replace("_", " ") for limit in point.active_limits]
    webs = [f"{one.web} {limit.replace('_', ' ')}" for one in point.counterweights for limit in one.active_limits]
    return ", ".join(machine + webs)


def _proven(ends: Ends) -> str:
    return (
        f"Proven: no counterweights reach below {number(ends.smallest_force_lower_bound_N)} N"
        f" or below {number(ends.smallest_moment_lower_bound_Nm)} N m."
    )
