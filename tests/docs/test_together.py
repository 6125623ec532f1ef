"""The table of docs/api/together.md, cell by cell against what requests are refused (property)."""

import json
import re
from collections.abc import Callable
from typing import Any

import pytest
from pydantic import BaseModel, ValidationError

from schemas.front.pareto import ParetoRequest
from schemas.match.request import MatchRequest
from schemas.request.accuracy import AccuracyRequest
from schemas.request.requests import OptimizeRequest
from schemas.request.rounding import RoundRequest
from schemas.sweep.request import SweepRequest
from tests.docs.reading import ROOT, document

Machine = dict[str, Any]
CATALOGUE = "catalogue, holes, `max_counterweights`"


def plain() -> Machine:
    """Two throws and four webs whose counterweights have any mass at any angle."""
    machine: Machine = json.loads((ROOT / "examples/catalogue-twin.json").read_text())["machine"]
    del machine["catalogue"], machine["webs"][3]["hole_angles_deg"]
    machine["bearings"] = [{"name": "a", "position_m": -0.6}, {"name": "b", "position_m": 0.6}]
    return machine


def grouped(machine: Machine) -> None:
    machine["web_groups"] = [{"name": "g", "webs": ["1a", "2b"]}]


def chosen(machine: Machine) -> None:
    machine["catalogue"] = {"masses_kg": [4, 11, 16], "angle_step_deg": 30}


def fitted(machine: Machine) -> None:
    machine["webs"][0]["min_fitted_mass_kg"] = 6


def cut(machine: Machine) -> None:
    web = machine["webs"][2]
    del web["counterweight_radius_m"], web["max_mass_kg"]
    web["envelope"] = {"shape": "sector", "inner_radius_m": 0.06, "outer_radius_m": 0.15, "thickness_m": 0.03}


def geared(machine: Machine) -> None:
    place = {"name": "s", "position_m": 0, "counterweight_radius_m": 0.1, "max_mass_kg": 9}
    machine["balance_shafts"] = [{"name": "back", "speed_ratio": -1, "webs": [place]}]


def fixed(machine: Machine) -> None:
    machine["webs"][1]["fixed"] = {"mass_kg": 10, "angle_deg": 270}


FIELDS: dict[str, Callable[[Machine], None]] = {
    "`web_groups`": grouped,
    CATALOGUE: chosen,
    "`min_fitted_mass_kg`": fitted,
    "`envelope`": cut,
    "`fixed`": fixed,
}
#: what stands in rows alone
MORE: dict[str, Callable[[Machine], None]] = {"`balance_shafts`": geared}
PARTS = {"class": "piston", "names": ["p"], "masses_kg": [5], "rows": [{"throw": 0, "row": 0}]}
FEATURES: dict[str, tuple[type[BaseModel], dict[str, Any]]] = {
    "ceilings, or a budget": (OptimizeRequest, {"objective": {"force_ceiling_N": 6e4}}),
    "goals over a revolution": (OptimizeRequest, {"objective": {"bearing_weight": 1}}),
    "goals in their order: `priorities`": (OptimizeRequest, {"objective": {"priorities": [{"goal": "external"}]}}),
    "`orders: all` with a ceiling along an axis": (
        OptimizeRequest,
        {"objective": {"orders": "all", "force_ceiling_x_N": 6e4}},
    ),
    "`scenarios`": (OptimizeRequest, {"scenarios": [{"name": "as it is"}]}),
    "`tolerances`": (OptimizeRequest, {"tolerances": {"mass_relative": 0.02}}),
    "front of force and moment": (ParetoRequest, {}),
    "front of named `responses`": (ParetoRequest, {"responses": ["force", "bearings"], "points": 3}),
    "front of `counts`": (ParetoRequest, {"counts": {"of": "weights", "least": "objective"}}),
    "`POST /v1/match`": (MatchRequest, {"parts": [PARTS]}),
    "`POST /v1/round`": (RoundRequest, {"mass_step_kg": 1, "angle_step_deg": 15}),
    "`POST /v1/accuracy`": (AccuracyRequest, {}),
}


def cells() -> list[tuple[str, str, str]]:
    rows = re.findall(r"^\|([^-].*)\|$", document("docs/api/together.md"), re.MULTILINE)
    head, *body = [[cell.strip() for cell in row.split("|")] for row in rows]
    return [(row[0], over, cell) for row in body for over, cell in zip(head[1:], row[1:], strict=True) if cell]


def taken(model: type[BaseModel], body: dict[str, Any]) -> bool:
    try:
        model.model_validate(body)
    except ValidationError:
        return False
    return True


@pytest.mark.parametrize(("row", "column", "cell"), cells())
def test_a_cell(row: str, column: str, cell: str) -> None:
    machine = plain()
    FIELDS[column](machine)
    if row in FIELDS or row in MORE:
        (FIELDS | MORE)[row](machine)
        went = taken(OptimizeRequest, {"machine": machine})
    elif row.startswith("sweeps"):
        orders = {"design": "crank_orders", "angles_deg": [90, 180]}
        speeds = {"axes": [{"path": "/machine/speed_rpm", "values": [900, 980]}]}
        design = speeds if row == "sweeps" else orders
        went = taken(SweepRequest, {"base": {"machine": machine}} | design)
    else:
        model, more = FEATURES[row]
        if cell.endswith("with a catalogue"):
            chosen(machine)
        wrapped = {"request": {"machine": machine}} if model is RoundRequest else {"machine": machine}
        went = taken(model, wrapped | more)
    # "no web of a group": the fixed web of this machine is in none
    assert went == cell.startswith(("yes", "as", "no web"))
