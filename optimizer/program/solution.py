"""Counterweights with their proof."""

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Any, TypeVar

import numpy as np

from optimizer.numerics.arrays import Complex, Real, mapped
from optimizer.numerics.records import record
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.certificate import Multipliers, nothing_proven
from optimizer.program.statement import Statement

#: an excess that rounding alone may make, as a share of the size: solvers keep ceilings up to here
CEILING_ROUNDING = 1e-13
#: optima are within this share of the objective without counterweights (docs/api/certificate.md)
OPTIMUM_SHARE = 1e-6
#: counterweights below this share of the largest are left out where the answer stays optimal
NEGLIGIBLE = 1e-7

Kind = TypeVar("Kind", bound="Solutions")

CONE_PROGRAM = "cone program, clarabel"
INTERIOR_POINT = "interior point, compiled"
CLOSED_FORM = "closed form, nothing to choose"


@record(frozen=True)
class ConeSolution:
    """Counterweights with their proof; every figure is evaluated from ``unbalance``, none is the solver's.

    With a conflict no counterweights keep the ceilings, and these are closest to them.
    """

    unbalance: Complex  # (K,) kg m
    objective: float
    lower_bound: float
    mass: float  # kg
    mass_lower_bound: float  # kg, 0 until the least mass was sought
    excess: float  # largest relative excess over a ceiling; -inf without ceilings
    multipliers: Multipliers  # those of the lower bound; all 0 where nothing is proven yet
    method: str = CLOSED_FORM
    certify_s: float = 0.0  # time spent on bounds
    mass_multipliers: Multipliers | None = None  # those of the lower bound of the mass
    mass_target: float = np.inf  # largest objective that this bound counts as an optimum
    conflict: Multipliers | None = None  # those of the excess that prove that none keep the ceilings: rows are ceilings

    @property
    def gap(self) -> float:
        return self.objective - self.lower_bound

    @property
    def keeps_ceilings(self) -> bool:
        """Within their tolerance."""
        return self.excess <= CEILING_TOLERANCE

    @property
    def below_ceilings(self) -> bool:
        """Up to rounding."""
        return self.excess <= CEILING_ROUNDING

    def bounded(self, bound: float, multipliers: Multipliers) -> "ConeSolution":
        """The same point with the better of two proofs of its objective."""
        return replace(self, lower_bound=bound, multipliers=multipliers) if bound > self.lower_bound else self

    def weighed(self, bound: float, multipliers: Multipliers | None, target: float) -> "ConeSolution":
        """The same point with the better of two proofs of its mass."""
        if not bound > self.mass_lower_bound:
            return self
        return replace(self, mass_lower_bound=bound, mass_multipliers=multipliers, mass_target=target)

    def with_point(self, statement: Statement, u: Complex) -> "ConeSolution":
        """Another point with the bounds that are proven already."""
        return replace(
            self,
            unbalance=u,
            objective=float(statement.objective(u)),
            mass=float(statement.mass(u)),
            excess=float(np.max(statement.ceilings.excess(u), initial=-np.inf)),
        )


@record(frozen=True)
class Solutions:
    """Counterweights of N programs with their proofs; every figure is evaluated from ``unbalance``."""

    unbalance: Complex  # (N, K) kg m
    objective: Real  # (N,)
    lower_bound: Real  # (N,)
    mass: Real  # (N,) kg
    mass_lower_bound: Real  # (N,) kg, of all that count as optima; 0 where the least mass was not sought
    excess: Real  # (N,) largest relative excess over a ceiling, -inf without ceilings
    multipliers: Multipliers  # (N, ...), those of the lower bound
    mass_multipliers: Multipliers  # (N, ...), those of the lower bound of the mass
    mass_target: Real  # (N,) largest objective that this bound counts as an optimum
    certify_s: Real  # (N,) time spent on bounds
    clean: np.ndarray  # (N,) bool: no counterweight is next to nothing beside the largest; False where nobody looked

    def subset(self: Kind, programs: np.ndarray) -> Kind:
        """Those of some of the programs."""
        return mapped(self, lambda array: array[programs])

    def put(self: Kind, programs: np.ndarray, solutions: Kind) -> None:
        """Others for some of the programs, in place."""
        for field in fields(self):
            value, replacement = getattr(self, field.name), getattr(solutions, field.name)
            if isinstance(value, Multipliers):
                value.put(programs, replacement)
            else:
                value[programs] = replacement


def side_by_side(parts: Sequence[Any], order: np.ndarray) -> Any:
    """Solutions of one kind side by side, then in an order of all programs."""
    if isinstance(parts[0], np.ndarray):
        return np.concatenate(parts)[order]
    names = [field.name for field in fields(parts[0])]
    return type(parts[0])(*(side_by_side([getattr(part, name) for part in parts], order) for name in names))


def evaluated(statement: Statement, u: Complex) -> ConeSolution:
    """What an unbalance amounts to; nothing proven yet."""
    nothing = ConeSolution(u, np.inf, -np.inf, np.inf, 0.0, np.inf, nothing_proven(statement))
    return nothing.with_point(statement, u)
