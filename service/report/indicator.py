"""Indicator diagrams: pressure in the chambers over the travel of the piston, as an indicator draws them."""

from collections.abc import Iterator

from schemas.answer.dynamics import Chamber, Gas, RowGas
from schemas.machine.machine import Machine
from service.drawings.svg import Drawing
from service.report.chapters.inputs import row_name
from service.report.charts import Line, chart

#: rows that are drawn; of more the first ones
MAX_ROWS = 8


def indicators(machine: Machine, gas: Gas) -> Iterator[Drawing]:
    """A diagram of each row: every chamber runs round a loop whose area is its work in a turn, but for its area."""
    for row in gas.rows[:MAX_ROWS]:
        if not row.chambers:
            continue
        name = row_name(machine, row.throw, row.row)
        lines = [
            Line(chamber_name(row, chamber), [*chamber.pressure_Pa, chamber.pressure_Pa[0]]) for chamber in row.chambers
        ]
        travel = [*row.displacement_m, row.displacement_m[0]]
        yield chart(f"row {name}: pressure", "Pa", "travel from the outer dead centre, m", travel, lines)


def chamber_name(row: RowGas, chamber: Chamber) -> str:
    """Side, and which cylinder where a row has several."""
    if len(row.chambers) <= 2:
        return chamber.side
    return f"{chamber.name or f'cylinder {chamber.cylinder + 1}'}, {chamber.side}"
