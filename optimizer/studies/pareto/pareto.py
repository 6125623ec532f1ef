"""From request to fronts: the trade-off of peak force, peak moment and total mass."""

import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from optimizer.formulation.balance_shafts import design_space, placement_of
from optimizer.formulation.counterweights import masses_and_angles, unbalance
from optimizer.formulation.goals import Goals
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.mechanics.fixed_weights import fixed_masses
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from optimizer.outputs.first_order import first_order, floor
from optimizer.outputs.registry import prepare
from optimizer.program.methods.symmetry import symmetric
from optimizer.program.solution import ConeSolution
from optimizer.program.verdict import Claim, mass_resolution, verdict
from optimizer.solve.answer_fields import touched_ceilings
from optimizer.solve.prices import touched_by_mass
from optimizer.solve.proof import Speeds, bound_multipliers, implied_max_mass, physical
from optimizer.solve.solution import Infeasible, finite_or_null
from optimizer.solve.solve import solve
from optimizer.solve.uncertain_program import Robust
from optimizer.solve.worst_case import worst_peaks
from optimizer.studies.pareto.choice_front import choice_front
from optimizer.studies.pareto.counts import count_front
from optimizer.studies.pareto.front import Front, FrontPoint, front
from optimizer.studies.pareto.points import knee, undominated, weighted_peaks
from optimizer.studies.pareto.trade import Trade, trade
from optimizer.studies.pareto.trades import needed, traded_front
from schemas.answer.answers import Timing
from schemas.answer.proof import EndMultipliers, Multipliers
from schemas.base.mappings import or_mapping
from schemas.base.responses import PAIR
from schemas.base.variation import with_fields
from schemas.front.pareto import (
    CornerCertificate,
    Ends,
    ParetoAnswer,
    ParetoFront,
    ParetoPoint,
    ParetoRequest,
    Reason,
    Scale,
    Status,
)
from schemas.machine.machine import Machine

#: width of the brackets by which what is touched is told, as a share of ceilings
_CLOSE = 1e-10
_WORST: tuple[Status, ...] = ("optimal", "inaccurate", "infeasible")


@or_mapping(ParetoRequest)
def pareto(request: ParetoRequest) -> ParetoAnswer:
    """The certified fronts of peak force and peak moment, one for each budget of the total mass.

    Every figure is evaluated by the mechanics from the returned masses and angles.
    """
    start = time.perf_counter()
    if request.responses is not None:
        needed(request, request.responses, request.machine)
    scene = prepare(request, ("residual",))
    solving = time.perf_counter()
    machines = _machines(request)
    plain = request.responses is None and request.counts is None
    results = [_front(request, machine, scene) for machine in machines if plain]
    fronts = tuple(entry.front for entry in results)
    solved, certified = sum(entry.solve_s for entry in results), sum(entry.certify_s for entry in results)
    trading = time.perf_counter()
    names, count_trade = request.responses, request.counts
    trades = () if names is None else tuple(traded_front(request, names, machine, scene) for machine in machines)
    counts = (
        () if count_trade is None else tuple(count_front(request, count_trade, machine, scene) for machine in machines)
    )
    end = time.perf_counter()
    solved += end - trading
    worst = [
        *(entry.status for entry in fronts),
        *(entry.status for entry in trades),
        *(count.status for count in counts),
    ]
    before = scene.first_order()
    return ParetoAnswer(
        status=max(worst, key=_WORST.index),
        fronts=fronts,
        trades=trades,
        counts=counts,
        without_counterweights=first_order(before),
        floor=floor(scene.layout, before),
        reference_plane_m=float(scene.layout.reference_plane),
        effects=scene.simulated.uses,
        timing=Timing(
            total_ms=(end - start) * 1e3,
            solve_ms=(solved - certified) * 1e3,
            mechanics_ms=scene.mechanics_ms,
            certificate_ms=certified * 1e3,
            report_ms=(end - solving - solved) * 1e3,
        ),
    )


@record(frozen=True)
class _TimedFront:
    """A front, and the time spent on its programs and on their bounds."""

    front: ParetoFront
    solve_s: float
    certify_s: float


def _machines(request: ParetoRequest) -> tuple[Machine, ...]:
    """The machine under each budget."""
    if request.total_mass_budgets_kg is None:
        return (request.machine,)
    return tuple(
        with_fields(request.machine, {("max_total_mass_kg",): budget}) for budget in request.total_mass_budgets_kg
    )


def _front(request: ParetoRequest, machine: Machine, scene: Prepared) -> _TimedFront:
    start = time.perf_counter()
    if request.is_nonconvex:
        return _TimedFront(choice_front(request, machine, scene), time.perf_counter() - start, 0.0)
    task = needed(request, PAIR, machine)
    robust = Robust(task, replace(scene, machine=machine, objective=task.objective), task.demand)
    result = _solved(robust, request.points)
    solve_s = time.perf_counter() - start
    if isinstance(result, ConeSolution):
        return _TimedFront(_infeasible(request, machine, scene), solve_s, result.certify_s)
    certify_s = sum(point.solution.certify_s for point in result.points)
    return _TimedFront(_certified(request, robust, result), solve_s, certify_s)


def _solved(robust: Robust, points: int) -> Front | ConeSolution:
    """The front with all changes of masses that matter at any of its points; there are finitely many."""
    demand = robust.demand
    while True:
        result = front(trade(robust.goals().program), points, demand.relative_gap, demand.least_mass)
        if isinstance(result, ConeSolution):
            return result
        # every point may show some
        learnt = [robust.learnt(point.solution.unbalance) for point in result.points]
        if not any(learnt):
            return result


def _certified(request: ParetoRequest, robust: Robust, curve: Front) -> ParetoFront:
    machine, goals = robust.task.machine, robust.goals()
    points = [_point(request, robust, goals, curve, point) for point in curve.points]
    # points that are nearer to each other than their gaps can be out of order; no tolerance is applied
    frontier = undominated(points, weighted_peaks)
    square = robust.scene.omega_squared
    ideal, scale = curve.ideal * square, curve.size * square
    first, last = frontier[0], frontier[-1]
    ends = Ends(
        smallest_force_N=first.weighted_force_peak_N,
        smallest_force_lower_bound_N=float(ideal[0]),
        moment_at_smallest_force_Nm=first.weighted_moment_peak_Nm,
        smallest_moment_Nm=last.weighted_moment_peak_Nm,
        smallest_moment_lower_bound_Nm=float(ideal[1]),
        force_at_smallest_moment_N=last.weighted_force_peak_N,
        multipliers=_of_ends(curve, square, goals.speeds) if request.multipliers else None,
    )
    excess = max(
        (ends.smallest_force_N - ends.smallest_force_lower_bound_N) / scale[0],
        (ends.smallest_moment_Nm - ends.smallest_moment_lower_bound_Nm) / scale[1],
    )
    exact = (
        not curve.undecided
        and excess <= request.accuracy.relative_gap
        and all(point.status == "optimal" for point in frontier)
    )
    return ParetoFront(
        max_total_mass_kg=machine.max_total_mass_kg,
        status="optimal" if exact else "inaccurate",
        points=tuple(frontier),
        reason=_reason(request, curve, frontier),
        knee=knee(frontier),
        ends=ends,
        scale=Scale(force_N=float(scale[0]), moment_Nm=float(scale[1])),
        implied_max_mass_kg=_implied(request, machine, curve),
    )


def _point(request: ParetoRequest, robust: Robust, goals: Goals, curve: Front, point: FrontPoint) -> ParetoPoint:
    machine, scene = robust.task.machine, robust.scene
    square, traded = scene.omega_squared, curve.trade
    limits = traded.minimax.limits
    unbalance_there = point.solution.unbalance
    if request.objective.symmetric:
        unbalance_there = symmetric(traded.minimax.alone(), unbalance_there[None])[0]
    masses, angles = masses_and_angles(design_space(machine, request.objective).machine, unbalance_there, limits)
    u = unbalance(masses, angles, limits.radius)
    point = point.counting(traded, u)
    placement = placement_of(machine, request.objective, masses, angles, u)
    peaks = traded.peaks(u)
    fixed = float(np.sum(fixed_masses(machine)))
    judged = verdict(
        Claim(
            value=peaks,
            lower_bound=point.corner,
            rounding=traded.rounding(u),
            yardstick=curve.size,
            excess=np.max(traded.minimax.ceilings.excess(u), axis=-1, initial=-np.inf),
            mass=np.asarray(np.sum(masses)),
            mass_resolution=mass_resolution(traded.minimax, curve.size[traded.peak]),
            mass_lower_bound=np.asarray(point.solution.mass_lower_bound) if request.objective.least_mass else None,
        ),
        request.accuracy.relative_gap,
    )
    plain = scene.beside(placement.on_shafts).first_order(placement.on_crank)
    limit = (point.mass_limit * square).tolist() if point.mass_proof is not None else (None, None)
    there = np.array([counterweight.mass_kg for counterweight in placement.counterweights])
    limited = goals.program.ceilings
    ceilings = touched_ceilings(robust.task, goals, goals.program.values(u, _CLOSE)) if limited else ()
    weighted: Real = peaks * square
    proven: Real = judged.lower_bound * square
    return ParetoPoint(
        status="optimal" if judged.status == "optimal" else "inaccurate",
        status_reason=str(judged.reason),
        force_peak_N=float(plain.force.peak),
        moment_peak_Nm=float(plain.moment.peak),
        weighted_force_peak_N=float(weighted[0]),
        weighted_moment_peak_Nm=float(weighted[1]),
        **placement.fields,
        worst_case=worst_peaks(robust, u) if robust.task.uncertain else None,
        active_limits=tuple(dict.fromkeys((*touched_by_mass(machine, there), *ceilings))),
        certificate=CornerCertificate(
            force_N=finite_or_null(proven[0]),
            moment_Nm=finite_or_null(proven[1]),
            relative_gap=finite_or_null(judged.relative_gap),
            yardstick=Scale(force_N=float(curve.size[0] * square), moment_Nm=float(curve.size[1] * square)),
            mass_lower_bound_kg=finite_or_null(judged.mass_lower_bound + fixed)
            if request.objective.least_mass
            else None,
            mass_relative_gap=finite_or_null(judged.mass_gap) if request.objective.least_mass else None,
            mass_yardstick_kg=float(judged.mass_yardstick) if request.objective.least_mass else None,
            mass_force_limit_N=limit[0],
            mass_moment_limit_Nm=limit[1],
            implied_max_mass_kg=_implied(request, machine, curve),
            method=point.solution.method,
        ),
        multipliers=_of_point(traded, point, square, goals.speeds) if request.multipliers else None,
    )


def _implied(request: ParetoRequest, machine: Machine, curve: Front) -> dict[str, float]:
    """Largest masses by web, kg, that all proofs of a front count with in place of those of the machine."""
    return implied_max_mass(
        design_space(machine, request.objective).machine, curve.trade.minimax.limits.max_mass[None]
    )[0]


def _of_point(traded: Trade, point: FrontPoint, omega_squared: float, speeds: Speeds) -> Multipliers:
    """The proofs of a point: of its corner, and of its mass."""
    minimax, of_mass = traded.minimax, point.mass_proof
    return Multipliers(
        objective=bound_multipliers(minimax, physical(minimax, point.proof, "parameter", omega_squared, speeds)),
        mass=None
        if of_mass is None
        else bound_multipliers(minimax, physical(minimax, of_mass, "mass", omega_squared, speeds)),
    )


def _of_ends(curve: Front, omega_squared: float, speeds: Speeds) -> EndMultipliers:
    """The proofs of both smallest peaks."""
    minimax = curve.trade.minimax
    force, moment = (
        bound_multipliers(minimax, physical(minimax, proof, "objective", omega_squared, speeds))
        for proof in curve.ideal_proofs
    )
    return EndMultipliers(smallest_force=force, smallest_moment=moment)


def _reason(request: ParetoRequest, curve: Front, frontier: Sequence[ParetoPoint]) -> Reason | None:
    if curve.undecided:
        return "undecided"
    if len(curve.points) == 1:
        return "reached_together"
    return "resolution" if len(frontier) < request.points else None


def _infeasible(request: ParetoRequest, machine: Machine, scene: Prepared) -> ParetoFront:
    """Which ceilings conflict, and what can be reached, as the optimum of one objective tells it."""
    none = solve(
        replace(Task.of(request), machine=machine), replace(scene, machine=machine), in_full=False, worst_case=False
    )
    return ParetoFront(
        max_total_mass_kg=machine.max_total_mass_kg,
        status="infeasible",
        points=(),
        infeasibility=none.infeasibility if isinstance(none, Infeasible) else None,
    )
