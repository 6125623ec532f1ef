"""How many counterweights, or part numbers, against what they come to at least: a search for each number."""

import time
from dataclasses import dataclass, replace

import numpy as np

from optimizer.choices.catalogue_options import part_numbers, stock
from optimizer.errors import MissingInput
from optimizer.formulation.counterweights import counterweights, unbalance
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.mechanics.fixed_weights import beside, fixed_masses
from optimizer.mechanics.layout import stacked
from optimizer.numerics.arrays import Real
from optimizer.outputs.requirements import missing
from optimizer.program.reference.solver import Solver
from optimizer.program.verdict import CONTRADICTED
from optimizer.solve.minimum_mass import minimum_mass
from optimizer.solve.solution import Infeasible
from optimizer.solve.solve import solve
from schemas.base.variation import with_fields
from schemas.front.counts import PIECES, Counted, CountFront, CountPoint, CountTrade
from schemas.front.pareto import ParetoRequest
from schemas.machine.catalogue import Catalogue
from schemas.machine.machine import Machine

#: of a mass, relative: by which sums of masses are rounded
_ROUNDING = 1e-12


@dataclass(frozen=True)
class _Best:
    """The best set of a search, and what is proven of it."""

    mass_kg: Real  # (K,), with the weights that are fixed
    angle_deg: Real  # (K,)
    value: float
    lower_bound: float  # nan where nothing is proven
    relative_gap: float  # likewise
    status: str
    reason: str
    nodes: int
    method: str


def count_front(
    request: ParetoRequest, trade: CountTrade, machine: Machine, scene: Prepared, solver: Solver
) -> CountFront:
    """The front under one limit of the total mass; all its searches together end at the time asked."""
    whole = replace(Task.of(request), machine=machine)
    half, scene = 0.5 * whole.time_limit_s, replace(scene, machine=machine)
    lacking = list(missing(machine, whole.objective))
    if lacking:
        raise MissingInput(lacking)

    def point(number: int | None, seconds: float) -> CountPoint:
        within = machine if number is None else at_most(machine, trade.of, number)
        return _point(replace(whole, machine=within, time_limit_s=max(seconds, 1e-3)), scene, trade, number, solver)

    # what is limited by no number says how many are of any use; it may take half of the time, and the others the other
    points = [point(None, half)]
    until, (last,) = time.monotonic() + half, points
    if last.status != "infeasible":
        used = last.at_most
        fewer = np.unique(np.round(np.linspace(0, used, min(request.points, used + 1))).astype(int)).tolist()[:-1]
        points = [*(point(number, until - time.monotonic()) for number in fewer), last]
    exact = all(point.status in ("optimal", "infeasible") for point in points)
    none = all(point.status == "infeasible" for point in points)
    return CountFront(
        max_total_mass_kg=machine.max_total_mass_kg,
        of=trade.of,
        least=trade.least,
        status="infeasible" if none else "optimal" if exact else "inaccurate",
        points=tuple(points),
    )


def at_most(machine: Machine, of: Counted, number: int) -> Machine:
    """The machine with no more counterweights, or part numbers, than a number."""
    if of in PIECES or number == 0:
        # nothing checked: there may be fewer of them than of sizes
        return with_fields(machine, {("max_counterweights",): number})
    catalogue = with_fields(machine.catalogue or Catalogue(), {("max_part_numbers",): number})
    return with_fields(machine, {("catalogue",): catalogue})


def _most(machine: Machine, of: Counted) -> int:
    """The largest number that means anything."""
    options = stock(machine).options
    if of in PIECES:
        return int(np.sum(options.webs[np.any(options.mass > 0, axis=-1)]))
    return int(np.max(options.part, initial=-1)) + 1


def _point(task: Task, scene: Prepared, trade: CountTrade, number: int | None, solver: Solver) -> CountPoint:
    best = (_smallest if trade.least == "objective" else _lightest)(task, scene, solver)
    result = best.status != "infeasible"
    machine = task.machine
    u = unbalance(best.mass_kg, best.angle_deg, stacked([web.radius_m for web in machine.webs]))
    after = scene.first_order(u)
    weights = int(np.sum(best.mass_kg[_chosen(machine)] > 0)) if result else None
    sizes = part_numbers(best.mass_kg[_chosen(machine)]) if result else None
    if number is None:
        # where no number limits it, so many as it takes
        used = weights if trade.of in PIECES else sizes
        number = _most(machine, trade.of) if used is None else used
    return CountPoint(
        at_most=number,
        status=best.status,
        status_reason=best.reason,
        value=best.value if result else None,
        lower_bound=_or_none(best.lower_bound) if result else None,
        relative_gap=_or_none(best.relative_gap) if result else None,
        weights=weights,
        part_numbers=sizes,
        total_mass_kg=float(np.sum(best.mass_kg)) if result else None,
        force_peak_N=float(after.force.peak) if result else None,
        moment_peak_Nm=float(after.moment.peak) if result else None,
        counterweights=counterweights(machine, best.mass_kg, best.angle_deg) if result else (),
        nodes=best.nodes,
        method=best.method,
    )


def _chosen(machine: Machine) -> np.ndarray:
    """Webs whose weights are not fixed (K,)."""
    return np.array([web.fixed is None for web in machine.webs], dtype=bool)


def _smallest(task: Task, scene: Prepared, solver: Solver) -> _Best:
    """The smallest objective, as a single answer has it."""
    best = solve(task, scene, solver, in_full=False)
    if isinstance(best, Infeasible):
        nothing = np.zeros(len(task.machine.webs))
        return _Best(nothing, nothing, np.nan, np.nan, np.nan, best.status, best.reason, best.nodes, best.method)
    proof, fitted = best.certificate, best.shown.counterweights
    return _Best(
        np.array([each.mass_kg for each in fitted]),
        np.array([each.angle_deg for each in fitted]),
        proof.objective,
        np.nan if proof.lower_bound is None else proof.lower_bound,
        np.nan if proof.relative_gap is None else proof.relative_gap,
        best.status,
        best.reason,
        best.nodes,
        best.method,
    )


def _lightest(task: Task, scene: Prepared, solver: Solver) -> _Best:
    """The least total mass of all that keep the ceilings."""
    best = minimum_mass(task, scene, solver)
    mass, angle = beside(task.machine, best.mass_kg, best.angle_deg)
    value, fixed = float(np.sum(mass)), float(np.sum(fixed_masses(task.machine)))
    bound, status, reason = best.lower_bound + fixed, best.status, best.reason
    if np.isfinite(bound) and bound > value * (1.0 + _ROUNDING):
        bound, status, reason = np.nan, "inaccurate", CONTRADICTED
    bound = min(bound, value)
    gap = (value - bound) / value if value > 0 else 0.0
    return _Best(mass, angle, value, bound, gap, status, reason, best.nodes, best.method)


def _or_none(figure: float) -> float | None:
    return figure if np.isfinite(figure) else None
