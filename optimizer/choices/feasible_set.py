"""What a set that is not convex answers: the best choice for a statement, and what is proven of all choices."""

from typing import NamedTuple, Protocol

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.statement import Statement


class Subproblem(NamedTuple):
    """One program for a search of its best choice, with the target gap and the time limit of the search."""

    statement: Statement  # one program, no leading axes
    points: Complex  # (M, K) kg m, its optimum of any masses, then earlier choices
    at_least: float  # lower bound of the objective
    relative_gap: float  # in units of the yardstick
    yardstick: float  # what gaps are relative to, in units of the objective
    time_limit_s: float
    below: Statement | None = None  # of few rows in one group, nowhere above it, for the batch kernel; None is that one


@record(frozen=True)
class SearchResult:
    """Where a search ended, and its proof about all choices."""

    feasible: bool  # whether the result keeps the ceilings
    lower_bound: float  # of all choices, over omega^2; inf where it is proven that none is feasible
    nodes: int  # of the tree
    method: str
    proven: bool = False  # all equals were compared as well
    ended: str | None = None  # "time", "size", "rounding" or "cuts" where that ended it before the target gap
    rounds: int = 0  # programs over the turn whose choices were searched
    cuts: int = 0  # that the last of them had


class Choice(NamedTuple):
    """The result of a search."""

    mass: Real  # (K,) kg
    angle: Real  # (K,) degrees
    unbalance: Complex  # (K,) kg m
    result: SearchResult
    castings: np.ndarray | None = None  # (K,) bool: webs that take options; None: all, or none of them does


class FeasibleSet(Protocol):
    """A set of counterweights."""

    @property
    def solved(self) -> bool:
        """Whether programs are solved for its choices, in place of judging those that there are."""
        ...

    @property
    def reach(self) -> Real:
        """The largest unbalance of every web (K,), kg m."""
        ...

    def holds(self, mass_kg: Real) -> bool:
        """Whether counterweights of any mass (K,) happen to be choices, so that nothing is to be searched."""
        ...

    def relaxation(self, statement: Statement) -> Statement:
        """A program of any masses as it is searched, with limits that hold every choice."""
        ...

    def best(self, subproblem: Subproblem) -> Choice:
        """The best choice, and what is proven of all."""
        ...
