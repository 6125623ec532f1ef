"""What accuracy costs in time: the ladders of methods, of effects and of peaks, and what they were measured with."""

from collections.abc import Iterator

from schemas.request.accuracy import (
    AccuracyAnswer,
    AccuracyRequest,
    AccuracyRow,
    ChoiceRow,
    EffectRow,
    PeakRow,
    Reference,
)
from service.common.figures import digits
from service.report.blocks import Block, Cell, Chapter, Number, Paragraph, Table, number, table

_METHODS = {
    "service": "the service",
    "interior_point": "interior point, compiled",
    "interior_point_batch": "interior point, one of 1000",
    "interior_point_interpreted": "interior point, finer numbers",
    "cone_program": "cone program",
    "cone_program_matrices": "cone program, matrices",
    "sampled_angles": "sampled angles",
    "polygonal_cones": "polygonal cones",
    "orders": "low orders alone",
    "cuts": "cuts at peaks by rounds",
    "nominal": "nominal optimum",
    "partly_off": "optimum with a part off",
    "first_order": "first order of the scatter",
    "corners": "worst corners by rounds",
    "one_scenario": "one scenario alone",
    "worst_scenarios": "worst scenarios by rounds",
    "rounding": "rounding by hand",
    "panels": "panels between kinks",
    "search": "search between kinks",
    "samples": "equal steps",
    "bracket": "bracket, proven",
    "pieces": "samples between kinks",
}
_EMPTY = {
    "nothing_to_choose": "No web can carry a counterweight, or the objective is 0 without any: nothing to measure.",
    "infeasible": "No counterweights satisfy the ceilings; `counterweight optimize` says why.",
    "contradicted": "A bound is above a value that was found, a fault of the service: nothing is measured from it.",
}


def ladders(request: AccuracyRequest, answer: AccuracyAnswer) -> Iterator[Chapter]:
    """The ladders, and what stands behind the figures."""
    if answer.choices_ladder:
        yield Chapter("What counterweights as they are made cost", tuple(_choices(answer)))
    else:
        worst = bool(request.cases) or (request.tolerances is not None and request.tolerances.any)
        goal = "the smallest worst case" if worst else "the smallest objective"
        yield Chapter(f"What {goal} costs (minimum mass is off)", tuple(_ladder(answer)))
    if answer.effects_ladder:
        yield Chapter("What the figures of the cycle cost", (_effects(answer.effects_ladder),))
    if answer.peaks_ladder:
        yield Chapter("What the peaks of the cycle cost", (_peaks(answer.peaks_ladder),))
    yield Chapter("Measured with", (Paragraph(_measured_with(answer)),))


def method_name(method: str) -> str:
    """A method in words; without an entry here, by its own name."""
    return _METHODS.get(method, method.replace("_", " "))


def _ladder(answer: AccuracyAnswer) -> Iterator[Block]:
    if answer.status != "measured":
        yield Paragraph(_EMPTY[answer.status], "warning")
    else:
        heads = ["method", "setting", "#time, ms", "#first, ms", "#error", "#as drawn", "#certified gap", "#claim", ""]
        yield table("", heads, [_rung(row) for row in answer.ladder])
        for row in answer.ladder:
            if row.skipped:
                yield Paragraph(f"{method_name(row.method)}, {row.setting}: {row.skipped}")
    if answer.reference is not None:
        yield Paragraph(_proven("no counterweights within the limits", answer.reference))
        yield from _goals_before(answer.reference)


def _goals_before(reference: Reference) -> Iterator[Block]:
    """The goals whose limits the last is under."""
    if not reference.goals:
        return
    yield Paragraph(
        "The objective is the last goal, under the limits of the goals before it. All methods are given these."
    )
    heads = ["goal", "#smallest", "#lower bound", "#limit", "#without counterweights"]
    yield table(
        "",
        heads,
        [
            (goal.goal, goal.value, goal.lower_bound, goal.limit, goal.without_counterweights)
            for goal in reference.goals
        ],
    )


def _proven(none: str, reference: Reference) -> str:
    return (
        f"Certified: {none} bring the objective below "
        f"{digits(reference.lower_bound)}; the best found bring it to {digits(reference.objective)}. "
        f"Errors are relative to {digits(reference.objective_without_counterweights)}, the objective "
        f"without any, and known to {reference.resolution:.0e}."
    )


def _choices(answer: AccuracyAnswer) -> Iterator[Block]:
    """Gap, mass and pieces against time."""
    heads = ["method", "setting", "#time, ms", "#objective", "#error", "#certified gap", "#kg", "#pieces", "#sizes", ""]
    yield table("", heads, [_choice(row) for row in answer.choices_ladder if not row.skipped])
    for row in answer.choices_ladder:
        if row.skipped:
            yield Paragraph(f"{method_name(row.method)}, {row.setting}: {row.skipped}.")
    if answer.reference is not None:
        yield Paragraph(_proven("no counterweights of this kind", answer.reference))
        if answer.reference.objective_of_any_mass is not None:
            of_any = digits(answer.reference.objective_of_any_mass)
            yield Paragraph(f"Any masses at any angles, each web by itself, bring it to {of_any}.")


def _choice(row: ChoiceRow) -> tuple[Cell | float | None, ...]:
    note = "" if row.limits_kept else "limits broken"
    return (
        method_name(row.method),
        row.setting,
        _time(row.time_ms),
        row.objective,
        _error(row.relative_error),
        _error(row.certified_gap),
        row.total_mass_kg,
        row.pieces,
        row.sizes,
        "frontier" if row.on_frontier else note,
    )


def _rung(row: AccuracyRow) -> tuple[Cell, ...]:
    errors = map(_error, (row.relative_error, row.as_drawn_error, row.certified_gap, row.claim_error))
    return method_name(row.method), row.setting, _time(row.time_ms), _time(row.first_ms), *errors, _remark(row)


def _remark(row: AccuracyRow) -> str:
    if row.skipped:
        return "skipped"
    broken = f"limits broken by {row.excess:.1e}" if row.excess is not None and row.excess > 1e-9 else ""
    return "frontier" if row.on_frontier else broken


def _effects(rows: tuple[EffectRow, ...]) -> Table:
    return table(
        "",
        ["figure", "method", "setting", "#time, ms", "#error"],
        [
            (
                row.quantity.replace("_", " "),
                method_name(row.method),
                row.setting,
                _time(row.time_ms),
                _error(row.relative_error),
            )
            for row in rows
        ],
    )


def _peaks(rows: tuple[PeakRow, ...]) -> Table:
    return table(
        "",
        ["peak", "method", "setting", "#angles", "#time, ms", "#missed", "#certified gap"],
        [
            (
                row.quantity.removeprefix("peak_").replace("_", " "),
                method_name(row.method),
                row.setting,
                row.angles,
                _time(row.time_ms),
                _error(row.relative_error),
                _error(row.certified_gap),
            )
            for row in rows
        ],
    )


def _time(value: float | None) -> Cell:
    return number(None) if value is None else Number(value, f"{value:.2f}")


def _error(value: float | None) -> Cell:
    return number(None) if value is None else Number(value, f"{value:.1e}")


def _measured_with(answer: AccuracyAnswer) -> str:
    size, versions = answer.size, ", ".join(f"{name} {value}" for name, value in answer.environment.versions.items())
    return (
        f"{size.webs} webs, {size.norm_terms} norms, {size.ceilings} ceilings; median of {answer.repeats} rounds, "
        f"largest error over {answer.positions} positions of grid or polygon; {versions}; "
        f"{answer.environment.cpus} processors, one for each solve."
    )
