"""Lower bounds in closed form: arrays in, bound out, whichever solver found the multipliers.

For |y_j| <= 1, P(u) >= sum_r lam_r (floor_r + sum_{j in r} Re(conj(y_j) a_j(u))), an affine function
of u whose minimum over the limits is a support function and a knapsack (docs/mathematics.md section 5). So any
multipliers give a rigorous bound; better ones give a better bound.
"""

from dataclasses import dataclass

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.program.limits import Limits
from optimizer.program.statement import Statement

#: allowance for rounding in a bound, in units of the sum of the magnitudes that enter it
_ROUNDING = 32 * np.finfo(float).eps


@dataclass(frozen=True)
class Multipliers:
    """Multipliers of one program.

    term : (..., J) lam_{r(j)} y_j, complex
    row : (..., rows) lam_r >= 0
    ceiling : (..., I) complex p_i; the multiplier of ceiling i is |p_i| (docs/mathematics.md section 5)
    """

    term: Complex
    row: Real
    ceiling: Complex

    def times(self, factor: Real) -> "Multipliers":
        factor = np.asarray(factor)[..., None]
        return Multipliers(self.term * factor, self.row * factor, self.ceiling * factor)

    def where(self, chosen: np.ndarray, other: "Multipliers") -> "Multipliers":
        """These where ``chosen`` (...), those of another elsewhere."""
        chosen = chosen[..., None]
        return Multipliers(
            np.where(chosen, self.term, other.term),
            np.where(chosen, self.row, other.row),
            np.where(chosen, self.ceiling, other.ceiling),
        )

    def chosen(self, programs: "int | np.ndarray") -> "Multipliers":
        """Those of some of the programs of one leading axis."""
        return Multipliers(self.term[programs], self.row[programs], self.ceiling[programs])

    def admissible(self, statement: Statement) -> "Multipliers":
        """The same multipliers with lam >= 0 and |y| <= 1, without which they prove nothing."""
        row = np.maximum(self.row, 0.0)
        allowed = row[..., statement.row]
        size = np.abs(self.term)
        shrink = np.where(size > allowed, allowed / np.where(size > 0, size, 1.0), 1.0)
        return Multipliers(self.term * shrink, row, self.ceiling)


def nothing_proven(statement: Statement) -> Multipliers:
    """Multipliers that are all 0, which prove that no mass is below 0."""
    return Multipliers(
        np.zeros_like(statement.norms.constant),
        np.zeros_like(statement.floor),
        np.zeros_like(statement.ceilings.norms.constant),
    )


def objective_lower_bound(statement: Statement, multipliers: Multipliers) -> Real:
    """No u within limits and ceilings has a smaller objective than this (...).

    -inf where the multipliers of the rows are all 0, which says nothing about the objective.
    """
    usable = multipliers.admissible(statement)
    total = np.sum(usable.row, axis=-1)
    usable = usable.times(1.0 / np.where(total > 0, total, 1.0))
    constant, slope, noise = _lagrangian(statement, usable)
    least, rounding = _least_over_limits(slope, np.zeros_like(statement.limits.radius), statement.limits)
    return np.where(total > 0, constant + least - noise - rounding, -np.inf)


def mass_lower_bound(statement: Statement, multipliers: Multipliers, target: Real) -> Real:
    """No u within limits and ceilings with P(u) <= target has a smaller total mass than this, kg (...).

    Parameters
    ----------
    multipliers : in kg per unit of objective (rows, terms) and of response (ceilings); the sum of
        the rows is the price nu of P(u) <= target.
    target : (...) largest objective that still counts as optimal.
    """
    usable = multipliers.admissible(statement)
    constant, slope, noise = _lagrangian(statement, usable)
    charge = np.sum(usable.row, axis=-1) * target
    least, rounding = _least_over_limits(slope, np.ones_like(statement.limits.radius), statement.limits)
    return np.maximum(constant - charge + least - noise - rounding - _ROUNDING * np.abs(charge), 0.0)


def budget_price(statement: Statement, multipliers: Multipliers, mass_cost: float) -> Real:
    """Price of the budget at which the knapsack of the bound is priced exactly (...).

    It is the gain of the web at which the budget ends, 0 where it does not end; with it the knapsack is
    sum_k max_mass_k max(gain_k - price, 0) + price budget (docs/mathematics.md section 5).

    Parameters
    ----------
    mass_cost : 0 in a bound on the objective, 1 in one on the mass.
    """
    limits = statement.limits
    _, slope, _ = _lagrangian(statement, multipliers)
    return knapsack_price(limits.radius * limits.support(-slope) - mass_cost, limits)


def knapsack_price(gain: Real, limits: Limits) -> Real:
    """Gain per kilogram (..., K) of the web at which the budget ends, at least 0; 0 where it does not end (...)."""
    order = np.argsort(-gain, axis=-1, kind="stable")
    spent = np.cumsum(np.take_along_axis(np.broadcast_to(limits.max_mass, gain.shape), order, axis=-1), axis=-1)
    unpaid = spent > limits.max_total_mass[..., None]
    return np.max(np.where(unpaid, np.take_along_axis(gain, order, axis=-1), 0.0), axis=-1, initial=0.0)


def _lagrangian(statement: Statement, multipliers: Multipliers) -> tuple[Real, Complex, Real]:
    """Constant and slope of the affine minorant, const + sum_k Re(conj(w_k) u_k), and its rounding."""
    norms, ceilings = statement.norms, statement.ceilings
    fixed = np.concatenate(
        [
            multipliers.row * statement.floor,
            (np.conj(multipliers.term) * norms.constant).real,
            (np.conj(multipliers.ceiling) * ceilings.norms.constant).real,
            -np.abs(multipliers.ceiling) * ceilings.cap,
        ],
        axis=-1,
    )
    slope = np.sum(norms.influence * multipliers.term[..., :, None], axis=-2)
    slope = slope + np.sum(ceilings.norms.influence * multipliers.ceiling[..., :, None], axis=-2)
    return np.sum(fixed, axis=-1), slope, _ROUNDING * np.sum(np.abs(fixed), axis=-1)


def _least_over_limits(slope: Complex, mass_cost: Real, limits: Limits) -> tuple[Real, Real]:
    """Minimum of sum_k (mass_cost_k m_k + Re(conj(w_k) u_k)) over the limits, and its rounding.

    One kilogram on web k gains at best R_k sigma_k - cost_k; with a budget the webs are filled in
    falling order of that gain (a fractional knapsack).
    """
    gain = np.maximum(limits.radius * limits.support(-slope) - mass_cost, 0.0)
    order = np.argsort(-gain, axis=-1, kind="stable")
    gain = np.take_along_axis(gain, order, axis=-1)
    available = np.take_along_axis(np.broadcast_to(limits.max_mass, gain.shape), order, axis=-1)
    before = np.cumsum(available, axis=-1) - available
    left = np.maximum(limits.max_total_mass[..., None] - before, 0.0)
    least = -np.sum(gain * np.minimum(available, left), axis=-1)
    return least, _ROUNDING * np.abs(least)
