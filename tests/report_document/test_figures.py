"""Figures in tables of chapters: whose they are, and how they are written."""

import json
from types import SimpleNamespace
from typing import Any

from optimizer.optimize import optimize
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import OptimizeRequest
from service.documents.examples import load
from service.report.blocks import Number, Paragraph, Table, figure_beside
from service.report.chapters.balance_quality import balance_quality
from service.report.chapters.built import _cells
from service.report.chapters.inputs import _reciprocating
from service.report.chapters.loads import loads
from service.tables.as_built import HEADS
from tests.optimize.machines import machine, row, throw, web


def _plain(cell: Any) -> Any:
    return cell.value if isinstance(cell, Number) else cell


def _grading(grade: float) -> Any:
    planes = [
        SimpleNamespace(position_m=0.1, permissible_kg_m=1e-3, unbalance_kg_m=part * grade, angle_deg=10.0)
        for part in (1.0, 2.0)
    ]
    return SimpleNamespace(grade_mm_s=grade, plane_a=planes[0], plane_b=planes[1])


def test_a_grade_is_that_with_counterweights_or_without() -> None:
    machine: Any = SimpleNamespace(balance_quality=SimpleNamespace(grade_mm_s=6.3))
    answer: Any = SimpleNamespace(balance_quality=SimpleNamespace(before=_grading(40.0), after=_grading(5.0)))
    (chapter,) = balance_quality(machine, answer)
    words, paragraph = chapter.blocks
    assert isinstance(words, Paragraph)
    assert "Reached: without counterweights G 40 mm/s; with counterweights G 5 mm/s." in words.text
    assert isinstance(paragraph, Table)
    assert [_plain(line[4]) for line in paragraph.rows] == [40.0, 80.0, 5.0, 10.0]


def test_a_row_stands_beside_its_throw_by_its_offset() -> None:
    throws = [throw(-0.3, 0.0, [row(0.0, 1.0, offset_m=0.02), row(90.0, 1.0, offset_m=-0.02)])]
    design = ReciprocatingMachine.model_validate(machine(throws, [web("a", 0.0, 4.0)]))
    (rows,) = (block for block in _reciprocating(design) if isinstance(block, Table) and block.title == "Rows")
    assert [round(_plain(line[2]), 12) for line in rows.rows] == [-0.28, -0.32]


def test_a_tolerance_alone_is_written_as_one() -> None:
    pair: Any = SimpleNamespace(web="a", built=None, optimum=None)
    cells: list[Any] = [1.0] * len(HEADS)
    written = [cell.text for cell in list(_cells(pair, cells))[3:] if isinstance(cell, Number)]
    assert written == ["±1"] * sum(head.startswith("tolerance") for head in HEADS[1:])


def test_nothing_is_not_below_a_gap() -> None:
    texts = [
        cell.text
        for cell in (figure_beside(figure, 0.0, 0.5) for figure in (0.1, 0.0, 0.5))
        if isinstance(cell, Number)
    ]
    assert [text.startswith("<") for text in texts] == [True, False, False]


def test_cylinders_are_counted_from_1() -> None:
    request = OptimizeRequest.model_validate(json.loads(load("2d12")) | {"outputs": ["loads"]})
    forces = optimize(request).loads
    assert forces is not None
    assert isinstance(request.machine, ReciprocatingMachine)
    tables = [block for block in loads(request.machine, forces).blocks if isinstance(block, Table)]
    (covers,) = (block for block in tables if any("cylinder" in column.title for column in block.columns))
    numbers = [cover.cylinder for row in forces.rows for cover in row.covers]
    assert min(numbers) == 0
    assert [_plain(line[1]) for line in covers.rows] == [number + 1 for number in numbers]
