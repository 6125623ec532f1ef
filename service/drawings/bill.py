"""The bill of material: a row for each counterweight, as CSV and as a workbook."""

import csv
import io
from collections.abc import Iterator

from schemas.answer.counterweights import Counterweight
from service.common.plain import inert, plain
from service.drawings.drawing_set import DrawingSet
from service.drawings.parts import Part
from service.tables.as_built import HEADS as BUILT_HEADS
from service.tables.as_built import line

HEADS = (
    "part", "pieces", "web", "mass, kg", "plane z, mm", "angle as drawn, deg", "angle from its crank, deg",
    "centre of mass, mm", "mass times radius, kg m", "to hold, N", "outline", "inner radius, mm", "outer radius, mm",
    "thickness, mm", "half of the opening, deg", "chord from the shaft, mm", "density, kg/m3", "drawing",
)  # fmt: skip
_WEB = HEADS.index("web")

Cell = str | float | int | bool | None


def heads(drawings: DrawingSet) -> tuple[str, ...]:
    """Of the columns; what is built stands beside the optimum."""
    return HEADS if drawings.built is None else (*HEADS, *BUILT_HEADS[1:])


def rows(drawings: DrawingSet) -> Iterator[tuple[Cell, ...]]:
    """The lines of the bill, each with what sets it beside the optimum where it is as built."""
    beside = (
        {}
        if drawings.built is None
        else {pair.web: line(pair, drawings.built.tolerance) for pair in drawings.built.pairs}
    )
    for row in _rows(drawings):
        yield *row, *(beside[str(row[_WEB])][1:] if beside else ())


def _rows(drawings: DrawingSet) -> Iterator[tuple[Cell, ...]]:
    """The counterweights that are drawn, part by part, then those without a plate."""
    for part in drawings.parts:
        for counterweight in part.places:
            yield part.number, len(part.places), *_placed(counterweight), *_shape(part, counterweight), part.name
    plate_webs = {place.web for part in drawings.parts for place in part.places}
    for counterweight in drawings.fitted:
        if counterweight.web not in plate_webs:
            yield None, 1, *_placed(counterweight), *(None,) * 7, "none: the web has no envelope"


def _placed(weight: Counterweight) -> tuple[Cell, ...]:
    return (
        weight.web, weight.mass_kg, 1e3 * weight.position_m, weight.angle_deg, weight.angle_from_crank_deg,
        1e3 * weight.radius_m, weight.mass_radius_kg_m, weight.centrifugal_force_N,
    )  # fmt: skip


def _shape(part: Part, counterweight: Counterweight) -> tuple[Cell, ...]:
    envelope, shape = part.envelope, counterweight.shape
    height = None if shape is None or shape.chord_height_m is None else 1e3 * shape.chord_height_m
    return (
        envelope.shape, 1e3 * envelope.inner_radius_m, 1e3 * envelope.outer_radius_m, 1e3 * envelope.thickness_m,
        None if shape is None else shape.half_angle_deg, height, envelope.density_kg_m3,
    )  # fmt: skip


def as_csv(drawings: DrawingSet) -> bytes:
    """In UTF-8; a text that a spreadsheet would run stays text."""
    out = io.StringIO(newline="")
    writer = csv.writer(out, lineterminator="\r\n")
    writer.writerow(heads(drawings))
    for row in rows(drawings):
        writer.writerow([inert(plain(cell)) if isinstance(cell, str) else cell for cell in row])
    return out.getvalue().encode()


def as_workbook(drawings: DrawingSet) -> bytes:
    """As xlsx."""
    # only who asks for drawings pays for the library
    from openpyxl import Workbook
    from openpyxl.cell import WriteOnlyCell

    book = Workbook(write_only=True)
    sheet = book.create_sheet("bill of material")
    sheet.append(heads(drawings))
    for row in rows(drawings):
        cells = []
        for value in row:
            cell = WriteOnlyCell(sheet, plain(value) if isinstance(value, str) else value)
            if isinstance(value, str):
                # never a formula
                cell.data_type = "s"
            cells.append(cell)
        sheet.append(cells)
    out = io.BytesIO()
    book.save(out)
    return out.getvalue()
