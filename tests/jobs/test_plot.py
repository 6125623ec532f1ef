"""The command `counterweight plot`: points and front of a sweep's rows, and what it cannot draw."""

from pathlib import Path
from xml.etree import ElementTree

import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner, Result

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from service.cli import app
from service.jobs.export import export
from service.report.charts import spread
from service.report.scatter import front
from tests.jobs.sweeps import analyses

_SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def rows() -> pa.Table:
    return run_chunk(SweepRequest.model_validate(analyses(4, 5)).model_dump_json().encode(), 0, 20)


def drawn(path: Path, x: str = "force_peak_N", y: str = "total_mass_kg") -> Result:
    return CliRunner().invoke(app, ["plot", str(path), "--x", x, "--y", y, "--out", str(path.with_suffix(".svg"))])


@pytest.mark.parametrize("name", ["rows.parquet", "rows.arrow", "rows.csv"])
def test_points_are_drawn_whatever_the_format(rows: pa.Table, name: str, tmp_path: Path) -> None:
    export(tmp_path / name, rows.schema, rows.to_batches())
    process = drawn(tmp_path / name)
    assert process.exit_code == 0, process.output
    # analytic: one speed of five is negative
    assert "16 designs; 4 without a certified answer left out" in process.output.replace("\n", " ")
    picture = ElementTree.parse(tmp_path / "rows.svg").getroot()
    # all weigh the same, nothing: the front is the design with the smallest force
    assert len(picture.findall(f"{_SVG}circle")) == 16 + 1
    texts = [element.text for element in picture.findall(f"{_SVG}text")]
    assert "16 designs, 1 on the front" in texts


def test_what_cannot_be_drawn(rows: pa.Table, tmp_path: Path) -> None:
    path = tmp_path / "rows.parquet"
    export(path, rows.schema, rows.to_batches())
    broken = tmp_path / "broken.parquet"
    broken.write_bytes(b"nothing")
    for drawing, text in (
        (drawn(path, x="mass"), "has no column mass; there are index"),
        (drawn(path, x="status"), "status is no column of numbers"),
        (drawn(tmp_path / "none.parquet"), "cannot read"),
        (drawn(broken), "holds no rows"),
        (drawn(tmp_path / "rows.txt"), "must end in .parquet"),
    ):
        assert drawing.exit_code == 2
        assert text in drawing.output.replace("\n", " ")


@given(st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), min_size=1, max_size=30))
def test_the_front_is_what_no_other_beats(points: list[tuple[int, int]]) -> None:
    across, upward = zip(*points, strict=True)
    positions = {points[place] for place in front(across, upward)}
    # independent: by definition
    expected = {
        point for point in points if not any(o != point and o[0] <= point[0] and o[1] <= point[1] for o in points)
    }
    assert positions == expected


def test_an_axis_around_values_far_from_zero() -> None:
    low, high, marks = spread([1000.0, 1010.0])
    assert low < 1000 < 1010 < high < 1020
    assert marks == [1000, 1002.5, 1005, 1007.5, 1010]
    assert spread([5.0])[0] < 5 < spread([5.0])[1]
    assert spread([0.0])[:2] == (-1, 1)
