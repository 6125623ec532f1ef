"""By what counterweights are judged: one sum, or the largest of the sums of several scenarios; of the first order in
closed form, over a revolution by brackets."""

from dataclasses import replace
from typing import Protocol

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.cuts.row_generation import MANY, single_group
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.limits import Limits
from optimizer.program.statement import Statement

#: width of the brackets of goals over a revolution, as a share of what they are measured by
_WIDTH = 1e-12
#: of the goals before an only one; nobody writes to it
_NO_LEVELS = np.zeros(0)


class Judge(Protocol):
    """What counterweights (K,) kg m come to."""

    @property
    def limits(self) -> Limits:
        """Limits of every web."""

    @property
    def terms(self) -> int:
        """Norms in the objective; over a revolution, responses that are each the largest of infinitely many."""

    @property
    def ceilings(self) -> int:
        """Ceilings on peaks."""

    @property
    def at_rest(self) -> float:
        """The objective without counterweights."""

    def objective(self, u: Complex) -> float:
        """The objective."""

    def excess(self, u: Complex) -> float:
        """The largest excess over a ceiling, relative to its size; -inf without ceilings."""

    def rounding(self, u: Complex) -> float:
        """What the objective may be off by rounding."""

    def goals(self, u: Complex) -> tuple[float, ...]:
        """The goals before the last."""


def judge_of(problem: Problem, levels: Real = _NO_LEVELS) -> Judge:
    """That of the last goal of a problem.

    Parameters
    ----------
    levels : of the goals before it.
    """
    if problem.quantities:
        return JudgeOverRevolution(problem, levels)
    return JudgeOfNorms(problem.begun, problem.case_of if problem.goal_of_case.size > 1 else None)


@record(frozen=True)
class JudgeOverRevolution:
    """What counterweights come to over a revolution: the upper ends of brackets.

    levels : (goals - 1,) what the goals before the last may come to; an excess over one counts as that of a ceiling.
    """

    problem: Problem
    levels: Real

    @property
    def limits(self) -> Limits:
        return self.problem.limits

    @property
    def terms(self) -> int:
        rows = sum(
            peak.norms.constant.size for group in self.problem.groups for row in group.rows for peak in row.peaks
        )
        return rows + sum(len(group.weighed) for group in self.problem.groups)

    @property
    def ceilings(self) -> int:
        return len(self.problem.ceilings) + len(self.problem.limited) + self.levels.size

    @property
    def at_rest(self) -> float:
        return float(self.problem.at_rest.goals[-1])

    def objective(self, u: Complex) -> float:
        return float(self.problem.values(u, _WIDTH).goals[-1])

    def excess(self, u: Complex) -> float:
        if not self.ceilings:
            return -np.inf
        values, count = self.problem.values(u, _WIDTH), self.levels.size
        over = (values.goals[:count] - self.levels) / self.problem.units[:count]
        return float(np.max(over, initial=values.excess))

    def rounding(self, u: Complex) -> float:
        return float(self.problem.begun.rounding(u))

    def goals(self, u: Complex) -> tuple[float, ...]:
        return tuple(self.problem.values(u, _WIDTH).goals[:-1].tolist())


@record(frozen=True)
class JudgeOfNorms:
    """What counterweights come to by finitely many norms.

    statement : all groups, with ceilings and limits.
    sums : (groups,) sum to which each belongs, of which the largest counts; None where all are one sum.
    """

    statement: Statement
    sums: np.ndarray | None = None

    @property
    def limits(self) -> Limits:
        return self.statement.limits

    @property
    def terms(self) -> int:
        return self.statement.norms.constant.size

    @property
    def ceilings(self) -> int:
        return len(self.statement.ceilings.names)

    def excess(self, u: Complex) -> float:
        return float(np.max(self.statement.ceilings.excess(u), initial=-np.inf))

    def rounding(self, u: Complex) -> float:
        return float(self.statement.rounding(u))

    def goals(self, u: Complex) -> tuple[float, ...]:
        return ()

    def objective(self, u: Complex) -> float:
        statement = self.statement
        if self.sums is None:
            return float(statement.objective(u))
        largest = statement.largest(statement.rows(statement.norms.sizes(u)))
        return float(np.max(np.bincount(self.sums, largest)))

    @property
    def at_rest(self) -> float:
        return self.objective(np.zeros(self.statement.limits.radius.shape, complex))

    def within(self, limits: Limits) -> "JudgeOfNorms":
        """The same with other limits."""
        return replace(self, statement=replace(self.statement, limits=limits))

    def only(self, webs: np.ndarray) -> "JudgeOfNorms":
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
