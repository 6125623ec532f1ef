"""Counterweights that are optimised with the parts: the value of each assignment with its best counterweights.

An assignment changes the program only in its constants, so multipliers of one bound all others (docs/mathematics.md).
For a workshop's counterweights this is the program of any masses, of which theirs are some. Then each assignment is
searched, cut or certified by itself.
"""

import time
from typing import NamedTuple, cast

import numpy as np

from optimizer.formulation.balance_shafts import design_space
from optimizer.formulation.formulate import responses
from optimizer.formulation.goals import cone_program
from optimizer.formulation.task import Task
from optimizer.mechanics.fixed_weights import laden
from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.layout import layout, spread
from optimizer.mechanics.shapes import closed_everywhere, every_plate
from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.outputs.registry import prepare
from optimizer.program.certificate import Multipliers, normalised, objective_lower_bound
from optimizer.program.methods.optima import optima
from optimizer.program.statement import Statement
from optimizer.solve.solution import Solution
from optimizer.solve.solve import solve
from optimizer.studies.matching.problem import Minorants, Problem
from schemas.base.rules import Path
from schemas.base.variation import with_fields
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.match.request import MatchRequest
from schemas.request.requests import OptimizeRequest

#: target gap of every program, in units of its objective without counterweights
_GAP = 1e-6
#: of what may be left open that part which a search of one assignment may leave, and its limits
_OPEN, _CLOSEST = 0.5, 1e-12
#: the shortest time that a search gets, s
_SHORTEST_S = 1e-3


class Solved(NamedTuple):
    """What assignments (N,) come to, over omega squared."""

    value: Real  # (N,), inf where the bound leaves no room for a better one, or the time was over
    lower_bound: Real  # (N,)
    below: Minorants  # of all assignments
    fitted: list[Solution | None]  # None where any mass at any angle is a choice


@record(frozen=True)
class CounterweightOptima:
    """What counterweights make of assignments."""

    request: MatchRequest
    problem: Problem
    near: float  # what may be left open, over omega squared
    until: float  # of this thread's own time, when no more are searched

    @property
    def is_nonconvex(self) -> bool:
        """Whether every assignment is certified by itself: with options, minimum masses, or plates."""
        machine = self.request.machine
        return machine.choice is not None or every_plate(machine) is not None

    def at(self, mass: Real, best: float) -> Solved:
        """Assignments (N, T), and what they prove of all.

        Parameters
        ----------
        best : objective of the best assignment so far; what is proven to be no better is not searched.
        """
        row_mass = self.problem.row_masses(mass)
        program = self._programs(row_mass)
        answer = optima(program, _GAP, False)
        below = self._minorants(program, answer.multipliers, mass)
        if not self.is_nonconvex:
            return Solved(answer.objective, answer.lower_bound, below, [None] * len(mass))
        value, bound = np.full(len(mass), np.inf), answer.lower_bound.copy()
        fitted_there: list[Solution | None] = [None] * len(mass)
        for n in np.argsort(bound, kind="stable").tolist():
            late = time.thread_time() >= self.until and np.isfinite(best)
            if late or bound[n] >= best:
                break
            value[n], own, fitted_there[n] = self._searched(row_mass[n], float(program.at_rest[n]))
            bound[n], best = max(bound[n], own), min(best, float(value[n]))
        return Solved(value, bound, below, fitted_there)

    @cached_property
    def _optimize_request(self) -> OptimizeRequest:
        return OptimizeRequest(machine=self.request.machine, objective=self.request.objective)

    @cached_property
    def _convex_machine(self) -> ReciprocatingMachine:
        """The machine whose counterweights have any mass within their limits; plates reach as far as they can."""
        return cast(ReciprocatingMachine, closed_everywhere(self.request.machine))

    def _programs(self, row_mass: Real) -> Statement:
        machine = with_masses(self._convex_machine, row_mass)
        leading = row_mass.shape[:-1]
        plan = spread(laden(layout(machine), machine), leading)
        space, objective = design_space(machine, self.request.objective)
        base = responses(plan, rotating(plan).plus(reciprocating(plan, 1)), objective)
        return cone_program(space, objective, base, np.ones(leading))

    def _searched(self, row_mass: Real, at_rest: float) -> tuple[float, float, Solution]:
        """Value, certified bound and counterweights of one assignment, over omega squared.

        Parameters
        ----------
        at_rest : the objective without counterweights, which gaps are relative to.
        """
        machine = with_masses(self.request.machine, row_mass)
        gap = np.clip(_OPEN * self.near / at_rest if at_rest > 0 else 1.0, _CLOSEST, 1.0)
        left = max(self.until - time.thread_time(), _SHORTEST_S)
        task = Task(machine, self.request.objective, self._optimize_request.fidelity, float(gap), left)
        scene = prepare(self._optimize_request, self._optimize_request.outputs, machine=machine)
        # without ceilings nothing is infeasible
        solution = solve(task, scene, in_full=False).certain()
        proof = solution.certificate
        bound = -np.inf if proof.lower_bound is None else proof.lower_bound / scene.omega_squared
        return proof.objective / scene.omega_squared, bound, solution

    def _minorants(self, program: Statement, multipliers: Multipliers, mass: Real) -> Minorants:
        """The bounds as functions of the vectors of the parts."""
        usable, mask = normalised(program, multipliers)
        problem, proven = self.problem, objective_lower_bound(program, multipliers)
        floor = problem.terms < 0
        weight = np.where(floor, usable.row[:, problem.row], 0.0)
        slope = np.where(floor, 0.0, usable.term[:, np.maximum(problem.terms, 0)])
        v = problem.vectors(mass)
        constant = proven - np.sum(np.real(np.conj(slope) * v) + weight * np.abs(v), axis=-1)
        mask &= np.isfinite(constant)
        return Minorants(constant[mask], slope[mask], weight[mask])


def with_masses(machine: ReciprocatingMachine, increase: Real) -> ReciprocatingMachine:
    """The machine with more on its rows, kg: numbers (rows,), or columns (N, rows) of many machines."""
    places = [(t, r) for t, throw in enumerate(machine.throws) for r in range(len(throw.rows))]
    values: dict[Path, Real | float] = {}
    for (t, r), more in zip(places, np.moveaxis(increase, -1, 0), strict=True):
        heavier = machine.throws[t].rows[r].reciprocating_mass_kg + more
        values["throws", t, "rows", r, "reciprocating_mass_kg"] = heavier if more.ndim else float(heavier)
    return with_fields(machine, values)
