"""What multipliers prove of the options left of many nodes, and better multipliers for that.

Whatever they are, P >= constant + sum_k min over the options left of Re(conj(slope_k) u), with prices for the budget
and for the number of counterweights (docs/mathematics.md section 16). An option by which that minimum rises to what is
the incumbent's value needs no search: it is forced out.
"""

from typing import NamedTuple

import numpy as np

from optimizer.choices.discrete.options import Beside, Options
from optimizer.choices.node_bounds import NodeBounds, price_of_budget
from optimizer.choices.node_bounds import uphill as uphill_by
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import Multipliers, affine_minorant
from optimizer.program.statement import Statement


def proven(statement: Statement, options: Options, left: np.ndarray, multipliers: Multipliers) -> NodeBounds:
    """What multipliers prove of the options left (N, K, O) of N nodes (N,)."""
    constant, slope, rounding = affine_minorant(statement, multipliers)
    beside = _Beside.of(options, slope, rounding)
    if beside is not None:
        slope, rounding = slope[..., : beside.first], rounding[..., : beside.first]
    size = np.abs(options.unbalance)
    value = _along(options.of_first(slope), options.unbalance) - options.together(rounding)[..., None] * size
    value = np.where(left, value, np.inf)
    budget = options.budget(statement)
    charged = budget if np.isfinite(budget) else 0.0

    def least(price: Real) -> tuple[Real, Real]:
        """The least sum at a price of the mass (N,), and the mass that it takes."""
        priced = value + price[:, None, None] * options.mass
        place = np.argmin(priced, axis=-1)[..., None]
        minimum = np.take_along_axis(priced, place, axis=-1)[..., 0]
        mass = np.take_along_axis(np.broadcast_to(options.mass, left.shape), place, axis=-1)[..., 0]
        if options.limits_fitted:
            can_stay = left[..., 0]
            gain = np.where(can_stay, np.minimum(minimum - priced[..., 0], 0.0), 0.0)
            # those that gain most for each of their webs, and of the last the share that there is room for
            room = (options.most_fitted or 0) - np.sum(np.where(can_stay, 0, options.webs), axis=-1)
            order = np.argsort(gain / options.webs, axis=-1, kind="stable")
            webs = np.where(np.take_along_axis(can_stay, order, axis=-1), options.webs[order], 0)
            share = np.clip((room[:, None] - np.cumsum(webs, axis=-1) + webs) / np.maximum(webs, 1), 0.0, 1.0)
            share = np.take_along_axis(share, np.argsort(order, axis=-1, kind="stable"), axis=-1)
            minimum = np.where(can_stay, priced[..., 0] + share * gain, minimum)
            mass = np.where(can_stay, share * mass, mass)
        sums, masses = np.sum(minimum, axis=-1) - price * charged, np.sum(mass, axis=-1)
        if beside is None:
            return sums, masses
        more, free_masses = beside.lowest(price)
        return sums + more, masses + free_masses

    def high() -> Real:
        """What every option could gain, by the lightest of all."""
        lightest = np.where(left, options.mass, np.inf)
        step = np.max(np.where(left & (options.mass > 0), np.abs(value), 0.0), axis=(1, 2))
        step = step / np.maximum(np.min(np.where(lightest > 0, lightest, np.inf), axis=(1, 2)), 1e-300)
        step = np.where(np.isfinite(step), 2.0 * step, 0.0)
        return step if beside is None else np.maximum(step, beside.high)

    budget_price, best = price_of_budget(least, budget, left.shape[0], high)
    magnitude = np.abs(constant) + np.sum(np.max(np.where(left, np.abs(value), 0.0), axis=-1), axis=-1)
    if beside is not None:
        magnitude = magnitude + beside.magnitude
    constant = constant - 1e-14 * (magnitude + options.slots * budget_price * charged)
    bound = constant + best
    # of one option in place of the best of its slot, whatever number of counterweights
    priced = value + budget_price[:, None, None] * options.mass
    lowest = np.min(priced, axis=-1, keepdims=True)
    apart = constant + np.sum(lowest[..., 0], axis=-1) - budget_price * charged
    if beside is not None:
        apart = apart + beside.lowest(budget_price)[0]
    with np.errstate(invalid="ignore"):
        forced = apart[:, None, None] + (priced - lowest)
    return NodeBounds(
        np.where(np.isnan(bound), -np.inf, bound), np.where(np.isnan(forced), -np.inf, forced), budget_price
    )


def uphill(
    statement: Statement, options: Options, left: np.ndarray, multipliers: Multipliers, price: Real, target: float
) -> Multipliers:
    """Multipliers of the terms that prove more of the options left, as far as ``target``."""
    # only what is left, side by side
    most = int(np.max(np.sum(left, axis=-1)))
    place = np.argsort(~left, axis=-1, kind="stable")[..., :most]
    slots = np.arange(options.slots)[:, None]
    u = options.unbalance[slots, place]
    cost = np.where(np.take_along_axis(left, place, axis=-1), price[:, None, None] * options.mass[slots, place], np.inf)
    budget = options.budget(statement)

    def lowest(slope: Complex) -> tuple[Real, Complex]:
        webs = slope.shape[-1] if options.beside is None else slope.shape[-1] - options.beside.most.size
        total = _along(options.of_first(slope[..., :webs]), u) + cost
        choice = np.argmin(total, axis=-1)[..., None]
        there = np.take_along_axis(u, choice, axis=-1)[..., 0]
        carried = there if options.alike is None else options.alike.carried(there)
        sums = np.sum(np.take_along_axis(total, choice, axis=-1)[..., 0], axis=-1)
        if options.beside is None:
            return sums, carried
        more, free = options.beside.lowest(slope[..., webs:], price[:, None] / options.beside.radius)
        return sums + np.sum(more, axis=-1), np.concatenate([carried, free], axis=-1)

    charge = price * budget if np.isfinite(budget) else np.zeros_like(price)
    return uphill_by(statement, multipliers, charge, lowest, target)


class _Beside(NamedTuple):
    """What is proven of the webs that take no options, of N nodes."""

    beside: Beside
    slope: Complex  # (N, S)
    rounding: Real  # (N, S)
    first: int  # of them among all webs

    @classmethod
    def of(cls, options: Options, slope: Complex, rounding: Real) -> "_Beside | None":
        beside = options.beside
        if beside is None:
            return None
        first = slope.shape[-1] - beside.most.size
        return cls(beside, slope[..., first:], rounding[..., first:], first)

    def lowest(self, price: Real) -> tuple[Real, Real]:
        """The least sums at a price of the mass (N,), and the masses there."""
        value, u = self.beside.lowest(self.slope, price[:, None] / self.beside.radius - self.rounding)
        return np.sum(value, axis=-1), np.sum(np.abs(u) / self.beside.radius, axis=-1)

    @property
    def high(self) -> Real:
        """Prices at which none of them takes anything (N,)."""
        return 2.0 * np.max(self.beside.radius * (np.abs(self.slope) + self.rounding), axis=-1, initial=0.0)

    @property
    def magnitude(self) -> Real:
        """Of what is summed (N,)."""
        return np.sum(np.abs(self.slope) * self.beside.most, axis=-1)


def _along(slope: Complex, u: Complex) -> Real:
    """Re(conj(slope_k) u_ko) (N, K, O), of unbalances (K, O) or (N, K, O)."""
    along: Real = slope.real[..., None] * u.real + slope.imag[..., None] * u.imag
    return along
