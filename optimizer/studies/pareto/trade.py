"""Two peaks that are traded for one another, and the programs that stand on them."""

from collections.abc import Sequence
from dataclasses import field, replace

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers
from optimizer.program.cuts.dominance import Group
from optimizer.program.cuts.optimum import Conflict, over_turn
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.methods.implied_bounds import bounded, far_limits
from optimizer.program.methods.optima import optima
from optimizer.program.rows import Row
from optimizer.program.solution import ConeSolution, evaluated
from optimizer.program.statement import Statement
from optimizer.studies.pareto.measures import scaled
from schemas.base.responses import PAIR


@record(frozen=True)
class Trade:
    """Weighted peak force (0) and weighted peak moment (1) under the limits and ceilings of a machine.

    Each is the largest of its rows: one for every change of the masses that is known to count, in every case.

    minimax : the program min max(F, M), kg m and kg m^2 (over omega^2).
    alone : min F and min M.
    peak : (rows,) to which of both peaks a row belongs.
    program : of both, without limits of the webs that are nearer.
    cap : (2,) peaks up to which all that can be reached is reached within the limits, and no heavier; inf where these
        are the machine's own.
    """

    minimax: Statement
    alone: tuple[Statement, Statement]
    peak: np.ndarray
    program: Problem
    cap: Real = field(default_factory=lambda: np.full(2, np.inf))

    def peaks(self, u: Complex) -> Real:
        """Weighted peak force [kg m] and moment [kg m^2] with counterweights u (..., K), (..., 2)."""
        return self._largest(self.minimax.rows(self.minimax.norms.sizes(u)))

    def gross(self, u: Complex) -> Real:
        """Sum of what every counterweight by itself adds to each peak at most, (..., 2)."""
        sizes = np.sum(np.abs(self.minimax.norms.influence) * np.abs(u)[..., None, :], axis=-1)
        return self._largest(np.sum(self.minimax.membership * sizes[..., None, :], axis=-1))

    def _largest(self, rows: Real) -> Real:
        """The largest row of each peak (..., 2) of what rows have (..., rows)."""
        if self.peak.size == len(PAIR):
            # one of each, in their order
            return rows
        return np.stack([np.max(rows[..., self.peak == n], axis=-1) for n in range(len(PAIR))], axis=-1)

    def rounding(self, u: Complex) -> Real:
        """What each peak may change by where masses and angles are rounded (..., 2)."""
        return np.stack([program.rounding(u) for program in self.alone], axis=-1)

    @property
    def at_rest(self) -> Real:
        """Peaks without counterweights (2,)."""
        return self.peaks(np.zeros(self.minimax.limits.radius.shape, complex))

    def within(self, max_mass: Real, cap: Real) -> "Trade":
        """The same with other limits of the webs (K,), kg."""
        minimax, force, moment = (
            replace(statement, limits=replace(statement.limits, max_mass=max_mass))
            for statement in (self.minimax, *self.alone)
        )
        program = self.program.changed(limits=minimax.limits)
        return replace(self, minimax=minimax, alone=(force, moment), program=program, cap=cap)

    def reach(self, peaks: Real) -> Real:
        """Limits of the webs (K,) [kg] within which lies all that no peak of is above these (2,), all finite.

        Whatever comes to such peaks, its like lies within them: one that changes as much, and is no heavier.
        """
        nothing = np.zeros(2)
        return bounded(self.along(nothing, peaks), 1.0 - float(self._shift(nothing, peaks))).limits.max_mass

    @property
    def bent(self) -> bool:
        """Whether parts of the front may be straight at any slope: something scatters, or a peak has several rows."""
        return self.minimax.norms.scatter > 0.0 or self.peak.size > len(PAIR)

    @property
    def far(self) -> bool:
        """Whether a web has no limit, or one beyond any need, for a peak alone or for both."""
        return any(np.any(far_limits(program)) for program in (*self.alone, self.minimax))

    def along(self, anchor: Real, unit: Real) -> Statement:
        """min max_i (P_i - anchor_i)/unit_i: the first attainable point on the line anchor + t unit.

        A constant makes the objective without counterweights 1, so that relative gaps are those of t
        and do not depend on where the anchor lies; t is read off by :meth:`parameter`.

        Parameters
        ----------
        anchor : (2,) a point of the plane of peaks, or (N, 2) for N programs.
        unit : (2,) a direction with both components above 0.
        """
        minimax = self.minimax if anchor.ndim == 1 else self.minimax.alone().subset(np.zeros(len(anchor), int))
        norms, of_row = minimax.norms, unit[self.peak]
        of_term = of_row[minimax.row]
        return replace(
            minimax,
            norms=replace(norms, constant=norms.constant / of_term, influence=norms.influence / of_term[:, None]),
            floor=(minimax.floor - anchor[..., self.peak]) / of_row - self._shift(anchor, unit)[..., None],
        )

    def smallest(self, index: int, relative_gap: float, least_mass: bool) -> ConeSolution:
        """The smallest value of one peak alone, or the proof that nothing keeps the ceilings."""
        program, alone = self.alone[index], self.program.changed(goals=(self._goal(index),))
        if alone.finite is not None:
            return optima(program.alone(), relative_gap, least_mass).single()
        return _by_cuts(program, alone, relative_gap, least_mass)

    def met(
        self, programs: Statement, anchors: Real, unit: Real, relative_gap: float, least_mass: bool
    ) -> list[ConeSolution]:
        """The first attainable points on the lines from anchors (N, 2), of their programs by :meth:`along`."""
        if self.program.finite is not None:
            together = optima(programs, relative_gap, least_mass)
            return [together.single(n) for n in range(len(anchors))]
        (group,), shift = self.program.groups, self._shift(anchors, unit)
        results = []
        for n, (anchor, off) in enumerate(zip(anchors, shift.tolist(), strict=True)):
            start, edges = (anchor + off * unit).tolist(), unit.tolist()
            rows = [scaled(row, start[of], edges[of]) for row, of in zip(group.rows, self.peak.tolist(), strict=True)]
            line = self.program.changed(goals=(Goal("trade", (Group(tuple(rows)),), 1.0),))
            results.append(_by_cuts(programs.subset(n), line, relative_gap, least_mass))
        return results

    def _goal(self, index: int) -> Goal:
        return _peak_goal(self.program.groups[0].rows, self.peak, index)

    def parameter(self, objective: float, anchor: Real, unit: Real) -> float:
        """t of an objective of :meth:`along`."""
        return objective + float(self._shift(anchor, unit))

    def per_peak(self, multipliers: Multipliers, unit: Real) -> Multipliers:
        """Multipliers of :meth:`along`, rows summing to 1 or in kg, as those of :attr:`minimax`, per unit of a peak."""
        of_row = unit[self.peak]
        return Multipliers(multipliers.term / of_row[self.minimax.row], multipliers.row / of_row, multipliers.ceiling)

    def widened(self, index: int, multipliers: Multipliers) -> Multipliers:
        """Admissible multipliers of the program of peak ``index`` alone as those of :attr:`minimax`."""
        own, term, row = self.peak == index, np.zeros_like(self.minimax.norms.constant), np.zeros(self.peak.shape)
        term[own[self.minimax.row]], row[own] = multipliers.term, multipliers.row
        return Multipliers(term, row, multipliers.ceiling)

    def _shift(self, anchor: Real, unit: Real) -> Real:
        return np.asarray(np.max((self.at_rest - anchor) / unit, axis=-1)) - 1.0


def trade(program: Problem) -> Trade:
    """The trade of a program of both peaks, each as it is weighed across the shaft."""
    (rows,) = (group.rows for group in program.groups)
    peak = np.array([PAIR.index(of.name) for row in rows for of in row.peaks])
    force, moment = (program.changed(goals=(_peak_goal(rows, peak, n),)) for n in range(len(PAIR)))
    return Trade(_finite(program), (_finite(force), _finite(moment)), peak, program)


def _peak_goal(rows: Sequence[Row], peak: np.ndarray, index: int) -> Goal:
    """One of both peaks by itself."""
    return Goal(PAIR[index], (Group(tuple(row for row, of in zip(rows, peak.tolist(), strict=True) if of == index)),))


def _by_cuts(statement: Statement, program: Problem, relative_gap: float, least_mass: bool) -> ConeSolution:
    """The optimum of a program in which counterweights scatter, within the limits of the same as a statement."""
    optimum = over_turn(program.changed(limits=statement.limits), relative_gap, least_mass)
    u, of_mass = (optimum.closest if isinstance(optimum, Conflict) else optimum.point).unbalance, None
    here = evaluated(statement, u)
    if isinstance(optimum, Conflict):
        return replace(here, method=optimum.method, certify_s=optimum.certify_s, conflict=optimum.proof.multipliers)
    of_mass = optimum.mass_proof
    return replace(
        here,
        lower_bound=optimum.proof.bound,
        multipliers=optimum.proof.multipliers,
        mass_lower_bound=0.0 if of_mass is None else of_mass.bound,
        mass_multipliers=None if of_mass is None else of_mass.multipliers,
        mass_target=optimum.mass_target,
        method=optimum.method,
        certify_s=optimum.certify_s,
    )


def _finite(program: Problem) -> Statement:
    """A program without quantities, whatever scatters."""
    return program.begun if program.finite is None else program.finite
