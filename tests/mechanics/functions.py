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

    one = rng.normal(size=4)
    ratio = np.array([-1.0, 1.0, 2.0, -2.0])
    return Design(
        layout=plan,
        chambers=chambers,
        shafts=BalanceWebs(one, np.abs(one), ratio, one + 1.0, one - 1.0),
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
        return type(first)(*(_joined(list(each)) for each in zip(*parts, strict=True)))
    if is_dataclass(first):
        return replace(first, **{f.name: _joined([getattr(one, f.name) for one in parts]) for f in fields(first)})
    return np.stack(parts).reshape(*LEADING, *np.shape(first))


def arrays_of(found: Any) -> Iterator[Any]:
    """The arrays of a result, whatever it is made of."""
    if is_dataclass(found):
        found = [getattr(found, field.name) for field in fields(found)]
    if isinstance(found, tuple | list):
        for each in found:
            yield from arrays_of(each)
    elif isinstance(found, np.ndarray | np.generic | float):
        yield np.asarray(found)


def _moving(one: Design, exact: bool = True) -> Any:
    return motion(one.layout, one.angle, exact)


def _rod(one: Design) -> Any:
    found = rod.rod_forces(one.over_turn, _moving(one), one.layout)
    return [found.rod, found.side, found.tangential, found.radial, found.torque, found.overturning]


def _gas(one: Design) -> Any:
    found = gas.gas_forces(one.chambers, _moving(one), one.layout)
    return found.pressure, found.force, found.total


def _wrench(one: Design) -> inertia.Wrench:
    return inertia.rotating(one.layout).plus(inertia.reciprocating(one.layout, 1)).times(one.number)


def _shares(one: Design, own: bool) -> Any:
    throws = one.layout.reciprocating.position[..., ::2]
    webs = one.layout.webs.position
    named = np.where(webs > 0.0, np.nan, 1.0) if own else None
    return balance_rate.web_shares(throws, webs, named)


def _rates(one: Design) -> Any:
    rotating = one.loads[..., :2, 0]
    shares = _shares(one, False)
    return balance_rate.balance_rates(rotating, shares, one.unbalance), balance_rate.customary(rotating, shares)


def _bending(one: Design, influence: Callable[[Any, Any], Any]) -> Any:
    carried = influence(one.bearings, one.planes) @ one.loads
    return carried, bearings.bending_moment(one.bearings, carried, one.planes, one.loads, one.planes + 0.1)


def _framed(one: Design) -> Any:
    shares = frame.Shares(one.number, 1.0 - one.number)
    force, moment = inertia.first_order_responses(one.layout, _wrench(one))
    backwards = (
        replace(force, counter_influence=2.0 * force.influence),
        replace(moment, counter_influence=1j * moment.influence),
    )
    return [
        frame.phasors(shares, _wrench(one)),
        frame.phasors(frame.FORCE, _wrench(one)),
        frame.phasors(frame.MOMENT, _wrench(one)),
        frame.first_order("a", "N", shares, force, moment).to(one.unbalance),
        frame.first_order("a", "N", shares, *backwards).to(one.unbalance),
    ]


def _keys(one: Design) -> Any:
    ring = oldham.Oldham(one.number, 2.0 * one.number, 3.0 * one.number, 4.0 * one.number, 5.0 + one.number)
    found = oldham.keys(ring, one.over_turn[..., 0, :], one.angle)
    lost = oldham.pin_losses(np.stack([one.angle, -one.angle], axis=-1), 0.1, one.angle, 3.0)
    return found, found.loss(one.angle), lost


def _quality(one: Design) -> Any:
    share = balance_quality.plane_shares(one.number, one.number - 1.0, one.number + 0.7)
    planes = balance_quality.in_planes(one.axis, 2.0 * one.axis, one.number - 1.0, one.number + 1.0)
    return share, planes, balance_quality.permissible_unbalance(one.number, one.number + 1.0, one.number + 2.0)


def _guided(one: Design) -> Any:
    rows = one.layout.reciprocating
    return weight.on_guide(one.over_turn, rows.axis, one.layout.sense, rows.mass, one.axis), weight.along_axis(
        rows.mass, rows.axis, one.axis
    )


def _turned(one: Design) -> Any:
    turn = panels(one.angle, 1.0)
    halves = panels(one.angle, 2.0, halved=True, turns=2)
    values = np.cos(3.0 * turn.angle) + turn.angle * one.number[..., None]
    # jumps at the breaks, and crosses its mean
    return [
        turn.angle, turn.middle, halves.start, halves.width, mean(turn, values), fluctuation(turn, values),
        mean(halves, np.sin(0.5 * halves.angle)),
    ]  # fmt: skip


def _loaded(one: Design) -> Any:
    wrench, load = _wrench(one), foundation.foundation_load
    rounded = foundation.rounding(one.layout, one.unbalance)
    dead = foundation.outer_dead_centre_deg(400.0 * one.number, 700.0 * one.number, one.layout.sense)
    return rounded, dead, load(wrench, 3, one.layout.sense, dead, rounded)


def _plate(one: Design, shape: Any) -> Any:
    plate = shape(0.3 * one.number, one.number, 100.0 + one.number, 0.5 + one.number)
    angle = one.number * plate.most
    mass, unbalance = plate.mass(angle), plate.unbalance(angle)
    chord = plate.chord(angle)
    return [
        mass, unbalance, plate.lever(angle), plate.inertia(angle),
        plate.opened(unbalance), plate.opened(2.0 * unbalance),
        opened_for(plate, mass), opened_for(plate, 3.0 * mass), mass if chord is None else chord,
    ]  # fmt: skip


def _traced(one: Design) -> Any:
    angle = np.array([[-1.0, 0.5, 3.0, 2.0 * np.pi + 0.5], [-0.5, 1.5, 4.0, 2.0 * np.pi + 1.5]])
    pressure = np.array([[1.0, 5.0, 2.0, 1.0], [3.0, 2.0, 9.0, 3.0]])
    table = np.where(one.number > 0.55, 1, 0)
    trace = Trace(1, 1, 1, angle, pressure, table, 2.0 * np.pi * table)
    rows = one.layout.reciprocating
    facts = (each[..., 1] for each in (one.of_rows, rows.crank_radius, rows.rod_ratio, rows.rod_margin))
    return trace.at(one.angle), trace.at(one.angle, one.angle + 0.01), trace.breaks(one.number), trace.work(*facts)


def _worked(one: Design) -> Any:
    work = RowWork(one.layout, 10.0 * one.of_rows, one.chambers)
    return work.of_a_turn, work.beside_mean(one.angle)


def curves_of(one: Design) -> TurnCurves:
    cut = break_angles(one.layout, gas.switching_angles(one.chambers, one.layout))
    return whole_turn(row_data(one.layout, True, 10.0 * one.of_rows, one.chambers), cut).torque


def _whole(one: Design) -> Any:
    torque, leading = curves_of(one), one.number.shape
    work = RowWork(one.layout, 10.0 * one.of_rows, one.chambers).fluctuation(torque)
    at = torque.at(np.array([0.3, 2.9]))
    return [
        work.value, torque.mean.reshape(leading), torque.variance.reshape(leading), at.reshape(*leading, 2),
    ]  # fmt: skip


def _bearing_curves(one: Design) -> Any:
    influence = bearings.continuous_beam_influence(one.bearings, shaft_curves.planes(one.layout))
    found = shaft_curves.shaft_curves(curves_of(one).whole, one.layout, influence)
    leading = (*one.number.shape, _B)
    means = [each.curves.mean.reshape(*one.number.shape, -1) for each in (found, found.first(2))]
    offsets = [found.offsets(each).reshape(leading) for each in (None, one.unbalance)]
    bending = shaft_curves.bending_influence(one.layout, one.bearings, influence, one.planes)
    return [*means, *offsets, bending]


FUNCTIONS: dict[str, Callable[[Design], Any]] = {
    "own angle": lambda one: own_angle(one.layout, one.angle),
    "motion": lambda one: [_moving(one), _moving(one).tangential_factor, _moving(one).radial_factor],
    "motion of the second order": lambda one: _moving(one, False),
    "steep angles": lambda one: steep_angles(0.5 * one.of_rows),
    "friction": lambda one: friction.reciprocating_friction(_moving(one), one.of_rows),
    "losses": lambda one: friction.share_of_losses(
        one.of_rows - 1.5, one.number, 0.5 * one.number, one.of_rows, one.number
    ),
    "gas": _gas,
    "switching": lambda one: [gas.switching_angles(one.chambers, one.layout, exact) for exact in (True, False)],
    "switching travels": lambda one: gas.switching_travels(one.chambers, one.layout),
    "indicated work": lambda one: gas.indicated_work(one.chambers, one.layout),
    "rod": _rod,
    "shaft loads": lambda one: rod.shaft_loads(one.over_turn, _moving(one), one.layout, one.angle),
    "turned": lambda one: angles.shaft_vectors(one.layout.sense, one.angle),
    "angles": lambda one: angles.angle_deg(one.unbalance),
    "rotating": lambda one: inertia.rotating(one.layout),
    "orders": lambda one: [inertia.reciprocating(one.layout, order) for order in (1, 2, 4)],
    "counterweights": lambda one: inertia.counterweights(one.layout, one.unbalance),
    "internal moment": lambda one: [internal_moment(one.layout), internal_moment(one.layout, one.unbalance)],
    "foundation": _loaded,
    "shares of webs": lambda one: [_shares(one, False), _shares(one, True)],
    "balance rates": _rates,
    "simple spans": partial(_bending, influence=bearings.simple_spans_influence),
    "continuous beam": partial(_bending, influence=bearings.continuous_beam_influence),
    "frame": _framed,
    "harmonics": lambda one: [
        harmonic(order, one.number)
        for order in (1, 2, 3, 6)
        for harmonic in (acceleration_harmonic, acceleration_harmonic_order_2)
    ],
    "Oldham ring": _keys,
    "balance quality": _quality,
    "weight": _guided,
    "balance shafts": lambda one: [
        balance_shafts.of_balance_shafts(one.layout, one.shafts, one.loads[..., :, 0], order) for order in (1, 2)
    ],
    "panels": _turned,
    "sector": partial(_plate, shape=AnnularSector),
    "segment": partial(_plate, shape=Segment),
    "indicated pressure": _traced,
    "work of rows": _worked,
    "the whole turn": _whole,
    "bearings over the turn": _bearing_curves,
}  # fmt: skip
