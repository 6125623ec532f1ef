"""What is built beside the optimum: what it leaves, web by web, and the tolerance that the optimum bears."""

from collections.abc import Iterator

from schemas.answer.answers import OptimizeAnswer
from service.report.blocks import Block, Paragraph, digits, table
from service.tables.as_built import ALLOWANCE, HEADS, RESIDUAL_HEADS, AsBuilt, Tolerance, line, residual


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
    heads = [HEADS[0], *(f"#{head.replace('+-', '±')}" for head in HEADS[1:])]
    yield table("As built", heads, [line(one, built.tolerance) for one in built.pairs])
    yield Paragraph(_words(built.tolerance))


def _words(bears: Tolerance) -> str:
    if bears.share is None or bears.angle_deg is None:
        return "No tolerance is known: there is no sensitivity of this answer."
    return (
        f"Tolerance: with all masses off together by ±{digits(round(100 * bears.share, 3))} % or all angles by "
        f"±{digits(round(bears.angle_deg, 3))} deg, the objective rises by {100 * ALLOWANCE:g} % of that without "
        "counterweights at most. Above one per cent and one degree nothing is known."
    )
