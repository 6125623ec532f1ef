"""Loads on the foundation, order by order."""

from collections.abc import Sequence

from schemas.answer.foundation import FoundationLoad, OrderOfFoundation
from service.report.blocks import Cell, Chapter, Paragraph, Table, table

_SETS = {"before": "without counterweights", "after": "with counterweights", "as_built": "as built"}
#: what is told in N, and what in N m
_FORCES = {"force_x": "force along x", "force_y": "force along y"}
_COUPLES = {"couple_of_x_forces": "couple of the x forces", "couple_of_y_forces": "couple of the y forces"}


def foundation_loads(found: Sequence[OrderOfFoundation]) -> Chapter:
    """A table of forces and one of couples; orders that load nothing are named in a sentence."""
    sets = [name for name in _SETS if any(getattr(one, name) is not None for one in found)]
    still = [one for one in found if all(_still(getattr(one, name)) for name in sets)]
    shown = [one for one in found if one not in still]
    words = [
        f"The load is A cos(k psi - phase): k the order, psi the angle of the shaft in its sense of rotation since the "
        f"outer dead centre of throw 1, first row (shaft angle {found[0].dead_centre_deg:g} deg). Forces act on the "
        "frame. Couples are sums of force times distance from the reference plane; that of the x forces turns about y.",
    ]
    if still:
        words.append(f"Nothing of order {', '.join(str(one.order) for one in still)} loads the foundation.")
    tables = [
        _table(title, unit, names, shown, sets)
        for title, unit, names in (("Forces", "N", _FORCES), ("Couples", "N m", _COUPLES))
    ]
    return Chapter("Loads on the foundation", (*map(Paragraph, words), *(tables if shown else ())))


def _table(
    title: str, unit: str, names: dict[str, str], found: Sequence[OrderOfFoundation], sets: Sequence[str]
) -> Table:
    heads = ["order", "load", *(head for name in sets for head in (f"#{_SETS[name]}, {unit}", "#phase, deg"))]
    rows = []
    for one in found:
        for name, words in names.items():
            cells: list[Cell | float | None] = []
            for of_set in sets:
                load = getattr(one, of_set)
                part = None if load is None else getattr(load, name)
                cells += [
                    None if part is None else getattr(part, f"amplitude_{unit.replace(' ', '')}"),
                    None if part is None else part.phase_deg,
                ]
            rows.append((str(one.order), words, *cells))
    return table(title, heads, rows)


def _still(load: FoundationLoad | None) -> bool:
    """Whether all amplitudes of an order are 0."""
    if load is None:
        return True
    forces, couples = (load.force_x, load.force_y), (load.couple_of_x_forces, load.couple_of_y_forces)
    return all(one.amplitude_N == 0 for one in forces) and all(one.amplitude_Nm == 0 for one in couples)
