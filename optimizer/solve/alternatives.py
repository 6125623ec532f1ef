"""Cheaper choices from a catalogue, beside the best one: what a little of the objective saves of mass, of castings and
of part numbers.

The least mass within an allowance is bounded by that of any masses at any angles, and found in halves below rising
masses. The fewest castings or sizes are found by one search for every number, which serves all allowances.
"""

import logging
import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from typing import NamedTuple, get_args

import numpy as np

from optimizer.choices.catalogue_options import Stock, part_numbers, stock
from optimizer.choices.discrete.ample import neighbourhoods
from optimizer.choices.discrete.clock import Clock
from optimizer.choices.discrete.lightest import lighter, lightest
from optimizer.choices.discrete.options import EQUAL, Options
from optimizer.choices.discrete.search import Known, search
from optimizer.formulation.counterweights import counterweights
from optimizer.formulation.demand import of_any_mass
from optimizer.formulation.goals import cone_program
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.fixed_weights import beside
from optimizer.numerics.arrays import Complex
from optimizer.program.cuts.dominance import Group
from optimizer.program.cuts.optimum import Found, Reached, next_goal, over_turn
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.methods.implied_bounds import within_reach
from optimizer.program.methods.optima import optima
from optimizer.program.reference.solver import Solver
from optimizer.program.rows import total_mass
from optimizer.program.statement import Statement
from optimizer.solve.uncertain_program import Robust
from schemas.answer.alternatives import Alternative, Cheaper
from schemas.request.requests import OptimizeRequest

_LOG = logging.getLogger(__name__)
#: share of the time limit of the request that all of this may take, and of that the share of the mass
_TIME, _MASS = 0.5, 0.4
#: options of a slot near to the optimum of any masses, and light ones of another, pass by pass
_COUNTS = ((40, 120), (80, 300))
#: numbers of castings or sizes that are looked at, each to a gap; sets of webs that are
_NUMBERS, _GAP, _SUBSETS = 6, 1e-3, 300


def alternatives(request: OptimizeRequest, scene: Prepared, u: Complex, solver: Solver) -> tuple[Alternative, ...]:
    """What is cheaper than the best choice within each allowance, without what a smaller allowance gives already.

    Parameters
    ----------
    u : (K,) kg m, the best choice, without the weights that are fixed.
    """
    cheaper = _Cheaper(request, scene, u, solver)
    bounds = {"mass": cheaper.lightest(), "pieces": cheaper.fewest("pieces"), "sizes": cheaper.fewest("sizes")}
    listed: list[Alternative] = []
    for minimised in get_args(Cheaper):
        known = cheaper.best
        for allowance, bound in zip(cheaper.allowances, bounds[minimised], strict=True):
            choice = cheaper.cheapest(minimised, allowance)
            if choice.cost(minimised) < known.cost(minimised) * (1.0 - EQUAL):
                listed.append(cheaper.described(minimised, allowance, choice, bound))
                known = choice
    return tuple(listed)


@dataclass(frozen=True)
class _Choice:
    """A choice, and what it costs."""

    options: np.ndarray  # (K,)
    value: float  # of the objective
    mass: float  # kg
    pieces: int
    sizes: int

    def cost(self, minimised: Cheaper) -> float:
        return float({"mass": self.mass, "pieces": self.pieces, "sizes": self.sizes}[minimised])


class _AnyMass(NamedTuple):
    """What is known of any masses at any angles on few webs."""

    lower_bound: float
    points: tuple[Complex, ...]  # (K,) kg m


class _Cheaper:
    """The searches of one answer, and every choice that they have come upon."""

    def __init__(self, request: OptimizeRequest, scene: Prepared, u: Complex, solver: Solver) -> None:
        self.request, self.scene, self.u, self.solver = request, scene, u, solver
        square = np.array([scene.omega_squared])
        program = cone_program(request.machine, request.objective, scene.responses, square)
        self.statement: Statement = within_reach(program, solver).chosen(0)
        self.stock: Stock = stock(request.machine)
        self.every = [np.flatnonzero(some) for some in self.options.exists]
        self.size = float(self.statement.at_rest) or 1.0
        self.seconds = _TIME * request.accuracy.time_limit_s
        self.allowances = sorted(set(request.alternatives))
        alike = self.options.alike
        self.best = self._choice(self.options.nearest(u if alike is None else alike.means(u)))
        self.choices = [self.best]

    @cached_property
    def free(self) -> tuple[Problem, Found, float]:
        """The problem of any masses at any angles, its optimum, and the gap of that."""
        robust = Robust(self.request, self.scene, of_any_mass(self.request)._replace(time_limit_s=self.seconds))
        program, gap = robust.asked().program, robust.wanted.relative_gap
        first = over_turn(program, gap, False, robust.left_s)
        assert isinstance(first, Found)  # the best choice keeps the ceilings
        return program, first, gap

    @property
    def options(self) -> Options:
        return self.stock.options

    def level(self, allowance: float) -> float:
        """What the objective may come to."""
        return self.best.value * (1.0 + allowance) + EQUAL * self.size

    def cheapest(self, minimised: Cheaper, allowance: float) -> _Choice:
        """Of all choices within an allowance that were come upon."""
        within = [choice for choice in self.choices if choice.value <= self.level(allowance)]
        return min(within, key=lambda choice: (choice.cost(minimised), choice.value))

    def _choice(self, options: np.ndarray) -> _Choice:
        mass, _ = self.stock.fitted(options)
        value = float(self.statement.objective(self.options.carried(options)))
        return _Choice(options, value, float(np.sum(mass)), int(np.sum(mass > 0)), part_numbers(mass))

    def lightest(self) -> list[float]:
        """Look for the lightest within each allowance: its lower bound, kg."""
        bounds, seconds = list[float](), _MASS * self.seconds / max(len(self.allowances), 1)
        for allowance in self.allowances:
            any_mass, clock, level = self._of_any_mass(allowance), Clock(seconds), self.level(allowance)
            at_least, known = max(any_mass.proof.bound, 0.0), self.cheapest("mass", allowance).mass
            found = lightest(self.statement, self.options, self.every, level, (at_least, known), clock)
            if found.chosen is None and found.lower_bound < known:
                self._near(any_mass.point.unbalance, allowance, clock)
            elif found.chosen is not None:
                self.choices.append(self._choice(found.chosen))
            bounds.append(found.lower_bound)
        return bounds

    def _near(self, relaxed: Complex, allowance: float, clock: Clock) -> None:
        """Look for lighter choices near the lightest of any masses."""
        alike = self.options.alike
        about = relaxed if alike is None else alike.means(relaxed)
        for near, many in _COUNTS:
            for which in neighbourhoods(self.options, about, near, many):
                if clock.spent():
                    return
                below = self.cheapest("mass", allowance).mass
                found = lighter(self.statement, self.options, which, self.level(allowance), below, clock)
                if found is not None:
                    self.choices.append(self._choice(found))

    def _of_any_mass(self, allowance: float) -> Found:
        """The least mass of any masses at any angles within an allowance."""
        program, first, gap = self.free
        reached = Reached(program.goals[-1].name, self.best.value, first.proof, self.level(allowance))
        weighed = program.changed(goals=(*program.goals, Goal("mass", (Group((total_mass(program.limits),)),))))
        return next_goal(weighed, [reached], self.u, gap, self.seconds)

    def fewest(self, minimised: Cheaper) -> list[float]:
        """Look for the fewest castings, or sizes: of each allowance the number that so many are at least."""
        own, clock = self.best.cost(minimised), Clock(0.5 * (1.0 - _MASS) * self.seconds)
        numbers, smallest, largest = range(int(own))[:_NUMBERS], self.level(self.allowances[0]), self.allowances[-1]
        proven: list[float] = []  # of every number, what the objective comes to at least
        for number in numbers:
            if clock.spent():
                break
            bound, found = self._fewest(minimised, number, self.level(largest), clock.left_s / (len(numbers) - number))
            proven.append(bound)
            if found is not None:
                self.choices.append(self._choice(found))
                if self.choices[-1].value <= smallest:
                    break
        return [
            float(next((n for n, bound in enumerate(proven) if bound <= self.level(allowance)), len(proven)))
            for allowance in self.allowances
        ]

    def _fewest(self, minimised: Cheaper, number: int, level: float, seconds: float) -> tuple[float, np.ndarray | None]:
        """What so many castings or sizes come to at least, and the best choice of them (K,), if one is worth it."""
        if minimised == "pieces" or number == 0:
            some, known = replace(self.options, most_fitted=number), self._of_few_webs(number)
        else:
            some, known = replace(self.options, most_parts=number), _AnyMass(-np.inf, ())
        if known.lower_bound > level:
            return known.lower_bound, None
        found = search(self.statement, some, self.u, known.lower_bound, _GAP, self.size, seconds, Known(known.points))
        return max(found.lower_bound, known.lower_bound), found.chosen if found.kept else None

    def _of_few_webs(self, number: int) -> _AnyMass:
        """What any masses on so few webs come to at least, and the optimum of these."""
        limits = self.statement.limits
        webs = limits.radius.size
        if limits.alike is not None or math.comb(webs, number) > _SUBSETS:
            return _AnyMass(-np.inf, ())
        subsets = np.zeros((math.comb(webs, number), webs), bool)
        for n, some in enumerate(combinations(range(webs), number)):
            subsets[n, list(some)] = True
        programs = self.statement.alone().chosen(np.zeros(len(subsets), int))
        programs = replace(programs, limits=replace(programs.limits, max_mass=subsets * limits.max_mass))
        found = optima(programs, of_any_mass(self.request).relative_gap, False, self.solver)
        lower_bound = np.where(found.unreachable, np.inf, found.lower_bound)
        best = int(np.argmin(np.where(found.unreachable, np.inf, found.objective)))
        return _AnyMass(float(np.min(lower_bound)), (found.unbalance[best],))

    def described(self, minimised: Cheaper, allowance: float, choice: _Choice, bound: float) -> Alternative:
        """As it is answered."""
        machine = self.request.machine
        mass, angle = beside(machine, *self.stock.fitted(choice.options))
        total = float(np.sum(mass))
        fixed = total - choice.mass if minimised == "mass" else 0.0
        cost, proven = choice.cost(minimised), None
        if bound > cost * (1.0 + EQUAL):
            _LOG.error("a choice of %s %g is below its bound of %g", minimised, cost, bound)
        else:
            # sums of masses are rounded
            proven = min(bound, cost)
        return Alternative(
            minimised=minimised,
            allowance=allowance,
            objective=choice.value * self.scene.omega_squared,
            total_mass_kg=total,
            pieces=choice.pieces,
            sizes=choice.sizes,
            lower_bound=None if proven is None else proven + fixed,
            counterweights=counterweights(machine, mass, angle),
        )
