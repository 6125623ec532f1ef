"""Points of a front of any masses on lines anchor + t unit, by the program over the turn.

A point is the first attainable on its line. The bound t_low of the program proves that nothing is below the corner
anchor + t_low unit in every response.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from optimizer.formulation.balance_shafts import placement_of
from optimizer.formulation.counterweights import masses_and_angles, unbalance
from optimizer.mechanics.fixed_weights import fixed_masses
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import ceiling_allowance
from optimizer.program.cuts.optimum import METHOD, CertifiedOptimum, Conflict, over_turn
from optimizer.program.solution import OPTIMUM_SHARE
from optimizer.program.verdict import Claim, mass_resolution, verdict
from optimizer.solve.solution import Infeasible, Solution, finite_or_null
from optimizer.solve.solve import solve
from optimizer.solve.uncertain_program import Robust
from optimizer.solve.worst_case import nominal
from optimizer.studies.pareto.measures import measures, sizes
from optimizer.studies.pareto.points import TradeEnds
from schemas.front.trade import Traded, TradedCertificate, TradedPoint

#: at an end the others may use so much of what counts first, as a share of its yardstick
_END_SLACK = 1e-6
#: a range below this share of the yardstick is none
_NARROW = 1e-6


class Lines:
    """What the lines of one front share; figures are over omega^2 but for the mass.

    square, there : (D,) what figures are times and above in the units of the answer: the mass is above what is fixed.
    """

    def __init__(self, robust: Robust, names: tuple[Traded, ...]) -> None:
        self.task, self.scene, self.robust = robust.task, robust.scene, robust
        task, scene = robust.task, robust.scene
        self.traded = measures(robust.goals().program, names)
        #: with nothing off, where anything may be
        self.nominal = measures(nominal(robust).program, names) if task.uncertain else None
        #: whether counterweights have shown changes of masses that are worse than those known before
        self.learnt = False
        self.square = np.array([1.0 if name == "mass" else scene.omega_squared for name in names])
        self.fixed = float(np.sum(fixed_masses(task.machine)))
        self.there = np.array([self.fixed if name == "mass" else 0.0 for name in names])
        # where the mass is traded, the corner speaks of it
        self.least_mass = task.objective.least_mass and "mass" not in names

    def ends(self) -> TradeEnds | Infeasible | Solution:
        """What all come to where each counts first; else what there is of one objective under the same ceilings."""
        traded = self.traded
        size = np.where(traded.at_rest > 0, traded.at_rest, 1.0)
        for _ in range(2):
            ends, smallest, gross = [], [], np.zeros(size.shape)
            for index in range(len(traded.names)):
                result = over_turn(traded.first(index, size, _END_SLACK), OPTIMUM_SHARE, False)
                if isinstance(result, Conflict):
                    return solve(self.task, self.scene, in_full=False, worst_case=False)
                self.learnt |= self.robust.learnt(result.point.unbalance)
                ends.append(traded.values(result.point.unbalance))
                gross = np.maximum(gross, traded.gross(result.point.unbalance))
                smallest.append((result.goals[0].value, result.goals[0].proof.bound))
            scale = sizes(traded.at_rest, gross)
            if np.all(scale == size):
                break
            size = scale
        value, bound = np.array(smallest).T
        return TradeEnds(np.array(ends), value, bound, size, traded.at_rest, self.square, self.there)

    def points(self, shares: Real, ends: TradeEnds) -> tuple[list[TradedPoint], bool]:
        """Points for shares of the ends (n, D), and that there is one for each; one where all are smallest together."""
        span = np.max(ends.values, axis=0) - ends.lower_bound
        if np.all(span <= _NARROW * ends.size):
            return [self._point(ends.lower_bound, ends.size, ends.size)], True
        unit = np.maximum(span, _NARROW * ends.size)
        return _with_rivals([self._point(share @ ends.values, unit, ends.size) for share in shares]), True

    def _point(self, anchor: Real, unit: Real, size: Real) -> TradedPoint:
        """The first attainable point on a line."""
        least, gap = self.least_mass, self.task.relative_gap
        share = min(1.0, float(np.min(size / unit)))
        # the ends have kept the ceilings
        result = over_turn(self.traded.along(anchor, unit), share * gap, least).certain()
        task = self.task
        masses, angles = masses_and_angles(task.space.machine, result.point.unbalance, result.limits)
        u = unbalance(masses, angles, result.limits.radius)
        self.learnt |= self.robust.learnt(u)
        values, excess = self.traded.values(u), self.traded.excess(u)
        bound, rounding = _bound(result, u, excess)
        mass = float(np.sum(masses))
        proof = result.mass_proof
        judged = verdict(
            Claim(
                value=values,
                lower_bound=anchor + bound * unit,
                rounding=rounding * unit,
                yardstick=size,
                excess=np.asarray(excess),
                mass=np.asarray(mass),
                mass_resolution=mass_resolution(result.proof.statement, np.ones(1)),
                mass_lower_bound=np.asarray(0.0 if proof is None else proof.bound) if least else None,
                contradicted=result.contradicted,
            ),
            gap,
        )
        placement = placement_of(task.machine, task.objective, masses, angles, u)
        plain = self.scene.beside(placement.on_shafts).first_order(placement.on_crank)
        return TradedPoint(
            status="optimal" if judged.status == "optimal" else "inaccurate",
            status_reason=str(judged.reason),
            values=self._in_units(values),
            nominal_values=None if self.nominal is None else self._in_units(self.nominal.values(u)),
            force_peak_N=float(plain.force.peak),
            moment_peak_Nm=float(plain.moment.peak),
            **placement.fields,
            certificate=TradedCertificate(
                corner=tuple(
                    finite_or_null(coordinate) for coordinate in judged.lower_bound * self.square + self.there
                ),
                relative_gap=finite_or_null(judged.relative_gap),
                mass_lower_bound_kg=finite_or_null(judged.mass_lower_bound + self.fixed) if least else None,
                mass_relative_gap=finite_or_null(judged.mass_gap) if least else None,
                cuts=result.cuts,
                rounds=result.rounds,
                method=METHOD,
            ),
        )

    def _in_units(self, values: Real) -> tuple[float, ...]:
        """What responses come to (D,) in the units of the answer."""
        return tuple((values * self.square + self.there).tolist())


def _bound(optimum: CertifiedOptimum, u: Complex, excess: float) -> tuple[float, float]:
    """What is proven of t for all that exceed no ceiling by more than u does, and the rounding of its value."""
    proof = optimum.proof
    over = np.full(proof.statement.ceilings.size.shape, max(excess, 0.0))
    allowance = float(ceiling_allowance(proof.statement, proof.multipliers, over))
    rounding = float(proof.statement.rounding(u)) + proof.charge * np.finfo(float).eps
    return proof.bound - allowance, rounding


def _with_rivals(points: Sequence[TradedPoint]) -> list[TradedPoint]:
    """The points with what beats them, of two responses in the order of the rising first."""
    ranking = sorted(points, key=lambda point: point.values) if points and len(points[0].values) == 2 else list(points)
    values = np.array([point.values for point in ranking])
    return [point.model_copy(update={"beaten_by": next(_beating(values, n), None)}) for n, point in enumerate(ranking)]


def _beating(values: Real, n: int) -> Iterator[int]:
    """Indices of the points that are as small as one in all values (n, D) and smaller in one."""
    better = np.all(values <= values[n], axis=-1) & np.any(values < values[n], axis=-1)
    yield from np.flatnonzero(better).tolist()
