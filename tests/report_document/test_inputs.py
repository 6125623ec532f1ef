"""The inputs in the report: whatever changes an answer stands there."""

from copy import deepcopy
from typing import Any

import pytest

from schemas.request.requests import OptimizeRequest
from service.report.blocks import Number, Table
from service.report.chapters.inputs import inputs
from tests.pairs.asking import body_of


def _body(*features: str) -> dict[str, Any]:
    body = body_of("twin", features)
    assert body is not None
    return body


def _rows(body: dict[str, Any]) -> dict[str, list[tuple[Any, ...]]]:
    """Rows of every table, with plain numbers."""
    tables = (block for block in inputs(OptimizeRequest.model_validate(body), 0.0).blocks if isinstance(block, Table))
    plain = {
        entry.title: [tuple(cell.value if isinstance(cell, Number) else cell for cell in row) for row in entry.rows]
        for entry in tables
    }
    assert plain
    return plain


@pytest.mark.parametrize(
    ("features", "place"),
    [
        (["bearing specific"], ("machine", "bearings", 1, "diameter_m")),
        (["bearing specific"], ("machine", "bearings", 0, "length_m")),
        (["overspeed and bolts"], ("machine", "overspeed_rpm")),
        (["overspeed and bolts"], ("machine", "webs", 0, "max_centrifugal_force_N")),
        (["priorities"], ("objective", "priorities", 1, "allowance")),
    ],
)
def test_what_changes_an_answer_stands_in_the_report(features: list[str], place: tuple[Any, ...]) -> None:
    """Property: another number there is another chapter."""
    body = _body(*features)
    other = deepcopy(body)
    part = other
    for key in place[:-1]:
        part = part[key]
    part[place[-1]] *= 1.25
    assert _rows(other) != _rows(body)


@pytest.mark.parametrize(
    ("features", "aim"),
    [
        ((), "smallest weighted sum of peak force and peak moment"),
        (("combine max",), "smallest larger one of weighted peak force and weighted peak moment"),
        (
            ("combine max", "bearing weight"),
            "smallest of the largest of peak force, peak moment and largest bearing load, all weighted",
        ),
        (
            ("bending weight", "balance shaft backwards", "roll weight"),
            "smallest weighted sum of peak force, peak moment, roll moment and largest bending moment",
        ),
        (("priorities",), "goals in their order; external: smallest weighted sum of peak force and peak moment"),
    ],
)
def test_the_aim_names_all_that_is_weighed(features: tuple[str, ...], aim: str) -> None:
    assert ("aim", aim) in _rows(_body(*features))["Objective"]


def test_goals_stand_with_what_those_after_them_may_use() -> None:
    rows = _rows(_body("priorities"))["Objective"]
    assert ("goals in their order", "external (allowance 1 %), bearings (allowance 1 %), bending") in rows
