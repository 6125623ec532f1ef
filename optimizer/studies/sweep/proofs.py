"""The proofs of many designs as text, one for each row of a sweep."""

import numpy as np

from optimizer.solve.certify import Certified
from optimizer.solve.proof import implied_max_mass, named_proofs, physical_proofs
from schemas.answer.proof import DesignMultipliers
from schemas.request.requests import OptimizeRequest


def multipliers_as_text(request: OptimizeRequest, best: Certified) -> np.ndarray:
    """Multipliers of every design as JSON, object (count,).

    Parameters
    ----------
    request : of columns (count,).
    """
    least_mass = request.objective.least_mass
    texts = np.full(best.omega_squared.shape, None, dtype=object)
    limit = (best.optima.mass_target * best.omega_squared).tolist()
    implied = implied_max_mass(request.machine, best.program.limits.max_mass)
    proofs = named_proofs(
        best.program,
        best.optima,
        physical_proofs(best.program, best.optima, best.omega_squared),
        best.omega_squared,
        least_mass,
    )
    for n, (proof, unreachable) in enumerate(zip(proofs, best.optima.unreachable, strict=True)):
        texts[n] = DesignMultipliers(
            objective=proof.objective,
            mass=proof.mass,
            mass_objective_limit=limit[n] if least_mass and not unreachable else None,
            conflict=proof.conflict,
            implied_max_mass_kg=implied[n],
        ).model_dump_json()
    return texts
