"""Largest load of the anti-rotation pins of a scroll for many designs at once."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from optimizer.arrays import Real
from optimizer.mechanics.layout import stacked
from optimizer.pins.loads import LoadShapes, PeriodicTable, gas_torques, peaks
from schemas.machine import CrankPins, ScrollMachine
from schemas.over_turn import ForceTable, TorqueTable


def peak_pin_load(machine: ScrollMachine, count: int) -> Real:
    """Largest load of evenly spaced pins over the turn (count,) N: 2 / (n R) max |T sin(theta - g)|.

    A constant torque has its peak in closed form. Designs with the same table and number of pins share one search
    of the turn, since radius and lever are factors.
    """
    guide = machine.anti_rotation
    assert isinstance(guide, CrankPins)  # missing inputs otherwise
    pins = np.broadcast_to(np.asarray(guide.count, dtype=float), (count,))
    factor = 2.0 / (pins * guide.pin_circle_radius_m)
    given: Any = machine.rotation_torque_Nm
    if machine.tangential_gas_force_N is not None:
        given = machine.tangential_gas_force_N
        factor = factor * gas_torques(np.ones(()), np.asarray(machine.orbit_radius_m))[0]
    if not isinstance(given, TorqueTable | ForceTable):
        return np.abs(given) * factor
    values = given.torque_Nm if isinstance(given, TorqueTable) else given.force_N
    return factor * _largest_product(given.angle_deg, values, pins)


def _largest_product(angle_deg: Sequence[Any], values: Sequence[Any], pins: Real) -> Real:
    """max over the turn and the pins of |value(theta) sin(theta - g)| for tables and pin numbers (n,)."""
    entries = len(angle_deg)
    cases = stacked([*angle_deg, *values, pins])
    distinct, which = np.unique(cases, axis=0, return_inverse=True)
    found = np.zeros(len(distinct))
    for k, case in enumerate(distinct):
        angles, torque, number = case[:entries], case[entries:-1], int(case[-1])
        inside = angles < 360.0
        shapes = LoadShapes.even(360.0 * np.arange(number) / number, 2.0 / number)
        found[k] = np.max(peaks(shapes, PeriodicTable(angles[inside], torque[inside]))[0])
    return found[which.reshape(-1)]
