"""Options for some webs of a machine, from a catalogue, and any mass at any angle for the webs behind them."""

from dataclasses import replace

import numpy as np

from optimizer.choices.catalogue_options import Stock
from optimizer.choices.feasible_set import Choice, Subproblem
from optimizer.choices.mixed.others import Others
from optimizer.choices.mixed.search import search
from optimizer.choices.semicontinuous.search import SearchGoal
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
class CastingsBeside:
    """Every web of the crankshaft takes one of its options, those of balance shafts behind them any mass in a sector,
    or one that is 0 or no less than a least one."""

    machine: Machine  # with all webs
    stock: Stock  # of those of the crankshaft
    least: Real  # (K + S,) kg, 0 where there is none
    limits: Limits  # (K + S,)
    lightest: bool  # of all that are optima, but for their share, the lightest is wanted

    solved = True

    @property
    def count(self) -> int:
        """Webs that take options."""
        return self.stock.options.on_webs.shape[0]

    @property
    def reach(self) -> Real:
        largest = np.max(np.abs(self.stock.options.on_webs), axis=-1)
        return np.concatenate([largest, self.limits.reach[self.count :]])

    def holds(self, mass_kg: Real) -> bool:
        return False

    def posed(self, statement: Statement) -> Statement:
        limits = with_castings(self.limits, self.stock)
        # what no optimum of any masses needs, those beside castings may
        return within_semicontinuous_reach(replace(statement, limits=limits), self._least)

    @property
    def _least(self) -> Real:
        """Of the webs that take no options (K + S,) kg."""
        return np.where(np.arange(self.least.size) < self.count, 0.0, self.least)

    def best(self, subproblem: Subproblem) -> Choice:
        statement, size, limits = subproblem.statement, subproblem.yardstick, subproblem.statement.limits
        behind = np.arange(self.least.size) >= self.count
        most = np.minimum(limits.max_mass, self.limits.max_mass)
        own = replace(limits, max_mass=most, alike=None, max_total_mass=np.asarray(np.inf)).only(behind)
        others = Others(own, self.least[behind] * own.radius)
        share = OPTIMUM_SHARE * size if self.lightest else 0.0
        goal = SearchGoal(subproblem.relative_gap * size, size, share, subproblem.time_limit_s)
        options = replace(self.stock.options, beside=others)
        chosen, beside, result = search(
            statement, options, others, subproblem.points, subproblem.at_least, goal, subproblem.below
        )
        mass, angle = masses_and_angles(
            self.machine, np.concatenate([options.carried(chosen), beside]), replace(limits, alike=None)
        )
        mass = np.where(np.abs(mass - self.least) <= _ROUNDING * self.least, self.least, mass)
        mass[: self.count], angle[: self.count] = self.stock.fitted(chosen)
        return Choice(mass, angle, unbalance(mass, angle, limits.radius), result, self.count)


def with_castings(limits: Limits, stock: Stock) -> Limits:
    """Limits (K + S,) with those of the first webs no larger than the largest of their options."""
    largest = np.max(np.abs(stock.options.on_webs), axis=-1)
    most = limits.max_mass.copy()
    most[: largest.size] = np.minimum(most[: largest.size], largest / limits.radius[: largest.size])
    return replace(limits, max_mass=most)
