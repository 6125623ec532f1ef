"""Cheaper choices beside the best one, as the decision that they are."""

from collections.abc import Iterator

from schemas.answer.alternatives import Alternative
from schemas.answer.answers import OptimizeAnswer
from schemas.answer.counterweights import every_counterweight
from service.report.blocks import Cell, Chapter, Number, Paragraph, table

_LEAST = {"mass": "least mass", "pieces": "fewest counterweights", "sizes": "fewest sizes"}
_HEADS = (
    "", "#allowance", "#objective above the best", "#mass, kg", "#counterweights", "#sizes", "#proven at least",
    "<castings",
)  # fmt: skip
_WORDS = (
    "Each row is the cheapest choice that was found within its allowance of the objective. No choice within the"
    " allowance is below the figure that is proven."
)


def alternatives(answer: OptimizeAnswer) -> Iterator[Chapter]:
    """A table, where there are cheaper choices."""
    if not answer.alternatives or answer.certificate is None:
        return
    best = answer.certificate.objective
    rows = [_row(alternative, best) for alternative in answer.alternatives]
    yield Chapter("Cheaper choices", (Paragraph(_WORDS), table("", _HEADS, rows)))


def _row(choice: Alternative, best: float) -> tuple[Cell | float | None, ...]:
    above = choice.objective / best - 1.0 if best > 0 else 0.0
    is_count, bound = choice.minimised != "mass", choice.lower_bound
    return (
        _LEAST[choice.minimised],
        _percent(choice.allowance),
        _percent(above),
        choice.total_mass_kg,
        Number(choice.pieces, str(choice.pieces)),
        Number(choice.sizes, str(choice.sizes)),
        Number(bound, f"{bound:.0f}") if is_count and bound is not None else bound,
        ", ".join(
            f"{weight.web}: {weight.mass_kg:g} kg at {weight.angle_deg:g}°"
            for weight in every_counterweight(choice)
            if weight.mass_kg
        ),
    )


def _percent(share: float) -> Number:
    return Number(share, f"{100.0 * share:.2g} %")
