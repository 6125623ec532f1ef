"""docs/accuracy.md names the methods of today, and its errors are those of today; times are not looked at."""

import re
import sys
from functools import cache
from pathlib import Path

import pytest

from optimizer.mechanics.layout import layout
from optimizer.studies.accuracy.measure import accuracy
from optimizer.studies.accuracy.peaks import peaks_ladder
from schemas.request.accuracy import AccuracyAnswer
from service.report.chapters.accuracy import method_name
from tests.night import at_night, but
from tests.studies.accuracy.problems import request

DOCS = Path(__file__).parents[3] / "docs"
TEXT = (DOCS / "accuracy.md").read_text()
#: regression: errors agree to this factor, and below this size they are rounding
FACTOR, NOISE = 2.0, 1e-8
#: of each ladder there is one by day, which takes seconds
DAILY = ("2d12",)


def rows(mark: str) -> list[list[str]]:
    """Cells of a table of the document, without its heading."""
    block = re.search(rf"<!-- {mark} -->\n(.*?)\n<!-- end -->", TEXT, re.DOTALL)
    assert block is not None
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in block[1].splitlines()[2:]]


def names(kind: str) -> list[str]:
    return re.findall(rf"<!-- {kind} (\S+) -->", TEXT)


def agrees(text: str, number: float | None) -> bool:
    if text == "-" or number is None:
        return (text == "-") == (number is None)
    value = float(text)
    return max(value, number) < NOISE or 1.0 / FACTOR <= value / max(number, 1e-300) <= FACTOR


@cache
def answer(name: str) -> AccuracyAnswer:
    return accuracy(request(name))


def test_there_are_tables_of_a_row_a_compressor_and_a_v_engine() -> None:
    assert {"single-horizontal", "2d12", "v8-cross-plane"} <= set(names("ladder"))
    assert set(names("effects")) <= set(names("ladder"))


@pytest.mark.parametrize("name", but(DAILY, names("ladder")))
def test_ladders_are_reproduced(name: str) -> None:
    ladder, lines = answer(name).ladder, rows(f"ladder {name}")
    assert [cells[:2] for cells in lines] == [[method_name(row.method), row.setting] for row in ladder]
    for cells, row in zip(lines, ladder, strict=True):
        for cell, value in zip(cells[4:7], (row.relative_error, row.as_drawn_error, row.certified_gap), strict=True):
            assert agrees(cell, value), (cells, value)


GOALS: dict[str, dict[str, object]] = {
    "2d12": {"orders": "all"},
    "inline-four-engine": {"bearing_weight": 1.0, "force_weight": 0.0, "moment_weight": 0.0},
}


@at_night
@pytest.mark.parametrize("name", names("revolution"))
def test_ladders_over_a_revolution_are_reproduced(name: str) -> None:
    ladder = [row for row in accuracy(request(name, **GOALS[name])).ladder if row.skipped is None]
    lines = rows(f"revolution {name}")
    assert [cells[:2] for cells in lines] == [[method_name(row.method), row.setting] for row in ladder]
    for cells, row in zip(lines, ladder, strict=True):
        for cell, value in zip(cells[2:5], (row.relative_error, row.as_drawn_error, row.certified_gap), strict=True):
            assert agrees(cell, value), (cells, value)
        assert row.claim_error is not None
        assert agrees(cells[5].removeprefix("-"), abs(row.claim_error)), (cells, row.claim_error)


@pytest.mark.parametrize("name", but(DAILY, names("effects")))
def test_effects_are_reproduced(name: str) -> None:
    effects_ladder, lines = answer(name).effects_ladder, rows(f"effects {name}")
    assert [cells[:3] for cells in lines] == [
        [row.quantity.replace("_", " "), method_name(row.method), row.setting] for row in effects_ladder
    ]
    for cells, row in zip(lines, effects_ladder, strict=True):
        assert agrees(cells[4], row.relative_error), (cells, row.relative_error)


@pytest.mark.parametrize("name", names("peaks"))
def test_peaks_are_reproduced(name: str) -> None:
    machine = request(name).machine
    ladder, lines = peaks_ladder(machine, layout(machine), 1), rows(f"peaks {name}")
    assert [[*cells[:2], cells[2]] for cells in lines] == [
        [row.quantity.removeprefix("peak_").replace("_", " "), method_name(row.method), row.setting] for row in ladder
    ]
    for cells, row in zip(lines, ladder, strict=True):
        assert cells[3] == ("-" if row.angles is None else str(row.angles))
        assert agrees(cells[5], row.relative_error), (cells, row.relative_error)
        assert agrees(cells[6], row.certified_gap), (cells, row.certified_gap)


def test_a_wrong_figure_would_be_found() -> None:
    assert agrees("2.0e-03", 2.1e-3)
    assert not agrees("2.0e-03", 2.1e-2)
    assert not agrees("2.0e-03", 1e-15)
    assert not agrees("-", 1e-3)
    assert agrees("-", None)


def test_conclusions_are_what_the_tables_say(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every figure in them is read from the tables, so that neither can change alone."""
    monkeypatch.setattr(sys, "path", [str(DOCS), *sys.path])
    from accuracy_pictures import conclude

    assert conclude(TEXT) == TEXT
    changed = TEXT.replace("| 720 angles | ", "| 720 angles | 9", 1)
    assert conclude(changed) != changed


@pytest.mark.parametrize("name", names("ladder"))
def test_every_ladder_has_its_picture(name: str) -> None:
    picture = DOCS / f"accuracy-{name}.svg"
    assert f"(accuracy-{name}.svg)" in TEXT
    assert picture.read_text().count("<svg") == 1
