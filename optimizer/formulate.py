"""From machine, objective and responses to the statement of the convex program.

Fields may hold columns, as in :func:`optimizer.mechanics.layout.layout`.
"""

from collections.abc import Mapping

import numpy as np

from optimizer.arrays import SMALLEST, Real, Reals
from optimizer.mechanics.angles import direction
from optimizer.mechanics.layout import stacked
from optimizer.program.limits import Limits
from optimizer.program.statement import Statement, combined, statement, weighted_peak
from optimizer.response import Response
from schemas.machine import Machine, ReciprocatingMachine
from schemas.requests import Objective

#: a larger limit is none, kg
_NO_LIMIT = 1e30


def limits(machine: Machine) -> Limits:
    """Limits of the counterweights on the webs of a machine (..., K)."""
    webs, budget = machine.webs, machine.max_total_mass_kg
    free, centre, half_angle = sectors(machine)
    edge = direction(half_angle)
    return Limits(
        radius=stacked([web.counterweight_radius_m for web in webs]),
        max_mass=_no_limit(stacked([np.inf if web.max_mass_kg is None else web.max_mass_kg for web in webs])),
        free=free,
        centre=direction(centre),
        half_angle_cos=edge.real,
        half_angle_sin=edge.imag,
        max_total_mass=np.asarray(np.inf if budget is None else budget, dtype=float),
    )


def sectors(machine: Machine) -> tuple[np.ndarray, Real, Real]:
    """Which webs have no sector (K,); centres and half-angles [deg] (..., K), 0 and 90 where there is none."""
    webs = machine.webs
    return (
        np.array([web.sector is None for web in webs], dtype=bool),
        stacked([web.sector.centre_deg if web.sector else 0.0 for web in webs]),
        stacked([web.sector.half_angle_deg if web.sector else 90.0 for web in webs]),
    )


def _no_limit(mass: Real) -> Real:
    """Largest masses, inf where they are none: null, or more than can be multiplied."""
    return np.where(mass > _NO_LIMIT, np.inf, mass)


def span(machine: Machine) -> Reals:
    """Axial span L of throws and webs, m; 1 m if that is zero (docs/api.md)."""
    if isinstance(machine, ReciprocatingMachine):
        planes = [throw.position_m for throw in machine.throws]
    else:
        planes = [machine.orbiting_position_m, machine.anti_rotation.position_m]
    planes += [web.position_m for web in machine.webs]
    places = stacked(planes)
    length = np.max(places, axis=-1) - np.min(places, axis=-1)
    return np.where(length <= SMALLEST, 1.0, length)[()]


def weights(machine: Machine, objective: Objective) -> Mapping[str, Reals]:
    """Weight of each response, by name: w_F [1/N] and w_M [1/(N m)]."""
    moment = 1.0 / span(machine) if objective.moment_weight is None else objective.moment_weight
    return {"force": objective.force_weight, "moment": moment}


def ceilings(objective: Objective) -> Mapping[str, float]:
    """Hard limits on the peaks, by response: N and N m."""
    given = {"force": objective.force_ceiling_N, "moment": objective.moment_ceiling_Nm}
    return {name: ceiling for name, ceiling in given.items() if ceiling is not None}


def formulate(
    machine: Machine, objective: Objective, responses: tuple[Response, ...], omega_squared: float
) -> Statement:
    """The program in mass-radius products: forces over omega^2, so that speed plays no part."""
    wanted, across = weights(machine, objective), objective.direction_weights
    return statement(
        combined(
            [
                weighted_peak(response, wanted[response.name], across.x, across.y)
                for response in responses
                if wanted[response.name] > 0
            ],
            objective.combine,
        ),
        [
            (response, ceilings(objective)[response.name] / omega_squared)
            for response in responses
            if response.name in ceilings(objective)
        ],
        limits(machine),
    )


def smallest_peak(response: Response, machine: Machine) -> Statement:
    """The program for one peak alone, without ceilings."""
    # the larger of one is that one, and its row has its name
    return statement(combined([weighted_peak(response, 1.0)], "max"), [], limits(machine))
