"""Slots and their options, and the best set of them that was come upon."""

from typing import Protocol

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.equal_castings import Alike
from optimizer.program.statement import Statement

#: objectives nearer than this share of the yardstick are equal
EQUAL = 1e-9
#: parts of the smallest mass that may be the unit of all, and what a whole multiple may be off by
_SHARES, _WHOLE = 10, 1e-9
_EPS = float(np.finfo(float).eps)


class Beside(Protocol):
    """Webs that take no options but any mass, or none, in a sector of their own; behind those of the slots."""

    @property
    def most(self) -> Real:
        """Largest unbalance of every web (S,), kg m."""
        ...

    @property
    def radius(self) -> Real:
        """Of every web (S,), m."""
        ...

    def lowest(self, slope: Complex, price: Real) -> tuple[Real, Complex]:
        """Least of Re(conj(slope_k) u_k) + price_k |u_k| of every web (N, S), or less, and where it is, kg m."""
        ...


@record(frozen=True)
class Options:
    """What each of K slots can take, O options at most; the first option of every slot is nothing.

    A slot is a web, or all webs that carry alike counterweights: then what it takes is on each of them.
    """

    unbalance: Complex  # (K, O) kg m, on the first web of a slot
    mass: Real  # (K, O) kg, on all webs of a slot together
    part: np.ndarray  # (K, O) int: the part number, -1 is no part
    exists: np.ndarray  # (K, O) bool, False beyond the options of a slot
    most_fitted: int | None = None  # webs that may take more than nothing
    most_parts: int | None = None  # different part numbers that may be used
    alike: Alike | None = None  # whose units are the slots; None: every web is one
    beside: Beside | None = None  # further webs of a program; None where all take options

    @property
    def slots(self) -> int:
        return self.mass.shape[0]

    @cached_property
    def webs(self) -> np.ndarray:
        """How many webs each slot is (K,)."""
        return np.ones(self.slots, int) if self.alike is None else self.alike.count

    @property
    def limits_fitted(self) -> bool:
        """Whether the number of counterweights is limited to fewer than there are webs."""
        return self.most_fitted is not None and self.most_fitted < int(np.sum(self.webs))

    @property
    def limits_parts(self) -> bool:
        """Whether the number of part numbers is limited to fewer than there are."""
        return self.most_parts is not None and self.most_parts < int(np.max(self.part, initial=-1)) + 1

    def budget(self, statement: Statement) -> float:
        """Largest total mass, kg, and what the rounding of as many masses adds to it, which bounds allow for."""
        return float(statement.limits.max_total_mass) * (1.0 + _EPS * (1 + int(np.sum(self.webs))))

    @cached_property
    def unit_kg(self) -> float:
        """The common unit of which all masses are whole multiples, as of steps; 0 without a common unit."""
        masses = self.mass[self.exists & (self.mass > 0)]
        for share in range(1, _SHARES + 1) if masses.size else ():
            unit = float(np.min(masses)) / share
            if np.all(np.abs(masses / unit - np.round(masses / unit)) <= _WHOLE):
                return unit
        return 0.0

    def next_mass(self, least: float) -> float:
        """The smallest mass, kg, that a set may have where none is lighter than so much."""
        unit = self.unit_kg
        return max(least, float(np.ceil(least / unit * (1.0 - _WHOLE) - _WHOLE)) * unit) if unit > 0 else least

    def of(self, array: np.ndarray, selection: np.ndarray) -> np.ndarray:
        """Elements of an array (K, O) for a selection of options (..., K)."""
        values: np.ndarray = array[np.arange(self.slots), selection]
        return values

    @cached_property
    def on_webs(self) -> Complex:
        """What every option puts on each of the webs (W, O) of its slot, kg m."""
        return self.unbalance if self.alike is None else self.alike.carried(self.unbalance.T).T

    def carried(self, selection: np.ndarray) -> Complex:
        """Unbalances of all webs (..., W) with a selection of options (..., K), kg m."""
        u = self.of(self.unbalance, selection)
        return u if self.alike is None else self.alike.carried(u)

    def of_first(self, slope: Complex) -> Complex:
        """Slopes (..., K) in what the first webs carry, of slopes in what all webs do (..., W)."""
        return slope if self.alike is None else self.alike.means(slope) * self.alike.count

    def together(self, of_webs: Real) -> Real:
        """Sums over the webs of every slot (..., K)."""
        summed: Real = of_webs if self.alike is None else self.alike.summed(of_webs)
        return summed

    def effect(self, slot: int, choices: np.ndarray | slice, influence: Real | Complex) -> Complex:
        """What some options of a slot do to J terms (some, J), of influences of the webs (J, W)."""
        webs = np.array([slot]) if self.alike is None else np.flatnonzero(self.alike.owner == slot)
        result: Complex = self.on_webs[webs][:, choices].T @ influence[:, webs].T
        return result

    def counts(self, statement: Statement, sets: np.ndarray) -> np.ndarray:
        """Whether sets (..., K) keep budget and counts."""
        mass = self.of(self.mass, sets)
        mask = np.sum(mass, axis=-1) <= self.budget(statement)
        if self.limits_fitted:
            mask &= (sets > 0) @ self.webs <= self.most_fitted
        if self.limits_parts:
            parts = np.sort(self.of(self.part, sets), axis=-1)
            new = np.concatenate([parts[..., :1] >= 0, (np.diff(parts, axis=-1) > 0)], axis=-1)
            mask &= np.sum(new, axis=-1) <= self.most_parts
        return mask

    def nearest(self, u: Complex) -> np.ndarray:
        """The option of every slot that is nearest to an unbalance of its first web (..., K)."""
        off = np.where(self.exists, np.abs(self.unbalance - u[..., None]), np.inf)
        return np.argmin(off, axis=-1)


class Incumbent:
    """The best set so far: of equal objectives the lightest, then the least sum of |u|^2, then the order of webs."""

    def __init__(self, statement: Statement, options: Options, resolution: float) -> None:
        """``resolution``: objectives that differ by no more are equal."""
        self.statement, self.options, self.resolution = statement, options, resolution
        self.least = np.inf  # smallest objective of a set within all limits
        self.selection: np.ndarray | None = None  # (K,)

    @cached_property
    def coordinates(self) -> tuple[Real, Complex]:
        """Influences of the terms in few coordinates (J, s), and what the options do to these (K, O, s).

        Influences of terms and ceilings are a product of few columns and orthonormal rows.
        """
        influence = self.statement.every_influence
        size = np.max(np.abs(influence), axis=-1, keepdims=True, initial=0.0)
        scaled = influence / np.where(size > 0, size, 1.0)
        _, singular, basis = np.linalg.svd(scaled, full_matrices=False)
        basis = basis[singular > 1e-14 * singular[0]] if singular.size else basis
        lever = (influence @ np.conj(basis.T))[: self.statement.norms.constant.size]
        every = slice(None)
        effects = [self.options.effect(k, every, basis) for k in range(self.options.slots)]
        return lever, np.array(effects, complex).reshape(*self.options.mass.shape, basis.shape[0])

    @property
    def level(self) -> float:
        """What an objective may come to and still be the answer."""
        return self.least + self.resolution

    def left(self, more: float) -> Real:
        """What the terms of every row (rows,) may come to where the objective is no more than the level and more."""
        statement = self.statement
        highest = statement.largest(statement.floor)
        rest = np.sum(highest) - highest
        room: Real = self.level + more - rest[statement.group] - statement.floor
        return room

    def offer(self, sets: np.ndarray) -> None:
        """Take the best of sets (M, K), or stay."""
        statement, options = self.statement, self.options
        sets = sets[options.counts(statement, sets)]
        if not len(sets):
            return
        u = options.carried(sets)
        mask = np.all(statement.ceilings.excess(u) <= statement.ceilings.tolerance, axis=-1)
        value = np.where(mask, statement.objective(u), np.inf)
        near = value <= min(float(np.min(value)), self.least) + self.resolution
        if not np.any(near & np.isfinite(value)):
            return
        self.least = min(self.least, float(np.min(value)))
        candidates = sets[near]
        if self.selection is not None and self._value(self.selection) <= self.level:
            candidates = np.concatenate([self.selection[None], candidates])
        self.selection = candidates[self._first(candidates)]

    def _value(self, selection: np.ndarray) -> float:
        return float(self.statement.objective(self.options.carried(selection)))

    def _first(self, sets: np.ndarray) -> int:
        """Place of the first in the order among equals."""
        mass = np.sum(self.options.of(self.options.mass, sets), axis=-1)
        square = np.sum(np.abs(self.options.carried(sets)) ** 2, axis=-1)
        # in steps, so that sums in another order do not differ
        steps = [np.round(measure / (1e-9 * (np.max(measure) or 1.0))) for measure in (mass, square)]
        return int(np.lexsort((*sets.T[::-1], steps[1], steps[0]))[0])
