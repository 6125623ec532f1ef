"""Two peaks that are traded for one another, and the programs that stand on them."""

from collections.abc import Sequence
from dataclasses import field, replace

import numpy as np

from optimizer.formulation.formulate import limited
from optimizer.formulation.limits import limits
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers
from optimizer.program.methods.implied_bounds import bounded, far_limits
from optimizer.program.norms import Norms
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.statement import Statement
from optimizer.responses.response import Response
from schemas.base.responses import PAIR
from schemas.machine.machine import Machine
from schemas.request.objective import Objective


@record(frozen=True)
class Trade:
    """Weighted peak force (0) and weighted peak moment (1) under the limits and ceilings of a machine.

    both : the program min max(F, M), kg m and kg m^2 (over omega^2).
    alone : min F and min M.
    cap : (2,) peaks up to which all that can be reached is reached within the limits, and no heavier; inf where these
        are the machine's own.
    """

    both: Statement
    alone: tuple[Statement, Statement]
    cap: Real = field(default_factory=lambda: np.full(2, np.inf))

    def peaks(self, u: Complex) -> Real:
        """Weighted peak force [kg m] and moment [kg m^2] with counterweights u (..., K), (..., 2)."""
        return self.both.rows(np.abs(self.both.norms.at(u)))

    def gross(self, u: Complex) -> Real:
        """Sum of what every counterweight by itself adds to each peak at most, (..., 2)."""
        sizes = np.sum(np.abs(self.both.norms.influence) * np.abs(u)[..., None, :], axis=-1)
        return np.sum(self.both.membership * sizes[..., None, :], axis=-1)

    def rounding(self, u: Complex) -> Real:
        """What each peak may change by where masses and angles are rounded (..., 2)."""
        return np.stack([program.rounding(u) for program in self.alone], axis=-1)

    @property
    def at_rest(self) -> Real:
        """Peaks without counterweights (2,)."""
        return self.peaks(np.zeros(self.both.limits.radius.shape, complex))

    def within(self, max_mass: Real, cap: Real) -> "Trade":
        """The same with other limits of the webs (K,), kg."""
        both, force, moment = (
            replace(statement, limits=replace(statement.limits, max_mass=max_mass))
            for statement in (self.both, *self.alone)
        )
        return Trade(both, (force, moment), cap)

    def reach(self, peaks: Real) -> Real:
        """Limits of the webs (K,) [kg] within which lies all that no peak of is above these (2,), all finite.

        Whatever comes to such peaks, its like lies within them: one that changes as much, and is no heavier.
        """
        nothing = np.zeros(2)
        return bounded(self.along(nothing, peaks), 1.0 - float(self._shift(nothing, peaks))).limits.max_mass

    @property
    def far(self) -> bool:
        """Whether a web has no limit, or one beyond any need, for a peak alone or for both."""
        return any(np.any(far_limits(program)) for program in (*self.alone, self.both))

    def along(self, anchor: Real, unit: Real) -> Statement:
        """min max_i (P_i - anchor_i)/unit_i: the first attainable point on the line anchor + t unit.

        A constant makes the objective without counterweights 1, so that relative gaps are those of t
        and do not depend on where the anchor lies; t is read off by :meth:`parameter`.

        Parameters
        ----------
        anchor : (2,) a point of the plane of peaks, or (N, 2) for N programs.
        unit : (2,) a direction with both components above 0.
        """
        both = self.both if anchor.ndim == 1 else self.both.alone().chosen(np.zeros(len(anchor), int))
        norms, row = both.norms, both.row
        return replace(
            both,
            norms=Norms(norms.constant / unit[row], norms.influence / unit[row, None]),
            floor=(both.floor - anchor) / unit - self._shift(anchor, unit)[..., None],
        )

    def parameter(self, objective: float, anchor: Real, unit: Real) -> float:
        """t of an objective of :meth:`along`."""
        return objective + float(self._shift(anchor, unit))

    def per_peak(self, multipliers: Multipliers, unit: Real) -> Multipliers:
        """Multipliers of :meth:`along`, rows summing to 1 or in kg, as those of :attr:`both`, per unit of a peak."""
        return Multipliers(multipliers.term / unit[self.both.row], multipliers.row / unit, multipliers.ceiling)

    def widened(self, which: int, multipliers: Multipliers) -> Multipliers:
        """Admissible multipliers of the program of peak ``which`` alone as those of :attr:`both`."""
        term = np.zeros_like(self.both.norms.constant)
        term[self.both.row == which] = multipliers.term
        return Multipliers(term, np.where(np.arange(2) == which, multipliers.row, 0.0), multipliers.ceiling)

    def _shift(self, anchor: Real, unit: Real) -> Real:
        return np.asarray(np.max((self.at_rest - anchor) / unit, axis=-1)) - 1.0


def trade(machine: Machine, objective: Objective, responses: Sequence[Response], omega_squared: float) -> Trade:
    """The trade of a machine: direction weights and ceilings count, the weights of force and moment do not."""
    across = objective.direction_weights
    caps = [(quantity, np.asarray(allowed / omega_squared)) for quantity, allowed in limited(responses, objective)]
    pair = (response for response in responses if response.name in PAIR)
    force, moment = (
        weighted_peak(quantity, np.ones(()), np.asarray(across.x), np.asarray(across.y)) for quantity in pair
    )
    bounds = limits(machine)
    return Trade(
        both=statement(combined([force, moment], "max"), caps, bounds),
        alone=(statement(combined([force], "sum"), caps, bounds), statement(combined([moment], "sum"), caps, bounds)),
    )
