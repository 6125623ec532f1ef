"""Loads on the foundation, order by order."""

from collections.abc import Iterator, Mapping, Sequence

from schemas.answer.foundation import OrderOfFoundation
from service.report.blocks import Block, Cell, Chapter, Number, Paragraph, Table, figure_beside, prose, table
from service.tables.foundation import oscillation, sets

#: a load below this share of the largest of its kind stands in a sentence, not in a line
_SMALL = 1e-3
_KILO = 1e3
_FORCES = {"force_x": "along x", "force_y": "along y"}
#: as API 618 names them
_COUPLES = {"couple_of_x_forces": "horizontal", "couple_of_y_forces": "vertical"}
#: of a heading, as a column has room for it
_SHORT = {"without counterweights": "before", "with counterweights": "after"}

Row = tuple[int, str, tuple[tuple[float, float] | None, ...]]


def foundation_loads(loads: Sequence[OrderOfFoundation]) -> Chapter:
    """A table of forces and one of couples; loads that are small or nothing are named in a sentence."""
    words = (
        "The load is A cos(k psi - phase): k the order, psi the angle of the shaft in its sense of rotation since the "
        f"outer dead centre of throw 1, first row (shaft angle {loads[0].dead_centre_deg:g} deg). Forces act on the "
        "frame. Couples are sums of force times distance from the reference plane. As in API 618 that of the x forces "
        "is the horizontal couple, which turns about y, and that of the y forces the vertical one, which turns about x."
    )
    forces, couples = _tables(loads, _FORCES, "Forces", "N"), _tables(loads, _COUPLES, "Couples", "N m")
    return Chapter("Loads on the foundation", (*forces, *couples, Paragraph(words)))


def _tables(loads: Sequence[OrderOfFoundation], names: Mapping[str, str], kind: str, unit: str) -> Iterator[Block]:
    """The loads of one kind, and a sentence on those that are left out."""
    headings = sets(loads)
    rows: list[Row] = [
        (order.order, words, tuple(oscillation(getattr(order, when), name) for when in headings))
        for order in loads
        for name, words in names.items()
    ]
    largest = max(map(_largest, rows))
    entries = [row for row in rows if _largest(row) > _SMALL * largest]
    if entries:
        yield _table(kind, unit, list(headings.values()), entries, largest)
    rest = [row for row in rows if row not in entries]
    if rest:
        yield Paragraph(_left_out(kind, unit, rest, bool(entries)))


def _largest(row: Row) -> float:
    return max((entry[0] for entry in row[2] if entry is not None), default=0.0)


def _left_out(kind: str, unit: str, rest: Sequence[Row], has_entries: bool) -> str:
    most = max(map(_largest, rest))
    subject = f"{kind} of the orders asked for" if not has_entries else f"{kind} that are not listed"
    return f"{subject} are 0." if most == 0.0 else f"{subject} are at most {prose(most)} {unit}."


def _table(kind: str, unit: str, headings: Sequence[str], rows: Sequence[Row], scale: float) -> Table:
    heads = ["order", kind.lower().removesuffix("s")]
    for words in headings:
        heads += [f"#{_SHORT.get(words, words)}, {unit}", f"#k{unit}", "#phase, deg"]
    return table(kind, heads, [(str(order), words, *_cells(parts, scale)) for order, words, parts in rows])


def _cells(parts: Sequence[tuple[float, float] | None], scale: float) -> Iterator[Cell | float | None]:
    """Amplitude in both units and phase; what rounding leaves beside the scale is 0, and its phase is none."""
    for part in parts:
        if part is None:
            yield from (None, None, None)
            continue
        amplitude = figure_beside(part[0], scale)
        still = isinstance(amplitude, Number) and amplitude.text == "0"
        yield from (amplitude, figure_beside(part[0] / _KILO, scale / _KILO), None if still else part[1])
