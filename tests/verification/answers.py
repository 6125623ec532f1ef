"""Requests of every kind of answer, by name, and their answers: what the table of tampering goes through."""

import copy
import json
from functools import cache
from typing import Any

from optimizer.optimize import optimize
from optimizer.studies.matching.match import match
from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.sweep.rows import rows
from optimizer.studies.sweep.table import result_schema, result_table
from schemas.front.pareto import ParetoRequest
from schemas.match.request import MatchRequest
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.documents.examples import bodies
from tests.pairs.asking import body_of
from tests.verification.kinds import SINGLE

Body = dict[str, Any]

#: pairs of tests/pairs that make a kind of their own: machine, features
_FEATURES: dict[str, tuple[str, tuple[str, ...]]] = {
    "groups": ("twin", ("mirrored group",)),
    "orders of all": ("vee", ("orders all", "combine max")),
    "bearings": ("twin", ("bearings alone",)),
    "bearings, rms": ("twin", ("bearing rms",)),
    "bearings, specific": ("twin", ("bearing specific", "clockwise")),
    "bending": ("twin", ("bending weight", "three bearings")),
    "continuous shaft": ("twin", ("bearing weight", "three bearings", "continuous shaft")),
    "gas": ("twin", ("bearing weight", "gas")),
    "indicated pressure": ("twin", ("bearing weight", "indicated pressure")),
    "ceilings over the turn": ("twin", ("bearing_ceiling_N near",)),
    "infeasible over the turn": ("twin", ("ceilings out of reach",)),
    "priorities": ("twin", ("priorities",)),
    "priorities of the first order": ("twin", ("external, then mass",)),
    "scenarios": ("twin", ("scenario of masses",)),
    "scenarios over the turn": ("vee", ("scenario of speed", "bearing weight")),
    "tolerances": ("twin", ("tolerances of masses and angles", "tolerance of unbalance")),
    "tolerances of rows": ("vee", ("tolerances of rows",)),
    "tolerances over the turn": ("twin", ("tolerances of masses and angles", "bearing weight")),
    "balance shaft": ("vee", ("balance shaft backwards",)),
    "balance shaft, orders": ("vee", ("balance shaft of order 2", "orders all")),
    "roll": ("vee", ("balance shaft backwards", "roll weight")),
    "plates, sectors": ("twin", ("plates, sectors",)),
    "plates, segments, budget": ("twin", ("plates, segments", "budget")),
    "catalogue": ("twin", ("masses of a catalogue", "steps")),
    "catalogue over the turn": ("twin", ("masses of a catalogue", "steps", "bearing weight")),
    "least fitted": ("vee", ("least fitted",)),
    "balance quality": ("twin", ("balance quality", "unbalances")),
}


def _pair(base: str, *features: str) -> Body:
    body = body_of(base, features, 2.0)
    assert body is not None
    return body


def _first_page(body: Body, **more: Any) -> Body:
    """What the page asks for first."""
    outputs = ["hodograph", "orders", "foundation_loads"]
    return {**body, **more, "outputs": outputs, "angles": {"step_deg": 5.0}}


def _dynamics(body: Body) -> Body:
    """What rows do over the revolution."""
    outputs = ["kinematics", "gas", "piston_force", "rod_loads", "torque", "overturning", "main_bearings", "roll"]
    outputs += ["loads", "internal_moment"]
    return {**body, "outputs": outputs, "angles": {"step_deg": 30.0}}


def _weighed(body: Body) -> Body:
    """With a direction of gravity, and a foundation."""
    more = {"gravity_deg": 123.0, "stationary_mass_kg": 300.0}
    return {**body, "machine": {**body["machine"], **more}, "outputs": ["loads"], "angles": {"step_deg": 30.0}}


def _four_strokes() -> Body:
    """One row with friction, the other with a pressure over two revolutions, the first of its dead centres given."""
    body = _dynamics(_pair("twin", "friction", "clockwise"))
    table = {"angle_deg": [0, 20, 180, 360, 540, 700, 720], "pressure_Pa": [9e5, 1.2e6, 3e5, 1e5, 1e5, 5e5, 9e5]}
    row = body["machine"]["throws"][0]["rows"][0]
    trunk = {"bore_m": 0.1, "ambient_pressure_Pa": 1e5}
    row["cylinder"] = {**trunk, "pressure": {"head": table, "cycle_turns": 2}}
    body["machine"]["flywheel"] = {"inertia_kg_m2": 40.0}
    body["outputs"] = [*body["outputs"], "flywheel"]
    return body


@cache
def _requests() -> dict[str, Body]:
    pairs = {name: SINGLE[name] for name in ("sum", "max", "direction weights", "budget and ceiling", "infeasible")}
    pairs |= {name: SINGLE[name] for name in ("no limits, max, sector", "2d12", "scroll-oldham")}
    for name, (base, features) in _FEATURES.items():
        pairs[name] = _pair(base, *features)
    pairs["shaking"] = _first_page(_pair("vee", "clockwise"), fitted=[{"web": "a", "mass_kg": 2.0, "angle_deg": 75.0}])
    pairs["shaking, balance shaft"] = _first_page(_pair("vee", "balance shaft of order 2"))
    pairs["stages"] = {**_pair("vee", "balance shaft of order 2"), "outputs": ["stages"]}
    pairs["pin loads"] = {**SINGLE["scroll-three-pins"], "outputs": ["pin_loads"], "angles": {"step_deg": 30.0}}
    pairs["weights"] = _weighed(_pair("twin"))
    pairs["dynamics"] = _dynamics(_pair("vee", "friction", "bearing weight"))
    pairs["four strokes"] = _four_strokes()
    pairs["front"] = {**SINGLE["sum"], "points": 3, "multipliers": True}
    masses = {"path": "/machine/throws/0/rows/0/reciprocating_mass_kg", "values": [9.0, 14.0]}
    pairs["sweep"] = {"base": SINGLE["ceilings"], "axes": [masses], "multipliers": True}
    pairs["matching"] = bodies("match")["2d12"]
    return pairs


def names() -> tuple[str, ...]:
    """All kinds."""
    return tuple(_requests())


def request_of(name: str) -> Body:
    """Request of a kind."""
    return copy.deepcopy(_requests()[name])


def answered(body: Body) -> Any:
    """The answer to a request of any kind."""
    return json.loads(_answer(body))


@cache
def _text(name: str) -> str:
    return _answer(_requests()[name])


def _answer(body: Body) -> str:
    if "parts" in body:
        return match(MatchRequest.model_validate(body)).model_dump_json()
    if "base" in body:
        request = SweepRequest.model_validate(body)

        table = result_table(rows(request, 0, request.total), result_schema(request, b"{}"))
        return json.dumps(table.to_pylist())
    if "points" in body:
        return pareto(ParetoRequest.model_validate(body)).model_dump_json()
    return optimize(OptimizeRequest.model_validate(body)).model_dump_json()


def pair(name: str) -> tuple[Body, Any]:
    """Request and answer of a kind."""
    return request_of(name), json.loads(_text(name))
