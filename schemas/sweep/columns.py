"""The columns of the result: names, units, and the field or output that each stands for."""

from collections.abc import Iterator, Sequence

from schemas.answer.outputs import COLUMNS_OF_PARTS, OUTPUT_COLUMNS, Column, labels
from schemas.base.responses import PAIR, active_responses
from schemas.base.rules import Path
from schemas.base.target import Target, pointer
from schemas.base.variation import with_fields
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import balance_shafts
from schemas.machine.webs import Web
from schemas.request.objective import COSTS, Objective
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.sweep.details import detail_columns

_ALWAYS = (
    Column(
        "status",
        "text",
        None,
        "optimal, inaccurate, infeasible or analyzed; invalid if a field is wrong, failed if computing broke down",
    ),
    Column("message", "text", None, "why there is no certified answer: the field that is wrong, or what broke down"),
)
_RESIDUAL = (
    Column("force_peak_N", "number", "N", "peak of the first-order force with the counterweights"),
    Column("moment_peak_Nm", "number", "N m", "peak of the first-order moment with the counterweights"),
)
_CERTIFICATE = (
    Column("method", "text", None, "what found the counterweights"),
    Column("objective", "number", None, "objective of the counterweights, recomputed"),
    Column("lower_bound", "number", None, "no counterweights within the limits have a smaller objective"),
    Column("relative_gap", "number", None, "objective above that bound, over `yardstick`"),
    Column("yardstick", "number", None, "what relative gaps are relative to: the objective without counterweights"),
    Column("mass_lower_bound_kg", "number", "kg", "no optimum has a smaller total mass"),
    Column("mass_relative_gap", "number", None, "total mass above that bound, over `yardstick`"),
    Column(
        "mass_yardstick_kg", "number", "kg", "what that gap is relative to: the total mass, or the least that counts"
    ),
)
#: by the fields of the price of robustness
PRICE = {
    "nominal": Column(
        "nominal_objective",
        "number",
        None,
        "objective of the counterweights on the unchanged machine, nothing off",
    ),
    "nominal_optimum": Column(
        "nominal_optimum", "number", None, "smallest objective of that machine, nothing off; null if it was not found"
    ),
    "nominal_optimum_worst_case": Column(
        "nominal_optimum_worst_case", "number", None, "objective of that optimum in the worst case; null likewise"
    ),
}
#: largest load of a main bearing in the worst case
WORST_LOAD = "worst_case_bearing_peak_N"
#: numbers of the certificate that a row holds, by the names of its fields
CERTIFICATE = tuple(column.name for column in _CERTIFICATE if column.kind == "number")
#: column of the proofs, of sweeps with `multipliers`
MULTIPLIERS = "multipliers"
_TOTAL_MASS = Column("total_mass_kg", "number", "kg", "total mass of the counterweights")
_SHAFTS_MASS = Column("balance_shafts_mass_kg", "number", "kg", "total mass of what the balance shafts carry")


def result_columns(
    base: OptimizeRequest | AnalyzeRequest,
    targets: Sequence[Target],
    multipliers: bool = False,
    always: Sequence[str] = (),
    details: bool = False,
) -> tuple[Column, ...]:
    """All columns of a sweep, in the order of the result: index, axes, status, figures, counterweights.

    Parameters
    ----------
    always : outputs with columns in every row, whether the request names them or not.
    details : whether those in detail come along.
    """
    columns: dict[str, Column] = {}
    for column in _columns(base, targets, always, details):
        columns.setdefault(column.name, column)
    if multipliers:
        meaning = "multipliers of the certificate, or of the conflict of the ceilings, as JSON"
        columns[MULTIPLIERS] = Column(MULTIPLIERS, "text", None, meaning)
    return tuple(columns.values())


def goal_columns(objective: Objective) -> Iterator[Column]:
    """What goals in their order come to: all of them with a cost among them, else those before the last."""
    order = [priority.goal for priority in objective.priorities]
    weighed = [priority for priority in objective.priorities if priority.goal not in COSTS]
    if order[-1:] == ["mass"] and weighed and weighed[-1].allowance == 0.0:
        # of equal counterweights the lightest are taken anyhow
        order.pop()
    for goal in order if any(goal in COSTS for goal in order) else order[:-1]:
        yield Column(f"goal_value.{goal}", "number", None, f"what the goal {goal} comes to in the end")
        yield Column(f"goal_lower_bound.{goal}", "number", None, "proven of what it comes to at least")
        yield Column(f"goal_limit.{goal}", "number", None, "what the goals after it may let it come to")


def worst_peak(name: str) -> str:
    """The column of a peak in the worst case, by that of the peak."""
    return f"worst_case_{name}"


def worst_columns(base: OptimizeRequest, targets: Sequence[Target]) -> Iterator[Column]:
    """What counterweights come to in the worst case, and what that costs; none without scenarios and tolerances."""
    if not base.uncertain:
        return
    for column in _residual(base, targets):
        yield column._replace(name=worst_peak(column.name), meaning=f"{column.meaning}, in the worst case")
    varied = {target.path[1:]: 1.0 for target in targets if target.path[0] == "objective"}
    if with_fields(base.objective, varied).of_the_shaft:
        yield Column(WORST_LOAD, "number", "N", "largest load of a main bearing in the worst case")
    yield from PRICE.values()


def _columns(
    base: OptimizeRequest | AnalyzeRequest, targets: Sequence[Target], always: Sequence[str], details: bool
) -> Iterator[Column]:
    yield Column("index", "integer", None, "number of the design, from 0")
    for target in targets:
        path = pointer(target.path)
        yield Column(path, "number", target.unit, "value of the field in this design", path)
    yield from _ALWAYS
    optimizes = isinstance(base, OptimizeRequest)
    if optimizes or "residual" in base.outputs:
        yield from _residual(base, targets)
        if details:
            yield from detail_columns(base.machine, "residual")
    yield _TOTAL_MASS
    if balance_shafts(base.machine):
        yield _SHAFTS_MASS
    if optimizes:
        yield from _CERTIFICATE
    if isinstance(base, OptimizeRequest):
        yield from worst_columns(base, targets)
        yield from goal_columns(base.objective)
    for output in dict.fromkeys((*always, *base.outputs)):
        yield from OUTPUT_COLUMNS[output]
        yield from _of_parts(base.machine, output)
        if details:
            yield from detail_columns(base.machine, output)
    if optimizes:
        yield from _of_webs(base.machine)


def _of_webs(machine: Machine) -> Iterator[Column]:
    """What is fitted on each web, on those of balance shafts behind those of the crankshaft."""
    webs: list[tuple[Path, Web]] = [(("machine", "webs", k), web) for k, web in enumerate(machine.webs)]
    for n, shaft in enumerate(balance_shafts(machine)):
        webs += [(("machine", "balance_shafts", n, "webs", k), web) for k, web in enumerate(shaft.webs)]
    for place, web in webs:
        path = pointer(place)
        yield Column(f"mass_kg.{web.name}", "number", "kg", "mass of the counterweight on this web", path)
        yield Column(f"angle_deg.{web.name}", "number", "deg", "its angle as drawn at shaft angle 0", path)
        if web.envelope is not None:
            meaning = "half of the opening of what is cut from its plate"
            yield Column(f"half_angle_deg.{web.name}", "number", "deg", meaning, path)


def _residual(base: OptimizeRequest | AnalyzeRequest, targets: Sequence[Target]) -> Iterator[Column]:
    """Peaks of force and moment, and of the other responses that count in some design."""
    yield from _RESIDUAL
    weights = {target.path[1:]: 1.0 for target in targets if target.path[0] == "objective"}
    for response in active_responses(with_fields(base.objective, weights)) if isinstance(base, OptimizeRequest) else ():
        if response.name not in PAIR:
            meaning = f"peak of the first-order {response.label} with the counterweights"
            yield Column(response.peak, "number", response.unit, meaning)


def _of_parts(machine: Machine, output: str) -> Iterator[Column]:
    """Columns of an output for each of the parts that it is about; none where the machine has no such parts."""
    if output not in COLUMNS_OF_PARTS:
        return
    parts, columns = COLUMNS_OF_PARTS[output]
    items = getattr(machine, parts, ())
    for k, label in enumerate(labels([part.name for part in items])):
        for column in columns:
            yield column._replace(name=f"{column.name}.{label}", source=pointer(("machine", parts, k)))
