"""From a request to a folder of drawings."""

import csv
import io
import json
from collections.abc import Mapping
from math import radians
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import openpyxl
import pytest
from typer.testing import CliRunner

from optimizer.errors import OutOfRange
from optimizer.optimize import optimize
from schemas.request.drawings import DrawingsRequest
from schemas.request.requests import OptimizeRequest
from service.cli import app
from service.common.plain import inert
from service.drawings.archive import zipped
from service.drawings.bill import HEADS
from service.drawings.drawing_set import drawings
from tests.drawings.exchange import File, names

EXAMPLE = Path("examples/drawings/2d12-plates.json")


def body() -> dict[str, Any]:
    document: dict[str, Any] = json.loads(EXAMPLE.read_text())
    return document


def drawn(request: Mapping[str, Any]) -> dict[str, bytes]:
    with ZipFile(io.BytesIO(zipped(drawings(DrawingsRequest.model_validate(request))))) as archive:
        assert archive.testzip() is None
        return {name: archive.read(name) for name in archive.namelist()}


def bill(files: Mapping[str, bytes]) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(files["bill-of-material.csv"].decode())))


def test_the_solids_weigh_what_the_answer_says() -> None:
    payload = body()
    answer, files = optimize(OptimizeRequest.model_validate(payload)), drawn(payload)
    volumes = File(files["counterweights.step"]).volumes()
    # independent: volumes by the divergence theorem, of steel
    masses = [counterweight.mass_kg for counterweight in answer.counterweights]
    assert [volume * 1e-9 * 7850 for volume in volumes] == pytest.approx(masses, rel=1e-9)
    assert list(names(File(files["counterweights.step"]).products())) == [
        f"Counterweight {counterweight.web}" for counterweight in answer.counterweights
    ]
    assert sum(float(row["mass, kg"]) for row in bill(files)) == pytest.approx(answer.total_mass_kg, rel=1e-12)


def test_given_counterweights_are_drawn_and_equal_ones_are_one_part() -> None:
    weights = [
        {"web": web, "mass_kg": 30.0, "angle_deg": angle} for web, angle in (("1a", 180), ("1b", 190), ("2a", 0))
    ]
    files = drawn({**body(), "counterweights": [*weights, {"web": "2b", "mass_kg": 20.0, "angle_deg": 0}]})
    assert [(row["part"], row["pieces"]) for row in bill(files)] == [("1", "3")] * 3 + [("2", "1")]
    assert {name for name in files if name.endswith(".dxf")} == {"counterweight-1.dxf", "counterweight-2.dxf"}
    # analytic: the volume of 30 kg of steel
    assert File(files["counterweight-1.step"]).volumes() == pytest.approx([30.0 / 7850 * 1e9], rel=1e-9)
    assert files["counterweight-1.svg"].decode().count("as drawn at shaft angle 0") == 3


def test_a_counterweight_without_a_plate_is_in_the_bill_and_said_not_to_be_drawn() -> None:
    payload = body()
    web = payload["machine"]["webs"][0]
    del web["envelope"]
    files = drawn({**payload, "machine": {**payload["machine"], "webs": [
        {**web, "counterweight_radius_m": 0.25, "max_mass_kg": 30}, *payload["machine"]["webs"][1:]
    ]}})  # fmt: skip
    (plain,) = [row for row in bill(files) if row["web"] == "1a"]
    assert (plain["part"], plain["drawing"]) == ("", "none: the web has no envelope")
    assert "Counterweight 1a" not in list(names(File(files["counterweights.step"]).products()))


@pytest.mark.parametrize(
    ("text", "cell"),
    [
        ("=1", "'=1"),
        ("\t1", "'\t1"),
        ("@x", "'@x"),
        ("1a", "1a"),
        ("a=b", "a=b"),
        ("", ""),
        (" a", " a"),
        (" =1", "' =1"),
        ("\u3000-1", "'\u3000-1"),
        ("\ufeff+1", "'\ufeff+1"),
        ("\u200b\xa0@x", "'\u200b\xa0@x"),
        ("\uff1d1", "'\uff1d1"),
        ("\uff0b1", "'\uff0b1"),
        ("\uff0d1", "'\uff0d1"),
        ("\uff20x", "'\uff20x"),
        ("\u22121", "'\u22121"),
        ("\n1", "'\n1"),
        ("a;=1", "a;'=1"),
        ('a;" =1;+2', "a;\" '=1;'+2"),
        ("=1;-2", "'=1;'-2"),
        ("a; b-c", "a; b-c"),
        ("a,=1", "a,=1"),
    ],
)
def test_what_a_spreadsheet_would_run_is_text(text: str, cell: str) -> None:
    assert inert(text) == cell


def test_the_workbook_says_what_the_csv_says_and_runs_nothing() -> None:
    payload = body()
    payload["machine"]["webs"][0]["name"] = "=1+1"
    files = drawn({**payload, "counterweights": [{"web": "=1+1", "mass_kg": 30.0, "angle_deg": 180}]})
    sheet = openpyxl.load_workbook(io.BytesIO(files["bill-of-material.xlsx"])).active
    heads, (line,) = [cell.value for cell in sheet[1]], list(sheet.iter_rows(min_row=2))
    assert tuple(heads) == HEADS
    assert (line[2].value, line[2].data_type) == ("=1+1", "s")
    (row,) = bill(files)
    assert row["web"] == "'=1+1"
    for head, cell in zip(heads, line, strict=True):
        if isinstance(cell.value, float | int):
            # the library writes 16 digits
            assert cell.value == pytest.approx(float(row[head]), rel=1e-14)


def test_the_same_request_gives_the_same_bytes() -> None:
    payload = {**body(), "counterweights": [{"web": "1a", "mass_kg": 30.0, "angle_deg": 180}]}
    drawing, second_drawing = drawn(payload), drawn(payload)
    # the library writes the time into a workbook
    assert {**drawing, "bill-of-material.xlsx": b""} == {**second_drawing, "bill-of-material.xlsx": b""}


def test_where_a_counterweight_sits() -> None:
    # analytic: half a disc of steel at 90 degrees stands upwards, from one face of its plate to the other
    payload = body()
    payload["machine"]["webs"] = [
        {
            "name": "w",
            "position_m": 0.2,
            "envelope": {"shape": "segment", "outer_radius_m": 0.1, "thickness_m": 0.05},
        }
    ]
    whole = 0.5 * radians(180) * 0.1**2 * 0.05 * 7850
    files = drawn({**payload, "counterweights": [{"web": "w", "mass_kg": whole, "angle_deg": 90}]})
    text = files["counterweights.step"].decode()
    points = [
        [float(part) for part in line.split("(", 2)[2].rstrip(");").split(",")]
        for line in text.splitlines()
        if "CARTESIAN_POINT" in line
    ]
    corners = {tuple(round(coordinate, 6) + 0.0 for coordinate in point) for point in points}
    assert {(100.0, 0.0, 175.0), (-100.0, 0.0, 225.0)} <= corners


@pytest.mark.parametrize(
    ("change", "path"),
    [
        ({"counterweights": []}, ("counterweights",)),
        ({"objective": {"force_ceiling_N": 1e-3, "moment_ceiling_Nm": 1e-3}}, ("objective",)),
        ({"counterweights": [{"web": "1a", "mass_kg": 1e4, "angle_deg": 0}]}, ("counterweights", 0, "mass_kg")),
    ],
)
def test_what_cannot_be_drawn_is_said(change: dict[str, Any], path: tuple[str | int, ...]) -> None:
    with pytest.raises(OutOfRange) as refused:
        drawings(DrawingsRequest.model_validate({**body(), **change}))
    assert [problem.path for problem in refused.value.problems] == [path]


def test_the_command(tmp_path: Path) -> None:
    run, answer, to = CliRunner(), tmp_path / "answer.json", tmp_path / "drawings.zip"
    answer.write_text(run.invoke(app, ["optimize", str(EXAMPLE), "--json"]).stdout)
    process = run.invoke(app, ["draw", str(EXAMPLE), "--answer", str(answer), "--to", str(to)])
    assert process.exit_code == 0, process.output
    with ZipFile(to) as archive:
        assert "counterweight-1.dxf" in archive.namelist()
    for wrong, text in (
        (["draw", "examples/2d12.json", "--to", str(to)], "/machine/webs: a drawing needs the envelope of a web"),
        (["draw", str(EXAMPLE), "--answer", str(EXAMPLE), "--to", str(to)], "is not the answer"),
        (["draw", str(EXAMPLE), "--to", str(tmp_path)], "cannot write"),
    ):
        refused = run.invoke(app, wrong)
        assert (refused.exit_code, text in refused.stderr) == (2, True), refused.output
