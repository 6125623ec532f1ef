"""What is implied for one program, of functions for many."""

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.limits import Limits
from optimizer.program.methods import implied_bounds
from optimizer.program.statement import Statement


def masses_by_inverse(influence: Real | Complex, most: Real) -> Real:
    return implied_bounds._masses_by_inverse(influence[None], most[None])[0]


def carrying_mass(influence: Real, limits: Limits, most: Real, scalar: np.ndarray) -> float:
    mass: float = implied_bounds.carrying_mass(
        influence[None], limits.mapped(lambda array: array[None]), most[None], scalar
    )[0]
    return mass


def responses(statement: Statement, far: np.ndarray, level: float) -> tuple[Real, Real, np.ndarray]:
    """Rows of influence (s, far), the most that each may change (s,), whether only its real part counts (s,)."""
    (every,) = implied_bounds.responses(statement.alone(), far, np.array([level]))
    return every.influence[0], every.most[0], every.scalar
