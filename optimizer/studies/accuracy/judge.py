"""By what counterweights are judged: one sum, or the largest of the sums of several scenarios."""

from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.numerics.records import record
from optimizer.program.cuts.row_generation import MANY, single_group
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.limits import Limits
from optimizer.program.statement import Statement


@record(frozen=True)
class Judge:
    """What counterweights come to.

    statement : all groups, with ceilings and limits.
    sums : (groups,) sum to which each belongs, of which the largest counts; None where all are one sum.
    """

    statement: Statement
    sums: np.ndarray | None = None

    @classmethod
    def of(cls, problem: Problem) -> "Judge":
        """That of the only goal of a problem of the first order."""
        return cls(problem.begun, problem.case_of if problem.goal_of_case.size > 1 else None)

    def objective(self, u: Complex) -> float:
        """The objective with counterweights (K,) kg m."""
        statement = self.statement
        if self.sums is None:
            return float(statement.objective(u))
        largest = statement.largest(statement.rows(statement.norms.sizes(u)))
        return float(np.max(np.bincount(self.sums, largest)))

    @property
    def at_rest(self) -> float:
        """The objective without counterweights."""
        return self.objective(np.zeros(self.statement.limits.radius.shape, complex))

    def within(self, limits: Limits) -> "Judge":
        """The same with other limits."""
        return replace(self, statement=replace(self.statement, limits=limits))

    def only(self, webs: np.ndarray) -> "Judge":
        """The same with some of the webs (K,)."""
        return replace(self, statement=self.statement.only(webs))

    @property
    def single_sum(self) -> Statement | None:
        """The same program with one group, a row for every row of each group with every other of its sum; None where
        these are too many."""
        if self.sums is None:
            return self.statement
        of_group = np.bincount(self.statement.group)
        count = sum(int(np.prod(of_group[self.sums == n])) for n in np.unique(self.sums))
        if max(count, len(self.statement.ceilings.names)) > MANY:
            return None
        still = np.zeros((1, self.statement.limits.radius.size), complex)
        return single_group(self.statement, self.sums, still, MANY, np.zeros(self.sums[-1] + 1, int))
