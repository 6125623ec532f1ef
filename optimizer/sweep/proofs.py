"""The proofs of many designs as text, one for each row of a sweep."""

import numpy as np

from optimizer.arrays import Real
from optimizer.figures.proof import conflict, named, named_conflict, physical
from optimizer.formulate import limits
from optimizer.program.optima import Optima
from optimizer.program.statement import Statement
from schemas.machine import Machine
from schemas.proof import DesignMultipliers


def multipliers_as_text(
    machine: Machine, program: Statement, found: Optima, square: Real, least_mass: bool
) -> np.ndarray:
    """Multipliers of every design as JSON, object (count,).

    Parameters
    ----------
    machine : of columns (count,).
    program : of all designs, leading axis (count,).
    square : (count,) omega^2.
    """
    texts = np.full(square.shape, None, dtype=object)
    implied = _implied(machine, program.limits.max_mass)
    reached = np.flatnonzero(~found.unreachable)
    if reached.size:
        part, speed = program.chosen(reached), square[reached]
        objective = physical(part, found.multipliers.chosen(reached), "objective", speed)
        mass = physical(part, found.mass_multipliers.chosen(reached), "mass", speed)
        limit = (found.mass_target[reached] * speed).tolist()
        for k, n in enumerate(reached):
            texts[n] = DesignMultipliers(
                objective=named(part, objective.chosen(k)),
                mass=named(part, mass.chosen(k)) if least_mass else None,
                mass_objective_limit=limit[k] if least_mass else None,
                conflict=None,
                implied_max_mass_kg=implied[n],
            ).model_dump_json()
    for n in np.flatnonzero(found.unreachable):
        alone = program.chosen(int(n))
        proof = conflict(alone, found.conflict.chosen(int(n)), square[n])
        texts[n] = DesignMultipliers(
            objective=None,
            mass=None,
            mass_objective_limit=None,
            conflict=named_conflict(alone, proof),
            implied_max_mass_kg=implied[n],
        ).model_dump_json()
    return texts


def _implied(machine: Machine, most: Real) -> list[dict[str, float]]:
    """Limits that the proof of each design counts with in place of those of the machine, kg."""
    smaller = most < limits(machine, most.shape[:-1]).max_mass
    return [
        {web.name: mass for web, mass, counts in zip(machine.webs, *of_design, strict=True) if counts}
        for of_design in zip(most.tolist(), smaller.tolist(), strict=True)
    ]
