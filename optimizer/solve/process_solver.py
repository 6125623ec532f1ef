"""The reference solver of this process."""

from functools import cache

from optimizer.program.reference.solver import Solver


@cache
def own_solver() -> Solver:
    """The one that all computations of this process share: what it has compiled is lent to one thread at a time."""
    return Solver()
