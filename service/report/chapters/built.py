"""What is built beside the optimum: what it leaves, web by web, and the tolerance that the optimum bears."""

from collections.abc import Iterator, Sequence

from schemas.answer.answers import OptimizeAnswer
from service.report.blocks import Block, Number, Paragraph, prose, table
from service.tables.as_built import ALLOWANCE, HEADS, RESIDUAL_HEADS, AsBuilt, Pair, Tolerance, line, residual
from service.tables.lines import Cell


def decision(answer: OptimizeAnswer, built: AsBuilt) -> Iterator[Block]:
    """Peaks without counterweights, at the optimum and as built."""
    floors = (answer.floor.force_N, answer.floor.moment_Nm, None)
    heads = [RESIDUAL_HEADS[0], *(f"#{head}" for head in RESIDUAL_HEADS[1:]), "#floor"]
    yield table("Decision", heads, [(*row, floor) for row, floor in zip(residual(answer, built), floors, strict=True)])
    yield Paragraph(
        "The optimum is certified. What is as built is evaluated by the same mechanics from the masses and angles that "
        "are fitted, and nothing is certified of it."
    )


def as_fitted(built: AsBuilt) -> Iterator[Block]:
    """Optimum, as built and difference of each web."""
    heads = ["web", "#plane z, m", "#radius, m"]
    for unit in ("kg", "deg"):
        heads += [f"#optimum, {unit}", "#as built", "#difference", "#tolerance"]
    rows = [tuple(_cells(pair, line(pair, built.tolerance))) for pair in built.pairs]
    yield table("Optimum and as built", heads, rows)
    yield Paragraph(_words(built.tolerance))


def _cells(pair: Pair, cells: Sequence[Cell]) -> Iterator[str | Number | float | None]:
    """Under the headings of the table; a tolerance to two digits, as nobody measures more."""
    place = pair.built or pair.optimum
    yield pair.web
    yield from (None, None) if place is None else (place.position_m, place.radius_m)
    for head, cell in zip(HEADS[1:], cells[1:], strict=True):
        value = cell if isinstance(cell, float) else None
        rough = value is not None and head.startswith("tolerance")
        yield Number(value, f"±{value:.2g}") if rough and value is not None else value


def _words(bears: Tolerance) -> str:
    if bears.share is None or bears.angle_deg is None:
        return "No tolerance is known: there is no sensitivity of this answer."
    return (
        f"Tolerance: with all masses off together by ±{prose(round(100 * bears.share, 3))} % or all angles by "
        f"±{prose(round(bears.angle_deg, 3))} deg, the objective rises by {100 * ALLOWANCE:g} % of that without "
        "counterweights at most. Above one per cent and one degree nothing is known."
    )
