"""Answers as readable tables for a terminal."""

import math
from collections.abc import Callable, Iterator, Sequence

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from schemas.answers import (
    AnalyzeAnswer,
    Certificate,
    Counterweight,
    FirstOrder,
    Floor,
    Infeasibility,
    OptimizeAnswer,
)
from schemas.outputs import Hodograph, Hodographs, OrdersComparison, Stages
from schemas.requests import Objective

_STYLES = {"optimal": "bold green", "inaccurate": "bold yellow", "infeasible": "bold red"}


def optimize_report(title: str, objective: Objective, answer: OptimizeAnswer) -> Group:
    """Counterweights, what they leave, and the certificate; or why there are none."""
    return Group(*_optimize_parts(title, objective, answer))


def analyze_report(title: str, answer: AnalyzeAnswer) -> Group:
    """What the machine does without and with its counterweights."""
    return Group(*_analyze_parts(title, answer))


def names_report(title: str, rows: Sequence[tuple[str, str]]) -> Table:
    """Names with what they stand for."""
    table = _table(title, "name", "")
    for name, meaning in rows:
        _add(table, name, meaning)
    return table


def _optimize_parts(title: str, objective: Objective, answer: OptimizeAnswer) -> Iterator[RenderableType]:
    yield Text.assemble(title, ": ", (answer.status, _STYLES[answer.status]))
    if answer.infeasibility is not None:
        yield from _infeasible(objective, answer.infeasibility, answer.residual.before, answer.floor)
    else:
        yield _counterweights("counterweights", answer.counterweights)
        yield _first_order(answer.residual.before, answer.residual.after, answer.floor)
        yield Text(f"total mass {_number(answer.total_mass_kg)} kg")
    if answer.active_limits:
        yield Text("the machine is at its " + ", ".join(name.replace("_", " ") for name in answer.active_limits))
    if answer.certificate is not None:
        yield from _certificate(answer.status == "optimal", answer.certificate)
    yield from _others(answer.orders, answer.stages, answer.hodograph)


def _analyze_parts(title: str, answer: AnalyzeAnswer) -> Iterator[RenderableType]:
    yield Text(title)
    if answer.total_mass_kg > 0:
        yield _counterweights("counterweights", answer.counterweights)
        yield Text(f"total mass {_number(answer.total_mass_kg)} kg")
    if answer.residual is not None and answer.floor is not None:
        yield _first_order(answer.residual.before, answer.residual.after, answer.floor)
    yield from _others(answer.orders, answer.stages, answer.hodograph)


def _infeasible(objective: Objective, why: Infeasibility, before: FirstOrder, floor: Floor) -> Iterator[RenderableType]:
    yield Text("No counterweights within the limits satisfy: " + ", ".join(why.conflict))
    closest = why.closest.first_order
    table = _table("what can be reached", "", "peak force, N", "peak moment, N m")
    _add(table, "ceiling", objective.force_ceiling_N, objective.moment_ceiling_Nm)
    _add(table, "smallest, the other left free", why.smallest_force_N, why.smallest_moment_Nm)
    _add(table, "certified not below", why.smallest_force_lower_bound_N, why.smallest_moment_lower_bound_Nm)
    _add(table, "best compromise", closest.force.peak_N, closest.moment.peak_Nm)
    yield table
    yield _counterweights("counterweights of the best compromise", why.closest.counterweights)
    yield _first_order(before, closest, floor)


def _counterweights(title: str, counterweights: Sequence[Counterweight]) -> Table:
    table = _table(title, "web", "mass, kg", "angle, deg", "mass x radius, kg m", "limits reached")
    for one in counterweights:
        limits = ", ".join(limit.replace("_", " ") for limit in one.active_limits)
        _add(table, one.web, one.mass_kg, one.angle_deg, one.mass_radius_kg_m, limits)
    return table


def _first_order(before: FirstOrder, after: FirstOrder | None, floor: Floor) -> Table:
    peaks: dict[str, Callable[[FirstOrder], float]] = {
        "peak force, N": lambda one: one.force.peak_N,
        "  along x": lambda one: one.force.peak_x_N,
        "  along y": lambda one: one.force.peak_y_N,
        "peak moment, N m": lambda one: one.moment.peak_Nm,
        "  in the x plane": lambda one: one.moment.peak_x_Nm,
        "  in the y plane": lambda one: one.moment.peak_y_Nm,
    }
    floors = {"peak force, N": floor.force_N, "peak moment, N m": floor.moment_Nm}
    table = _table("first order", "", "before", "after", "floor")
    for name, peak in peaks.items():
        _add(table, name, peak(before), None if after is None else peak(after), floors.get(name, ""))
    return table


def _certificate(optimal: bool, proof: Certificate) -> Iterator[Text]:
    yield Text(
        f"{'Certified' if optimal else 'Not certified to the gap asked for'}: no counterweights within the limits "
        f"bring the objective below {_number(proof.lower_bound)}; these bring it to {_number(proof.objective)}, "
        f"from {_number(proof.objective_without_counterweights)} without any "
        f"(relative gap {proof.relative_gap:.1e}; {proof.method})."
    )
    if proof.mass_lower_bound_kg is not None:
        yield Text(f"No optimum weighs less than {_number(proof.mass_lower_bound_kg)} kg.")


def _others(
    orders: OrdersComparison | None, stages: Stages | None, hodographs: Hodographs | None
) -> Iterator[RenderableType]:
    if orders is not None:
        yield _orders(orders)
    if stages is not None:
        yield _stages(stages)
        if any(stage.rules_of_thumb for stage in stages):
            yield _rules_of_thumb(stages)
    if hodographs is not None:
        yield from _hodographs(hodographs)


def _orders(orders: OrdersComparison) -> Table:
    table = _table("orders", "order", "force, N", "after", "moment, N m", "after")
    after = {one.order: one for one in orders.after or ()}
    for one in orders.before:
        left = after.get(one.order)
        force, moment = (left.force.peak_N, left.moment.peak_Nm) if left else (None, None)
        _add(table, str(one.order), one.force.peak_N, force, one.moment.peak_Nm, moment)
    return table


def _stages(stages: Stages) -> Table:
    columns = ("stage", "title", "quantity", "value", "remaining", "unit", "plane", "frequency", "balanceable")
    table = _table("balancing stages", *columns)
    for one in stages:
        values = (one.value, one.remaining)
        _add(table, one.stage, one.title, one.quantity, *values, one.unit, one.plane, one.frequency, one.balanceable)
    return table


def _rules_of_thumb(stages: Stages) -> Table:
    columns = ("stage", "rule", "share", "mass x radius, kg m", "peak", "source")
    table = _table("rules of thumb beside the optimum", *columns)
    for stage in stages:
        for rule in stage.rules_of_thumb:
            share, product = rule.transferred_share, rule.total_mass_radius_kg_m
            _add(table, stage.stage, rule.name, share, product, rule.peak, rule.source)
    return table


def _hodographs(hodographs: Hodographs) -> Iterator[Text]:
    yield Text(f"hodograph: {len(hodographs.angle_deg)} shaft angles; --json prints them")
    for when, one in (("before", hodographs.before), ("after", hodographs.after)):
        if one is not None:
            yield Text(f"  {when}: {_hodograph_range(one)}")


def _hodograph_range(one: Hodograph) -> str:
    force = list(map(math.hypot, one.force_x_N, one.force_y_N))
    moment = list(map(math.hypot, one.moment_x_Nm, one.moment_y_Nm))
    return (
        f"force {_number(min(force))} to {_number(max(force))} N, "
        f"moment {_number(min(moment))} to {_number(max(moment))} N m"
    )


def _table(title: str, *columns: str) -> Table:
    table = Table(title=title, title_justify="left", title_style="bold")
    for column in columns:
        table.add_column(column, overflow="fold")
    return table


def _add(table: Table, *cells: str | float | None) -> None:
    # names come from the request: as plain text, they are no markup
    table.add_row(*(Text(cell if isinstance(cell, str) else _number(cell)) for cell in cells))


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.6g}"
