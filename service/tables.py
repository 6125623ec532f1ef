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
    Outputs,
    ShadowPrice,
)
from schemas.effects import EffectCatalogue
from schemas.outputs import Hodograph, Hodographs, OrdersComparison, Stages
from schemas.requests import Objective
from schemas.verify import VerifyAnswer
from service.cells import add, number, table
from service.dynamics_tables import dynamics
from service.pin_tables import pin_loads_report

_STYLES = {"optimal": "bold green", "inaccurate": "bold yellow", "infeasible": "bold red"}
_VERDICTS = {"held": "bold green", "not covered": "bold yellow", "broken": "bold red"}


def optimize_report(title: str, objective: Objective, answer: OptimizeAnswer) -> Group:
    """Counterweights, what they leave, and the certificate; or why there are none."""
    return Group(*_optimize_parts(title, objective, answer))


def analyze_report(title: str, answer: AnalyzeAnswer) -> Group:
    """What the machine does without and with its counterweights."""
    return Group(*_analyze_parts(title, answer))


def names_report(title: str, names: Sequence[tuple[str, str]]) -> Table:
    """Names with what they stand for."""
    rows = table(title, "name", "")
    for name, meaning in names:
        add(rows, name, meaning)
    return rows


def verify_report(answer: VerifyAnswer) -> Group:
    """What became of the claims of an answer."""
    rows = table("claims", "claim", "verdict", "margin", "where")
    for one in answer.claims:
        margin = "" if one.margin is None else f"{one.margin:.1e}"
        add(rows, one.claim, one.verdict, margin, one.where)
    return Group(rows, Text.assemble("the answer: ", (answer.verdict, _VERDICTS[answer.verdict])))


def effects_report(catalogue: EffectCatalogue) -> Group:
    """What can be asked for, and what is simulated and read for it."""
    columns = ("name", "", "needs", "inputs beyond masses and geometry")
    outputs, effects = table("outputs", *columns), table("effects", *columns)
    for rows, entries in ((outputs, catalogue.outputs), (effects, catalogue.effects)):
        for one in entries:
            add(rows, one.name, one.meaning, ", ".join(one.needs), ", ".join(one.inputs))
    return Group(outputs, effects)


def _optimize_parts(title: str, objective: Objective, answer: OptimizeAnswer) -> Iterator[RenderableType]:
    yield Text.assemble(title, ": ", (answer.status, _STYLES[answer.status]))
    if answer.infeasibility is not None:
        yield from _infeasible(objective, answer.infeasibility, answer.residual.before, answer.floor)
    else:
        yield _counterweights("counterweights", answer.counterweights)
        yield _first_order(answer.residual.before, answer.residual.after, answer.floor)
        yield Text(f"total mass {number(answer.total_mass_kg)} kg")
    if answer.active_limits:
        yield Text("the machine is at its " + ", ".join(name.replace("_", " ") for name in answer.active_limits))
    if answer.shadow_prices:
        yield _shadow_prices(answer.shadow_prices)
    if answer.certificate is not None:
        yield from _certificate(answer.status == "optimal", answer.certificate)
    yield from _others(answer)


def _analyze_parts(title: str, answer: AnalyzeAnswer) -> Iterator[RenderableType]:
    yield Text(title)
    if answer.total_mass_kg > 0:
        yield _counterweights("counterweights", answer.counterweights)
        yield Text(f"total mass {number(answer.total_mass_kg)} kg")
    if answer.residual is not None and answer.floor is not None:
        yield _first_order(answer.residual.before, answer.residual.after, answer.floor)
    yield from _others(answer)


def _infeasible(objective: Objective, why: Infeasibility, before: FirstOrder, floor: Floor) -> Iterator[RenderableType]:
    yield Text("No counterweights within the limits satisfy: " + ", ".join(why.conflict))
    closest = why.closest.first_order
    rows = table("what can be reached", "", "peak force, N", "peak moment, N m")
    add(rows, "ceiling", objective.force_ceiling_N, objective.moment_ceiling_Nm)
    add(rows, "smallest, the other left free", why.smallest_force_N, why.smallest_moment_Nm)
    add(rows, "certified not below", why.smallest_force_lower_bound_N, why.smallest_moment_lower_bound_Nm)
    add(rows, "best compromise", closest.force.peak_N, closest.moment.peak_Nm)
    yield rows
    yield _counterweights("counterweights of the best compromise", why.closest.counterweights)
    yield _first_order(before, closest, floor)


def _counterweights(title: str, counterweights: Sequence[Counterweight]) -> Table:
    rows = table(title, "web", "mass, kg", "angle, deg", "mass x radius, kg m", "limits reached")
    for one in counterweights:
        limits = ", ".join(limit.replace("_", " ") for limit in one.active_limits)
        add(rows, one.web, one.mass_kg, one.angle_deg, one.mass_radius_kg_m, limits)
    return rows


def _shadow_prices(prices: Sequence[ShadowPrice]) -> Table:
    rows = table("what the limits cost", "limit", "web", "the objective falls by", "per")
    for one in prices:
        quantity, _, per = one.unit.partition("/")
        add(rows, one.limit.replace("_", " "), one.web or "", f"{number(one.value)} {quantity}", per)
    return rows


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
    rows = table("first order", "", "before", "after", "floor")
    for name, peak in peaks.items():
        add(rows, name, peak(before), None if after is None else peak(after), floors.get(name, ""))
    return rows


def _certificate(optimal: bool, proof: Certificate) -> Iterator[Text]:
    if proof.lower_bound is None or proof.relative_gap is None:
        yield Text(
            f"Nothing is proven of these counterweights, which bring the objective to {number(proof.objective)}."
        )
        return
    yield Text(
        f"{'Certified' if optimal else 'Not certified to the gap asked for'}: no counterweights within the limits "
        f"bring the objective below {number(proof.lower_bound)}; these bring it to {number(proof.objective)}, "
        f"from {number(proof.objective_without_counterweights)} without any "
        f"(relative gap {proof.relative_gap:.1e}; {proof.method})."
    )
    if proof.mass_lower_bound_kg is not None:
        yield Text(f"No optimum weighs less than {number(proof.mass_lower_bound_kg)} kg.")


def _others(answer: Outputs) -> Iterator[RenderableType]:
    if answer.orders is not None:
        yield _orders(answer.orders)
    if answer.stages is not None:
        yield _stages(answer.stages)
        if any(stage.rules_of_thumb for stage in answer.stages):
            yield _rules_of_thumb(answer.stages)
    if answer.hodograph is not None:
        yield from _hodographs(answer.hodograph)
    yield from dynamics(answer)
    if answer.pin_loads is not None:
        yield pin_loads_report(answer.pin_loads)


def _orders(orders: OrdersComparison) -> Table:
    rows = table("orders", "order", "force, N", "after", "moment, N m", "after")
    after = {one.order: one for one in orders.after or ()}
    for one in orders.before:
        left = after.get(one.order)
        force, moment = (left.force.peak_N, left.moment.peak_Nm) if left else (None, None)
        add(rows, str(one.order), one.force.peak_N, force, one.moment.peak_Nm, moment)
    return rows


def _stages(stages: Stages) -> Table:
    columns = ("stage", "title", "quantity", "value", "remaining", "unit", "plane", "frequency", "balanceable")
    rows = table("balancing stages", *columns)
    for one in stages:
        values = (one.value, one.remaining)
        add(rows, one.stage, one.title, one.quantity, *values, one.unit, one.plane, one.frequency, one.balanceable)
    return rows


def _rules_of_thumb(stages: Stages) -> Table:
    columns = ("stage", "rule", "share", "mass x radius, kg m", "peak", "source")
    rows = table("rules of thumb beside the optimum", *columns)
    for stage in stages:
        for rule in stage.rules_of_thumb:
            share, product = rule.transferred_share, rule.total_mass_radius_kg_m
            add(rows, stage.stage, rule.name, share, product, rule.peak, rule.source)
    return rows


def _hodographs(hodographs: Hodographs) -> Iterator[Text]:
    yield Text(f"hodograph: {len(hodographs.angle_deg)} shaft angles; --json prints them")
    for when, one in (("before", hodographs.before), ("after", hodographs.after)):
        if one is not None:
            yield Text(f"  {when}: {_hodograph_range(one)}")


def _hodograph_range(one: Hodograph) -> str:
    force = list(map(math.hypot, one.force_x_N, one.force_y_N))
    moment = list(map(math.hypot, one.moment_x_Nm, one.moment_y_Nm))
    return (
        f"force {number(min(force))} to {number(max(force))} N, "
        f"moment {number(min(moment))} to {number(max(moment))} N m"
    )
