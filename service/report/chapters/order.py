"""The order for a workshop, where counterweights are chosen from sizes."""

from collections.abc import Iterator

from schemas.answer.answers import OptimizeAnswer
from schemas.machine.machine import Machine
from service.report.blocks import Cell, Chapter, Number, Paragraph, table
from service.tables.as_built import ALLOWANCE
from service.tables.order import order

_HEADS = (
    "#size, kg", "#pieces", "#centre of mass, m", "web", "#from its crank, deg", "#as drawn, deg", "#+- kg", "#+- deg",
)  # fmt: skip
_WORDS = (
    "Equal castings stand together, the heaviest first. All of them together may be off by these tolerances, masses or"
    f" angles alone. That costs at most {ALLOWANCE:.0%} of the objective without counterweights."
)


def workshop_order(machine: Machine, answer: OptimizeAnswer) -> Iterator[Chapter]:
    """Of choices from a catalogue, which are what a workshop has or casts."""
    if machine.discrete:
        yield from order_chapter(answer)


def order_chapter(answer: OptimizeAnswer) -> Iterator[Chapter]:
    """The table, where there is anything to order."""
    cells: list[tuple[Cell | float | None, ...]] = [
        (size, Number(quantity, str(quantity)), *rest)
        for size, quantity, *rest in order(answer)
        if isinstance(quantity, int)
    ]
    if cells:
        yield Chapter("Order for the workshop", (Paragraph(_WORDS), table("", _HEADS, cells)))
