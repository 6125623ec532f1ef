"""Proof that a web which carries next to nothing is needed: without it no answer is as good as the one that has it.

Independent: the goals at finitely many angles, solved by cvxpy. What is left out can only make them larger, so that
the smallest without the web is a bound.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import cvxpy as cp
import numpy as np

from optimizer.formulation.goals import Case, formulate
from optimizer.formulation.limits import limits
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.registry import prepare
from optimizer.outputs.requirements import effects_of_objective
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.methods.optima import optima
from optimizer.program.rows import Row
from optimizer.program.verdict import MASS_GAP
from optimizer.solve.whole_turn import whole_turn_of
from schemas.answer.answers import OptimizeAnswer
from schemas.front.pareto import ParetoFront, ParetoPoint, ParetoRequest
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import OptimizeRequest
from tests.studies.pareto.cases import trade_of

#: shares of a turn: angles at first, and among those that are looked at for larger loads
_COARSE, _FINE = 48, 3600
#: how often angles are added
_ROUNDS = 6
#: share of a figure that the solver may be off by
_SOLVED = 1e-6
#: share of the range of a front up to which peaks are those of a point
_SHARPEST = 1e-9


def is_needed(request: OptimizeRequest, answer: OptimizeAnswer, web: str) -> bool:
    """Whether nothing without the web keeps the goals and is as good and as light as the answer may claim to be.

    Of the whole turn alone, of peaks, without ceilings, shafts, groups, plates, scenarios or tolerances: of all else
    nothing is proven.
    """
    objective, machine, proof = request.objective, request.machine, answer.certificate
    if proof is None or proof.lower_bound is None or not isinstance(machine, ReciprocatingMachine):
        return False
    plain = objective.of_the_shaft and objective.bearing_measure != "rms"
    plain &= not (request.scenarios or request.robust or machine.web_groups or machine.balance_shafts)
    if not plain or any(plane.envelope is not None or plane.max_mass_kg is None for plane in machine.webs):
        return False
    scene = prepare(request, ("residual",), effects_of_objective(objective))
    case = Case(machine, scene.omega_squared, (scene.responses,), (whole_turn_of(scene, objective), scene.laden))
    program = formulate(machine, objective, [case], scene.omega_squared, request.fidelity).program
    if program.ceilings or program.limited:
        return False
    largest = [goal.limit for goal in proof.goals or ()]
    largest.append(proof.lower_bound + request.accuracy.relative_gap * proof.yardstick)
    without = _Without(request, program, web, np.array(largest) / float(scene.omega_squared))
    if without.comes_to_more("objective", float(without.largest[-1])):
        return True
    least = objective.least_mass and proof.mass_lower_bound_kg is not None
    return least and without.comes_to_more("mass", float(proof.mass_lower_bound_kg or 0.0) / (1.0 - MASS_GAP))


def is_needed_at(request: ParetoRequest, front: ParetoFront, point: ParetoPoint, web: str) -> bool:
    """Whether nothing without the web has the peaks of a point of a front, or one below them, and is as light as that
    point may claim to be.

    Not independent: bounds of the compiled method, which multipliers prove. The share of the range that tells webs of
    a few milligrams apart is below what another solver resolves. Of fronts of several points, without choices
    and budgets to vary.
    """
    machine = request.machine
    if request.is_nonconvex or request.total_mass_budgets_kg is not None or not request.objective.least_mass:
        return False
    scene = prepare(request, ("residual",))
    whole = trade_of(request)
    peaks = np.array([[position.weighted_force_peak_N, position.weighted_moment_peak_Nm] for position in front.points])
    unit = np.ptp(peaks, axis=0) / float(scene.omega_squared)
    if not np.all(unit > 0.0):
        return False
    here = np.array([point.weighted_force_peak_N, point.weighted_moment_peak_Nm]) / float(scene.omega_squared)
    most = np.where([plane.name == web for plane in machine.webs], 0.0, whole.minimax.limits.max_mass)
    program = whole.within(most, whole.cap).along(here, unit)
    # t is nothing at the point
    target = _SHARPEST - whole.parameter(0.0, here, unit)
    solution = optima(program.alone(), _SHARPEST, False).single()
    if solution.conflict is not None or solution.lower_bound > target:
        return True
    minimum = optima(program.alone(), target - solution.lower_bound + _SHARPEST, True).single()
    assert minimum.conflict is None
    return minimum.mass_target >= target and minimum.mass_lower_bound > point.total_mass_kg / (1.0 - MASS_GAP)


@dataclass
class _Without:
    """The goals of a program without a web, at some angles of the turn."""

    request: OptimizeRequest
    program: Problem
    web: str
    largest: Real  # (goals,) over omega^2, what each may come to
    angles: list[Real] = field(init=False)  # of every quantity, rad

    def __post_init__(self) -> None:
        self.angles = [
            np.linspace(0.0, np.deg2rad(quantity.response.period_deg), _COARSE, endpoint=False)
            for quantity in self.program.quantities
        ]

    def comes_to_more(self, minimised: str, most: float) -> bool:
        """Whether the last goal, or the mass with all goals kept, is above a figure wherever the others are kept."""
        for _ in range(_ROUNDS):
            smallest, u = self._smallest(minimised)
            if smallest > most * (1.0 + _SOLVED):
                return True
            self._look_closer(u)
        return False

    def _smallest(self, minimised: str) -> tuple[float, Complex]:
        """inf where nothing keeps the goals."""
        count = len(self.request.machine.webs)
        x, y, mass = (cp.Variable(count) for _ in range(3))
        goals = [self._goal(goal, x, y) for goal in self.program.goals]
        values = list(zip(goals, self.largest.tolist(), strict=True))
        constraints = [goal <= most for goal, most in (values if minimised == "mass" else values[:-1])]
        constraints += self._limits(x, y, mass)
        cost = cp.sum(mass) if minimised == "mass" else goals[-1]
        problem = cp.Problem(cp.Minimize(cost), constraints)
        problem.solve(solver=cp.CLARABEL)
        if problem.status in ("infeasible", "infeasible_inaccurate"):
            return np.inf, np.zeros(count, complex)
        return float(problem.value), x.value + 1j * y.value

    def _limits(self, x: cp.Variable, y: cp.Variable, mass: cp.Variable) -> Iterator[cp.Constraint]:
        machine, within = self.request.machine, limits(self.request.machine)
        yield cp.norm(cp.vstack([x, y]), axis=0) <= cp.multiply(within.radius, mass)
        yield mass <= np.where([web.name == self.web for web in machine.webs], 0.0, within.max_mass)
        for n in np.flatnonzero(~within.free).tolist():
            centre = within.centre[n]
            along, across = centre.real * x[n] + centre.imag * y[n], centre.real * y[n] - centre.imag * x[n]
            yield cp.abs(across) * within.half_angle_cos[n] <= along * within.half_angle_sin[n]
        if machine.max_total_mass_kg is not None:
            yield cp.sum(mass) <= machine.max_total_mass_kg

    def _goal(self, goal: Goal, x: cp.Variable, y: cp.Variable) -> cp.Expression:
        """The sum of the groups, each the largest of its rows and quantities."""
        groups = []
        for group in goal.groups:
            several = [_row(row, x, y) for row in group.rows]
            for weighed_row in group.weighed:
                response = self.program.quantities[weighed_row.quantity].response
                angles = self.angles[weighed_row.quantity]
                curve = response.at(angles)
                influence = np.repeat(np.asarray(response.influence)[None], angles.size, axis=0)
                several.append(weighed_row.offset + weighed_row.weight * cp.max(_sizes(curve, influence, x, y)))
            groups.append(cp.maximum(*several) if len(several) > 1 else several[0])
        return sum(groups[1:], groups[0])

    def _look_closer(self, u: Complex) -> None:
        """Add the angles at which each quantity is largest."""
        for n, quantity in enumerate(self.program.quantities):
            response = quantity.response
            fine = np.linspace(0.0, np.deg2rad(response.period_deg), _FINE, endpoint=False)
            size = np.abs(response.at(fine) + response.offset(u))
            top = (size >= np.roll(size, 1)) & (size >= np.roll(size, -1))
            self.angles[n] = np.union1d(self.angles[n], fine[top])


def _sizes(constant: Complex, influence: Real | Complex, x: cp.Variable, y: cp.Variable) -> cp.Expression:
    """Lengths of c_j + H_j u, with real H."""
    assert not np.iscomplexobj(influence)
    vectors = cp.vstack([constant.real + influence @ x, constant.imag + influence @ y])
    return cp.norm(vectors, axis=0)


def _row(row: Row, x: cp.Variable, y: cp.Variable) -> cp.Expression:
    """A sum of peaks."""
    peaks = [float(peak.floor) + cp.sum(_sizes(peak.norms.constant, peak.norms.influence, x, y)) for peak in row.peaks]
    return sum(peaks[1:], peaks[0])
