"""All drawings of a machine's counterweights in one file."""

import io
from collections.abc import Iterator
from math import pi, radians
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from schemas.answer.counterweights import Counterweight
from service.drawings.bill import as_csv, as_workbook
from service.drawings.drawing_set import DrawingSet
from service.drawings.dxf import dxf
from service.drawings.outline import Point, rotation
from service.drawings.parts import Part
from service.drawings.sheet import sheet
from service.drawings.step import Solid, step

_FONT = "Helvetica, Arial, sans-serif"


def zipped(drawings: DrawingSet) -> bytes:
    """A folder: of each part its outline, its sheet and its solid, all of them in their places, the bill of material.

    The same drawings are the same bytes, but for the workbook, which bears the time.
    """
    out = io.BytesIO()
    with ZipFile(out, "w") as archive:
        for name, content in files(drawings):
            archive.writestr(ZipInfo(name), content, ZIP_DEFLATED)
    return out.getvalue()


def files(drawings: DrawingSet) -> Iterator[tuple[str, bytes]]:
    """Names and contents."""
    for part in drawings.parts:
        yield f"{part.name}.dxf", dxf(part.outline)
        yield f"{part.name}.svg", sheet(part, drawings.built).svg(_FONT).encode()
        half = 0.5 * part.envelope.thickness_m
        yield f"{part.name}.step", step(part.name, [Solid(part.name, part.outline, -half, half)])
    yield "counterweights.step", step(drawings.title, list(_placed(drawings)))
    yield "bill-of-material.csv", as_csv(drawings)
    yield "bill-of-material.xlsx", as_workbook(drawings)


def _placed(drawings: DrawingSet) -> Iterator[Solid]:
    """Every counterweight where it sits at shaft angle 0, in the coordinates of the machine."""
    for part in drawings.parts:
        for place in part.places:
            yield _solid(part, place, drawings.axes.get(place.web, (0.0, 0.0)))


def _solid(part: Part, counterweight: Counterweight, axis: Point) -> Solid:
    half = 0.5 * part.envelope.thickness_m
    # drawn upwards, which is at a right angle
    edges = rotation(part.outline, radians(counterweight.angle_deg) - 0.5 * pi)
    low, high = counterweight.position_m - half, counterweight.position_m + half
    return Solid(f"Counterweight {counterweight.web}", edges, low, high, axis)
