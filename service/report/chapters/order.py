"""The order for a workshop, where counterweights come in sizes."""

from collections.abc import Iterator

from schemas.answer.answers import OptimizeAnswer
from schemas.machine.machine import Machine
from service.report.blocks import Cell, Chapter, Number, Paragraph, table
from service.tables.as_built import ALLOWANCE
from service.tables.order import order

_HEADS = (
    "#size, kg", "#of this size", "#centre of mass, m", "web", "#from its crank, deg", "#as drawn, deg", "#+- kg",
    "#+- deg",
)  # fmt: skip
_WORDS = (
    "Equal castings stand together, the heaviest first. All of them together may be off by these tolerances, masses or"
    f" angles alone. That costs at most {ALLOWANCE * 100:g} % of the objective without counterweights."
)


def workshop_order(machine: Machine, answer: OptimizeAnswer) -> Iterator[Chapter]:
    """Of choices from a catalogue, which are what a workshop has or casts."""
    if machine.discrete:
        yield from order_chapter(answer)


def order_chapter(answer: OptimizeAnswer) -> Iterator[Chapter]:
    """The table, where there is anything to order."""
    rows: list[list[Cell | float | None]] = [
        [Number(cell, str(cell)) if isinstance(cell, int) else cell for cell in line] for line in order(answer)
    ]
    if rows:
        yield Chapter("Order for the workshop", (Paragraph(_WORDS), table("", _HEADS, rows)))
