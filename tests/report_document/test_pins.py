"""Pins of a scroll as a table, a picture and a chapter: loads by pin, dead points, what is assumed."""

import csv
import io
from math import pi, sin
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree

import pytest
from starlette.testclient import TestClient

from optimizer.pins.answer import pin_loads
from schemas.scroll.pin_loads import PinLoadsRequest
from service.app import create_app
from service.computations.table import COMPUTATIONS
from service.report.blocks import Number, Paragraph, Table
from service.report.chapters.pins import _assumption
from service.report.chapters.pins import pins as chapters_of_pins
from service.settings import Settings
from service.tables.pins import lines
from tests.report_document.conftest import request_of

EVEN = {"pin_count": 3, "pin_circle_radius_m": 0.05, "rotation_torque_Nm": 12.5}


def test_the_table_is_the_formula() -> None:
    """Analytic: Q_i = 2 T/(n R) sin(theta - 2 pi (i - 1)/n)."""
    heads, *rows = lines(pin_loads(PinLoadsRequest.model_validate(EVEN)))
    assert heads == ["shaft angle, deg", "Q 1, N", "Q 2, N", "Q 3, N", "rotation torque, N m"]
    assert len(rows) == 360
    for angle, *loads, torque in rows:
        assert torque == 12.5
        for pin, load in enumerate(loads):
            expected = 2 * 12.5 / (3 * 0.05) * sin(float(angle or 0.0) * pi / 180 - 2 * pi * pin / 3)
            assert load == pytest.approx(expected, abs=1e-9)


def test_dead_points_are_where_a_load_is_nothing() -> None:
    request = PinLoadsRequest.model_validate(EVEN)
    answer = pin_loads(request)
    (chapter,) = chapters_of_pins(request, answer)
    tables = {block.title: block for block in chapter.blocks if isinstance(block, Table)}
    data = tables["Dead points, stiffness and clearance"]
    dead = [[cell.value for cell in row[1:3] if isinstance(cell, Number)] for row in data.rows]
    # analytic: pins a third of a revolution apart
    assert [pytest.approx(values) for values in dead] == [[0, 180], [120, 300], [240, 60]]
    for pin, angles in zip(answer.pins, dead, strict=True):
        assert [pin.load_N[round(angle)] for angle in angles] == [pytest.approx(0.0, abs=1e-9)] * 2
    assert [row[3] for row in data.rows] == ["equal"] * 3
    assert len(tables["Q_i over the revolution"].rows) == 18
    words = " ".join(block.text for block in chapter.blocks if isinstance(block, Paragraph))
    assert "all pins have equal stiffness" in words


@pytest.mark.parametrize(
    ("angles", "more", "torque", "is_proven"),
    [
        ([0, 120, 240], {}, 12.5, True),
        ([0, 120, 240], {"clearance_m": 1e-5}, 12.5, True),
        # beside dead points nothing bounds what errors strain, and with a torque there is no peak at all
        ([0, 180], {"eccentricity_error_m": 1e-5}, 0.0, False),
        ([0, 180], {}, 12.5, False),
    ],
)
def test_the_chapter_says_whether_peaks_are_proven(
    angles: list[float], more: dict[str, float], torque: float, is_proven: bool
) -> None:
    pins: list[dict[str, float]] = [
        {"angle_deg": angle, "radius_m": 0.05, "stiffness_N_per_m": 2e7} for angle in angles
    ]
    pins[0] |= more
    request = PinLoadsRequest.model_validate({"pins": pins, "rotation_torque_Nm": torque})
    (chapter,) = chapters_of_pins(request, pin_loads(request))
    words = " ".join(block.text for block in chapter.blocks if isinstance(block, Paragraph))
    assert ("Peaks are proven for every angle" in words) == is_proven


def test_stiffness_and_clearance_are_in_view() -> None:
    pins = [
        {"angle_deg": 120 * k, "radius_m": 0.05, "stiffness_N_per_m": 2e7, "clearance_m": 1e-5 * k} for k in range(3)
    ]
    request = PinLoadsRequest.model_validate({"pins": pins, "rotation_torque_Nm": 12.5})
    (chapter,) = chapters_of_pins(request, pin_loads(request))
    tables = {block.title: block for block in chapter.blocks if isinstance(block, Table)}
    rows = tables["Dead points, stiffness and clearance"].rows
    assert [row[3].value for row in rows if isinstance(row[3], Number)] == [2e7] * 3
    assert [row[4].value for row in rows if isinstance(row[4], Number)] == [0.0, 1e-5, 2e-5]
    assert "equal stiffness" not in " ".join(block.text for block in chapter.blocks if isinstance(block, Paragraph))


def test_the_picture_draws_every_pin_and_a_crank_has_none() -> None:
    picture_pin_loads = COMPUTATIONS["picture_pin_loads"]
    texts = [
        element.text
        for element in ElementTree.fromstring(picture_pin_loads.function(request_of("scroll-three-pins")).svg()).iter()
    ]
    assert {"pin 1", "pin 2", "pin 3"} <= set(texts)
    with TestClient(create_app(Settings(), warm=False)) as client:
        response = client.post("/v1/scroll/pin-loads", json=EVEN, headers={"Accept": "text/csv"})
        assert response.status_code == 200
        assert len(list(csv.reader(io.StringIO(response.text)))) == 361
        assert client.post("/v1/scroll/pin-loads", json=EVEN).headers["content-type"] == "application/json"
        drawn = client.post("/v1/scroll/pin-loads", json=EVEN, headers={"Accept": "image/svg+xml"})
        assert drawn.text.startswith("<svg")
        body = request_of("2d12").alone.model_dump(mode="json")
        assert client.post("/v1/tables/pin_loads", json=body).status_code == 422


@pytest.mark.parametrize(
    ("clearance", "error", "stiffness", "expected"),
    [
        (0.0, 0.0, None, ("all pins have equal stiffness", "No pin has clearance")),
        (1e-6, 0.0, None, ("all pins have equal stiffness", "as below")),
        (0.0, -1e-6, 2e7, ("stiffnesses below share", "as below")),
        (0.0, 0.0, 2e7, ("stiffnesses below share", "No pin has clearance")),
    ],
)
def test_what_is_assumed_of_pins(
    clearance: float, error: float, stiffness: float | None, expected: tuple[str, ...]
) -> None:
    """Of two pins the second alone has any of it."""
    pins: Any = [
        SimpleNamespace(stiffness_N_per_m=firm, clearance_m=play, eccentricity_error_m=off)
        for firm, play, off in ((None, 0.0, 0.0), (stiffness, clearance, error))
    ]
    assert all(part in _assumption(pins) for part in expected)
