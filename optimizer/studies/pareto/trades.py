"""The front of any two or three responses: its ends, and points between them, each with its proof.

As in :mod:`optimizer.studies.pareto.front` a point is the first attainable on a line anchor + t unit, here by the
program over
the turn, whose bound t_low proves that nothing is below the corner anchor + t_low unit in every response. The anchors
are evenly apart on the chord, or in the triangle, between the ends (normal-boundary intersection, Das and Dennis 1998).
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from optimizer.errors import MissingInput
from optimizer.formulation.counterweights import counterweights, masses_and_angles, unbalance
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.mechanics.fixed_weights import beside, fixed_masses
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.requirements import missing
from optimizer.program.certificate import ceiling_allowance
from optimizer.program.cuts.optimum import METHOD, CertifiedOptimum, Conflict, over_turn
from optimizer.program.reference.solver import Solver
from optimizer.program.solution import OPTIMUM_SHARE
from optimizer.program.verdict import Claim, mass_resolution, verdict
from optimizer.solve.solution import Infeasible, finite_or_null
from optimizer.solve.solve import solve
from optimizer.solve.whole_turn import whole_turn_of
from optimizer.studies.pareto.chosen_trades import chosen_trades
from optimizer.studies.pareto.measures import Measures, alone, measures, sizes, unit_of
from schemas.front.pareto import ParetoRequest
from schemas.front.trade import Traded, TradedCertificate, TradedFront, TradedNames, TradedPoint, TradedResponse
from schemas.machine.machine import Machine

#: at an end the others may use so much of what counts first, as a share of its yardstick
_END_SLACK = 1e-6
#: a range below this share of the yardstick is none
_NARROW = 1e-6


def needed(request: ParetoRequest, names: Sequence[Traded], machine: Machine) -> Task:
    """One objective of all that is traded, under one limit of the total mass.

    Raises
    ------
    MissingInput
        if the machine lacks what a response needs.
    """
    task = replace(Task.of(request), machine=machine, objective=alone(request.objective, names))
    lacking = list(missing(task.machine, task.objective))
    if lacking:
        raise MissingInput(lacking)
    return task


def traded_front(
    request: ParetoRequest, names: TradedNames, machine: Machine, scene: Prepared, solver: Solver
) -> TradedFront:
    """The front of some responses, for one limit of the total mass."""
    task = needed(request, names, machine)
    # what is traded counts, whatever the objective weighs
    scene = replace(scene, machine=machine, objective=task.objective)
    if request.chosen:
        return chosen_trades(task, names, [*_places(len(names), request.points)], scene, solver)
    turn = whole_turn_of(scene, task.objective) if task.objective.of_the_revolution else None
    traded = measures(task, names, scene, turn)
    result = _ends(traded)
    if result is None:
        none = solve(task, scene, solver, in_full=False)
        return TradedFront(
            max_total_mass_kg=machine.max_total_mass_kg,
            status="infeasible",
            responses=(),
            points=(),
            infeasibility=none.infeasibility if isinstance(none, Infeasible) else None,
        )
    ends, smallest, size = result
    front = _Front(request, machine, scene, traded, size)
    span = np.max(ends, axis=0) - smallest[:, 1]
    together = np.all(span <= _NARROW * size)
    places = _places(len(names), request.points)
    if together:
        points = [front.point(smallest[:, 1], size)]
    else:
        unit = np.maximum(span, _NARROW * size)
        points = [front.point(place @ ends, unit) for place in places]
    told = _with_rivals(points)
    close = np.all(smallest[:, 0] - smallest[:, 1] <= max(request.accuracy.relative_gap, OPTIMUM_SHARE) * size)
    square, there = front.square, front.there
    return TradedFront(
        max_total_mass_kg=machine.max_total_mass_kg,
        status="optimal" if close and all(point.status == "optimal" for point in told) else "inaccurate",
        reason="reached_together" if together else None,
        responses=tuple(
            TradedResponse(
                response=name,
                unit=unit_of(name, task.objective),
                without_counterweights=float((traded.at_rest * square + there)[i]),
                smallest=float(smallest[i, 0] * square[i] + there[i]),
                lower_bound=float(smallest[i, 1] * square[i] + there[i]),
                yardstick=float(size[i] * square[i]),
            )
            for i, name in enumerate(names)
        ),
        points=tuple(told),
    )


def _ends(traded: Measures) -> tuple[Real, Real, Real] | None:
    """What all come to where each counts first (D, D), its smallest value and what is proven of it (D, 2), sizes (D,).

    None where no counterweights keep the ceilings.
    """
    size = np.where(traded.at_rest > 0, traded.at_rest, 1.0)
    for _ in range(2):
        ends, smallest, gross = [], [], np.zeros(size.shape)
        for which in range(len(traded.names)):
            result = over_turn(traded.first(which, size, _END_SLACK), OPTIMUM_SHARE, False)
            if isinstance(result, Conflict):
                return None
            ends.append(traded.values(result.point.unbalance))
            gross = np.maximum(gross, traded.gross(result.point.unbalance))
            smallest.append((result.goals[0].value, result.goals[0].proof.bound))
        known = sizes(traded.at_rest, gross)
        if np.all(known == size):
            break
        size = known
    return np.array(ends), np.array(smallest), size


def _places(count: int, points: int) -> Real:
    """Shares of the ends (n, D), evenly apart: as many as asked for, of three as make a whole triangle."""
    if count == 2:
        share = np.linspace(0.0, 1.0, points)
        return np.stack([1.0 - share, share], axis=-1)
    side = 1
    while (side + 2) * (side + 3) // 2 <= points:
        side += 1
    results = [(i, j, side - i - j) for i in range(side, -1, -1) for j in range(side - i, -1, -1)]
    return np.array(results) / side


class _Front:
    """What the points of a front share."""

    def __init__(self, request: ParetoRequest, machine: Machine, scene: Prepared, traded: Measures, size: Real) -> None:
        self.request, self.machine, self.scene, self.traded, self.size = request, machine, scene, traded, size
        self.square = np.array([1.0 if name == "mass" else scene.omega_squared for name in traded.names])
        self.fixed = float(np.sum(fixed_masses(machine)))
        #: what is there whatever is chosen, in the units of the answer (D,)
        self.there = np.array([self.fixed if name == "mass" else 0.0 for name in traded.names])

    def point(self, anchor: Real, unit: Real) -> TradedPoint:
        """The first attainable point on a line."""
        # where the mass is traded, the corner speaks of it
        least = self.request.objective.least_mass and "mass" not in self.traded.names
        asked = self.request.accuracy.relative_gap
        share = min(1.0, float(np.min(self.size / unit)))
        # the ends have kept the ceilings
        result = over_turn(self.traded.along(anchor, unit), share * asked, least).certain()
        masses, angles = masses_and_angles(self.machine, result.point.unbalance, result.limits)
        u = unbalance(masses, angles, result.limits.radius)
        values, excess = self.traded.values(u), self.traded.excess(u)
        bound, rounding = self._bound(result, u, excess)
        mass = float(np.sum(masses))
        proof = result.mass_proof
        judged = verdict(
            Claim(
                value=values,
                lower_bound=anchor + bound * unit,
                rounding=rounding * unit,
                yardstick=self.size,
                excess=np.asarray(excess),
                mass=np.asarray(mass),
                mass_resolution=mass_resolution(result.proof.statement, np.ones(1)),
                mass_lower_bound=np.asarray(0.0 if proof is None else proof.bound) if least else None,
                contradicted=result.contradicted,
            ),
            asked,
        )
        on_crank = beside(self.machine, masses, angles)
        plain = self.scene.first_order(unbalance(*on_crank, result.limits.radius))
        return TradedPoint(
            status="optimal" if judged.status == "optimal" else "inaccurate",
            status_reason=str(judged.reason),
            values=tuple((values * self.square + self.there).tolist()),
            force_peak_N=float(plain.force.peak),
            moment_peak_Nm=float(plain.moment.peak),
            total_mass_kg=mass + self.fixed,
            counterweights=counterweights(self.machine, *on_crank),
            certificate=TradedCertificate(
                corner=tuple(finite_or_null(each) for each in judged.lower_bound * self.square + self.there),
                relative_gap=finite_or_null(judged.relative_gap),
                mass_lower_bound_kg=finite_or_null(judged.mass_lower_bound + self.fixed) if least else None,
                mass_relative_gap=finite_or_null(judged.mass_gap) if least else None,
                cuts=result.cuts,
                rounds=result.rounds,
                method=METHOD,
            ),
        )

    def _bound(self, optimum: CertifiedOptimum, u: Complex, excess: float) -> tuple[float, float]:
        """What is proven of t for all that exceed no ceiling by more than u does, and the rounding of its value."""
        proof = optimum.proof
        over = np.full(proof.statement.ceilings.size.shape, max(excess, 0.0))
        allowance = float(ceiling_allowance(proof.statement, proof.multipliers, over))
        rounding = float(proof.statement.rounding(u)) + proof.charge * np.finfo(float).eps
        return proof.bound - allowance, rounding


def _with_rivals(points: Sequence[TradedPoint]) -> list[TradedPoint]:
    """The points with what beats them, of two responses in the order of the rising first."""
    ordered = sorted(points, key=lambda point: point.values) if points and len(points[0].values) == 2 else list(points)
    values = np.array([point.values for point in ordered])
    return [point.model_copy(update={"beaten_by": next(_beating(values, n), None)}) for n, point in enumerate(ordered)]


def _beating(values: Real, n: int) -> Iterator[int]:
    """Indices of the points that are as small as one in all values (n, D) and smaller in one."""
    better = np.all(values <= values[n], axis=-1) & np.any(values < values[n], axis=-1)
    yield from np.flatnonzero(better).tolist()
