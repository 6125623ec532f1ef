"""Machines of every kind, and what the mechanics make of a whole machine."""

from collections.abc import Callable
from functools import cache
from hashlib import sha256
from typing import Any

import numpy as np
from pydantic import TypeAdapter

from optimizer.analyze import analyze
from optimizer.mechanics import (
    balance_shafts,
    crank_of_web,
    cylinders,
    fixed_weights,
    frame,
    gas,
    inertia,
    roll,
    row_work,
    scatter,
    shaft,
    shaft_curves,
    shapes,
)
from optimizer.mechanics.curve_batch import CurveBatch
from optimizer.mechanics.indicated import Trace, entries
from optimizer.mechanics.kinematics import motion, own_angle
from optimizer.mechanics.layout import Layout, layout
from optimizer.mechanics.reading import READINGS
from optimizer.mechanics.row_data import row_data
from optimizer.mechanics.whole_turn import TurnCurves, WholeTurn, break_angles, whole_turn
from optimizer.responses.curve import TurnResponse
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import AnalyzeRequest
from tests.analyze.driven import random_driven
from tests.pairs.asking import body_of

_ANGLES = np.array([0.1, 1.3, 2.9, 4.4, 6.1])
_PRESSURE = {
    "head": {"angle_deg": [0, 20, 180, 360, 540, 700, 720], "pressure_Pa": [9e5, 1.2e6, 3e5, 1e5, 1e5, 5e5, 9e5]},
    "cycle_turns": 2,
}
_PAIRS: dict[str, tuple[str, ...]] = {
    "twin": ("friction", "clockwise", "offset row", "unbalances", "fixed"),
    "twin, pressure": ("indicated pressure", "three bearings", "reference plane", "balance quality"),
    "twin, plates": ("plates, segments", "endless rod", "parts"),
    "vee": ("balance shaft backwards", "gas", "continuous shaft"),
    "vee, order 2": ("balance shaft of order 2", "kinematics of order 2", "friction", "clockwise"),
    "scroll": ("reference plane", "fixed"),
}


@cache
def scenes() -> dict[str, dict[str, Any]]:
    """Machines with what is to be known of how they are looked at, as clients post them."""
    bodies = {}
    for name, features in _PAIRS.items():
        body = body_of(name.partition(",")[0], features)
        assert body is not None
        bodies[name] = {"machine": body["machine"], "fidelity": body.get("fidelity", {})}
    rows = bodies["twin, pressure"]["machine"]["throws"][1]["rows"]
    # of four strokes, a trunk piston that is open to the crankcase
    rows[0]["cylinder"] = {"bore_m": 0.1, "ambient_pressure_Pa": 1e5, "pressure": _PRESSURE}
    webs = bodies["twin, plates"]["machine"]["webs"]
    webs[1]["envelope"] = {**webs[0]["envelope"], "shape": "sector", "inner_radius_m": 0.04}
    webs[3] = {"name": webs[3]["name"], "position_m": webs[3]["position_m"], "envelope": webs[0]["envelope"]}
    bodies["w"] = {"machine": random_driven(7, "w", throws=2)}
    return bodies


@cache
def machine(name: str) -> Machine:
    """One of them."""
    design: Machine = TypeAdapter(Machine).validate_python(scenes()[name]["machine"])
    return design


def _exact(name: str) -> bool:
    return scenes()[name].get("fidelity", {}).get("kinematics") != "order_2"


@cache
def _layout(name: str) -> Layout:
    return layout(machine(name))


@cache
def _traces(name: str) -> tuple[Trace, ...]:
    return cylinders.traces(_driven(name), _layout(name))


@cache
def _turn(name: str) -> WholeTurn:
    plan, data = _layout(name), cylinders.chambers(_driven(name))
    opens = gas.switching_angles(data, plan, _exact(name))
    cut = break_angles(plan, opens, _traces(name))
    friction = 100.0 * np.arange(1.0, plan.reciprocating.mass.size + 1.0)
    return whole_turn(row_data(plan, _exact(name), friction, data, _traces(name)), cut)


def _unbalance(name: str) -> Any:
    webs = np.arange(1.0, len(machine(name).webs) + 1.0)
    return 0.1 * webs * np.exp(2j * webs)


def _of_curves(curves: TurnCurves) -> list[Any]:
    pieces = curves.pieces
    piece = np.flatnonzero(pieces.half[0] > 0.0)[[0, -1]]
    first = np.zeros(2, int)
    middle, half = pieces.centre[0, piece], 0.5 * pieces.half[0, piece]
    return [
        pieces.centre, pieces.half, pieces.cubic, pieces.rest, pieces.size, curves.mean, curves.variance,
        np.log(curves.rms_error), curves.at(_ANGLES), curves.in_pieces(np.array([-1.0, 0.3])), curves.period_deg,
        curves.cubics(first, piece, middle, half), curves.values(first, piece, middle + half),
    ]  # fmt: skip


def _of_response(response: TurnResponse, name: str) -> list[Any]:
    more = np.ones(response.influence.size - len(machine(name).webs)) * 0.3j
    unbalance = np.concatenate([_unbalance(name), more])
    added = np.atleast_1d(response.contribution(unbalance, _ANGLES))
    return [response.name, response.unit, response.at(_ANGLES), added, response.curves.mean]


def _readings(name: str) -> list[Any]:
    turn = _turn(name)
    return [_of_curves(turn.of_rows(reading)) for reading in READINGS]  # type: ignore[arg-type]


def _row_parts(name: str) -> list[Any]:
    parts = _turn(name).torque.parts
    curve, piece = np.zeros(2, int), np.flatnonzero(parts.half > 0.0)[[0, -1]]
    centre, half = parts.centre[piece], parts.half[piece]
    return [
        parts.largest, parts.fourth(curve, piece), parts.cubics(curve, piece, centre, 0.5 * half),
        parts.values(curve, piece, centre + 0.1 * half), parts.at(0, _ANGLES),
    ]  # fmt: skip


def _batch(name: str) -> list[Any]:
    turn = _turn(name)
    batch = CurveBatch((turn.curves("side", np.eye(2)[None]), turn.curves("rod", np.ones((1, 1, 2)))))
    pieces = batch.pieces
    return [batch.first, pieces.cubic, pieces.rest, pieces.size, batch.parts[1].pieces.cubic]


def _on_the_turn(name: str) -> list[Any]:
    turn, plan, places = _turn(name), _layout(name), shaft.bearing_places(machine(name))
    named = {"force": ("N", frame.FORCE), "moment": ("N m", frame.MOMENT), "c": ("N", frame.Shares(0.4, 1.7))}
    bearing_loads = [*frame.shaking(turn, plan, named), roll.roll(turn, plan)]
    if plan.balance is not None and np.any(plan.balance.ratio == -1.0):
        bearing_loads.append(roll.mirrored(bearing_loads[-1], plan.balance))
    for influence in shaft.INFLUENCES.values():
        bearing_loads += shaft_curves.bearing_loads(turn, plan, [str(n) for n in range(places.size)], places, influence)
        bearing_loads += shaft_curves.bending_moments(turn, plan, places, influence)
    return [_of_response(bearing_load, name) for bearing_load in bearing_loads]


def _first_order(name: str) -> list[Any]:
    plan = _layout(name)
    wrench = inertia.rotating(plan).plus(inertia.reciprocating(plan, 1))
    first_order_responses = balance_shafts.first_order_responses(plan, wrench)
    parts = scatter.row_parts(plan)
    signs = [scatter.worst_signs(pair, *weights) for pair in parts for weights in ((1.0, 1.0), (0.3, 1.0))]
    mixed = frame.first_order("c", "N", frame.Shares(0.4, 1.7), *first_order_responses)
    return [wrench, first_order_responses, mixed, parts, signs, scatter.changed(parts.force, signs[0], 0.1)]


def _driven(name: str) -> ReciprocatingMachine:
    design = machine(name)
    assert isinstance(design, ReciprocatingMachine)
    return design


def _gas(name: str) -> list[Any]:
    driven, plan = _driven(name), _layout(name)
    data, moving = cylinders.chambers(driven), motion(plan, _ANGLES, _exact(name))
    forces = gas.gas_forces(data, moving, plan, _traces(name))
    counts = [cylinders.cycle_turns(driven), cylinders.entry_count(driven), cylinders.without_gas(driven)]
    ahead = own_angle(plan, np.zeros(1))[..., 0]
    actual_entries = [entries(_traces(name), ahead)] if _traces(name) else []
    rules = [rule.broken for rules in (cylinders.delivery_rules, cylinders.trace_rules) for rule in rules(driven, plan)]
    problems = [[problem.path, problem.message] for problem in cylinders.gas_problems(driven)]
    return [data, forces.pressure, forces.total, counts, _traces(name), actual_entries, rules, problems]


def _work(name: str) -> list[Any]:
    plan = _layout(name)
    friction = 100.0 * np.arange(1.0, plan.reciprocating.mass.size + 1.0)
    work = row_work.RowWork(plan, friction, cylinders.chambers(_driven(name)))
    fluctuation = work.fluctuation(_turn(name).torque)
    return [work.of_a_turn, work.beside_mean(_ANGLES), fluctuation.value]


def _fixed(name: str) -> list[Any]:
    design = machine(name)
    webs = np.arange(1.0, len(design.webs) + 1.0)
    beside = fixed_weights.beside(design, webs, 10.0 * webs)
    return [
        fixed_weights.fixed_webs(design), fixed_weights.fixed_masses(design), beside,
        fixed_weights.laden(_layout(name), design).rotating,
    ]  # fmt: skip


def _plates(name: str) -> list[Any]:
    design = machine(name)
    plates = shapes.plates(design)
    assert plates is not None
    angle = np.array([0.3, 0.9, 0.5]) * plates.most
    masses, unbalances = plates.mass(angle), plates.unbalance(angle)
    figures = [masses, unbalances, plates.lever(angle), plates.inertia(angle), plates.chord(angle)]
    opened = [
        plates.opened(unbalances), plates.opened_for(masses), plates.mass_of(unbalances),
        plates.opened_by_mass(masses, unbalances / masses), plates.opened_for(10.0 * masses),
    ]  # fmt: skip
    every = np.array([0.4, 0.3, 9.0, 0.2])
    fits = (shapes.fitted(design, angle), shapes.closed(design), shapes.fitted_masses(design, every))
    return [plates.webs, plates.kinds, plates.outer, plates.most, figures, opened, [_radii(engine) for engine in fits]]


def _radii(design: Machine) -> list[Any]:
    return [web.radius_m for web in design.webs]


def _cranks(name: str) -> list[Any]:
    design = machine(name)
    shares = [crank_of_web.shares(design)] if isinstance(design, ReciprocatingMachine) else []
    return [shares, crank_of_web.own_throws(design), crank_of_web.crank_angles(design)]


_OUTPUTS = {
    "reciprocating": (
        "residual", "hodograph", "orders", "foundation_loads", "kinematics", "piston_force", "rod_loads", "torque",
        "overturning", "main_bearings", "roll", "loads", "internal_moment", "stages",
    ),
    "scroll": ("residual", "hodograph", "orders", "foundation_loads", "internal_moment"),
}  # fmt: skip


def _answer(name: str) -> Any:
    scene = scenes()[name]
    body = {"machine": scene["machine"], "fidelity": scene.get("fidelity", {}), "angles": {"step_deg": 60.0}}
    outputs = list(_OUTPUTS[scene["machine"]["kind"]])
    if cylinders_of(name):
        outputs.append("gas")
    webs = [web["name"] for web in scene["machine"]["webs"] if "fixed" not in web]
    counterweights = [{"web": web, "mass_kg": 0.5 + n, "angle_deg": 40.0 * n} for n, web in enumerate(webs)]
    request = AnalyzeRequest.model_validate({**body, "outputs": outputs, "counterweights": counterweights})
    fields = analyze(request).model_dump(exclude={"timing", "version", "effects"})
    return {output: _listed(value) for output, value in fields.items() if value is not None}


def _listed(value: Any) -> list[Any]:
    """The numbers of an output side by side, and a word for all the rest of it."""
    numbers: list[float] = []
    rest: list[Any] = []

    def walk(subject: Any) -> None:
        for single_subject in subject.values() if isinstance(subject, dict) else subject:
            if isinstance(single_subject, dict | list | tuple):
                walk(single_subject)
            else:
                (numbers if isinstance(single_subject, float) else rest).append(single_subject)

    walk([value])
    return [np.array(numbers), sha256(repr(rest).encode()).hexdigest()[:12]]


def cylinders_of(name: str) -> bool:
    """Whether every row of a machine has gas."""
    design = machine(name)
    return isinstance(design, ReciprocatingMachine) and not cylinders.without_gas(design)


_TURNING = ("twin", "twin, pressure", "vee", "vee, order 2", "w")
#: what is made of a machine, by name: of which of the machines, and how
OF_MACHINES: dict[str, tuple[tuple[str, ...], Callable[[str], Any]]] = {
    "layout": (tuple(_PAIRS), lambda name: vars(_layout(name))),
    "first order": (("twin", "vee", "vee, order 2", "w"), _first_order),
    "gas": (_TURNING, _gas),
    "readings": (("twin", "twin, pressure", "vee, order 2"), _readings),
    "row parts": (("twin", "vee, order 2"), _row_parts),
    "batch": (("twin",), _batch),
    "on the turn": (_TURNING, _on_the_turn),
    "work": (("twin", "vee"), _work),
    "fixed": (("twin", "scroll", "vee"), _fixed),
    "plates": (("twin, plates",), _plates),
    "cranks": (tuple(_PAIRS), _cranks),
    "answer": ((*_PAIRS, "w"), _answer),
}
