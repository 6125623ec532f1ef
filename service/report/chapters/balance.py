"""The result: stages, counterweights, first order before and after, orders."""

import math
from collections.abc import Iterator, Mapping, Sequence

from schemas.answer.answers import OptimizeAnswer
from schemas.answer.counterweights import Counterweight, FittedShaft, every_counterweight
from schemas.answer.first_order import FirstOrder, Floor
from schemas.answer.outputs import Hodographs, Stage
from schemas.base.model import FieldProblem
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import balance_shafts
from schemas.request.requests import OptimizeRequest
from service.common.validation import pointer
from service.report.blocks import (
    Block,
    Cell,
    Chapter,
    Equation,
    Figure,
    Paragraph,
    Table,
    angle,
    facts,
    figure_beside,
    number,
    table,
)
from service.report.chapters.built import as_fitted
from service.report.chapters.limits import limits
from service.report.chapters.making import holding, outlines
from service.report.chapters.orders import two_orders
from service.report.chapters.resolution import resolutions
from service.report.first_order import hodographs
from service.report.formula import formula
from service.report.stage_scheme import stage_scheme
from service.tables.as_built import AsBuilt

_FIRST_ORDER = (
    ("peak force, N", "force", "peak_N"),
    ("smallest force over a revolution, N", "force", "minor_N"),
    ("direction of the peak force, deg", "force", "major_axis_deg"),
    ("peak force along x, N", "force", "peak_x_N"),
    ("peak force along y, N", "force", "peak_y_N"),
    ("turning with the shaft |f|, N", "force", "co_rotating_N"),
    ("turning against the shaft |b|, N", "force", "counter_rotating_N"),
    ("peak moment, N m", "moment", "peak_Nm"),
    ("smallest moment over a revolution, N m", "moment", "minor_Nm"),
    ("direction of the peak moment, deg", "moment", "major_axis_deg"),
    ("peak horizontal couple (of the x forces), N m", "moment", "peak_x_Nm"),
    ("peak vertical couple (of the y forces), N m", "moment", "peak_y_Nm"),
    ("turning with the shaft |f|, N m", "moment", "co_rotating_Nm"),
    ("turning against the shaft |b|, N m", "moment", "counter_rotating_Nm"),
)
_SOURCES = (
    "Sources: Qian and Qu (2017), inertia force and torque equilibrium of piston compressors; Balancing "
    "(Уравновешивание), lecture slides on compressors, which name neither author nor year."
)
#: of a peak, below which a figure is what rounding leaves
_DUST = 1e-6
_NO_GAPS: Mapping[str, float] = {}
_VERDICT = {"fully": "fully", "partly": "partly", "no": "not"}


def best_set(answer: OptimizeAnswer) -> tuple[Sequence[Counterweight], FirstOrder | None]:
    """Counterweights to show and what they leave; of an infeasible request the best compromise."""
    if answer.infeasibility is not None:
        closest = answer.infeasibility.closest
        return closest.counterweights, closest.first_order
    return answer.counterweights, answer.residual.after


def carried(answer: OptimizeAnswer) -> tuple[Counterweight, ...]:
    """All that is to be drawn: those on balance shafts behind the counterweights to show."""
    return every_counterweight(answer if answer.infeasibility is None else answer.infeasibility.closest)


def response_rows(answer: OptimizeAnswer, gaps: Mapping[str, float]) -> Iterator[tuple[str, float, Cell, str]]:
    """Peaks of the responses that count beside force and moment: without counterweights, with those that are shown.

    Parameters
    ----------
    gaps : peaks by response that are not distinguishable from zero.
    """
    why = answer.infeasibility
    closest = {} if why is None else {response.response: response.peak for response in why.closest.responses}
    for response in answer.residual.responses:
        after = closest.get(response.response, response.after)
        yield (
            f"peak {response.label}, {response.unit}",
            response.before,
            figure_beside(after, response.before, gaps.get(response.response, 0.0)),
            "",
        )
        if response.turn_before is not None:
            yield (
                f"peak {response.label} of all orders, {response.unit}",
                response.turn_before,
                figure_beside(response.turn_after, response.turn_before),
                "",
            )


def best_set_label(answer: OptimizeAnswer) -> str:
    """What the counterweights are that :func:`best_set` gives."""
    return "best compromise" if answer.infeasibility is not None else "with counterweights"


def stages(machine: Machine, results: Sequence[Stage] | None, missing: Sequence[FieldProblem]) -> Chapter:
    """The eight balancing stages, or what the machine lacks for them."""
    title = "The eight balancing stages"
    if results is None:
        fields = "; ".join(f"{pointer(path)}: {message}" for path, message in missing[:5])
        return Chapter(title, (Paragraph(f"Not computed, because the machine does not give what they need. {fields}"),))
    left_by = "counterweights and balance shafts" if balance_shafts(machine) else "the counterweights"
    values = table(
        f"Values without counterweights, and what {left_by} leave",
        ["stage", "<subject", "#value", "#remaining", "unit", "can be balanced"],
        [
            (
                stage.stage,
                stage.title,
                stage.value,
                figure_beside(stage.remaining, stage.value or 0.0),
                stage.unit,
                _VERDICT[stage.balanceable],
            )
            for stage in results
        ],
    )
    where = table(
        "Direction and frequency",
        ["stage", "<plane", "frequency"],
        [(stage.stage, stage.plane, stage.frequency) for stage in results],
    )
    formulas = table(
        "Formulas, with d the angle of a crank, g that of a row axis, and sums over all masses",
        ["stage", "<quantity", "<formula"],
        [(stage.stage, stage.quantity, formula(stage.formula)) for stage in results],
    )
    scheme = Figure(
        (stage_scheme(machine, results),),
        "Scheme of the stages, from the front at shaft angle 0, each with a scale of its own: cranks black, row axes "
        "dash-dotted, forces orange and dashed without counterweights, blue what they leave. What turns is a circle "
        "with an arrow, what keeps its direction a line; of a moment the line is the trace of its plane.",
    )
    return Chapter(title, (scheme, values, where, formulas, *_rules(results), Paragraph(_SOURCES)))


def _rules(results: Sequence[Stage]) -> Iterator[Block]:
    rows = [
        (
            stage.stage, rule.name, rule.transferred_share, rule.total_mass_radius_kg_m, rule.peak, stage.unit,
            rule.source,
        )
        for stage in results
        for rule in stage.rules_of_thumb
    ]  # fmt: skip
    if rows:
        heads = [
            "stage", "<rule of thumb", "#share", "#mass times radius, kg m", "#peak that it leaves", "unit", "<source",
        ]  # fmt: skip
        yield table("Customary partial balances, for comparison", heads, rows)


def counterweights(request: OptimizeRequest, answer: OptimizeAnswer, built: AsBuilt | None) -> Chapter:
    """One row for each web."""
    fitted, _ = best_set(answer)
    blocks: list[Block] = []
    if answer.infeasibility is not None:
        blocks.append(Paragraph("These are the counterweights of the best compromise, not an answer.", "warning"))
    holder = answer if answer.infeasibility is None else answer.infeasibility.closest
    shafts = list(on_balance_shafts(holder.balance_shafts, answer.balance_shafts_mass_kg))
    if built is None:
        shafts += holding(
            request.machine, [weight for shaft in holder.balance_shafts for weight in shaft.counterweights]
        )
    if not fitted:
        blocks.append(Paragraph("There are none on the crankshaft." if shafts else "There are none."))
    if fitted or shafts:
        blocks.append(
            Paragraph("Angles are those of the centres of mass, counter-clockwise from +x, as drawn at shaft angle 0.")
        )
    if built is not None:
        blocks += as_fitted(built)
    elif fitted:
        blocks += workshop_blocks(request.machine, fitted)
    return Chapter("Counterweights", (*blocks, *shafts))


def on_balance_shafts(shafts: Sequence[FittedShaft], mass_kg: float | None) -> Iterator[Block]:
    """What each balance shaft carries, and which way gearing turns it.

    Parameters
    ----------
    mass_kg : of all of it; None where nothing is to be fitted.
    """
    for shaft in shafts:
        yield Paragraph(f"Balance shaft {shaft.name}: {shaft.gearing}")
        yield places(shaft.counterweights)
    if mass_kg is not None:
        yield facts("", [("total mass on the balance shafts, kg", mass_kg)])


def workshop_blocks(machine: Machine, fitted: Sequence[Counterweight]) -> Iterator[Block]:
    """What is on the crankshaft, and what a workshop has to know of it."""
    yield places(fitted)
    yield from holding(machine, fitted)
    yield from outlines(fitted)


def places(fitted: Sequence[Counterweight]) -> Table:
    """Masses and angles, one row for each web."""
    return table(
            "",
            [
                "web", "#mass, kg", "#angle, deg", "#from its crank, deg", "#plane z, m", "#radius, m",
                "#mass times radius, kg m", "limits reached",
            ],
            [
                (
                    item.web,
                    *(
                        (
                            item.mass_kg, angle(item.angle_deg), angle(item.angle_from_crank_deg), item.position_m,
                            item.radius_m, item.mass_radius_kg_m,
                        )
                        if item.mass_kg > 0
                        else ("none", *5 * (None,))
                    ),
                    "fixed" if item.fixed else limits(item.active_limits) or "none",
                )
                for item in fitted
            ],
    )  # fmt: skip


def before_and_after(request: OptimizeRequest, answer: OptimizeAnswer, built: AsBuilt | None) -> Chapter:
    """First-order force and moment, what the counterweights leave, and what those that are fitted do."""
    _, left = best_set(answer)
    # an answer with all orders has a chapter for them
    orders = two_orders(answer.residual.orders) if answer.orders is None else None
    filed = None if built is None else built.left
    gaps = resolutions(request, answer)
    return first_order(
        request.machine, answer.residual.before, left, answer.floor, best_set_label(answer), orders, filed, gaps
    )


def first_order(
    machine: Machine,
    was: FirstOrder,
    left: FirstOrder | None,
    floor: Floor,
    label: str,
    beside: Table | None,
    built: FirstOrder | None = None,
    gaps: Mapping[str, float] = _NO_GAPS,
) -> Chapter:
    """First-order force and moment: ellipses as figures and as hodographs.

    Parameters
    ----------
    left : with counterweights, if there are any.
    label : what these are.
    beside : the second order, where it stands nowhere else.
    built : with what is fitted, if anything is.
    gaps : peaks of force and moment that are not distinguishable from zero.
    """
    scales = {"force": was.force.peak_N, "moment": was.moment.peak_Nm}
    # what a gap says of peaks it says of their parts, and not of angles
    smallest = {name: 0.0 if name.endswith("_deg") else gaps.get(vector, 0.0) for _, vector, name in _FIRST_ORDER}
    floors = {"peak_N": floor.force_N, "peak_Nm": floor.moment_Nm}
    rows = [
        (
            title,
            figure_beside(getattr(getattr(was, vector), name), scales[vector]),
            figure_beside(getattr(getattr(left, vector), name), scales[vector], smallest[name]) if left else None,
            number(floors[name]) if name in floors else "",
        )
        for title, vector, name in _FIRST_ORDER
        # along an axis of which nothing is and nothing comes, there is nothing to file
        if name in floors
        or any(getattr(getattr(state, vector), name) > _DUST * scales[vector] for state in (was, left) if state)
    ]
    return Chapter(
        "First order before and after",
        (
            Equation(formula("F(theta) = f e^{j s theta} + b e^{-j s theta},   peak |f| + |b|,   floor |b|")),
            table("", ["quantity", "#without counterweights", f"#{label}", "#floor"], rows),
            *(() if beside is None else (beside,)),
            Figure(
                hodographs(machine, was, left, floor, label, built),
                "Hodographs: the tips of first-order force and moment run along these ellipses once a revolution. No "
                "counterweight on the shaft brings a peak below the floor circle. Moments are couples in the plane of "
                "the forces about the reference plane.",
            ),
        ),
    )


def hodograph(output: Hodographs) -> Chapter:
    """Between which values force and moment run over the turn; the answer itself holds every sample."""
    rows = [
        (name, figure_beside(min(force), max(force)), max(force), figure_beside(min(moment), max(moment)), max(moment))
        for name, curve in (("without counterweights", output.before), ("with counterweights", output.after))
        if curve is not None
        for force in [list(map(math.hypot, curve.force_x_N, curve.force_y_N))]
        for moment in [list(map(math.hypot, curve.moment_x_Nm, curve.moment_y_Nm))]
    ]
    heads = ["", "#smallest force, N", "#largest force, N", "#smallest moment, N m", "#largest moment, N m"]
    return Chapter("Hodograph", (table(f"Over {len(output.angle_deg)} shaft angles", heads, rows),))
