"""The ladders of accuracy as readable tables."""

from collections.abc import Iterator

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from schemas.accuracy import AccuracyAnswer, AccuracyRow, EffectRow
from service.cells import add, number, table

_METHODS = {
    "service": "the service",
    "interior_point": "interior point, compiled",
    "interior_point_batch": "interior point, one of 1000",
    "interior_point_interpreted": "interior point, finer numbers",
    "cone_program": "cone program",
    "cone_program_matrices": "cone program, matrices",
    "sampled_angles": "sampled angles",
    "polygonal_cones": "polygonal cones",
    "panels": "panels between kinks",
    "search": "search between kinks",
    "samples": "equal steps",
}
_EMPTY = {
    "nothing_to_choose": "No web can carry a counterweight, or the objective is 0 without any: nothing to measure.",
    "infeasible": "No counterweights satisfy the ceilings; `counterweight optimize` says why.",
}


def accuracy_report(title: str, answer: AccuracyAnswer) -> Group:
    """The ladder of methods, the ladder of effects, and what they were measured with."""
    return Group(*_parts(title, answer))


def method_name(method: str) -> str:
    """A method in words; one that is not known here by its own name."""
    return _METHODS.get(method, method.replace("_", " "))


def _parts(title: str, answer: AccuracyAnswer) -> Iterator[RenderableType]:
    yield Text(title)
    if answer.status != "measured":
        yield Text(_EMPTY[answer.status])
    else:
        yield _ladder(answer)
        yield from (
            Text(f"{method_name(row.method)}, {row.setting}: {row.skipped}") for row in answer.ladder if row.skipped
        )
    if answer.reference is not None:
        yield Text(
            f"Certified: no counterweights within the limits bring the objective below "
            f"{number(answer.reference.lower_bound)}; the best found bring it to {number(answer.reference.objective)}. "
            f"Errors are relative to {number(answer.reference.objective_without_counterweights)}, the objective "
            f"without any, and known to {answer.reference.resolution:.0e}."
        )
    if answer.effects_ladder:
        yield _effects(answer.effects_ladder)
    yield Text(_measured_with(answer))


def _ladder(answer: AccuracyAnswer) -> Table:
    columns = ("method", "setting", "time, ms", "first, ms", "error", "as drawn", "certified gap", "claim", "")
    found = table("what the smallest objective costs (least mass is off)", *columns)
    for row in answer.ladder:
        time_ms, first_ms = (None if value is None else f"{value:.2f}" for value in (row.time_ms, row.first_ms))
        errors = map(scientific, (row.relative_error, row.as_drawn_error, row.certified_gap, row.claim_error))
        add(found, method_name(row.method), row.setting, time_ms, first_ms, *errors, _remark(row))
    return found


def _remark(row: AccuracyRow) -> str:
    if row.skipped:
        return "skipped"
    broken = "ceilings broken by " + scientific(row.excess) if (row.excess or 0.0) > 1e-9 else ""
    return "frontier" if row.on_frontier else broken


def _effects(rows: tuple[EffectRow, ...]) -> Table:
    found = table("what the figures of the turn cost", "figure", "method", "setting", "time, ms", "error")
    for row in rows:
        cells = row.quantity.replace("_", " "), method_name(row.method), row.setting
        add(found, *cells, f"{row.time_ms:.2f}", scientific(row.relative_error))
    return found


def _measured_with(answer: AccuracyAnswer) -> str:
    size, versions = answer.size, ", ".join(f"{name} {value}" for name, value in answer.environment.versions.items())
    return (
        f"{size.webs} webs, {size.norm_terms} norms, {size.ceilings} ceilings; median of {answer.repeats} rounds, "
        f"largest error over {answer.positions} positions of grid or polygon; {versions}; "
        f"{answer.environment.cpus} processors, one for each solve."
    )


def scientific(value: float | None) -> str:
    """An error to two digits."""
    return "-" if value is None else f"{value:.1e}"
