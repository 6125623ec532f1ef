"""Points of many programs, and what they come to."""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.statement import Statement


class Points(NamedTuple):
    """One point of each of N programs, and what it comes to."""

    unbalance: Complex  # (N, K) kg m
    objective: Real  # (N,)
    mass: Real  # (N,) kg
    excess: Real  # (N,) largest relative excess over a ceiling, -inf without ceilings
    rounding: Real  # (N,) of the objective

    def subset(self, programs: np.ndarray) -> "Points":
        """Those of some of the programs."""
        return Points(*(values[programs] for values in self))

    def put(self, programs: np.ndarray, points: "Points") -> None:
        """Others for some of the programs, in place."""
        for mine, values in zip(self, points, strict=True):
            mine[programs] = values


def points_at(statement: Statement, u: Complex) -> Points:
    """What unbalances (..., N, K) [kg m] come to."""
    return Points(u, *statement.flat.values(u))
