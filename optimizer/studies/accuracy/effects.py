"""What accuracy costs in the simulated effects: the torque over the turn, and what a flywheel has to take.

The reference agrees with what the service computes to rounding: Gauss-Legendre panels between the angles at which
valves open and rows reverse. Beside it stands what a spreadsheet does: values at equal steps, their average as the mean
(which the trapezoidal rule is over a whole turn), the running trapezoidal sum for the energy.
"""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Literal

import numpy as np
from scipy.optimize import minimize_scalar

from optimizer.effects.inertia import rod_problems
from optimizer.effects.registry import run
from optimizer.mechanics.cylinders import cycle_turns, delivery_rules, gas_problems, trace_rules, without_gas
from optimizer.mechanics.indicated import TURN, turns_of
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.rod import rod_forces
from optimizer.mechanics.turn import fluctuation, mean, panels
from optimizer.mechanics.whole_turn import break_angles
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from optimizer.studies.accuracy.ladder import median_ms, timed
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.accuracy import EffectRow
from schemas.request.scene import Fidelity

STEPS_DEG = (30.0, 15.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.1)
#: rows of a machine up to which the ladder is made
MAX_ROWS = 100
_WIDEST_PANEL = np.deg2rad(10.0)
#: distance from a jump at which its sides are looked at, rad
_BESIDE = 1e-9
#: panels whose nodes come this near to the largest may hold the peak; and samples within them
_NEARLY, _WITHIN = 0.95, 65

Figure = Literal["mean", "peak", "energy"]
Figures = Mapping[Figure, float]
Quantity = Literal[
    "mean_torque", "peak_torque", "fluctuation_energy", "peak_inertia_torque", "inertia_fluctuation_energy"
]
_WITH_GAS: Mapping[Figure, Quantity] = {
    "mean": "mean_torque",
    "peak": "peak_torque",
    "energy": "fluctuation_energy",
}
#: inertia alone has no mean torque
_INERTIA_ALONE: Mapping[Figure, Quantity] = {"peak": "peak_inertia_torque", "energy": "inertia_fluctuation_energy"}
#: torque (T,) N m against rotation at shaft angles (T,) rad
Torque = Callable[[Real], Real]


@record(frozen=True)
class TorqueMethod:
    """One way to the figures of the turn."""

    method: Literal["panels", "search", "samples"]
    setting: str
    figures: Callable[[], Figures]


def effects_ladder(machine: Machine, layout: Layout, repeats: int) -> tuple[EffectRow, ...]:
    """Rows for every figure; none where the machine does not give what the torque takes."""
    if not isinstance(machine, ReciprocatingMachine) or any(rod_problems(machine)):
        return ()
    if not 0 < layout.reciprocating.mass.size <= MAX_ROWS:
        return ()
    complete = not without_gas(machine) and not any(gas_problems(machine))
    rules = [*delivery_rules(machine, layout), *trace_rules(machine, layout)] if complete else []
    has_gas = complete and not any(rule.broken for rule in rules)
    turns = cycle_turns(machine) if has_gas else 1
    torque = _torque if has_gas else _inertia_torque
    exact, cut_off = (
        partial(torque, machine, layout, fidelity) for fidelity in (Fidelity(), Fidelity(kinematics="order_2"))
    )
    breaks = _breaks(machine, layout, has_gas)
    ways = [
        TorqueMethod("panels", "exact kinematics", lambda: _by_panels(exact, breaks, turns)),
        TorqueMethod("panels", "kinematics of order 2", lambda: _by_panels(cut_off, breaks, turns)),
        TorqueMethod("search", "exact kinematics", lambda: _by_search(exact, breaks, turns)),
        TorqueMethod("search", "kinematics of order 2", lambda: _by_search(cut_off, breaks, turns)),
        *(TorqueMethod("samples", f"{step:g} deg", partial(_by_samples, exact, step, turns)) for step in STEPS_DEG),
    ]
    reference = {**_by_panels(exact, breaks, turns), **_by_search(exact, breaks, turns)}
    estimate = _own_estimate(exact, breaks, turns)
    result, first, times = timed([way.figures for way in ways], repeats)
    return tuple(
        EffectRow(
            quantity=name,
            method=way.method,
            setting=way.setting,
            time_ms=median_ms(times[n]) or 0.0,
            first_ms=first[n] * 1e3,
            relative_error=_relative(result[n][figure], reference[figure])
            if way.method == "samples" or way.setting != "exact kinematics"
            else estimate.get(figure),
            runs=len(times[n]),
        )
        for figure, name in (_WITH_GAS if has_gas else _INERTIA_ALONE).items()
        for n, way in enumerate(ways)
        if figure in result[n]
    )


def _torque(machine: Machine, layout: Layout, fidelity: Fidelity, angle: Real) -> Real:
    """Torque of gas, inertia and friction."""
    total: Real = run(machine, layout, ("torque",), fidelity, angle)["torque"].total
    return total


def _inertia_torque(_machine: Machine, layout: Layout, fidelity: Fidelity, angle: Real) -> Real:
    """Torque of the reciprocating masses alone."""
    moving = motion(layout, angle, fidelity.kinematics == "exact")
    force = layout.reciprocating.mass[:, None] * moving.acceleration
    return np.sum(rod_forces(force, moving, layout).torque, axis=0)


def _breaks(machine: Machine, layout: Layout, has_gas: bool) -> Real:
    """Shaft angles at which the torque jumps, has a kink or is steep, rad."""
    if not has_gas:
        result, turns = break_angles(layout), 1
    else:
        gas = run(machine, layout, ("gas",), Fidelity(), np.zeros(1))["gas"]
        result, turns = break_angles(layout, gas.opens, gas.traces), turns_of(gas.traces)
    return np.unique(np.mod(result[~np.isnan(result)], TURN * turns))


def _by_panels(torque: Torque, breaks: Real, turns: int = 1) -> Figures:
    """As the service integrates: its halved panels."""
    turn = panels(breaks, _WIDEST_PANEL, halved=True, turns=turns)
    values = torque(turn.angle)
    return {"mean": float(mean(turn, values)), "energy": float(fluctuation(turn, values))}


def _own_estimate(torque: Torque, breaks: Real, turns: int) -> Figures:
    """Difference from panels twice as wide, which the service reports as its error; the peak has none."""
    coarse = panels(breaks, _WIDEST_PANEL, turns=turns)
    values, fine = torque(coarse.angle), _by_panels(torque, breaks, turns)
    results: dict[Figure, float | None] = {
        "mean": _relative(float(mean(coarse, values)), fine["mean"]),
        "energy": _relative(float(fluctuation(coarse, values)), fine["energy"]),
    }
    return {figure: error for figure, error in results.items() if error is not None}


def _by_search(torque: Torque, breaks: Real, turns: int = 1) -> Figures:
    """Largest magnitude of the torque: on both sides of every break, and within the panels that may hold it."""
    beside = np.max(np.abs(torque(np.concatenate([breaks - _BESIDE, breaks + _BESIDE]))))
    turn = panels(breaks, _WIDEST_PANEL, halved=True, turns=turns)
    highest = np.max(np.abs(torque(turn.angle)).reshape(turn.start.size, -1), axis=-1)
    # of a torque that is 0 everywhere all panels hold the peak
    candidates = (highest >= _NEARLY * np.max(highest)) & (turn.width > 0)
    within = np.linspace(0.0, 1.0, _WITHIN)
    angle = (turn.start[candidates, None] + turn.width[candidates, None] * within).ravel()
    best = int(np.argmax(np.abs(torque(angle))))
    # smooth within a panel, so that there is one maximum beside the best of the fine samples
    step = float(np.max(turn.width[candidates])) * within[1]
    inside = minimize_scalar(
        lambda at: -abs(float(torque(np.array([at]))[0])),
        bounds=(angle[best] - step, angle[best] + step),
        method="bounded",
        options={"xatol": 1e-9},
    )
    return {"peak": max(float(beside), float(-inside.fun), float(np.max(highest)))}


def _by_samples(torque: Torque, step_deg: float, turns: int = 1) -> Figures:
    count = turns * round(360.0 / step_deg)
    values = torque(np.linspace(0.0, TURN * turns, count, endpoint=False))
    middle = float(np.mean(values))
    rest = np.append(values, values[0]) - middle
    running = np.concatenate([[0.0], np.cumsum(0.5 * (rest[:-1] + rest[1:]))]) * (TURN * turns / count)
    return {"mean": middle, "peak": float(np.max(np.abs(values))), "energy": float(np.ptp(running))}


def _relative(value: float, reference: float) -> float | None:
    return abs(value - reference) / abs(reference) if reference != 0 else None
