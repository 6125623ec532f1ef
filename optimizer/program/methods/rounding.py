"""Counterweights that nearly vanish, or nearly touch a limit, exactly there: no dust, and limits to the last digit.

An interior point ends inside all limits. Masses that are small beside the others are taken away, and those next to a
limit are put there. The counterweights between their limits make up for it by the least change, relative to their size.
It leaves every term of the objective and every response under a ceiling as it was.
"""

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.limits import Limits
from optimizer.program.points import Points
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.program.statement import Statement

#: how near to nothing, or to a limit, as a share of the largest mass or of the limit: the next where one is too much
NEAR = (1e-4, 1e-6, 1e-8)
#: one after the other: of dust, of limits, and the next one where that did no harm, or nothing
RUNGS = np.array(
    [
        (NEAR[0], NEAR[0], 2 * len(NEAR)),
        *((dust, 0.0, len(NEAR)) for dust in NEAR[1:]),
        *((0.0, touched, 2 * len(NEAR)) for touched in NEAR),
    ]
)
#: relative gap of the least mass that may be left
HEAVIER = 1e-5


def snap_to_limits(statement: Statement, points: Points, target: Real, mass_bound: Real | None) -> Points:
    """The same without dust, and at the limits that they touch, where they are no worse for it.

    Parameters
    ----------
    statement : programs of one leading axis (N,).
    points : within the limits.
    target : (N,) largest objective of an optimum; the points may be above it.
    mass_bound : (N,) kg, no optimum is lighter; None where the mass does not count.
    """
    heaviest = np.full(target.shape, np.inf) if mass_bound is None else mass_bound / (1.0 - HEAVIER)
    u, figures = points.unbalance.copy(), np.array(points[1:])
    statement.flat.settle(u, figures, target, heaviest, CEILING_ROUNDING, RUNGS)
    return Points(u, *figures)


def dust(mass: Real) -> np.ndarray:
    """Which masses (..., K) are next to nothing beside the largest of theirs (..., K) bool."""
    most = np.maximum.reduce(mass, axis=-1, keepdims=True, initial=0.0)
    return np.asarray((mass > 0) & (mass <= NEAR[0] * most))


def has_dust(limits: Limits, u: Complex) -> np.ndarray:
    """Whether some counterweights (..., K) kg m are next to nothing beside the largest of theirs (...)."""
    return np.asarray(np.logical_or.reduce(dust(np.abs(u) / limits.radius), axis=-1))
