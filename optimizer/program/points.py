"""Points of many programs, and what they come to."""

from typing import NamedTuple

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.statement import Statement


class Points(NamedTuple):
    """One point of each of N programs, and what it comes to."""

    unbalance: Complex  # (N, K) kg m
    objective: Real  # (N,)
    mass: Real  # (N,) kg
    excess: Real  # (N,) largest relative excess over a ceiling, -inf without ceilings
    rounding: Real  # (N,) of the objective


def points_at(statement: Statement, u: Complex) -> Points:
    """What unbalances (..., N, K) [kg m] come to."""
    return Points(u, *statement.flat.values(u))
