"""What accuracy costs at the peaks of the turn: brute force on even and uneven grids against the bracket.

The bracket is what the service answers, proven on both sides (:mod:`optimizer.responses.piecewise_cubics`). A grid of
equal steps misses
the peaks that stand at valves, dead centres and entries of tables; an uneven one has samples on both sides of each of
them. Neither knows what it misses.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Literal, NamedTuple

import numpy as np

from optimizer.effects.registry import closure, rules_of, run
from optimizer.mechanics.indicated import TURN
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.shaft import INFLUENCES, bearing_places
from optimizer.mechanics.shaft_curves import bending_influence, planes, shaft_curves
from optimizer.mechanics.whole_turn import TurnCurves, WholeTurn
from optimizer.numerics.arrays import Complex
from optimizer.numerics.records import record
from optimizer.studies.accuracy.effects import MAX_ROWS
from optimizer.studies.accuracy.ladder import median_ms, timed
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.accuracy import PeakRow
from schemas.request.scene import Fidelity

TOLERANCES = (1e-3, 1e-6, 1e-9)
STEPS_DEG = (30.0, 10.0, 5.0, 1.0, 0.1, 0.01)
PLACES = (2, 5, 17)
_SHARPEST = f"tolerance {TOLERANCES[-1]:.0e}"
#: rows and curves times angles that one way may look at
_MOST = 400_000

Quantity = Literal["peak_bearing_load", "peak_bending_moment", "peak_torque"]
#: what a figure is the largest of, in a unit of its own: loads and moments are over omega^2
Curves = Callable[[WholeTurn], TurnCurves]


class Peak(NamedTuple):
    """A peak: what was attained, and what nothing is above."""

    lower: float
    upper: float | None


@record(frozen=True)
class PeakMethod:
    """One way to a peak."""

    quantity: Quantity
    method: Literal["bracket", "pieces", "samples"]
    setting: str
    angles: int | None
    peak: Callable[[], Peak]


def peaks_ladder(machine: Machine, layout: Layout, repeats: int) -> tuple[PeakRow, ...]:
    """Rows for every peak; none where the machine does not give what it takes."""
    needs = ("whole_turn", "kinematics")
    if not isinstance(machine, ReciprocatingMachine) or not 0 < layout.reciprocating.mass.size <= MAX_ROWS:
        return ()
    if any(rule.broken for effect in closure(machine, needs) for rule in rules_of(machine, effect)):
        return ()
    results = run(machine, layout, (*needs, "friction"), Fidelity(), np.zeros(1))
    whole: WholeTurn = results["whole_turn"]
    friction = complex(results["friction"].torque) if "friction" in results else 0j
    ways = [
        way
        for quantity, curves in _curves(machine, layout).items()
        for way in _ways(quantity, whole, curves, friction if quantity == "peak_torque" else 0j)
    ]
    result, first, times = timed([way.peak for way in ways], repeats)
    sharpest = {way.quantity: peak.lower for way, peak in zip(ways, result, strict=True) if way.setting == _SHARPEST}
    return tuple(
        PeakRow(
            quantity=way.quantity,
            method=way.method,
            setting=way.setting,
            angles=way.angles,
            time_ms=median_ms(times[n]) or 0.0,
            first_ms=first[n] * 1e3,
            relative_error=(sharpest[way.quantity] - result[n].lower) / sharpest[way.quantity],
            certified_gap=_gap(result[n]),
            runs=len(times[n]),
        )
        for n, way in enumerate(ways)
        # what cancels has no digits to tell
        if sharpest[way.quantity] > 0.0
    )


def _curves(machine: ReciprocatingMachine, layout: Layout) -> Mapping[Quantity, Curves]:
    """The curves behind every figure: loads over omega^2, the torque."""
    curves: dict[Quantity, Curves] = {}
    if machine.bearings:
        influence, places = INFLUENCES[Fidelity().shaft], bearing_places(machine)
        loads = influence(places, planes(layout))
        stations = np.unique(np.concatenate([planes(layout), places]))
        moments = bending_influence(layout, places, loads, stations)
        curves["peak_bearing_load"] = lambda whole: shaft_curves(whole, layout, loads).curves
        curves["peak_bending_moment"] = lambda whole: shaft_curves(whole, layout, moments).curves
    curves["peak_torque"] = lambda whole: whole.torque
    return curves


def _ways(quantity: Quantity, whole: WholeTurn, curves: Curves, offset: complex) -> Iterator[PeakMethod]:
    """All ways to a peak; grids that are too fine for the machine are left out."""

    def fresh() -> TurnCurves:
        # nothing that an earlier run has worked out
        return curves(replace(whole))

    size = whole.rows.ahead.shape[-1] + fresh().weights.shape[1]
    pieces = int(np.count_nonzero(whole.half))

    def affordable(angles: int) -> bool:
        return size * angles <= _MOST

    for tolerance in TOLERANCES:
        peak = partial(_bracket, fresh, offset, tolerance)
        yield PeakMethod(quantity, "bracket", f"tolerance {tolerance:.0e}", None, peak)
    for count in PLACES:
        if affordable(pieces * count):
            peak = partial(_in_pieces, fresh, offset, count)
            yield PeakMethod(quantity, "pieces", f"{count} in a piece", pieces * count, peak)
    for step in STEPS_DEG:
        angles = whole.turns * round(360.0 / step)
        if affordable(angles):
            peak = partial(_sampled, fresh, offset, angles)
            yield PeakMethod(quantity, "samples", f"{step:g} deg", angles, peak)


def _bracket(fresh: Callable[[], TurnCurves], offset: complex, tolerance: float) -> Peak:
    pieces = fresh().pieces
    count = len(pieces.half)
    group = np.zeros(count, dtype=np.intp)
    # of the torque, a scalar, the offset is real
    shift = np.full(count, offset.real)
    bracket = pieces.peaks(shift, tolerance, None, group)
    return Peak(float(bracket.lower[0]), float(bracket.upper[0]))


def _in_pieces(fresh: Callable[[], TurnCurves], offset: complex, count: int) -> Peak:
    return _largest(fresh().in_pieces(np.linspace(-1.0, 1.0, count)) + offset)


def _sampled(fresh: Callable[[], TurnCurves], offset: complex, angles: int) -> Peak:
    turn = fresh()
    turns = turn.whole.turns
    return _largest(turn.at(np.linspace(0.0, TURN * turns, angles, endpoint=False)) + offset)


def _largest(values: Complex) -> Peak:
    return Peak(float(np.max(np.abs(values))), None)


def _gap(peak: Peak) -> float | None:
    return None if peak.upper is None or peak.lower <= 0.0 else (peak.upper - peak.lower) / peak.lower
