"""Requests as cells and back."""

import io
import json
from pathlib import Path
from typing import Any

import openpyxl
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from schemas.base.model import FieldProblem
from schemas.request.requests import OptimizeRequest
from service.documents.examples import bodies
from service.documents.template import EMPTY, template
from service.workbook.files import workbook, workbook_sheets
from service.workbook.sheets import Misplaced, Sheets, read, request_sheets

TEXTS = st.text(st.characters(min_codepoint=32, max_codepoint=0x2FFF, exclude_categories=("Cs", "Cc")), min_size=1)
LEAVES = st.one_of(st.none(), st.booleans(), st.integers(-(10**6), 10**6), TEXTS)


@pytest.mark.parametrize("name", bodies())
def test_every_example_comes_back(name: str) -> None:
    body = bodies()[name]
    assert read(workbook_sheets(workbook(request_sheets(body)))).body == body


@given(st.dictionaries(st.sampled_from(["a", "b", "c"]), st.one_of(LEAVES, st.lists(LEAVES), st.just({}))))
def test_any_value_comes_back(objective: dict[str, Any]) -> None:
    body = {"machine": {"throws": [{"name": "x", "rows": []}]}, "objective": objective}
    # a throw without rows has no line among the rows; what is empty is said where it stands
    expected = {"machine": {"throws": [{"name": "x"}]}, "objective": objective}
    assert read(request_sheets(body)).body == expected


def test_text_that_looks_like_a_formula_stays_text() -> None:
    body = {"machine": {"name": "=1+1", "webs": [{"name": "@x"}, {"name": "-y"}]}}
    content = workbook(request_sheets(body))
    sheet = openpyxl.load_workbook(io.BytesIO(content))["webs"]
    assert [cell.data_type for cell in sheet["A"]] == ["s", "s", "s"]
    assert read(workbook_sheets(content)).body == body


def test_names_that_a_spreadsheet_made_numbers_of() -> None:
    sheets: Sheets = {"webs": [["name", "max_mass_kg"], [1, 60], [2.5, 60]]}
    assert [web["name"] for web in read(sheets).body["machine"]["webs"]] == ["1", "2.5"]


def test_where_a_field_stands_or_is_missing() -> None:
    content = read(request_sheets(bodies()["2d12"]))

    def where(*path: str | int) -> str:
        return content.where(FieldProblem(path, ""))

    assert where("machine", "webs", 2, "max_mass_kg") == "webs!D4"
    assert where("machine", "throws", 1, "rows", 0, "connecting_rod", "length_m") == "rows!E3"
    assert where("machine", "webs", 2, "sector", "centre_deg") == "webs, line 4: sector.centre_deg"
    assert where("machine", "speed_rpm") == "machine!B5"
    assert where("objective", "force_weight") == "machine: objective.force_weight"


@pytest.mark.parametrize(
    ("sheets", "text"),
    [
        ({"machines": [["field"]]}, "machines: no sheet of a machine"),
        ({"webs": [["name", None], ["a", 3]]}, "webs!B2: a value without a heading"),
        ({"webs": [["name", "name"], ["a", "b"]]}, "webs!B2: name is said twice"),
        ({"webs": [["sector", "sector.centre_deg"], ["null", 3]]}, "webs!B2: sector.centre_deg is said beside sector"),
        ({"webs": [["name"], ["[1"]]}, "webs!A2: no JSON"),
        ({"machine": [["field", "value"], [None, 3]]}, "machine!B2: a value without a field beside it"),
        ({"machine": [["field", "value"], ["machine", 3]], "webs": [["name"], ["a"]]}, "webs, line 2: the machine is"),
        ({"rows": [["throw"], [0]]}, "rows, line 2: throw: there are no throws"),
        ({"machine": [["f"], ["machine.webs", 3]], "webs": [["name"], ["a"]]}, "webs, line 2: the sheet machine says"),
        ({"machine": [["f"], ["machine.throws", 3]], "rows": [["throw"], [0]]}, "rows, line 2: the sheet machine"),
        ({"machine": [["f"], ["machine.throws", "[3]"]], "rows": [["throw"], [0]]}, "rows, line 2: its throw is"),
        ({"throws": [["rows"], [3]], "rows": [["throw"], [0]]}, "rows, line 2: its throw is no object"),
        (
            {"throws": [["name"], ["a"]], "rows": [["throw"], [1]]},
            "rows, line 2: throw: the name of its throw: a",
        ),
        ({"throws": [["name"], ["a"]], "rows": [["name"], ["b"]]}, "rows, line 2: throw: the name of its throw: a"),
        ({"throws": [["name"], ["a"]], "rows": [["throw"], ["{}"]]}, "rows, line 2: throw: the name of its throw: a"),
        ({"throws": [["name"], ["1"]], "rows": [["throw"], [True]]}, "rows, line 2: throw: the name of its throw: 1"),
        ({"throws": [["name"], ["a"]], "rows": [["throw"], [10**400]]}, "rows, line 2: throw: the name of its throw"),
        ({"throws": [["position_m"], [0]], "rows": [["throw"], [1]]}, "rows, line 2: throw: the number of its throw"),
        ({"throws": [["name"], ["a"], ["a"]], "rows": [["throw"], ["a"]]}, "rows, line 2: throw: the number of"),
    ],
)
def test_what_says_nothing_of_a_machine_is_named(sheets: Sheets, text: str) -> None:
    with pytest.raises(Misplaced) as refused:
        read(sheets)
    assert any(line.startswith(text) for line in refused.value.lines), refused.value.lines


def test_the_example_of_plates_comes_back() -> None:
    body = json.loads(Path("examples/drawings/2d12-plates.json").read_text())
    assert read(workbook_sheets(workbook(request_sheets(body)))).body == body


@pytest.mark.parametrize(
    ("names", "cells", "places"),
    [
        # names of a machine that counts its throws from 1, which a spreadsheet makes numbers of
        (("1", "2"), (1, 2), [0, 1]),
        (("drive end", "free end"), ("free end", "drive end"), [1, 0]),
        # workbooks of before hold numbers from 0
        (("1", "2"), (0, 1), [0, 1]),
        (("drive end", "free end"), (0, 1), [0, 1]),
        ((None, None), (0, 1), [0, 1]),
    ],
)
def test_rows_stand_on_throws_by_name(names: tuple[str | None, ...], cells: tuple[Any, ...], places: list[int]) -> None:
    throws = [["name", "position_m"], *([name, 0] for name in names)]
    sheets: Sheets = {"throws": throws, "rows": [["throw", "name"], *([cell, str(cell)] for cell in cells)]}
    cranks = read(sheets).body["machine"]["throws"]
    assert [crank["rows"] for crank in cranks] == [[{"name": str(cells[places.index(at)])}] for at in range(len(names))]


def test_rows_of_a_machine_name_their_throws() -> None:
    rows = request_sheets(bodies()["2d12"])["rows"]
    names = [throw["name"] for throw in bodies()["2d12"]["machine"]["throws"]]
    assert [line[rows[0].index("throw")] for line in rows[1:]] == names


def test_the_empty_workbook_holds_heads_that_the_schema_has() -> None:
    sheets = workbook_sheets(template(EMPTY))
    assert read(sheets).body == {"machine": {"kind": "reciprocating"}}
    machine: dict[str, Any] = {"kind": "reciprocating"}
    for sheet in ("throws", "webs", "bearings"):
        machine[sheet] = [_with(heads) for heads in sheets[sheet]]
    machine["throws"][0]["rows"] = [_with([head for head in sheets["rows"][0] if head != "throw"])]
    assert _unknown(machine) == []
    machine["webs"][0]["wings"] = "x"
    assert _unknown(machine) == ["wings"]


def _with(heads: Any) -> dict[str, Any]:
    """A thing that has all of these fields, none of them with a value."""
    fields: dict[str, Any] = {}
    for head in heads:
        *around, last = head.split(".")
        place = fields
        for name in around:
            place = place.setdefault(name, {})
        place[last] = "no value of any field"
    return fields


def _unknown(machine: dict[str, Any]) -> list[Any]:
    """Fields that the schema does not have."""
    with pytest.raises(ValidationError) as refused:
        OptimizeRequest.model_validate({"machine": machine})
    return [error["loc"][-1] for error in refused.value.errors() if error["type"] == "extra_forbidden"]
