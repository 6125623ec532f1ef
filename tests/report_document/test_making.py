"""Planes and radii in the table of counterweights, and what bolts hold, where that is asked."""

import json
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from optimizer.analyze import analyze
from schemas.answer.first_order import FirstOrder
from schemas.request.requests import AnalyzeRequest
from service.documents.examples import load
from service.report.blocks import Document, Number, Table
from service.report.chapters.answers import analyzed
from service.report.chapters.balance import first_order
from service.report.chapters.making import holding
from service.report.document import report
from tests.report_document.conftest import AT, request_of

_TITLE = "What holds them at {} rpm"


def machine(**changes: Any) -> Any:
    return {**json.loads(load("m-type-four"))["machine"], **changes}


def held(blocks: Any, rpm: str) -> list[tuple[Any, ...]]:
    """Rows of the table, numbers as they are."""
    tables = [block for block in blocks if isinstance(block, Table)]
    (table,) = [sheet for sheet in tables if sheet.title == _TITLE.format(rpm)]
    return [tuple(cell.value if isinstance(cell, Number) else cell for cell in row) for row in table.rows]


def fitted(document: Document) -> Any:
    (chapter,) = [section for section in document.chapters if section.title == "Counterweights"]
    return chapter.blocks


def test_weights_with_a_radius_and_a_plane_of_their_own() -> None:
    counterweights = [
        {"web": "1a", "mass_kg": 10, "angle_deg": 180, "radius_m": 0.21},
        {"position_m": 0.05, "radius_m": 0.18, "mass_kg": 4, "angle_deg": 30},
    ]
    request = AnalyzeRequest.model_validate({"machine": machine(overspeed_rpm=500), "counterweights": counterweights})
    (chapter,) = [section for section in analyzed(request, analyze(request)) if section.title == "Counterweights"]
    square = (500 * np.pi / 30) ** 2
    # analytic: m r omega^2 at the overspeed
    assert held(chapter.blocks, "500") == [
        ("1a", pytest.approx(10 * 0.21 * square)),
        ("counterweight 2", pytest.approx(4 * 0.18 * square)),
    ]
    places = next(block for block in chapter.blocks if isinstance(block, Table))
    assert [column.title for column in places.columns[4:6]] == ["plane z, m", "radius, m"]
    values = [tuple(cell.value for cell in row[4:6] if isinstance(cell, Number)) for row in places.rows]
    assert (1.43, 0.21) in values
    assert (0.05, 0.18) in values


@pytest.mark.parametrize("limited", [False, True])
def test_what_bolts_hold(limited: bool) -> None:
    changed = machine(**({} if limited else {"overspeed_rpm": 504}))
    if limited:
        changed["webs"][0]["max_centrifugal_force_N"] = 5e3
    rpm = 420 if limited else 504
    rows = held(fitted(report(request_of("m-type-four", machine=changed), AT)), str(rpm))
    assert {"1a", "4b"} <= {row[0] for row in rows}
    assert not limited or rows[0][1] <= 5e3 * (1 + 1e-9)


def test_bolts_hold_light_counterweights_too_and_no_plates() -> None:
    """Analytic: what has any mass is held; a web without, and what is cut from a plate, is not in the table."""
    bolted: Any = SimpleNamespace(
        overspeed_rpm=None, speed_rpm=500.0, every_web=[SimpleNamespace(max_centrifugal_force_N=9.0)]
    )
    light, none, heavy = ("light", 1e-3, None, 0.4), ("none", 0.0, None, 0.0), ("heavy", 30.0, None, 900.0)
    weights: Any = [
        SimpleNamespace(web=name, mass_kg=mass, shape=shape, centrifugal_force_N=force)
        for name, mass, shape, force in (light, none, ("cut", 2.0, "a sector", 70.0), heavy)
    ]
    assert held(holding(bolted, weights), "500") == [("light", 0.4), ("heavy", 900.0)]
    assert not list(holding(bolted, weights[1:3]))


def test_nothing_is_said_where_nothing_is_asked() -> None:
    titles = [block.title for block in fitted(report(request_of("m-type-four"), AT)) if isinstance(block, Table)]
    assert not [title for title in titles if title.startswith("What holds them")]


def test_a_direction_is_filed_where_something_is_or_comes() -> None:
    """Analytic: what is 0 without counterweights and with them is left out, what is 0 in one of both is not."""
    body = AnalyzeRequest.model_validate({"machine": machine(), "counterweights": []})
    answer = analyze(body)
    assert answer.residual is not None
    was, floor = answer.residual.before, answer.floor

    def without(field: str) -> FirstOrder:
        return was.model_copy(update={"moment": was.moment.model_copy(update={field: 0.0})})

    def titles(before: FirstOrder, after: FirstOrder | None) -> set[Any]:
        chapter = first_order(body.machine, before, after, floor, "with", None)
        (table,) = [block for block in chapter.blocks if isinstance(block, Table)]
        return {row[0] for row in table.rows}

    title, none = "peak horizontal couple (of the x forces), N m", without("peak_x_Nm")
    assert title in titles(was, none)
    assert title in titles(none, was)
    assert title not in titles(none, none)
    assert title not in titles(none, None)
