"""The best set of options that was come upon, with the best that the other webs carry beside it."""

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.choices.mixed.others import Others
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.statement import Statement

#: sets whose other webs are solved for at once
_AT_ONCE = 64
#: by which sums of masses are rounded, relative
_ROUNDING = 1e-12


class MixedIncumbent(Incumbent):
    """Of equal objectives the lightest, all webs together."""

    def __init__(self, statement: Statement, options: Options, others: Others, resolution: float, clock: Clock) -> None:
        super().__init__(statement, options, resolution)
        self.others, self._clock = others, clock
        self.beside: Complex = np.zeros(others.least.size, complex)  # (S,) kg m
        self._offers = set[bytes]()

    @property
    def unbalance(self) -> Complex | None:
        """Of all webs (W + S,) kg m."""
        return None if self.chosen is None else np.concatenate([self.options.carried(self.chosen), self.beside])

    def programs(self, chosen: np.ndarray, statement: Statement | None = None) -> Statement:
        """Programs (M,) of the other webs beside sets (M, K), of a statement or of its own."""
        options = self.options
        mass = np.sum(options.of(options.mass, chosen), axis=-1)
        return self.others.program(statement or self.statement, options.carried(chosen), mass)

    def offer(self, chosen: np.ndarray) -> None:
        """Take the best of sets (M, K), each with the best of the other webs, or stay."""
        chosen = chosen[self.options.counts(self.statement, chosen)]
        fresh = [n for n in range(len(chosen)) if self._fresh(chosen[n])]
        for first in range(0, len(fresh), _AT_ONCE):
            some = chosen[fresh[first : first + _AT_ONCE]]
            self.offer_beside(some, self.others.best(self.programs(some), self.least, self._clock))

    def offer_beside(self, chosen: np.ndarray, beside: Complex) -> None:
        """The same of sets with what the other webs carry (M, S) kg m."""
        value = self.values(chosen, beside)
        mass = self.masses(chosen, beside)
        for n in np.argsort(value, kind="stable").tolist():
            if not np.isfinite(value[n]) or value[n] > self.least + self.resolution:
                break
            if value[n] >= self.least - self.resolution and self.chosen is not None:
                own = self.masses(self.chosen[None], self.beside[None])[0]
                if mass[n] >= own * (1.0 - _ROUNDING):
                    continue
            self.least = min(self.least, float(value[n]))
            self.chosen, self.beside = chosen[n], beside[n]

    def values(self, chosen: np.ndarray, beside: Complex) -> Real:
        """Objectives (M,), infinite of what breaks a limit."""
        statement = self.statement
        u = np.concatenate([self.options.carried(chosen), beside], axis=-1)
        mask = np.all(statement.ceilings.excess(u) <= statement.ceilings.tolerance, axis=-1)
        mask &= self.masses(chosen, beside) <= statement.limits.max_total_mass * (1.0 + _ROUNDING)
        size = np.abs(beside)
        mask &= np.all((size == 0) | (size >= self.others.least * (1.0 - _ROUNDING)), axis=-1)
        return np.where(mask, statement.objective(u), np.inf)

    def masses(self, chosen: np.ndarray, beside: Complex) -> Real:
        """Of all webs together (M,), kg."""
        options, others = self.options, self.others
        castings = np.sum(options.of(options.mass, chosen), axis=-1)
        mass: Real = castings + np.sum(np.abs(beside) / others.radius, axis=-1)
        return mass

    def _fresh(self, chosen: np.ndarray) -> bool:
        """Whether a set was not offered before."""
        code = chosen.astype(np.int32).tobytes()
        if code in self._offers:
            return False
        self._offers.add(code)
        return True
