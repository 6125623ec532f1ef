"""What is asked of random machines: each mode draws a request and tells the counterweights of all its answers."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from optimizer.optimize import optimize
from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.sweep import run_chunk
from schemas.front.pareto import ParetoRequest
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.common.validation import check
from tests.dust import machines
from tests.dust.need import is_needed, is_needed_at
from tests.hard.cases.case import Body

Draw = Callable[[np.random.Generator], Body]

_ORDERED = ("external", "bearings", "bending")


class Fitted(NamedTuple):
    """The counterweights of one answer."""

    status: str
    mass_kg: Mapping[str, float]  # by their webs; none that were there already
    opened_deg: Mapping[str, float]  # half-angles of plates that are cut
    needs: Callable[[str], bool] = lambda web: False  # whether it is proven of a web that no such answer lacks it


class Mode(NamedTuple):
    """How requests are drawn, and which way in they take."""

    draw: Draw
    answers: Callable[[Body], Iterator[Fitted]]
    weight: int  # how often, against the others


def _masses_and_openings(counterweights: Any) -> tuple[dict[str, float], dict[str, float]]:
    mass = {counterweight.web: counterweight.mass_kg for counterweight in counterweights if not counterweight.fixed}
    opened = {
        counterweight.web: counterweight.shape.half_angle_deg
        for counterweight in counterweights
        if counterweight.shape is not None and counterweight.mass_kg > 0
    }
    return mass, opened


def of_request(body: Body) -> Iterator[Fitted]:
    request = check(OptimizeRequest, body)
    answer = optimize(request)
    everywhere = [
        *answer.counterweights,
        *(counterweight for shaft in answer.balance_shafts or () for counterweight in shaft.counterweights),
    ]
    yield Fitted(answer.status, *_masses_and_openings(everywhere), partial(is_needed, request, answer))


def of_front(body: Body) -> Iterator[Fitted]:
    request = check(ParetoRequest, body)
    answer = pareto(request)
    for front in answer.fronts:
        for point in front.points:
            needs = partial(is_needed_at, request, front, point)
            yield Fitted(front.status, *_masses_and_openings(point.counterweights), needs)
    for trade in answer.trades:
        for traded in trade.points:
            yield Fitted(trade.status, *_masses_and_openings(traded.counterweights))


def of_rows(body: Body) -> Iterator[Fitted]:
    request = check(SweepRequest, body)
    for row in run_chunk(request.model_dump_json().encode(), 0, request.total).to_pylist():
        if row["status"] == "failed":
            raise RuntimeError(row["message"])
        mass = {name[8:]: value for name, value in row.items() if name.startswith("mass_kg.") and value is not None}
        yield Fitted(row["status"], mass, {})


def _first_order(sectors: float = 0.0, **objective: object) -> Draw:
    return lambda rng: {"machine": machines.crankshaft(rng, sectors), "objective": objective}


def _across(rng: np.random.Generator) -> Body:
    body = _first_order(_half(rng))(rng)
    weights = {"x": float(rng.uniform(0.2, 1.0)), "y": float(rng.uniform(0.0, 1.0))}
    body["objective"] = {"combine": str(rng.choice(["sum", "max"])), "direction_weights": weights}
    return body


def _half(rng: np.random.Generator) -> float:
    """No sectors, or many."""
    return float(rng.choice([0.0, 0.8]))


def _budget(rng: np.random.Generator) -> Body:
    return {"machine": machines.with_budget(rng, machines.crankshaft(rng, _half(rng)))}


def _ceilings(rng: np.random.Generator) -> Body:
    """Ceilings a little above the smallest peaks of their own."""
    body = _first_order(_half(rng))(rng)
    of_force = bool(rng.random() < 0.5)
    alone = {"force_weight": float(of_force), "moment_weight": float(not of_force)}
    answer = optimize(check(OptimizeRequest, {**body, "objective": alone}))
    assert answer.certificate is not None
    field = "force_ceiling_N" if of_force else "moment_ceiling_Nm"
    body["objective"] = {field: float(rng.uniform(1.01, 2.0)) * answer.certificate.objective}
    return body


def _any_optimum(rng: np.random.Generator) -> Body:
    return {"machine": machines.crankshaft(rng, _half(rng)), "objective": {"least_mass": False}}


def _gaps(rng: np.random.Generator) -> Body:
    """Gaps that are asked for, of all sizes."""
    return {"machine": machines.crankshaft(rng, 0.8), "accuracy": {"relative_gap": float(10 ** rng.uniform(-9, -2))}}


def _tolerances(rng: np.random.Generator) -> Body:
    """What masses and angles may be off, which makes cone programs of larger size."""
    scatter = {"mass_relative": float(rng.uniform(0, 0.05)), "angle_deg": float(rng.uniform(0, 3))}
    return {"machine": machines.crankshaft(rng, _half(rng), most_throws=3), "tolerances": scatter}


def _groups(rng: np.random.Generator) -> Body:
    return {"machine": machines.with_groups(rng, machines.crankshaft(rng, _half(rng)))}


def _balance_shafts(rng: np.random.Generator) -> Body:
    return {"machine": machines.with_balance_shafts(rng, machines.crankshaft(rng, _half(rng)))}


def _plates(rng: np.random.Generator) -> Body:
    return {"machine": machines.with_plates(rng, machines.crankshaft(rng, _half(rng)))}


def _plates_in_budget(rng: np.random.Generator) -> Body:
    """Plates under a limit of the total mass, or of which any optimum will do."""
    machine = machines.with_budget(rng, machines.crankshaft(rng, _half(rng)))
    body: Body = {"machine": machines.with_plates(rng, machine)}
    if rng.random() < 0.5:
        del machine["max_total_mass_kg"]
        body["objective"] = {"least_mass": False}
    return body


def _scenarios(rng: np.random.Generator) -> Body:
    machine = machines.crankshaft(rng, _half(rng), most_throws=3)
    return {"machine": machine, "scenarios": machines.scenarios(rng, machine)}


def _turn(**objective: object) -> Draw:
    """Over the turn, with bearings and rods."""
    return lambda rng: {
        "machine": machines.crankshaft(rng, _half(rng), rods=True, most_throws=4),
        "objective": objective,
        "angles": {"step_deg": 30},
    }


def _bearings(rng: np.random.Generator) -> Body:
    measure = str(rng.choice(["peak", "rms", "specific"]))
    return _turn(force_weight=0, moment_weight=0, bearing_weight=1, bearing_measure=measure)(rng)


def _bending(rng: np.random.Generator) -> Body:
    return _turn(bearing_weight=1, bending_weight=2.0)(rng)


def _priorities(rng: np.random.Generator) -> Body:
    """One to three goals, in any order."""
    count = int(rng.integers(1, 4))
    named = [
        {"goal": str(name), "allowance": float(rng.choice([0.0, 1e-3, 0.05]))} for name in rng.permutation(_ORDERED)
    ]
    chosen = [fields for fields in named if fields["goal"] == "external" or count > 1][:count]
    weights = {"bearings": "bearing_weight", "bending": "bending_weight"}
    fields: Body = {weights[fields["goal"]]: 1.0 for fields in chosen if fields["goal"] in weights}
    if all(fields["goal"] != "external" for fields in chosen):
        fields |= {"force_weight": 0, "moment_weight": 0}
    if rng.random() < 0.5:
        chosen.append({"goal": "mass"})
    return _turn(priorities=chosen, **fields)(rng)


def _light(rng: np.random.Generator) -> Body:
    """The mass with what the first order allows it."""
    body = _first_order(_half(rng))(rng)
    allowed = {"goal": "external", "allowance": float(rng.choice([1e-4, 1e-3, 0.02, 0.1]))}
    return {**body, "objective": {**body["objective"], "priorities": [allowed, {"goal": "mass"}]}}


def _front(rng: np.random.Generator) -> Body:
    return {"machine": machines.with_budget(rng, machines.crankshaft(rng, _half(rng))), "points": 5}


def _traded(rng: np.random.Generator) -> Body:
    body = {"machine": machines.crankshaft(rng, _half(rng), most_throws=3), "points": 3}
    return {**body, "responses": [str(rng.choice(["force", "moment"])), "mass"]}


def _rows(rng: np.random.Generator) -> Body:
    machine = machines.crankshaft(rng, _half(rng))
    path = f"/machine/webs/{rng.integers(len(machine['webs']))}/max_mass_kg"
    return {"base": {"machine": machine}, "axes": [{"path": path, "values": [1.0, 5.0, 25.0, 125.0]}]}


MODES: Mapping[str, Mode] = {
    "first order": Mode(_first_order(), of_request, 10),
    "sectors": Mode(_first_order(0.8), of_request, 30),
    "largest of both": Mode(_first_order(0.8, combine="max"), of_request, 10),
    "directions": Mode(_across, of_request, 10),
    "budget": Mode(_budget, of_request, 10),
    "ceilings": Mode(_ceilings, of_request, 10),
    "any optimum": Mode(_any_optimum, of_request, 10),
    "groups": Mode(_groups, of_request, 5),
    "balance shafts": Mode(_balance_shafts, of_request, 5),
    "gaps": Mode(_gaps, of_request, 10),
    "tolerances": Mode(_tolerances, of_request, 1),
    "plates": Mode(_plates, of_request, 10),
    "plates in budget": Mode(_plates_in_budget, of_request, 3),
    "scenarios": Mode(_scenarios, of_request, 3),
    "all orders": Mode(_turn(orders="all"), of_request, 2),
    "bearings": Mode(_bearings, of_request, 2),
    "bending": Mode(_bending, of_request, 2),
    "priorities": Mode(_priorities, of_request, 5),
    "light": Mode(_light, of_request, 5),
    "front": Mode(_front, of_front, 5),
    "trade": Mode(_traded, of_front, 2),
    "rows": Mode(_rows, of_rows, 10),
}
