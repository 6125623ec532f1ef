"""Loads of the anti-rotation pins: the answer of one scroll, and the largest load of each of many."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from optimizer.effects.machine_kinds import pinned_scroll
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.layout import stacked
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.output import Columns, Output
from optimizer.pins.loads import LoadShapes, PeriodicTable, gas_torques, peaks
from schemas.scroll.over_turn import ForceTable, TorqueTable
from schemas.scroll.pin_loads import PinLoads


def _figure(scene: Prepared, _fitted: Complex | None) -> PinLoads:
    # an answer to pins alone says besides who computed it
    return PinLoads.of_figures(vars(scene.results["pin_loads"]))


def _columns(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    """Largest load of evenly spaced pins over the turn (n,) N: 2 / (n R) max |T sin(theta - g)|.

    Radius, lever and a constant torque are factors, so that designs with the same table and number of pins share one
    search of the turn.
    """
    machine, guide = pinned_scroll(scene.machine)
    pins = np.broadcast_to(np.asarray(guide.count, dtype=float), scene.layout.omega.shape)
    factor = 2.0 / (pins * guide.pin_circle_radius_m)
    if machine.drive_bearing.carries:
        # one pin or two hold nothing where the eccentric lies along them
        factor = np.where(pins < 3.0, np.nan, factor)
    load: Any = machine.rotation_torque_Nm
    if machine.tangential_gas_force_N is not None:
        load = machine.tangential_gas_force_N
        factor = factor * gas_torques(np.ones(()), np.asarray(machine.orbit_radius_m))[0]
    if isinstance(load, TorqueTable | ForceTable):
        values = load.torque_Nm if isinstance(load, TorqueTable) else load.force_N
        return {"peak_pin_load_N": factor * _largest_product(load.angle_deg, values, pins)}
    return {"peak_pin_load_N": np.abs(load) * factor * _largest_product((0.0,), (1.0,), pins)}


def _largest_product(angle_deg: Sequence[Any], values: Sequence[Any], pins: Real) -> Real:
    """max over the turn and the pins of |value(theta) sin(theta - g)| for tables and pin numbers (n,)."""
    entries = len(angle_deg)
    cases = stacked([*angle_deg, *values, pins])
    distinct, inverse = np.unique(cases, axis=0, return_inverse=True)
    result = np.zeros(len(distinct))
    for k, case in enumerate(distinct):
        angles, torque, number = case[:entries], case[entries:-1], int(case[-1])
        inside = angles < 360.0
        shapes = LoadShapes.even(360.0 * np.arange(number) / number, 2.0 / number)
        result[k] = np.max(peaks(shapes, PeriodicTable(angles[inside], torque[inside]))[0])
    return result[inverse.reshape(-1)]


# a sweep needs the peaks alone, not what every pin carries over the turn
PIN_LOADS = Output(
    "pin_loads", "loads of the anti-rotation pins of a scroll", ("pin_loads",), _figure, Columns(_columns, needs=())
)
