"""The Python client against the real service."""

import json
from pathlib import Path
from types import ModuleType
from typing import Any
from zipfile import ZipFile

import pyarrow.parquet as pq
import pytest


@pytest.fixture(scope="module")
def service(counterweight: ModuleType, url: str) -> Any:
    return counterweight.Service(url)


@pytest.fixture(scope="module")
def request_2d12(service: Any) -> dict[str, Any]:
    example: dict[str, Any] = service.example("2d12")
    return example


def test_the_examples_are_listed(service: Any) -> None:
    assert "2d12" in [example["name"] for example in service.examples()["examples"]]


def test_what_was_optimised_is_what_an_analysis_finds(service: Any, request_2d12: dict[str, Any]) -> None:
    answer = service.optimize(request_2d12)
    assert answer["status"] == "optimal"
    fitted = [
        {key: counterweight[key] for key in ("web", "mass_kg", "angle_deg")}
        for counterweight in answer["counterweights"]
    ]
    reply = service.analyze({**request_2d12, "counterweights": fitted, "outputs": ["residual"]})
    # analytic: the same masses and angles leave the same force
    assert reply["residual"]["after"]["force"]["peak_N"] == pytest.approx(
        answer["residual"]["after"]["force"]["peak_N"], rel=1e-12
    )


def test_a_front_goes_from_the_smallest_force_to_the_smallest_moment(
    service: Any, request_2d12: dict[str, Any]
) -> None:
    points = service.pareto({**request_2d12, "points": 3})["fronts"][0]["points"]
    assert points[0]["force_peak_N"] < points[-1]["force_peak_N"]
    assert points[0]["moment_peak_Nm"] > points[-1]["moment_peak_Nm"]


def test_any_other_route_is_posted_to(service: Any) -> None:
    fields = {"pin_count": 3, "pin_circle_radius_m": 0.05, "rotation_torque_Nm": 12.5}
    # analytic: 2 T/(n R)
    assert service.post("v1/scroll/pin-loads", fields)["peak_N"] == pytest.approx(2 * 12.5 / (3 * 0.05))


@pytest.mark.parametrize(("name", "begins"), [("report.pdf", b"%PDF-"), ("report.html", b"<!DOCTYPE html>")])
def test_a_report_is_written_as_its_name_says(
    service: Any, request_2d12: dict[str, Any], tmp_path: Path, name: str, begins: bytes
) -> None:
    written = service.report(request_2d12, tmp_path / name)
    assert written.read_bytes().startswith(begins)


def test_a_picture_is_drawn(service: Any, request_2d12: dict[str, Any]) -> None:
    assert service.picture("front", request_2d12).startswith("<svg ")


def test_drawings_are_written(service: Any, tmp_path: Path) -> None:
    request = json.loads(Path("examples/drawings/2d12-plates.json").read_text())
    with ZipFile(service.drawings(request, tmp_path / "drawings.zip")) as archive:
        assert archive.testzip() is None
        assert "bill-of-material.csv" in archive.namelist()


def test_a_report_of_an_unknown_kind_is_not_asked_for(
    service: Any, request_2d12: dict[str, Any], tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=r"report\.doc: the name must end in \.html, \.pdf"):
        service.report(request_2d12, tmp_path / "report.doc")


def test_a_sweep_is_started_waited_for_and_read(service: Any, request_2d12: dict[str, Any], tmp_path: Path) -> None:
    speeds = [300.0, 400.0, 500.0]
    sweep = service.sweep({"base": request_2d12, "axes": [{"path": "/machine/speed_rpm", "values": speeds}]})
    states: list[str] = []
    assert service.finished(sweep, lambda state: states.append(state["state"]))["state"] == "done"
    assert states[-1] == "done"
    rows = list(service.rows(sweep, columns="index,status,moment_peak_Nm,/machine/speed_rpm"))
    assert [row["/machine/speed_rpm"] for row in rows] == speeds
    # analytic: moments grow with the square of the speed; both are certified to a gap of 1e-6
    assert rows[2]["moment_peak_Nm"] / rows[0]["moment_peak_Nm"] == pytest.approx(25 / 9, rel=1e-5)
    assert pq.read_table(service.download(sweep, tmp_path / "rows.parquet")).num_rows == 3


def test_what_is_refused_names_its_fields(service: Any, counterweight: ModuleType) -> None:
    with pytest.raises(counterweight.Refused) as refused:
        service.optimize({"machine": {"kind": "reciprocating", "speed_rpm": -1, "throws": []}})
    assert refused.value.status == 422
    assert set(refused.value.fields) == {"/machine/speed_rpm", "/machine/throws"}
    assert refused.value.problem["type"] == "/problems/invalid-request"
    assert "/machine/throws: must hold at least one item" in str(refused.value)


def test_numbers_that_are_none_are_not_sent(service: Any) -> None:
    with pytest.raises(ValueError, match="not JSON compliant"):
        service.optimize({"machine": {"kind": "reciprocating", "speed_rpm": float("nan")}})


def test_a_service_that_is_not_there(counterweight: ModuleType) -> None:
    with pytest.raises(OSError, match="refused"):
        counterweight.Service("http://127.0.0.1:9").examples()
