"""Loads on the foundation as a table: a line for each load of each order, in N and kN."""

from collections.abc import Iterator, Sequence

from schemas.answer.foundation import FoundationLoad, OrderOfFoundation
from service.tables.lines import Cell, Lines

#: loads in the words of API 618, which has x level and y upright
FORCES = {"force_x": "force along x", "force_y": "force along y"}
COUPLES = {
    "couple_of_x_forces": "horizontal couple",
    "couple_of_y_forces": "vertical couple",
}
_LOADS = {**FORCES, **COUPLES}
_KILO = 1e3


def sets(loads: Sequence[OrderOfFoundation]) -> dict[str, str]:
    """The sets of counterweights with loads: the field of each, and its heading."""
    built = any(load.as_built is not None for load in loads)
    names = {"before": "without counterweights", "after": "optimum" if built else "with counterweights"}
    headings = {**names, "as_built": "as built"}
    return {name: words for name, words in headings.items() if any(getattr(load, name) is not None for load in loads)}


def oscillation(load: FoundationLoad | None, name: str) -> tuple[float, float] | None:
    """Amplitude [N or N m] and phase [deg] of one load of a set; None where the set has none."""
    if load is None:
        return None
    part = getattr(load, name)
    return (part.amplitude_N if name in FORCES else part.amplitude_Nm), part.phase_deg


def lines(loads: Sequence[OrderOfFoundation]) -> Lines:
    """The headings, and a line for each load of each order."""
    headings = sets(loads)
    heads = ["order", "load"]
    for words in headings.values():
        heads += [f"{words}, N or N m", f"{words}, kN or kN m", f"{words}, phase, deg"]
    return [
        [*heads, "phases count from shaft angle, deg"],
        *(_line(order, name, list(headings)) for order, name in _pairs(loads)),
    ]


def _pairs(loads: Sequence[OrderOfFoundation]) -> Iterator[tuple[OrderOfFoundation, str]]:
    for order in loads:
        for name in _LOADS:
            yield order, name


def _line(order: OrderOfFoundation, name: str, fields: Sequence[str]) -> list[Cell]:
    cells: list[Cell] = [order.order, _LOADS[name]]
    for when in fields:
        load = oscillation(getattr(order, when), name)
        cells += [None] * 3 if load is None else [load[0], load[0] / _KILO, load[1]]
    return [*cells, order.dead_centre_deg]
