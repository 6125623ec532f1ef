"""The functions of the mechanics, and designs that they are tried with."""

from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass, replace
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np

from optimizer.mechanics import (
    angles,
    balance_quality,
    balance_rate,
    balance_shafts,
    bearings,
    foundation,
    frame,
    friction,
    gas,
    inertia,
    oldham,
    rod,
    shaft_curves,
    weight,
)
from optimizer.mechanics.envelope import AnnularSector, Segment, opened_for
from optimizer.mechanics.indicated import Trace
from optimizer.mechanics.internal_moment import internal_moment
from optimizer.mechanics.kinematics import motion, own_angle, steep_angles
from optimizer.mechanics.layout import BalanceWebs, Layout
from optimizer.mechanics.row_data import row_data
from optimizer.mechanics.row_work import RowWork
from optimizer.mechanics.slider_crank import acceleration_harmonic, acceleration_harmonic_order_2
from optimizer.mechanics.turn import fluctuation, mean, panels
from optimizer.mechanics.whole_turn import TurnCurves, break_angles, whole_turn
from tests.analyze.driven import arrays, random_driven

LEADING = (2, 3)
_T, _B = 5, 3


class Design(NamedTuple):
    """One of the designs, or all of them: arrays (...)."""

    layout: Layout
    chambers: gas.Chambers
    shafts: BalanceWebs
    angle: Any  # (..., T) rad
    unbalance: Any  # (..., webs) kg m
    of_rows: Any  # (..., rows) above 0
    over_turn: Any  # (..., rows, T)
    bearings: Any  # (..., B) m
    planes: Any  # (..., L) m
    loads: Any  # (..., L, T)
    number: Any  # (...) from 0.2 to 0.9
    axis: Any  # (...) a unit vector


def _design(seed: int) -> Design:
    plan, chambers = arrays(random_driven(seed, "v", throws=2))
    rng = np.random.default_rng(seed)
    rows = plan.reciprocating.mass.size

    def vectors(*shape: int) -> Any:
        return rng.normal(size=(*shape, 2)) @ [1, 1j]

    values = rng.normal(size=4)
    ratio = np.array([-1.0, 1.0, 2.0, -2.0])
    return Design(
        layout=plan,
        chambers=chambers,
        shafts=BalanceWebs(values, np.abs(values), ratio, values + 1.0, values - 1.0),
        angle=rng.uniform(0.0, 12.0, _T),
        unbalance=vectors(plan.webs.position.size),
        of_rows=rng.uniform(1.0, 2.0, rows),
        over_turn=rng.normal(size=(rows, _T)),
        bearings=rng.permutation(np.array([-1.0, 0.1, 1.3]) + rng.uniform(-0.3, 0.3, _B)),
        planes=rng.uniform(-2.0, 2.0, 4),
        loads=vectors(4, _T),
        number=np.asarray(rng.uniform(0.2, 0.9)),
        axis=np.asarray(np.exp(1j * rng.uniform(0.0, 6.0))),
    )


@cache
def designs() -> tuple[Design, ...]:
    return tuple(map(_design, range(6)))


@cache
def together() -> Design:
    return _joined(list(designs()))


def _joined(parts: list[Any]) -> Any:
    """Parts of the designs with the leading axes."""
    first = parts[0]
    if first is None or isinstance(first, str | bool | int):
        return first
    if isinstance(first, tuple):
        return type(first)(*(_joined(list(entry)) for entry in zip(*parts, strict=True)))
    if is_dataclass(first):
        return replace(first, **{f.name: _joined([getattr(part, f.name) for part in parts]) for f in fields(first)})
    return np.stack(parts).reshape(*LEADING, *np.shape(first))


def arrays_of(value: Any) -> Iterator[Any]:
    """The arrays of a result, whatever it is made of."""
    if is_dataclass(value):
        value = [getattr(value, field.name) for field in fields(value)]
    if isinstance(value, tuple | list):
        for number in value:
            yield from arrays_of(number)
    elif isinstance(value, np.ndarray | np.generic | float):
        yield np.asarray(value)


def _moving(design: Design, exact: bool = True) -> Any:
    return motion(design.layout, design.angle, exact)


def _rod(design: Design) -> Any:
    forces = rod.rod_forces(design.over_turn, _moving(design), design.layout)
    return [forces.rod, forces.side, forces.tangential, forces.radial, forces.torque, forces.overturning]


def _gas(design: Design) -> Any:
    forces = gas.gas_forces(design.chambers, _moving(design), design.layout)
    return forces.pressure, forces.force, forces.total


def _wrench(design: Design) -> inertia.Wrench:
    return inertia.rotating(design.layout).plus(inertia.reciprocating(design.layout, 1)).times(design.number)


def _shares(design: Design, own: bool) -> Any:
    throws = design.layout.reciprocating.position[..., ::2]
    webs = design.layout.webs.position
    named = np.where(webs > 0.0, np.nan, 1.0) if own else None
    return balance_rate.web_shares(throws, webs, named)


def _rates(design: Design) -> Any:
    rotating = design.loads[..., :2, 0]
    shares = _shares(design, False)
    return balance_rate.balance_rates(rotating, shares, design.unbalance), balance_rate.customary(rotating, shares)


def _bending(design: Design, influence: Callable[[Any, Any], Any]) -> Any:
    carried = influence(design.bearings, design.planes) @ design.loads
    return carried, bearings.bending_moment(design.bearings, carried, design.planes, design.loads, design.planes + 0.1)


def _framed(design: Design) -> Any:
    shares = frame.Shares(design.number, 1.0 - design.number)
    force, moment = inertia.first_order_responses(design.layout, _wrench(design))
    backwards = (
        replace(force, counter_influence=2.0 * force.influence),
        replace(moment, counter_influence=1j * moment.influence),
    )
    return [
        frame.phasors(shares, _wrench(design)),
        frame.phasors(frame.FORCE, _wrench(design)),
        frame.phasors(frame.MOMENT, _wrench(design)),
        frame.first_order("a", "N", shares, force, moment).to(design.unbalance),
        frame.first_order("a", "N", shares, *backwards).to(design.unbalance),
    ]


def _keys(design: Design) -> Any:
    ring = oldham.Oldham(
        design.number, 2.0 * design.number, 3.0 * design.number, 4.0 * design.number, 5.0 + design.number
    )
    forces = oldham.keys(ring, design.over_turn[..., 0, :], design.angle)
    lost = oldham.pin_losses(np.stack([design.angle, -design.angle], axis=-1), 0.1, design.angle, 3.0)
    return forces, forces.loss(design.angle), lost


def _quality(design: Design) -> Any:
    share = balance_quality.plane_shares(design.number, design.number - 1.0, design.number + 0.7)
    planes = balance_quality.in_planes(design.axis, 2.0 * design.axis, design.number - 1.0, design.number + 1.0)
    return share, planes, balance_quality.permissible_unbalance(design.number, design.number + 1.0, design.number + 2.0)


def _guided(design: Design) -> Any:
    rows = design.layout.reciprocating
    guides = weight.guides(rows.mass, rows.axis, design.layout.sense, design.axis)
    along = weight.along_axis(rows.mass, rows.axis, design.axis)
    return guides.weight, guides.load(design.over_turn), along


def _turned(design: Design) -> Any:
    turn = panels(design.angle, 1.0)
    halves = panels(design.angle, 2.0, halved=True, turns=2)
    values = np.cos(3.0 * turn.angle) + turn.angle * design.number[..., None]
    # jumps at the breaks, and crosses its mean
    return [
        turn.angle, turn.middle, halves.start, halves.width, mean(turn, values), fluctuation(turn, values),
        mean(halves, np.sin(0.5 * halves.angle)),
    ]  # fmt: skip


def _loaded(design: Design) -> Any:
    wrench, load = _wrench(design), foundation.foundation_load
    rounded = foundation.rounding(design.layout, design.unbalance)
    dead = foundation.outer_dead_centre_deg(400.0 * design.number, 700.0 * design.number, design.layout.sense)
    return rounded, dead, load(wrench, 3, design.layout.sense, dead, rounded)


def _plate(design: Design, shape: Any) -> Any:
    plate = shape(0.3 * design.number, design.number, 100.0 + design.number, 0.5 + design.number)
    angle = design.number * plate.most
    mass, unbalance = plate.mass(angle), plate.unbalance(angle)
    chord = plate.chord(angle)
    return [
        mass, unbalance, plate.lever(angle), plate.inertia(angle),
        plate.opened(unbalance), plate.opened(2.0 * unbalance),
        opened_for(plate, mass), opened_for(plate, 3.0 * mass), mass if chord is None else chord,
    ]  # fmt: skip


def _traced(design: Design) -> Any:
    angle = np.array([[-1.0, 0.5, 3.0, 2.0 * np.pi + 0.5], [-0.5, 1.5, 4.0, 2.0 * np.pi + 1.5]])
    pressure = np.array([[1.0, 5.0, 2.0, 1.0], [3.0, 2.0, 9.0, 3.0]])
    table = np.where(design.number > 0.55, 1, 0)
    trace = Trace(1, 1, 1, angle, pressure, table, 2.0 * np.pi * table)
    rows = design.layout.reciprocating
    facts = (numbers[..., 1] for numbers in (design.of_rows, rows.crank_radius, rows.rod_ratio, rows.rod_margin))
    return (
        trace.at(design.angle),
        trace.at(design.angle, design.angle + 0.01),
        trace.breaks(design.number),
        trace.work(*facts),
    )


def _worked(design: Design) -> Any:
    work = RowWork(design.layout, 10.0 * design.of_rows, design.chambers)
    return work.of_a_turn, work.beside_mean(design.angle)


def curves_of(design: Design) -> TurnCurves:
    cut = break_angles(design.layout, gas.switching_angles(design.chambers, design.layout))
    return whole_turn(row_data(design.layout, True, 10.0 * design.of_rows, design.chambers), cut).torque


def _whole(design: Design) -> Any:
    torque, leading = curves_of(design), design.number.shape
    work = RowWork(design.layout, 10.0 * design.of_rows, design.chambers).fluctuation(torque)
    at = torque.at(np.array([0.3, 2.9]))
    return [
        work.value, torque.mean.reshape(leading), torque.variance.reshape(leading), at.reshape(*leading, 2),
    ]  # fmt: skip


def _bearing_curves(design: Design) -> Any:
    influence = bearings.continuous_beam_influence(design.bearings, shaft_curves.planes(design.layout))
    curves = shaft_curves.shaft_curves(curves_of(design).whole, design.layout, influence)
    leading = (*design.number.shape, _B)
    means = [curves.curves.mean.reshape(*design.number.shape, -1) for curves in (curves, curves.first(2))]
    offsets = [curves.offsets(unbalance).reshape(leading) for unbalance in (None, design.unbalance)]
    bending = shaft_curves.bending_influence(design.layout, design.bearings, influence, design.planes)
    return [*means, *offsets, bending]


FUNCTIONS: dict[str, Callable[[Design], Any]] = {
    "own angle": lambda model: own_angle(model.layout, model.angle),
    "motion": lambda model: [_moving(model), _moving(model).tangential_factor, _moving(model).radial_factor],
    "motion of the second order": lambda model: _moving(model, False),
    "steep angles": lambda model: steep_angles(0.5 * model.of_rows),
    "friction": lambda model: friction.reciprocating_friction(_moving(model), model.of_rows),
    "losses": lambda model: friction.share_of_losses(
        model.of_rows - 1.5, model.number, 0.5 * model.number, model.of_rows, model.number
    ),
    "gas": _gas,
    "switching": lambda model: [gas.switching_angles(model.chambers, model.layout, exact) for exact in (True, False)],
    "switching travels": lambda model: gas.switching_travels(model.chambers, model.layout),
    "indicated work": lambda model: gas.indicated_work(model.chambers, model.layout),
    "pressure range": lambda model: gas.pressure_range(model.chambers),
    "dead centres": lambda model: gas.forces_at_dead_centres(model.chambers),
    "rod": _rod,
    "shaft loads": lambda model: rod.shaft_loads(model.over_turn, _moving(model), model.layout, model.angle),
    "turned": lambda model: angles.shaft_vectors(model.layout.sense, model.angle),
    "angles": lambda model: angles.angle_deg(model.unbalance),
    "rotating": lambda model: inertia.rotating(model.layout),
    "orders": lambda model: [inertia.reciprocating(model.layout, order) for order in (1, 2, 4)],
    "counterweights": lambda model: inertia.counterweights(model.layout, model.unbalance),
    "internal moment": lambda model: [internal_moment(model.layout), internal_moment(model.layout, model.unbalance)],
    "foundation": _loaded,
    "shares of webs": lambda model: [_shares(model, False), _shares(model, True)],
    "balance rates": _rates,
    "simple spans": partial(_bending, influence=bearings.simple_spans_influence),
    "continuous beam": partial(_bending, influence=bearings.continuous_beam_influence),
    "frame": _framed,
    "harmonics": lambda model: [
        harmonic(order, model.number)
        for order in (1, 2, 3, 6)
        for harmonic in (acceleration_harmonic, acceleration_harmonic_order_2)
    ],
    "Oldham ring": _keys,
    "balance quality": _quality,
    "weight": _guided,
    "balance shafts": lambda model: [
        balance_shafts.of_balance_shafts(model.layout, model.shafts, model.loads[..., :, 0], order) for order in (1, 2)
    ],
    "panels": _turned,
    "sector": partial(_plate, shape=AnnularSector),
    "segment": partial(_plate, shape=Segment),
    "indicated pressure": _traced,
    "work of rows": _worked,
    "the whole turn": _whole,
    "bearings over the turn": _bearing_curves,
}  # fmt: skip
