"""From request to answer: machine -> responses -> program -> counterweights -> report."""

import time
from dataclasses import replace

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.figures.counterweights import counterweights, masses_and_angles, unbalance
from optimizer.figures.first_order import first_order, smallest_peaks, smallest_proofs
from optimizer.figures.machine_limits import touched_limits
from optimizer.figures.proof import conflict, named, named_conflict, physical
from optimizer.figures.shadow_prices import shadow_prices as priced
from optimizer.formulate import RESPONSES, ceilings, formulate, smallest_peak, weights
from optimizer.outputs import fields as answered
from optimizer.outputs import prepare
from optimizer.program.edge import Unreachable
from optimizer.program.optima import optima
from optimizer.program.reach import within_reach
from optimizer.program.reference.solver import Solver
from optimizer.program.sensitivity import shadow_prices
from optimizer.program.solution import Solution
from optimizer.program.statement import Statement
from optimizer.program.verdict import INFEASIBLE, claim, verdict
from optimizer.scene import Prepared
from schemas.answers import (
    Certificate,
    Closest,
    Counterweight,
    Infeasibility,
    OptimizeAnswer,
    Timing,
)
from schemas.machine import Machine
from schemas.proof import InfeasibilityMultipliers
from schemas.proof import Multipliers as NamedMultipliers
from schemas.requests import OptimizeRequest

#: outputs that every answer holds
_ALWAYS = ("residual",)

# compiled programs of this process; they are lent to one thread at a time
_SOLVER = Solver()


def optimize(request: OptimizeRequest, solver: Solver = _SOLVER) -> OptimizeAnswer:
    """Counterweights that minimise the weighted first-order peaks, with a certificate.

    Every figure is evaluated by the mechanics from the returned masses and angles.

    Raises
    ------
    MissingInput
        if the machine lacks what a requested output needs.
    """
    start = time.perf_counter()
    scene = prepare(request, _ALWAYS)
    solving = time.perf_counter()
    statement = formulate(request.machine, request.objective, scene.responses, scene.omega_squared)
    statement = within_reach(statement, solver)
    outcome = optima(statement.alone(), request.accuracy.relative_gap, request.objective.least_mass, solver).one()

    reporting = time.perf_counter()
    if isinstance(outcome, Unreachable):
        fields = _infeasible(request, scene, statement, outcome, solver)
    else:
        fields = _certified(request, scene, statement, outcome)
    end = time.perf_counter()
    return OptimizeAnswer(
        **fields,
        reference_plane_m=float(scene.layout.reference_plane),
        effects=scene.simulated.uses,
        timing=Timing(
            total_ms=(end - start) * 1e3,
            solve_ms=(reporting - solving - outcome.certify_s) * 1e3,
            mechanics_ms=scene.mechanics_ms,
            certificate_ms=outcome.certify_s * 1e3,
            report_ms=(end - reporting) * 1e3,
        ),
    )


def _fitted(machine: Machine, statement: Statement, u: Complex) -> tuple[tuple[Counterweight, ...], Complex]:
    """Counterweights for an unbalance, and the unbalance that their masses and angles really make."""
    mass, angle = masses_and_angles(machine, u, statement.limits)
    return counterweights(machine, mass, angle), unbalance(mass, angle, statement.limits.radius)


def _certified(
    request: OptimizeRequest, scene: Prepared, statement: Statement, solution: Solution
) -> dict[str, object]:
    fitted, u = _fitted(request.machine, statement, solution.unbalance)
    square, goal = scene.omega_squared, request.objective
    mass = float(sum(counterweight.mass_kg for counterweight in fitted))
    claimed = claim(
        statement,
        u,
        np.asarray(mass),
        np.asarray(solution.lower_bound),
        solution.multipliers,
        np.asarray(solution.mass_lower_bound) if goal.least_mass else None,
    )
    judged = verdict(claimed, request.accuracy.relative_gap)
    value, rest = float(claimed.value[0]), float(statement.at_rest)
    gap = float(judged.gap[0])
    touched = touched_limits(request.machine, goal, scene.responses, u, mass, square)
    return {
        "status": str(judged.status),
        "status_reason": str(judged.reason),
        "counterweights": fitted,
        "total_mass_kg": mass,
        "active_limits": touched,
        "shadow_prices": ()
        if solution.multipliers is None or np.isnan(gap)
        else priced(
            request.machine,
            goal,
            {name: float(weight) for name, weight in weights(request.machine, goal).items()},
            shadow_prices(statement, u, solution.multipliers),
            fitted,
            touched,
            square,
            gap,
            rest,
        ),
        "certificate": Certificate(
            objective=value * square,
            lower_bound=proven_or_null(judged.lower_bound[0] * square),
            gap=proven_or_null(gap * square),
            relative_gap=proven_or_null(judged.relative_gap),
            yardstick=float(claimed.yardstick[0]) * square,
            objective_without_counterweights=rest * square,
            mass_lower_bound_kg=proven_or_null(judged.mass_lower_bound) if goal.least_mass else None,
            mass_relative_gap=proven_or_null(judged.mass_gap) if goal.least_mass else None,
            mass_yardstick_kg=float(judged.mass_yardstick) if goal.least_mass else None,
            mass_objective_limit=_finite(solution.mass_target * square) if goal.least_mass else None,
            implied_max_mass_kg=implied_max_mass(request.machine, statement.limits.max_mass),
            method=solution.method,
            multipliers=_multipliers(statement, solution, square, goal.least_mass),
        ),
        **answered(scene, u, _ALWAYS),
    }


def _multipliers(statement: Statement, solution: Solution, omega_squared: float, least_mass: bool) -> NamedMultipliers:
    """The proofs of both stages."""
    # a bound that is printed has multipliers: rest, at least, proves one
    assert solution.multipliers is not None
    of_mass = solution.mass_multipliers if least_mass else None
    return NamedMultipliers(
        objective=named(statement, physical(statement, solution.multipliers, "objective", omega_squared)),
        mass=None if of_mass is None else named(statement, physical(statement, of_mass, "mass", omega_squared)),
    )


def implied_max_mass(machine: Machine, most: Real) -> dict[str, float]:
    """Limits that the proof counts with in place of those of the machine, kg."""
    return {
        web.name: float(mass)
        for web, mass in zip(machine.webs, most, strict=True)
        if np.isfinite(mass) and (web.max_mass_kg is None or mass < web.max_mass_kg)
    }


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None


def proven_or_null(value: Real | float) -> float | None:
    """A figure, null where nothing is proven."""
    return None if np.isnan(value) else float(value)


def _infeasible(
    request: OptimizeRequest, scene: Prepared, statement: Statement, proof: Unreachable, solver: Solver
) -> dict[str, object]:
    """Which ceilings conflict, and what can be reached: each peak by itself, and the best compromise."""
    square, allowed = scene.omega_squared, ceilings(request.objective)
    smallest, bound, proofs = {}, {}, {}
    peaks = {response.name: smallest_peak(response, request.machine) for response in scene.responses}
    # one reach for all that is proven here
    most = np.max(
        [each.limits.max_mass for each in (statement, *(within_reach(peak, solver) for peak in peaks.values()))], axis=0
    )
    for response in scene.responses:
        peak = replace(peaks[response.name], limits=replace(statement.limits, max_mass=most))
        alone = optima(peak.alone(), 1e-9, False, solver).one()
        # without ceilings nothing is unreachable, and rest proves something
        assert isinstance(alone, Solution)
        assert alone.multipliers is not None
        proofs[response.name] = named(peak, physical(peak, alone.multipliers, "objective", square))
        smallest[response.name], bound[response.name] = alone.objective * square, alone.lower_bound * square
    impossible = [name for name in allowed if bound[name] > allowed[name]]
    fitted, u = _fitted(request.machine, statement, proof.closest)
    return {
        "status": "infeasible",
        "status_reason": INFEASIBLE,
        "counterweights": (),
        "total_mass_kg": None,
        "certificate": None,
        "infeasibility": Infeasibility(
            conflict=tuple(each.ceiling_field for each in RESPONSES.values() if each.name in (impossible or allowed)),
            **smallest_peaks(smallest, bound),
            implied_max_mass_kg=implied_max_mass(request.machine, most),
            closest=Closest(counterweights=fitted, first_order=first_order(scene.first_order(u))),
            multipliers=InfeasibilityMultipliers(
                conflict=named_conflict(statement, conflict(statement, proof.multipliers, square)),
                **smallest_proofs(proofs),
            ),
        ),
        **answered(scene, None, _ALWAYS),
    }
