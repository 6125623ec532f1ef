"""Counterweights that are chosen with the parts: what each assignment comes to with those that are best for it.

An assignment changes the program only in its constants, so multipliers of one bound all others (docs/mathematics.md).
"""

from dataclasses import dataclass

import numpy as np

from optimizer.formulation.formulate import responses
from optimizer.formulation.goals import cone_program
from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.layout import layout, spread
from optimizer.numerics.arrays import Real
from optimizer.program.certificate import Multipliers, normalised, objective_lower_bound
from optimizer.program.methods.optima import optima
from optimizer.program.reference.solver import Solver
from optimizer.program.statement import Statement
from optimizer.studies.matching.problem import Minorants, Problem
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.throws import Row
from schemas.match.request import MatchRequest

#: asked of every program, in units of its objective without counterweights
_GAP = 1e-6


@dataclass(frozen=True)
class Chosen:
    """What counterweights make of assignments."""

    request: MatchRequest
    problem: Problem
    solver: Solver

    def at(self, mass: Real) -> tuple[Real, Real, Minorants]:
        """Objectives and certified lower bounds (N,) of assignments (N, T), over omega squared, and what they prove."""
        program = self._programs(self.problem.row_masses(mass))
        found = optima(program, _GAP, False, self.solver)
        return found.objective, found.lower_bound, self._minorants(program, found.multipliers, mass)

    def _programs(self, row_mass: Real) -> Statement:
        machine = with_masses(self.request.machine, row_mass)
        leading = row_mass.shape[:-1]
        plan = spread(layout(machine), leading)
        base = responses(plan, rotating(plan).plus(reciprocating(plan, 1)), self.request.objective)
        return cone_program(machine, self.request.objective, base, np.ones(leading))

    def _minorants(self, program: Statement, multipliers: Multipliers, mass: Real) -> Minorants:
        """The bounds as functions of the vectors of the parts."""
        usable, known = normalised(program, multipliers)
        problem, proven = self.problem, objective_lower_bound(program, multipliers)
        floor = problem.terms < 0
        weight = np.where(floor, usable.row[:, problem.row], 0.0)
        slope = np.where(floor, 0.0, usable.term[:, np.maximum(problem.terms, 0)])
        v = problem.vectors(mass)
        constant = proven - np.sum(np.real(np.conj(slope) * v) + weight * np.abs(v), axis=-1)
        known &= np.isfinite(constant)
        return Minorants(constant[known], slope[known], weight[known])


def with_masses(machine: ReciprocatingMachine, added: Real) -> ReciprocatingMachine:
    """The machine with more on its rows, kg: numbers (rows,), or columns (N, rows) of many machines."""
    masses = iter(np.moveaxis(added, -1, 0))
    throws = tuple(
        throw.model_copy(update={"rows": tuple(_heavier(row, next(masses)) for row in throw.rows)})
        for throw in machine.throws
    )
    return machine.model_copy(update={"throws": throws})


def _heavier(row: Row, added: Real) -> Row:
    heavier = row.reciprocating_mass_kg + added
    return row.model_copy(update={"reciprocating_mass_kg": heavier if added.ndim else float(heavier)})
