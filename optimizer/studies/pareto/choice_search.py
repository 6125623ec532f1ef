"""Searches of a front for what is chosen: from a catalogue, heavy enough where it is fitted, or cut from plates.

Such sets are not convex, and no line from an anchor meets their front. A point is the optimum of the largest of the
responses, each as a share of a unit, with the mass under a budget where it is traded as well (weighted Chebyshev,
Steuer and Choo 1983; epsilon constraint, Haimes, Lasdon and Wismer 1971). A bound t_low of that search proves that no
choice within the budget is below t_low times the unit in every other response.
"""

from collections.abc import Mapping
from dataclasses import replace
from time import thread_time
from typing import Literal

import numpy as np

from optimizer.formulation.formulate import weighing
from optimizer.formulation.formulate import weights as own_weights
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.mechanics.fixed_weights import fixed_masses
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.solve.solution import Infeasible, Solution
from optimizer.solve.solve import solve
from optimizer.solve.uncertain_program import Robust
from optimizer.solve.worst_case import nominal
from optimizer.studies.pareto.measures import Measures, measures
from schemas.base.variation import with_fields
from schemas.front.trade import Traded
from schemas.request.objective import Objective

#: least gap that may be asked of an optimum
_LEAST_GAP = 1e-12
#: least time of a search, s
_LEAST_TIME = 1e-3
_NO_CEILINGS: Mapping[str, float] = {}
#: fields of the weights of what is traded beside the responses on the frame
_BESIDE: Mapping[Traded, str] = {"bearings": "bearing_weight", "bending": "bending_weight", "roll": "roll_weight"}


@record(frozen=True)
class ChoicePoint:
    """Counterweights that are chosen, beside what they come to in D responses, in the units of the answer."""

    solution: Solution
    values: Real  # (D,)
    corner: Real  # (D,) no choice is below this in all of them; nan where nothing is proven


class ChoiceSearch:
    """What the searches of one front share, in the units of the answer; all together end at the time of the task.

    Parameters
    ----------
    task : weighs all that is traded, under one limit of the total mass.
    """

    def __init__(self, task: Task, names: tuple[Traded, ...], scene: Prepared) -> None:
        self.task, self.names, self.scene = task, names, scene
        self.gap, self.seconds = task.relative_gap, task.time_limit_s
        self.until = thread_time() + self.seconds
        self.square = np.array([1.0 if name == "mass" else scene.omega_squared for name in names])
        self.fixed = float(np.sum(fixed_masses(task.machine)))
        self.is_mass = np.array([name == "mass" for name in names])
        self.nothing = np.zeros(len(task.space.machine.webs), complex)

    @cached_property
    def traded(self) -> Measures:
        """What is traded, with all changes of masses that may be the worst."""
        return measures(self.robust.goals().anywhere, self.names)

    @cached_property
    def robust(self) -> Robust:
        """What may be off of what is traded."""
        return Robust(self.task, self.scene, self.task.demand)

    @cached_property
    def at_rest(self) -> Real:
        """What there is without counterweights (D,)."""
        return self.values(self.nothing)

    @property
    def left_s(self) -> float:
        """Time that is left, s."""
        return self.until - thread_time()

    def values(self, u: Complex) -> Real:
        """What unbalances (K,) come to (D,)."""
        return self._in_units(self.traded, u)

    def nominal_values(self, u: Complex) -> Real | None:
        """The same with nothing off, where anything may be."""
        if not self.task.uncertain:
            return None
        return self._in_units(measures(nominal(self.robust).program, self.names), u)

    def _in_units(self, traded: Measures, u: Complex) -> Real:
        result = traded.values(u) * self.square
        return np.where(self.is_mass, result + self.fixed, result)

    def gross(self, point: ChoicePoint) -> Real:
        """What every counterweight of a point by itself adds to each response at most, summed (D,)."""
        return self.traded.gross(point.solution.unbalance) * self.square

    def first_along(
        self, unit: Real, size: Real, seconds: float, budget: float | None = None
    ) -> ChoicePoint | Infeasible:
        """The best choice as shares of a unit (D,), under a budget where the mass is traded.

        Parameters
        ----------
        size : (D,) what gaps are relative to.
        """
        counts = ~self.is_mass
        weights = {name: 1.0 / float(scale) for name, scale in zip(self.names, unit, strict=True) if name != "mass"}
        # gaps are relative to the largest share without counterweights, and are asked for of every response
        yardstick = float(np.max((self.at_rest / unit)[counts])) or 1.0
        gap = self.gap * float(np.min((size / unit)[counts])) / yardstick
        return self.optimum(weights, gap, seconds, budget)

    def optimum(
        self,
        weights: Mapping[Traded, float],
        gap: float,
        seconds: float,
        budget: float | None = None,
        combine: Literal["sum", "max"] = "max",
        ceilings: Mapping[str, float] = _NO_CEILINGS,
    ) -> ChoicePoint | Infeasible:
        """The best choice for the largest of some responses times their weights, or for their sum.

        Parameters
        ----------
        budget : limit of the total mass, kg; None is that of the task.
        combine : of a sum no corner is proven.
        ceilings : of the objective in place of its own, by field.
        """
        machine = self.task.machine
        if budget is not None:
            # nothing checked: a budget below what is fixed leaves no counterweights
            machine = with_fields(machine, {("max_total_mass_kg",): budget})
        goal = self._weighing(weights, combine, ceilings)
        limit = min(max(seconds, _LEAST_TIME), self.seconds)
        gap = min(max(gap, _LEAST_GAP), 1.0)
        task = replace(self.task, machine=machine, objective=goal, relative_gap=gap, time_limit_s=limit)
        best = solve(task, replace(self.scene, machine=machine, objective=goal), in_full=False, worst_case=False)
        if isinstance(best, Infeasible):
            return best
        values = np.where(self.is_mass, best.placement.mass_kg, self.values(best.unbalance))
        bound = best.certificate.lower_bound
        corner = np.full(values.shape, np.nan)
        if bound is not None and combine == "max":
            # a response that does not count is not below what it comes to here
            proven = [bound / weights[name] if name in weights else np.nan for name in self.names]
            corner = np.where(np.isnan(proven), values, proven)
        return ChoicePoint(best, values, corner)

    def _weighing(
        self, weights: Mapping[Traded, float], combine: Literal["sum", "max"], ceilings: Mapping[str, float]
    ) -> Objective:
        """The largest of the responses times their weights, or their sum; the objective itself times its own."""
        objective = self.task.objective
        if "objective" in weights:
            own = own_weights(self.task.machine, objective)
            more = {name: float(weight) * weights["objective"] for name, weight in own.items()}
            return weighing(objective, more)
        beside = {field: weights.get(name, 0.0) for name, field in _BESIDE.items()}
        return weighing(objective, weights, combine=combine, **beside, **ceilings)
