"""Options for some webs of a machine, from a catalogue, and any mass at any angle for the others."""

from dataclasses import replace

import numpy as np

from optimizer.choices.catalogue_options import Stock
from optimizer.choices.feasible_set import Choice, Subproblem
from optimizer.choices.mixed.free_webs import FreeWebs
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
    """Some webs take one of their options. The others take any mass in a sector, or one that is 0 or above a minimum.
    Such are balance shafts beside castings on the crankshaft, or the other way round."""

    machine: Machine  # with all webs
    stock: Stock  # of those that take options
    castings: np.ndarray  # (K,) bool: those
    least: Real  # (K,) kg, of the others; 0 where there is none
    limits: Limits  # (K,)
    lightest: bool  # prefer the lightest of all that are optima, but for their share

    solved = True

    @property
    def reach(self) -> Real:
        reach = self.limits.reach.copy()
        reach[self.castings] = np.max(np.abs(self.stock.options.on_webs), axis=-1)
        return reach

    def holds(self, mass_kg: Real) -> bool:
        return False

    def relaxation(self, statement: Statement) -> Statement:
        limits = with_castings(self.limits, self.stock, self.castings)
        # what no optimum of any masses needs, those beside castings may
        return within_semicontinuous_reach(replace(statement, limits=limits), self.least)

    def best(self, subproblem: Subproblem) -> Choice:
        size, limits, free = subproblem.yardstick, subproblem.statement.limits, ~self.castings
        most = np.minimum(limits.max_mass, self.limits.max_mass)
        own = replace(limits, max_mass=most, alike=None, max_total_mass=np.asarray(np.inf)).only(free)
        beside = FreeWebs(own, self.least[free] * own.radius)
        goal = SearchGoal(
            subproblem.relative_gap * size,
            size,
            OPTIMUM_SHARE * size if self.lightest else 0.0,
            subproblem.time_limit_s,
        )
        options = replace(self.stock.options, beside=beside)
        # those that take options come first
        order = np.concatenate([np.flatnonzero(self.castings), np.flatnonzero(free)])
        below = subproblem.below
        selection, free_unbalance, result = search(
            subproblem.statement.permutation(order),
            options,
            beside,
            subproblem.points[:, order],
            subproblem.at_least,
            goal,
            None if below is None else below.permutation(order),
        )
        u = np.zeros(limits.radius.shape, complex)
        u[order] = np.concatenate([options.carried(selection), free_unbalance])
        mass, angle = masses_and_angles(self.machine, u, replace(limits, alike=None))
        mass = np.where(np.abs(mass - self.least) <= _ROUNDING * self.least, self.least, mass)
        mass[self.castings], angle[self.castings] = self.stock.fitted(selection)
        return Choice(mass, angle, unbalance(mass, angle, limits.radius), result, self.castings)


def with_castings(limits: Limits, stock: Stock, castings: np.ndarray) -> Limits:
    """Limits (K,) with those of webs that take options no larger than the largest of these."""
    largest = np.max(np.abs(stock.options.on_webs), axis=-1)
    most = limits.max_mass.copy()
    most[castings] = np.minimum(most[castings], largest / limits.radius[castings])
    return replace(limits, max_mass=most)
