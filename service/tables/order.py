"""The order for a workshop: sizes with how many of each, where they go, and how far each may be off."""

from itertools import groupby

from optimizer.errors import OutOfRange
from schemas.answer.answers import OptimizeAnswer
from schemas.answer.counterweights import Counterweight, every_counterweight
from schemas.base.model import FieldProblem
from service.tables.as_built import tolerance
from service.tables.lines import Cell, Lines

HEADS = (
    "size, kg", "of this size", "radius of the centre of mass, m", "web", "angle from its crank, deg",
    "angle as drawn, deg", "tolerance, +- kg", "tolerance, +- deg",
)  # fmt: skip
#: masses that agree this closely, relative, are one size
_SAME = 1e-9


def order(answer: OptimizeAnswer) -> list[list[Cell]]:
    """A line for each piece that is to be made for any shaft, the heaviest first; equal ones stand together."""
    every = [piece for piece in every_counterweight(answer) if piece.mass_kg > 0 and not piece.fixed]
    sizes = _Sizes()
    every.sort(key=lambda piece: (-piece.mass_kg, piece.radius_m))
    rows: list[list[Cell]] = []
    allowed = tolerance(answer)
    for (mass, radius), equal in groupby(every, key=sizes.of):
        pieces = list(equal)
        off = None if allowed.share is None else allowed.share * mass
        for piece in pieces:
            angles = (piece.angle_from_crank_deg, piece.angle_deg)
            rows.append([mass, len(pieces), radius, piece.web, *angles, off, allowed.angle_deg])
    return rows


def required(answer: OptimizeAnswer) -> Lines:
    """Headings and lines.

    Raises
    ------
    OutOfRange
        if there is nothing to be made.
    """
    lines = order(answer)
    if not lines:
        raise OutOfRange([FieldProblem(("machine", "webs"), "there is nothing to order: no counterweight is chosen")])
    return [[*HEADS], *lines]


class _Sizes:
    """Which size a counterweight has: the last one that it equals, of those in falling order."""

    def __init__(self) -> None:
        self._last = (0.0, 0.0)

    def of(self, piece: Counterweight) -> tuple[float, float]:
        mass, radius = self._last
        if abs(piece.mass_kg - mass) > _SAME * piece.mass_kg or piece.radius_m != radius:
            self._last = (piece.mass_kg, piece.radius_m)
        return self._last
