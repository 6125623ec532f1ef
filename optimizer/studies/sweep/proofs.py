"""The proofs of many designs as text, one for each row of a sweep."""

import numpy as np

from optimizer.formulation.balance_shafts import design_space
from optimizer.program.certificate import Multipliers
from optimizer.solve.certify import Certified
from optimizer.solve.proof import (
    Bounded,
    bound_multipliers,
    conflict,
    conflict_multipliers,
    implied_max_mass,
    physical_bounds,
)
from schemas.answer.proof import DesignMultipliers
from schemas.request.requests import OptimizeRequest


def multipliers_as_text(request: OptimizeRequest, best: Certified) -> np.ndarray:
    """Multipliers of every design as JSON, object (count,).

    Parameters
    ----------
    request : of columns (count,).
    """
    least_mass, program, square, optima = request.objective.least_mass, best.program, best.omega_squared, best.optima
    bounds: dict[Bounded, Multipliers] = {"objective": optima.multipliers, "mass": optima.mass_multipliers}
    objective, mass = physical_bounds(program, bounds, square)
    texts = np.full(square.shape, None, dtype=object)
    limit = (optima.mass_target * square).tolist()
    machine = design_space(request.machine, request.objective).machine
    implied = implied_max_mass(machine, program.limits.max_mass)
    for n, unreachable in enumerate(optima.unreachable.tolist()):
        of_mass = least_mass and not unreachable
        against = conflict(program.subset(n), optima.conflict.subset(n), square[n]) if unreachable else None
        texts[n] = DesignMultipliers(
            objective=None if unreachable else bound_multipliers(program, objective.subset(n)),
            mass=bound_multipliers(program, mass.subset(n)) if of_mass else None,
            mass_objective_limit=limit[n] if of_mass else None,
            conflict=None if against is None else conflict_multipliers(program, against),
            implied_max_mass_kg=implied[n],
        ).model_dump_json()
    return texts
