"""Indicated pressures that are refused, each with the field that is wrong."""

import copy
from typing import Any

import pytest
from pydantic import ValidationError

from schemas.machine.reciprocating import ReciprocatingMachine
from tests.analyze.engines import cylinder, engine

CLOSED = {"angle_deg": [0, 100, 300, 500, 720], "pressure_Pa": [5e6, 1e6, 1e5, 1e5, 5e6]}
ONE = {"angle_deg": [0, 100, 200, 360], "pressure_Pa": [5e6, 1e6, 1e5, 5e6]}
AT = "throws/0/rows/0/cylinder/pressure"


def with_pressure(pressure: dict[str, Any], **rest: Any) -> dict[str, Any]:
    body = engine([rest.pop("fired", 0.0)], [cylinder(CLOSED)], **rest)
    body["throws"][0]["rows"][0]["cylinder"]["pressure"] = pressure
    return body


def refused(pressure: dict[str, Any], **rest: Any) -> dict[str, str]:
    """What is said, by path from the machine."""
    with pytest.raises(ValidationError) as caught:
        ReciprocatingMachine.model_validate(with_pressure(pressure, **rest))
    messages = {}
    for error in caught.value.errors():
        problems = error.get("ctx", {}).get("problems", [((), error["msg"])])
        messages |= {"/".join(map(str, (*error["loc"], *path))): message for path, message in problems}
    return messages


def head(changes: dict[str, Any] | None = None, **rest: Any) -> dict[str, Any]:
    return {"head": {**copy.deepcopy(CLOSED), **(changes or {})}, "cycle_turns": 2, **rest}


REFUSED = [
    pytest.param(head({"pressure_Pa": [5e6, 1e6, 1e5, 1e5, 4e6]}), "head/pressure_Pa/4", "close", id="ends apart"),
    pytest.param(head({"angle_deg": [0, 50, 100, 200, 360]}), "head/angle_deg/4", "close", id="half of the cycle"),
    pytest.param(head({"angle_deg": [0, 100, 100, 500, 720]}), "head/angle_deg/2", "rise", id="equal"),
    pytest.param(head({"angle_deg": [0, 300, 100, 500, 720]}), "head/angle_deg/2", "rise", id="falling"),
    pytest.param(head({"angle_deg": [0, 100, 100 + 1e-9, 500, 720]}), "head/angle_deg/2", "rise", id="a jump"),
    pytest.param(head({"angle_deg": [0, 100, 300, 500, 721]}), "head/angle_deg/4", "720", id="beyond two turns"),
    pytest.param(head({"angle_deg": [-1, 100, 300, 500, 720]}), "head/angle_deg/0", "", id="before the cycle"),
    pytest.param({**head(), "cycle_turns": 1}, "head/angle_deg/3", "1 turn", id="beyond one turn"),
    pytest.param(head({"angle_deg": [0, 360], "pressure_Pa": [1e5, 1e5]}), "head/angle_deg", "3 items", id="two"),
    pytest.param(head({"pressure_Pa": [5e6, 1e6, 1e5, 1e5]}), "head/pressure_Pa", "each of the 5", id="too few values"),
    pytest.param(head({"pressure_Pa": [5e6, 1e6, -1.0, 1e5, 5e6]}), "head/pressure_Pa/2", "", id="negative"),
    pytest.param(head({"pressure_Pa": [5e6, 1e6, "1 m", 1e5, 5e6]}), "head/pressure_Pa/2", "unit", id="wrong unit"),
    pytest.param({**head(), "cycle_turns": 3}, "cycle_turns", "1 or 2", id="three turns"),
    pytest.param({**head(), "cycle_turns": 0}, "cycle_turns", "1 or 2", id="no turn"),
    pytest.param({"cycle_turns": 2}, "head", "head or crank", id="no side"),
    pytest.param(head(dead_centre_deg=180), "dead_centre_deg", "outer dead centre", id="inner dead centre"),
    pytest.param(head(dead_centre_deg=0.1), "dead_centre_deg", "outer dead centre", id="near a dead centre"),
    pytest.param(head(dead_centre_deg=1080), "dead_centre_deg", "cycle", id="a dead centre beyond the cycle"),
    pytest.param(head(dead_centre_deg=-360), "dead_centre_deg", "cycle", id="a dead centre before the cycle"),
    pytest.param({"head": ONE, "dead_centre_deg": 720}, "dead_centre_deg", "cycle", id="a second turn that is none"),
    pytest.param({"crank": {**ONE, "angle_deg": [0, 200, 100, 360]}}, "crank/angle_deg/2", "rise", id="crank side"),
]


@pytest.mark.parametrize(("pressure", "field", "words"), REFUSED)
def test_a_refusal_names_the_field(pressure: dict[str, Any], field: str, words: str) -> None:
    refusal = refused(pressure)
    assert list(refusal) == [f"{AT}/{field}"]
    assert words in refusal[f"{AT}/{field}"]


@pytest.mark.parametrize(
    "pressure",
    [
        head(),
        head(dead_centre_deg=0),
        head(dead_centre_deg=360),
        head(dead_centre_deg=720),
        head({"angle_deg": [5, 100, 300, 500, 700]}),
        head({"angle_deg": [5, 100, 300, 500, 720]}),
        head({"pressure_Pa": ["50 bar", "1 MPa", 0, "14.5 psi", "5e3 kPa"]}),
        # computed, and rounded at its end
        head({"pressure_Pa": [5e6, 1e6, 1e5, 1e5, 5e6 * (1 + 1e-13)]}),
        {"head": ONE, "crank": ONE},
        {"crank": CLOSED, "cycle_turns": 2},
    ],
)
def test_traces_that_are_a_cycle(pressure: dict[str, Any]) -> None:
    ReciprocatingMachine.model_validate(with_pressure(pressure))


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_the_dead_centres_of_a_row_follow_its_crank_and_the_rotation(rotation: str) -> None:
    for start in (100.0, 460.0):
        ReciprocatingMachine.model_validate(with_pressure(head(dead_centre_deg=start), fired=100.0, rotation=rotation))
    assert list(refused(head(dead_centre_deg=260.0), fired=100.0, rotation=rotation)) == [f"{AT}/dead_centre_deg"]
