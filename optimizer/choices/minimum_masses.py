"""Counterweights that are at least so heavy where they are fitted, or not there: semicontinuous masses."""

from dataclasses import replace

import numpy as np

from optimizer.choices.feasible_set import Choice, Subproblem
from optimizer.choices.semicontinuous.search import SearchGoal, search
from optimizer.formulation.counterweights import masses_and_angles, unbalance
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from optimizer.program.limits import Limits
from optimizer.program.methods.semicontinuous_bounds import within_semicontinuous_reach
from optimizer.program.solution import OPTIMUM_SHARE
from optimizer.program.statement import Statement
from schemas.machine.machine import Machine

#: of a mass, relative: what is this near to the least is the least
_ROUNDING = 1e-11


@record(frozen=True)
class MinimumMasses:
    """The mass of every web is 0, or from a least one to its limit."""

    machine: Machine
    least: Real  # (K,) kg, 0 where there is none
    limits: Limits
    lightest: bool  # prefer the lightest of all that are optima, but for their share

    solved = True

    @property
    def reach(self) -> Real:
        return self.limits.reach

    def holds(self, mass_kg: Real) -> bool:
        return bool(np.all((mass_kg == 0) | (mass_kg >= self.least)))

    def relaxation(self, statement: Statement) -> Statement:
        # what no optimum of any masses needs, those of a least mass may
        return within_semicontinuous_reach(replace(statement, limits=self.limits), self.least)

    def best(self, subproblem: Subproblem) -> Choice:
        relaxed, *points = subproblem.points
        statement, size = subproblem.statement, subproblem.yardstick
        share = OPTIMUM_SHARE * size if self.lightest else 0.0
        goal = SearchGoal(subproblem.relative_gap * size, size, share, subproblem.time_limit_s)
        least = self.least * statement.limits.radius
        u, result = search(statement, least, relaxed, subproblem.at_least, goal, points, subproblem.below)
        mass, angle = masses_and_angles(self.machine, u, statement.limits)
        mass = np.where(np.abs(mass - self.least) <= _ROUNDING * self.least, self.least, mass)
        return Choice(mass, angle, unbalance(mass, angle, self.limits.radius), result)
