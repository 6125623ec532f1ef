"""What multipliers prove of one stage of a program over the turn, for all angles, since no u makes a quantity smaller
than its cuts."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.certificate import (
    Multipliers,
    best_proof,
    mass_bound_up_to,
    mass_lower_bound,
    nothing_proven,
    objective_lower_bound,
)
from optimizer.program.cuts.floors import floor_multipliers
from optimizer.program.cuts.semi_infinite import Cuts, Problem
from optimizer.program.limits import Limits
from optimizer.program.multipliers import mass_multipliers, objective_multipliers, resting_multipliers
from optimizer.program.statement import Statement

#: shares of several sums, which are to sum to no more than 1
_MEAN = 1.0 - 64 * np.finfo(float).eps


@record(frozen=True)
class Proof:
    """A bound by multipliers of a statement with finitely many cuts.

    charge : what the goals that are kept below a level are charged with: the bound of several goals is that of the
        statement, whose groups are those of all goals times their prices, less this.
    cuts : of every quantity, in the order of the statement.
    prices : of a bound of the mass, what its rows are multiplied by in sum where the last goal may come to one more.
    scale : (groups,) what the groups of the statement are multiplied by; None where they are as they are.
    laid : that by which it was proven, with tangents in place of plates whose mass counts; None without plates.
    """

    bound: float
    statement: Statement
    multipliers: Multipliers
    charge: float = 0.0
    cuts: tuple[int, ...] = ()
    prices: float = 1.0
    scale: Real | None = None
    laid: Statement | None = None

    def of_webs(self, statement: Statement) -> "Proof":
        """The same of the statement whose plates have tangents in the one of the proof."""
        return replace(
            self, statement=statement if self.scale is None else times(statement, self.scale), laid=self.statement
        )

    @property
    def with_pieces(self) -> Statement:
        """The statement whose limits price a budget: with what was laid in place of plates."""
        return self.statement if self.laid is None else self.laid

    def within(self, limits: Limits) -> "Proof":
        """The same with other limits, of which it is true as well; a budget stays priced by those that proved it."""
        return replace(self, statement=replace(self.statement, limits=limits), laid=self.with_pieces)

    def up_to(self, more: float) -> "Proof":
        """That of the mass of all whose last goal comes to so much more."""
        # of one sum the multipliers tell it; of several they sum to 1 and the groups have the prices
        price = self.prices * self.multipliers.admissible(self.statement).price(self.statement)
        return replace(self, bound=float(mass_bound_up_to(np.asarray(self.bound), price, np.asarray(more))))


def resting_proof(program: Problem, cuts: Cuts, statement: Statement) -> Proof:
    """What is proven of the last goal without a solver, whatever the goals before it come to.

    Parameters
    ----------
    statement : of the program with these cuts.
    """
    last = np.flatnonzero(program.goal_of_case == len(program.goals) - 1)
    proofs = []
    for case in last:
        scale = (program.case_of == case).astype(float)
        alone = times(statement, scale)
        candidates = (*resting_multipliers(alone), floor_multipliers(program, cuts, alone))
        bound, best = best_proof(alone, candidates)
        proofs.append(Proof(float(bound), alone, best, 0.0, tuple(map(len, cuts)), scale=scale))
    return max(proofs, key=lambda proof: proof.bound)


def proofs(
    program: Problem, cuts: Cuts, statement: Statement, u: Complex, dual: Multipliers, levels: Real
) -> Iterator[Proof]:
    """Bounds of the last goal, or of the mass, by the multipliers of the solver and by sharper ones.

    Parameters
    ----------
    statement : of the program with these cuts.
    u : the solver's point.
    dual : the solver's multipliers, of the statement whose goals are in their units where there are several.
    levels : levels that the bound counts with, of all goals but the last; of all where the mass is to be small.
    """
    of_mass = levels.size == len(program.goals)
    charge, prices, scale = float(np.sum(levels)), 1.0, None
    if program.goal_of_case.size > 1:
        statement, dual, charges = _charged(program, of_mass, statement, dual)
        cases, scale = program.goal_of_case < levels.size, charges[program.case_of]
        charge = float(np.sum(charges[cases] * levels[program.goal_of_case[cases]]))
        prices = float(np.sum(charges[program.goal_of_case == len(program.goals) - 1]))
    sharper = mass_multipliers if of_mass else objective_multipliers
    for multipliers in sharper(statement, u, dual):
        if of_mass:
            bound = float(mass_lower_bound(statement, multipliers, np.asarray(charge)))
        else:
            bound = float(objective_lower_bound(statement, multipliers)) - charge
        if np.isfinite(bound):
            yield Proof(bound, statement, multipliers, charge, tuple(map(len, cuts)), prices, scale)


def _charged(
    program: Problem, of_mass: bool, statement: Statement, dual: Multipliers
) -> tuple[Statement, Multipliers, Real]:
    """The statement whose groups have the prices of their sums, where each group's multipliers sum to 1."""
    case_of, goal_of_case, unit_of = program.case_of, program.goal_of_case, units(program)
    price = np.zeros(goal_of_case.size)
    np.maximum.at(price, case_of, np.add.reduceat(np.maximum(dual.row, 0.0), statement.first_rows))
    last = goal_of_case == len(program.goals) - 1
    unit = 1.0 if of_mass else float(np.sum(price[last])) / unit_of[-1]
    if not unit > 0:
        return statement, nothing_proven(statement), price
    charges = price / unit_of[goal_of_case] / unit
    if np.count_nonzero(last) > 1:
        # the largest sum is no less than their mean, whatever the rounding of the shares
        charges[last] *= _MEAN
    factors = np.where(price > 0, 1.0 / np.where(price > 0, price, 1.0), 0.0)[case_of]
    multipliers = Multipliers(
        dual.term * factors[statement.group][statement.row], dual.row * factors[statement.group], dual.ceiling / unit
    )
    return times(statement, charges[case_of]), multipliers, charges


def units(program: Problem) -> Real:
    """(goals,) what the goals are divided by before they are dual: one alone stays as it is."""
    return program.units if len(program.goals) > 1 else np.ones(1)


def times(statement: Statement, factor: Real) -> Statement:
    """The statement with its groups times factors (groups,)."""
    if np.all(factor == 1.0):
        return statement
    of_row = factor[statement.group]
    of_term = of_row[statement.row]
    norms = replace(
        statement.norms,
        constant=statement.norms.constant * of_term,
        influence=statement.norms.influence * of_term[:, None],
    )
    return replace(statement, norms=norms, floor=statement.floor * of_row)
