"""The report follows the answer: each figure stands where its name says, and nothing else moves with it.

follows.txt lists for every kind of leaf of the answer the places of the report that change with it
(``python -m tests.report_document.follow`` writes it; regression). What its labels say of quantity, sense, side and
unit is compared with the name of the leaf, independently of how the table was made.
"""

import io
import json
import random
import re
from html.parser import HTMLParser

import openpyxl
import pytest
from rich.console import Console

from schemas.answer.answers import OptimizeAnswer
from service.common.figures import typeset
from service.report.blocks import Document, Number, Table
from service.report.html import html
from service.report.terminal import terminal
from service.workbook.answers import answered
from tests.night import ALL
from tests.report_document.follow import (
    NOWHERE,
    answer,
    places,
    rendered,
    request,
    stored,
    subject,
)

FOLLOWS = stored()
#: every day one of so many, and those that once were printed in the place of others
_STEP = 6 if ALL else 12
_ALWAYS = {
    "gas.rows[].chambers[].pressure_Pa[] above",
    "gas.rows[].chambers[].pressure_Pa[] below",
    "kinematics.rows[].velocity_m_s[] above",
    "kinematics.rows[].acceleration_m_s2[] above",
    "counterweights[].mass_kg",
    "counterweights[].angle_deg",
    "counterweights[].angle_from_crank_deg",
}
_DAILY = _ALWAYS | set(sorted(FOLLOWS)[::_STEP])


@pytest.mark.parametrize(
    "name", [name if name in _DAILY else pytest.param(name, marks=pytest.mark.nightly) for name in FOLLOWS]
)
def test_the_report_changes_where_a_figure_stands_and_nowhere_else(name: str) -> None:
    (change,) = (variant for variant in subject().changes if variant.name == name)
    assert subject().follows(change) == FOLLOWS[name]


def test_every_figure_stands_in_its_place_when_all_are_changed_at_once() -> None:
    """What is shown itself; what follows from several has no number of its own."""
    numbers, value = subject().changed_together()
    actual_places = places(rendered(value).chapters)
    actual_numbers = {place[2:]: numbers[name] for name in numbers for place in FOLLOWS[name] if place.startswith("= ")}
    assert len(actual_numbers) > 130
    assert {place: actual_places.get(place) for place in actual_numbers} == actual_numbers


def test_every_kind_of_figure_of_the_answer_is_in_the_table() -> None:
    assert [change.name for change in subject().changes] == list(FOLLOWS)


#: in the name of a leaf, and in every label that shows it
SENTENCES = {
    r"_Nm\b": r"N m\b|couple|moment|objective",
    r"_N\b": r"\bN\b|value|remaining|gas|inertia|friction|sum|side|tangential|radial|largest|smallest",
    r"_Pa\b": r"\bPa\b",
    r"_kg_m2\b": r"kg m(?:2|²)",
    r"_kg_m\b": r"kg m\b",
    r"_kg\b": r"\bkg\b|relative to",
    r"(?<!per)_deg\b": r"\bdeg\b",
    r"_m_s2\b": r"acceleration, m/s2",
    r"_m_s\b": r"velocity, m/s\b",
    r"displacement_m\b": r"displacement, m\b",
    r" above$": r"largest|highest",
    r" below$": r"smallest|lowest",
    r"\bbefore\b": r"without|before|as listed|floor|peak force, N$|peak moment, N m$",
    r"\bafter\b": r"with |rms with,|after|as matched",
    r"tension": r"tension",
    r"compression": r"compression",
    r"peak_x|along_x": r"along x|x forces",
    r"peak_y|along_y": r"along y|y forces",
    r"\.co_rotating": r"with the shaft",
    r"counter_rotating": r"against the shaft",
    r"outer_dead_centre": r"outer dead centre",
    r"inner_dead_centre": r"inner dead centre",
    r"angle_from_crank": r"from its crank",
    r"suction": r"suction",
    r"discharge": r"discharge",
    r"\bfloor": r"floor",
    r"minor": r"smallest",
    r"\brms": r"rms",
    r"lower_bound": r"lower bound|no \w+ has an objective below|certified not below|proven at least",
    r"\bgap": r"gap",
}


def test_labels_say_what_the_names_of_the_leaves_say() -> None:
    labels = [
        (name, place[2:].rstrip("'")) for name, where in FOLLOWS.items() for place in where if place.startswith("= ")
    ]
    values = [(text, name, label) for name, label in labels for text in SENTENCES if re.search(text, name)]
    assert len(values) > 150
    assert [(name, label) for text, name, label in values if not re.search(SENTENCES[text], label)] == []


def test_fields_in_each_other_s_place_are_noticed() -> None:
    """A chapter that takes one field for another changes where the table says that the other stands."""
    labels = [name for name, where in FOLLOWS.items() if where != [NOWHERE]]
    chance = random.Random(20261125)
    swaps = [chance.sample(labels, 2) for _ in range(100)]
    assert sum(FOLLOWS[first] != FOLLOWS[second] for first, second in swaps) >= 98
    # nearer by, where it happens: fields of one table
    siblings: dict[str, list[str]] = {}
    for name in labels:
        if any(place.startswith("= ") for place in FOLLOWS[name]):
            siblings.setdefault(re.split(r"\.\w+(?:\[\])?(?: \w+)?$", name)[0], []).append(name)
    alike = [
        (first_name, second_name)
        for names in siblings.values()
        for place, first_name in enumerate(names)
        for second_name in names[place + 1 :]
        if FOLLOWS[first_name] == FOLLOWS[second_name]
    ]
    assert alike == []


def exchanged(optimum: OptimizeAnswer, first: str, second: str) -> OptimizeAnswer:
    """The answer with two series of the motion in each other's place."""
    body = optimum.model_dump()
    for row in body["kinematics"]["rows"]:
        row[first], row[second] = row[second], row[first]
    return OptimizeAnswer.model_validate(body)


def test_velocity_is_not_shown_as_acceleration() -> None:
    wrong = places(rendered(exchanged(answer(), "velocity_m_s", "acceleration_m_s2")).chapters)
    right = subject().unchanged
    for label in ("I: velocity, m/s | largest", "II: acceleration, m/s2 | smallest"):
        place = f"Motion | Extremes among the samples | {label}"
        assert right[place] != wrong[place]


def workbook_cells(optimum: OptimizeAnswer) -> dict[tuple[str, int, int], object]:
    """Every cell of the workbook on an answer."""
    book = openpyxl.load_workbook(io.BytesIO(answered(request().alone, optimum)), read_only=True)
    return {
        (sheet.title, line, place): value
        for sheet in book.worksheets
        for line, row in enumerate(sheet.iter_rows(values_only=True))
        for place, value in enumerate(row)
        if value is not None
    }


@pytest.mark.parametrize(
    "name",
    [
        "gas.rows[].chambers[].pressure_Pa[] above",
        "counterweights[].mass_kg",
        "residual.after.force.peak_N",
        "certificate.lower_bound",
        *(
            pytest.param(name, marks=pytest.mark.nightly)
            for name in sorted(FOLLOWS)[::_STEP]
            if "foundation" not in name
        ),
    ],
)
def test_the_workbook_changes_in_the_cell_of_the_figure(name: str) -> None:
    (change,) = (variant for variant in subject().changes if variant.name == name)
    _, new, number = subject().changed(change)
    before, after = workbook_cells(answer()), workbook_cells(number)
    ((place, value),) = ((place, value) for place, value in after.items() if before.get(place) != value)
    # a series stands in one cell, as JSON
    assert _holds(json.loads(value) if isinstance(value, str) else value, new)
    line = [text for (sheet, row, _), text in after.items() if (sheet, row) == place[:2]]
    heads = [text for (sheet, row, _), text in after.items() if (sheet, row) == (place[0], 0)]
    assert any(str(step) in str(text) for step in change.path if isinstance(step, str) for text in (*line, *heads))


def _holds(record: object, number: float) -> bool:
    """Whether a number stands in a value read from JSON."""
    if isinstance(record, dict):
        return any(_holds(single_record, number) for single_record in record.values())
    if isinstance(record, list):
        return any(_holds(value, number) for value in record)
    return record == pytest.approx(number, rel=1e-15)


def test_the_terminal_writes_every_figure_of_the_tables_in_their_order() -> None:
    document = rendered(answer())
    console = Console(width=600, record=True, file=io.StringIO())
    console.print(terminal(document.chapters))
    text = console.export_text()
    place = 0
    for cell in figures(document):
        count = text.find(cell.text, place)
        assert count >= 0, cell
        place = count + len(cell.text)


def figures(document: Document) -> list[Number]:
    """Every figure of the tables, in order."""
    blocks = (block for chapter in document.chapters for block in chapter.blocks if isinstance(block, Table))
    return [cell for block in blocks for row in block.rows for cell in row if isinstance(cell, Number)]


class _Cells(HTMLParser):
    """Texts of the cells of tables, in order."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.cells: list[str] = []
        self._inside = False
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: object) -> None:
        if tag in ("td", "th"):
            self._inside = True
            self.cells.append("")

    def handle_endtag(self, tag: str) -> None:
        if tag in ("td", "th"):
            self._inside = False

    def handle_data(self, data: str) -> None:
        if self._inside:
            self.cells[-1] += data


def test_the_page_writes_every_figure_of_the_tables_in_their_order() -> None:
    document = rendered(answer())
    texts = [typeset(cell.text) for cell in figures(document)]
    cells = iter(cell.strip() for cell in _Cells(html(document).decode()).cells)
    assert len(texts) > 400
    # `in` goes on with the iterator: one after the other
    assert [text for text in texts if text not in cells] == []
