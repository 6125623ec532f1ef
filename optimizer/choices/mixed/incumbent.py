"""The best set of options that was come upon, with the best that the other webs carry beside it."""

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.choices.mixed.free_webs import FreeWebs
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.statement import Statement

#: sets whose other webs are solved for at once
_AT_ONCE = 64
#: by which sums of masses are rounded, relative
_ROUNDING = 1e-12


class MixedIncumbent(Incumbent):
    """Of equal objectives the lightest, all webs together."""

    def __init__(
        self, statement: Statement, options: Options, free_webs: FreeWebs, resolution: float, clock: Clock
    ) -> None:
        super().__init__(statement, options, resolution)
        self.free_webs, self._clock = free_webs, clock
        self.beside: Complex = np.zeros(free_webs.least.size, complex)  # (S,) kg m
        self._offers = set[bytes]()

    @property
    def unbalance(self) -> Complex | None:
        """Of all webs (W + S,) kg m."""
        return None if self.selection is None else np.concatenate([self.options.carried(self.selection), self.beside])

    def programs(self, sets: np.ndarray, statement: Statement | None = None) -> Statement:
        """Programs (M,) of the other webs beside sets (M, K), of a statement or of its own."""
        options = self.options
        mass = np.sum(options.of(options.mass, sets), axis=-1)
        return self.free_webs.program(statement or self.statement, options.carried(sets), mass)

    def offer(self, sets: np.ndarray) -> None:
        """Take the best of sets (M, K), each with the best of the other webs, or stay."""
        sets = sets[self.options.counts(self.statement, sets)]
        fresh = [n for n in range(len(sets)) if self._fresh(sets[n])]
        for first in range(0, len(fresh), _AT_ONCE):
            block = sets[fresh[first : first + _AT_ONCE]]
            self.offer_beside(block, self.free_webs.best(self.programs(block), self.least, self._clock))

    def offer_beside(self, sets: np.ndarray, beside: Complex) -> None:
        """The same of sets with what the other webs carry (M, S) kg m."""
        value = self.values(sets, beside)
        mass = self.masses(sets, beside)
        for n in np.argsort(value, kind="stable").tolist():
            if not np.isfinite(value[n]) or value[n] > self.least + self.resolution:
                break
            if value[n] >= self.least - self.resolution and self.selection is not None:
                own = self.masses(self.selection[None], self.beside[None])[0]
                if mass[n] >= own * (1.0 - _ROUNDING):
                    continue
            self.least = min(self.least, float(value[n]))
            self.selection, self.beside = sets[n], beside[n]

    def values(self, sets: np.ndarray, beside: Complex) -> Real:
        """Objectives (M,), infinite of what breaks a limit."""
        statement = self.statement
        u = np.concatenate([self.options.carried(sets), beside], axis=-1)
        mask = np.all(statement.ceilings.excess(u) <= statement.ceilings.tolerance, axis=-1)
        mask &= self.masses(sets, beside) <= statement.limits.max_total_mass * (1.0 + _ROUNDING)
        size = np.abs(beside)
        mask &= np.all((size == 0) | (size >= self.free_webs.least * (1.0 - _ROUNDING)), axis=-1)
        return np.where(mask, statement.objective(u), np.inf)

    def masses(self, sets: np.ndarray, beside: Complex) -> Real:
        """Of all webs together (M,), kg."""
        options, free_webs = self.options, self.free_webs
        castings = np.sum(options.of(options.mass, sets), axis=-1)
        mass: Real = castings + np.sum(np.abs(beside) / free_webs.radius, axis=-1)
        return mass

    def _fresh(self, selection: np.ndarray) -> bool:
        """Whether a set was not offered before."""
        code = selection.astype(np.int32).tobytes()
        if code in self._offers:
            return False
        self._offers.add(code)
        return True
