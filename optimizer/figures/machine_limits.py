"""Limits of the whole machine that counterweights touch."""

from collections.abc import Sequence

from optimizer.arrays import Complex
from optimizer.formulate import RESPONSES, ceilings
from optimizer.response import Response
from schemas.answers import MachineLimit
from schemas.machine import Machine
from schemas.requests import Objective

#: a limit counts as touched when what it limits is nearer than this share of it
_TOUCHED = 1e-4


def touched_limits(
    machine: Machine,
    objective: Objective,
    responses: Sequence[Response],
    unbalance: Complex,
    mass_kg: float,
    omega_squared: float,
) -> tuple[MachineLimit, ...]:
    """Budget and ceilings that are touched, in the order of the answer.

    Parameters
    ----------
    unbalance : (K,) kg m.
    mass_kg : of all counterweights.
    """
    touched: list[MachineLimit] = []
    budget, allowed = machine.max_total_mass_kg, ceilings(objective)
    if budget is not None and mass_kg >= budget * (1.0 - _TOUCHED):
        touched.append("max_total_mass")
    peaks = {each.name: each.to(unbalance).peak * omega_squared for each in responses}
    touched += [
        each.limit
        for each in RESPONSES.values()
        if each.name in allowed and peaks[each.name] >= allowed[each.name] * (1.0 - _TOUCHED)
    ]
    return tuple(touched)
