"""Designs that computing breaks down for: their rows say so, and the others are what they are without them."""

import logging
from collections.abc import Callable, Sequence
from typing import Any

import pytest

from optimizer.studies.sweep import rows
from schemas.request.requests import OptimizeRequest
from tests.studies.sweep.single import assert_row_is_the_single_answer, example, sweep, table

#: the design that is made to break down
_SPEED = 333.0
_AXIS = {"path": "/machine/speed_rpm", "values": [300, _SPEED, 400, 500]}


def _plain() -> dict[str, Any]:
    return {"machine": example("2d12")["machine"]}


def _over_the_turn() -> dict[str, Any]:
    return _plain() | {"objective": {"bearing_weight": 1.0}}


def _alone() -> dict[str, Any]:
    return {"machine": example("plate-single")["machine"]}


def _breaking(function: Callable[..., Any], at: Callable[..., bool]) -> Callable[..., Any]:
    def broken(*arguments: Any, **named: Any) -> Any:
        if at(*arguments):
            raise ZeroDivisionError("as a fault of the program would")
        return function(*arguments, **named)

    return broken


def _of_columns(request: Any, *_rest: object) -> bool:
    speed = request.machine.speed_rpm
    return bool(_SPEED in (speed if hasattr(speed, "__len__") else [speed]))


def _of_many(requests: Sequence[OptimizeRequest], *_rest: object) -> bool:
    return any(request.machine.speed_rpm == _SPEED for request in requests)


@pytest.mark.parametrize(
    ("base", "module", "name", "at"),
    [
        (_plain, rows, "optimal", _of_columns),
        (_plain, rows, "columns", _of_columns),
        (_over_the_turn, rows, "single_optima", _of_many),
        (_alone, rows, "single_optima", _of_many),
    ],
)
def test_one_design_that_breaks_down_ends_no_other(
    base: Callable[[], dict[str, Any]],
    module: Any,
    name: str,
    at: Callable[..., bool],
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    request = sweep(base(), _AXIS)
    monkeypatch.setattr(module, name, _breaking(getattr(module, name), at))
    with caplog.at_level(logging.ERROR, "optimizer"):
        sheet = table(request).to_pylist()
    faulty = sheet.pop(1)
    assert faulty["status"] == "failed"
    assert faulty["message"].startswith("internal fault: ZeroDivisionError")
    assert faulty["/machine/speed_rpm"] == _SPEED
    # nothing that was computed before it broke down is told as if it were an answer
    labels = {"index", "status", "message", "/machine/speed_rpm"}
    assert all(value is None for column, value in faulty.items() if column not in labels)
    assert [assert_row_is_the_single_answer(request, row) for row in sheet] == ["optimal"] * 3
    assert [record.getMessage() for record in caplog.records] == [
        "1 design(s) of a sweep broke down, 1 first: ZeroDivisionError: as a fault of the program would"
    ]


def test_a_lack_of_memory_is_no_fault_of_a_design(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_arguments: object) -> Any:
        raise MemoryError

    monkeypatch.setattr(rows, "optimal", full)
    with pytest.raises(MemoryError):
        table(sweep(_plain(), _AXIS))


def test_webs_that_change_nothing_are_left_without_counterweights() -> None:
    """A catalogue for a web in the plane of an end bearing, where it bends nothing; analytic: none is the lightest."""
    machine = example("2d12")["machine"]
    machine["webs"] = [{"name": "end", "position_m": 0.4, "counterweight_radius_m": 0.25, "max_mass_kg": 60}]
    machine["catalogue"] = {"masses_kg": [10, 20], "angle_step_deg": 90}
    goal = {"force_weight": 0, "moment_weight": 0, "bending_weight": 1}
    request = sweep(
        {"machine": machine, "objective": goal}, {"path": "/machine/webs/0/position_m", "values": [0.4, 0.2]}
    )
    sheet = table(request).to_pylist()
    assert [row["status"] for row in sheet] == ["optimal", "optimal"]
    assert sheet[0]["total_mass_kg"] == 0.0
