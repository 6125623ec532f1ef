"""Lower bounds in closed form: arrays in, bound out. Multipliers may come from any solver.

For |y_j| <= 1 and lam of sum 1 in each group, P(u) >= sum_r lam_r (floor_r + sum_{j in r} Re(conj(y_j) a_j(u))), an
affine function of u whose minimum over the limits is a support function and a knapsack (docs/mathematics.md section 5).
So any multipliers give a rigorous bound; better ones give a better bound.
"""

from collections.abc import Iterable

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.compiled_evaluation import Dual, Minorants
from optimizer.program.statement import Statement

_EPS = float(np.finfo(float).eps)
#: for the rounding of a product
_UP = 1.0 + 64 * _EPS


@record(frozen=True)
class Multipliers:
    """Multipliers of one program.

    term : (..., J) lam_{r(j)} y_j, complex
    row : (..., rows) lam_r >= 0
    ceiling : (..., I) complex p_i; the multiplier of ceiling i is |p_i| (docs/mathematics.md section 5)
    """

    term: Complex
    row: Real
    ceiling: Complex

    @property
    def parts(self) -> Dual:
        """Of terms, rows and ceilings."""
        return self.term, self.row, self.ceiling

    def times(self, factor: Real) -> "Multipliers":
        factor = np.asarray(factor)[..., None]
        return Multipliers(self.term * factor, self.row * factor, self.ceiling * factor)

    def subset(self, programs: "int | np.ndarray | tuple[np.ndarray, ...]") -> "Multipliers":
        """Those of some of the programs by their leading axes."""
        return Multipliers(self.term[programs], self.row[programs], self.ceiling[programs])

    def put(self, n: "int | np.ndarray", multipliers: "Multipliers") -> None:
        """Those of one or some of the programs of one leading axis, in place."""
        self.term[n], self.row[n], self.ceiling[n] = multipliers.term, multipliers.row, multipliers.ceiling

    def price(self, statement: Statement) -> Real:
        """What a unit of the objective costs: the sum of the rows of a group, alike in all if admissible (...)."""
        rows = self.row if statement.group[-1] == 0 else self.row[..., statement.group == 0]
        return np.add.reduce(rows, axis=-1)

    def admissible(self, statement: Statement) -> "Multipliers":
        """The same multipliers with lam >= 0 of one sum in every group, |y| <= 1, and y real of a scalar.

        Others prove nothing.
        """
        row = _alike(statement, np.maximum(self.row, 0.0))
        allowed = row[..., statement.row]
        size = np.abs(self.term)
        over = size > allowed
        # a term of 1e-310 divides nothing: the quotient would be infinite
        shrink = np.where(over, allowed / np.where(over, size, 1.0), 1.0)
        term = statement.norms.counting(self.term * shrink)
        return Multipliers(term, row, statement.ceilings.norms.counting(self.ceiling))


def _alike(statement: Statement, row: Real) -> Real:
    """Multipliers of rows with the same sum, the price of the objective, in every group (..., rows).

    What a group lacks it gets at its highest floor, which is true of any u.
    """
    if statement.group[-1] == 0:
        return row
    price = np.add.reduceat(row, statement.first_rows, axis=-1)
    lacking = np.maximum.reduce(price, axis=-1, keepdims=True) - price
    return row + statement.where_largest(statement.floor) * lacking[..., statement.group]


def nothing_proven(statement: Statement) -> Multipliers:
    """Multipliers that are all 0, which prove that no mass is below 0."""
    return Multipliers(
        np.zeros(statement.norms.constant.shape, complex),
        np.zeros(statement.floor.shape),
        np.zeros(statement.ceilings.norms.constant.shape, complex),
    )


def objective_lower_bound(statement: Statement, multipliers: Multipliers) -> Real:
    """No u within limits and ceilings has a smaller objective than this (...).

    -inf where the multipliers of the rows are all 0, which says nothing about the objective.
    """
    return statement.flat.bounds(*multipliers.parts)


def best_proof(statement: Statement, proofs: Iterable[Multipliers]) -> tuple[Real, Multipliers]:
    """The highest of the lower bounds (...) that several multipliers prove, and those that prove it: the first of equal
    ones. All are evaluated at once, as many programs are."""
    candidates = list(proofs)
    every = together(candidates)
    bound = objective_lower_bound(statement, every)
    best = np.where(np.isnan(bound), -np.inf, bound).argmax(axis=0)
    if not np.count_nonzero(best):
        return bound[0], candidates[0]
    place = (best, *np.indices(best.shape))
    return bound[place], every.subset(place)


def together(several: Iterable[Multipliers]) -> Multipliers:
    """Several multipliers of the same programs as those of one more leading axis."""
    term, row, ceiling = zip(*(multipliers.parts for multipliers in several), strict=True)
    return Multipliers(np.array(term), np.array(row), np.array(ceiling))


def mass_lower_bound(statement: Statement, multipliers: Multipliers, target: Real) -> Real:
    """Nothing within the limits that counts as keeping the ceilings, with P(u) <= target, is lighter than this (...).

    Parameters
    ----------
    multipliers : in kg per unit of objective (rows, terms) and of response (ceilings); the sum of
        the rows of a group is the price nu of P(u) <= target.
    target : (...) largest objective that still counts as optimal.
    """
    return statement.flat.bounds(*multipliers.parts, target)


def mass_bound_up_to(bound: Real, price: Real, more: Real) -> Real:
    """A bound on the mass of all whose objective comes to so much more, by the multipliers that proved it (...).

    Parameters
    ----------
    price : (...) kg per unit of the objective.
    """
    return np.maximum(bound - price * more * _UP, 0.0)


def affine_minorant(statement: Statement, multipliers: Multipliers) -> tuple[Real, Complex, Real]:
    """An affine function that is nowhere above the objective of what counts as keeping the ceilings.

    Returns
    -------
    constant (...) without its rounding, -inf where nothing is proven; slopes (..., K), Re(conj(slope_k) u_k) of the
    unbalances; and what the slopes may be off by (..., K).
    """
    minorant = _minorants(statement, multipliers, with_tolerance=True, normal=True)
    return minorant.constant, minorant.slope, minorant.rounding


def tolerance_allowance(statement: Statement, multipliers: Multipliers) -> Real:
    """What a bound on the mass gives up for all that counts as keeping the ceilings but exceeds them (...), kg."""
    ceilings = statement.ceilings
    return np.add.reduce(np.abs(multipliers.ceiling) * ceilings.tolerance * ceilings.size, axis=-1)


def budget_price(statement: Statement, multipliers: Multipliers, mass_cost: float) -> Real:
    """Price of the budget at which the knapsack of the bound is priced exactly (...).

    It is the gain of the web at which the budget ends, 0 where it does not end; with it the knapsack is
    sum_k max_mass_k max(gain_k - price, 0) + price budget (docs/mathematics.md section 5).

    Parameters
    ----------
    mass_cost : 0 in a bound on the objective, 1 in one on the mass.
    """
    limits = statement.limits
    ends = limits.budget_ends
    if not np.count_nonzero(ends):
        return np.zeros(ends.shape)
    minorant = _minorants(statement, multipliers, with_tolerance=False, normal=False)
    # with the rounding of the slopes, as in the bound: at a lower price a web behind this one would gain something
    # a plate that is opened further adds a kilogram at its edge (section 18)
    _, price = limits.spent(limits.margin * minorant.support - mass_cost)
    return price


def ceiling_allowance(statement: Statement, multipliers: Multipliers, excess: Real) -> Real:
    """What an objective bound falls by if it has to hold for all u that exceed the ceilings by this much (...).

    Parameters
    ----------
    multipliers : those of the bound.
    excess : (..., I) in units of the ceilings' size; what is below 0 is none.
    """
    if not (excess > 0).any():
        return np.zeros(excess.shape[:-1])
    usable, mask = normalised(statement, multipliers)
    over = np.maximum(excess, 0.0) * statement.ceilings.size
    allowance = np.add.reduce(np.where(over > 0, np.abs(usable.ceiling) * over, 0.0), axis=-1)
    return np.where(mask, allowance, 0.0)


def normalised(statement: Statement, multipliers: Multipliers) -> tuple[Multipliers, np.ndarray]:
    """Admissible multipliers whose rows sum to 1 in every group, and where there are any (...)."""
    usable = multipliers.admissible(statement)
    total = usable.price(statement)
    mask = proves(total)
    return usable.times(1.0 / np.where(mask, total, 1.0)), mask


def proves(price: Real) -> np.ndarray:
    """Whether rows that sum to this in every group say anything about the objective (...)."""
    return (price > 0) & np.isfinite(price)


def spread(statement: Statement, multipliers: Multipliers) -> Real | float:
    """What a bound rises by, or less, for a kilogram metre on each web because counterweights scatter (..., K)."""
    if not statement.norms.scatter and not statement.ceilings.norms.scatter:
        return 0.0
    return _minorants(statement, multipliers, with_tolerance=False, normal=False).spread


def _minorants(statement: Statement, multipliers: Multipliers, with_tolerance: bool, normal: bool) -> Minorants:
    """As :meth:`optimizer.program.compiled_evaluation.Flat.minorants`."""
    return statement.flat.minorants(*multipliers.parts, with_tolerance, normal)
