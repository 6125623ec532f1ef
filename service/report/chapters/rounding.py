"""What steps of mass and angle cost, beside the answer on these steps."""

from collections.abc import Iterator

from schemas.answer.answers import OptimizeAnswer
from schemas.answer.counterweights import every_counterweight
from schemas.request.rounding import RoundAnswer, Rounding, RoundRequest, Weights
from service.report.blocks import Block, Cell, Chapter, Number, Paragraph, facts, table
from service.report.chapters import balance, verdict
from service.report.chapters.answers import optimized
from service.report.chapters.order import order_chapter


def with_rounding(request: RoundRequest, answer: RoundAnswer) -> Iterator[Chapter]:
    """What rounding costs, and the answer on the steps."""
    if answer.rounding is None:
        yield from optimized(request.request, answer)
        return
    yield Chapter("What rounding costs", tuple(_blocks(request, answer, answer.rounding)))
    yield balance.counterweights(request.request, answer, None)
    yield from order_chapter(answer)
    yield balance.before_and_after(request.request, answer, None)
    yield verdict.certificate(request.request, answer)


def _blocks(request: RoundRequest, answer: OptimizeAnswer, rounding: Rounding) -> Iterator[Block]:
    assert answer.certificate is not None  # there is none where nothing can be rounded
    heads = ["#mass on the crankshaft, kg", "#on balance shafts, kg"] if answer.balance_shafts else ["#mass, kg"]
    yield table(
        "",
        ["", "#objective", *heads, "#counterweights", "<limits"],
        [
            _row("any mass, any angle", rounding.optimum),
            _row("each on the nearest step", rounding.nearest),
            ("best rounding", answer.certificate.objective, *_masses(answer), "kept"),
        ],
    )
    yield Paragraph(answer.status_reason)
    share = rounding.relative_rise
    yield facts(
        "",
        [
            ("steps", f"{request.mass_step_kg:g} kg, {request.angle_step_deg:g}°"),
            ("the objective rises by", rounding.objective_rise),
            ("which is of it", "" if share is None else Number(share, f"{100.0 * share:.3g} %")),
            ("with the masses alone on steps", rounding.masses_alone_rise),
            ("with the angles alone on steps", rounding.angles_alone_rise),
        ],
    )
    rows = [(step.web, step.lighter, step.heavier, step.backward, step.forward) for step in rounding.steps]
    if rows:
        title = "The objective rises by, where one counterweight is a step off"
        yield table(title, ["web", "#lighter", "#heavier", "#angle back", "#angle on"], rows)


def _row(name: str, weights: Weights) -> tuple[Cell | float | None, ...]:
    return (name, weights.objective, *_masses(weights), "kept" if weights.limits_kept else "broken")


def _masses(weights: Weights | OptimizeAnswer) -> tuple[Cell | float | None, ...]:
    """Masses, those on balance shafts apart, and how many there are that are not fixed."""
    every = every_counterweight(weights)
    pieces = sum(counterweight.mass_kg > 0 and not counterweight.fixed for counterweight in every)
    there = (weights.balance_shafts_mass_kg,) if weights.balance_shafts else ()
    return (weights.total_mass_kg, *there, Number(pieces, str(pieces)))
