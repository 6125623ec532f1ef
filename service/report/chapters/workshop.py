"""What a workshop makes: the sheets of the counterweights that are cut from plates."""

from collections.abc import Iterator

from schemas.answer.answers import OptimizeAnswer
from schemas.machine.machine import Machine
from service.drawings.parts import parts
from service.drawings.sheet import sheet
from service.report.blocks import Chapter, Figure
from service.tables.as_built import AsBuilt


def sheets(machine: Machine, answer: OptimizeAnswer, built: AsBuilt | None) -> Iterator[Chapter]:
    """A sheet for each part number, where there are plates; the same as `/v1/drawings` has."""
    every = answer.counterweights if built is None else built.counterweights
    result = parts(machine, (counterweight for counterweight in every if counterweight.mass_kg > 0))
    if result:
        yield Chapter(
            "Workshop sheets", tuple(Figure((sheet(part, built),), _caption(len(part.places))) for part in result)
        )


def _caption(pieces: int) -> str:
    return "As seen along the shaft, and from the side." if pieces == 1 else f"{pieces} pieces of one outline."
