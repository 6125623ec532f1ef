"""Steps of mass and angle on either side of counterweights, and the nearest ones."""

import math
from typing import NamedTuple

import numpy as np

from optimizer.errors import refuse
from optimizer.formulation.balance_shafts import web_paths, with_shaft_webs
from optimizer.formulation.groups import alike_webs
from optimizer.formulation.limits import largest_mass, sectors
from optimizer.mechanics.crank_of_web import crank_angles
from optimizer.numerics.arrays import Real
from schemas.base.model import FieldProblem
from schemas.machine.catalogue import in_sector
from schemas.machine.machine import Machine

#: of a step: what is this near to a whole number of them is one
_WHOLE = 1e-9


class Sides(NamedTuple):
    """The steps on either side of what a web carries, the nearest first; none where it carries nothing."""

    masses_kg: tuple[float, ...] = ()  # of none nothing fits
    angles_deg: tuple[float, ...] = ()

    @property
    def nearest(self) -> "Sides":
        """The nearest of them alone."""
        return Sides(self.masses_kg[:1], self.angles_deg[:1])


def sides(machine: Machine, mass_kg: Real, angle_deg: Real, mass_step: float, angle_step: float) -> list[Sides]:
    """Of every web the steps within its limits.

    Parameters
    ----------
    mass_kg, angle_deg : (K + S,) what the webs carry as drawn, those of balance shafts behind those of the crankshaft,
        fixed weights apart; of a group all the same, on their own cranks. Angles on balance shafts count from 0.

    Raises
    ------
    OutOfRange
        where a web that carries something has no crank to count from, or no step falls into its sector.
    """
    paths, cranks = web_paths(machine), [*crank_angles(machine)]
    cranks += [0.0] * (len(paths) - len(cranks))
    machine = with_shaft_webs(machine)
    alike, limit = alike_webs(machine), largest_mass(machine).tolist()
    free, centre, half_angle = sectors(machine)
    leader = list(range(len(machine.webs))) if alike is None else list(alike.leader)
    mirrored = [False] * len(leader) if alike is None else list(alike.mirrored)
    problems: list[FieldProblem] = []
    result = [Sides()] * len(leader)
    turns: dict[int, list[int]] = {}  # steps from the own crank, of first webs
    for k, first in enumerate(leader):
        crank = cranks[k]
        if mass_kg[k] <= 0.0:
            continue
        if crank is None:
            message = "steps of angle count from a crank: name the throw"
            problems.append(FieldProblem(("machine", *paths[k], "throw"), message))
            continue
        if first == k:
            near = _steps(float(np.mod(angle_deg[k] - crank, 360.0)) / angle_step)
            inside = [n for n in near if free[k] or in_sector(crank + n * angle_step, centre[k], half_angle[k])]
            if not inside:
                message = "no step of the angle falls into the sector"
                problems.append(FieldProblem(("machine", *paths[k], "sector"), message))
            turns[k] = inside
        masses = (_decimal(n * mass_step) for n in _steps(mass_kg[first] / mass_step))
        fit = tuple(mass for mass in masses if 0.0 < mass <= limit[k])
        signs = (-n if mirrored[k] else n for n in turns.get(first, ()))
        angles = tuple(_decimal((crank + n * angle_step) % 360.0 % 360.0) for n in signs)
        result[k] = Sides(fit, angles) if fit and angles else Sides()
    refuse(problems)
    return result


def nearest(every: list[Sides]) -> tuple[Real, Real]:
    """The nearest masses [kg] and angles [deg] of all webs (K,)."""
    mass = np.array([(*web.masses_kg, 0.0)[0] for web in every])
    return mass, np.array([(*web.angles_deg, 0.0)[0] for web in every])


def _steps(places: float) -> list[int]:
    """Whole numbers on either side of a number of steps, the nearest first."""
    near = round(places)
    if abs(places - near) <= _WHOLE * max(1.0, abs(places)):
        return [near]
    return sorted((math.floor(places), math.ceil(places)), key=lambda n: abs(places - n))


def _decimal(value: float) -> float:
    """Without the last digits, which products of decimals get wrong."""
    return float(f"{value:.15g}")
