"""Points of many programs, and what they come to."""

from collections.abc import Iterator
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

    @property
    def items(self) -> "Iterator[Points]":
        """One by one of the first of two leading axes, (n, N)."""
        return (Points(*values) for values in zip(*self, strict=True))

    def where(self, mask: np.ndarray, other: "Points") -> "Points":
        """These where ``kept`` (N,), others elsewhere."""
        count = np.count_nonzero(mask)
        if count == mask.size:
            return self
        if not count:
            return other
        return Points(
            np.where(mask[:, None], self.unbalance, other.unbalance),
            *(np.where(mask, mine, others) for mine, others in zip(self[1:], other[1:], strict=True)),
        )


def points_at(statement: Statement, u: Complex) -> Points:
    """What unbalances (..., N, K) [kg m] come to."""
    return Points(u, *statement.flat.values(u))
