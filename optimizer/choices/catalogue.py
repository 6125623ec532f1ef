"""Finitely many options for every web, from a machine's catalogue, holes and steps of angle."""

import numpy as np

from optimizer.choices.catalogue_options import Stock
from optimizer.choices.discrete.search import Prior, search
from optimizer.choices.feasible_set import Choice, SearchResult, Subproblem
from optimizer.formulation.counterweights import unbalance
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from optimizer.program.statement import Statement


@record(frozen=True)
class Catalogue:
    """Every web takes one of its options, the first of which is nothing."""

    stock: Stock
    radius: Real  # (K,) m

    solved = False

    @property
    def reach(self) -> Real:
        return np.max(np.abs(self.stock.options.on_webs), axis=-1)

    def holds(self, mass_kg: Real) -> bool:
        return False

    def relaxation(self, statement: Statement) -> Statement:
        return statement

    def best(self, subproblem: Subproblem) -> Choice:
        relaxed, *points = subproblem.points
        selection, result = search(
            subproblem.statement,
            self.stock.options,
            relaxed,
            subproblem.at_least,
            subproblem.relative_gap,
            subproblem.yardstick,
            subproblem.time_limit_s,
            Prior(points, subproblem.below),
        )
        return self.picked(selection, result)

    def picked(self, selection: np.ndarray, result: SearchResult) -> Choice:
        """Options (K,) as a choice."""
        mass, angle = self.stock.fitted(selection)
        return Choice(mass, angle, unbalance(mass, angle, self.radius), result)
