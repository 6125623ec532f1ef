"""How many counterweights, or part numbers, against what they come to at least: a search for each number."""

import time
from dataclasses import replace

import numpy as np

from optimizer.choices.catalogue_options import part_numbers
from optimizer.choices.construction import options_of, takes_options
from optimizer.errors import MissingInput
from optimizer.formulation.balance_shafts import fitted
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.outputs.requirements import missing
from optimizer.solve.minimum_mass import BestSet, minimum_mass, none_of
from optimizer.solve.solution import Infeasible
from optimizer.solve.solve import solve
from schemas.base.variation import with_fields
from schemas.front.counts import PIECES, Countable, CountFront, CountPoint, CountTrade
from schemas.front.pareto import ParetoRequest
from schemas.machine.catalogue import Catalogue
from schemas.machine.machine import Machine


def count_front(request: ParetoRequest, trade: CountTrade, machine: Machine, scene: Prepared) -> CountFront:
    """The front under one limit of the total mass; all its searches together end at the time asked."""
    whole = replace(Task.of(request), machine=machine)
    half, scene = 0.5 * whole.time_limit_s, replace(scene, machine=machine)
    lacking = list(missing(machine, whole.objective))
    if lacking:
        raise MissingInput(lacking)

    def point(number: int | None, seconds: float) -> CountPoint:
        within = machine if number is None else at_most(machine, trade.of, number)
        return _point(replace(whole, machine=within, time_limit_s=max(seconds, 1e-3)), scene, trade, number)

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


def at_most(machine: Machine, of: Countable, number: int) -> Machine:
    """The machine with no more counterweights, or part numbers, than a number."""
    if of in PIECES or number == 0:
        # nothing checked: there may be fewer of them than of sizes
        return with_fields(machine, {("max_counterweights",): number})
    catalogue = with_fields(machine.catalogue or Catalogue(), {("max_part_numbers",): number})
    return with_fields(machine, {("catalogue",): catalogue})


def _most(task: Task, of: Countable) -> int:
    """The largest number that means anything."""
    options = options_of(task).options
    if of in PIECES:
        return int(np.sum(options.webs[np.any(options.mass > 0, axis=-1)]))
    return int(np.max(options.part, initial=-1)) + 1


def _point(task: Task, scene: Prepared, trade: CountTrade, number: int | None) -> CountPoint:
    best = (_smallest if trade.least == "objective" else minimum_mass)(task, scene)
    result = best.status != "infeasible"
    machine = task.machine
    placement = fitted(machine, best.mass_kg, best.angle_deg)
    after = scene.beside(placement.on_shafts).first_order(placement.on_crank)
    castings = best.mass_kg[_free_webs(task)]
    weights = int(np.sum(castings > 0)) if result else None
    sizes = part_numbers(castings) if result else None
    if number is None:
        # where no number limits it, so many as it takes
        used = weights if trade.of in PIECES else sizes
        number = _most(task, trade.of) if used is None else used
    return CountPoint(
        at_most=number,
        status=best.status,
        status_reason=best.reason,
        value=best.value if result else None,
        lower_bound=_or_none(best.lower_bound) if result else None,
        relative_gap=_or_none(best.relative_gap) if result else None,
        weights=weights,
        part_numbers=sizes,
        force_peak_N=float(after.force.peak) if result else None,
        moment_peak_Nm=float(after.moment.peak) if result else None,
        **(placement.fields if result else {"total_mass_kg": None, "counterweights": ()}),
        nodes=best.nodes,
        method=best.method,
    )


def _free_webs(task: Task) -> np.ndarray:
    """Webs that take castings which are not fixed (K + S,)."""
    return takes_options(task) & np.array([web.fixed is None for web in task.space.machine.webs], dtype=bool)


def _smallest(task: Task, scene: Prepared) -> BestSet:
    """The smallest objective, as a single answer has it."""
    best = solve(task, scene, in_full=False, worst_case=False)
    if isinstance(best, Infeasible):
        return none_of(task.machine, best.status, best.reason, best.nodes, best.method)
    proof, weights = best.certificate, best.placement.every_weight
    return BestSet(
        np.array([weight.mass_kg for weight in weights]),
        np.array([weight.angle_deg for weight in weights]),
        proof.objective,
        np.nan if proof.lower_bound is None else proof.lower_bound,
        np.nan if proof.relative_gap is None else proof.relative_gap,
        best.status,
        best.reason,
        best.nodes,
        best.method,
    )


def _or_none(figure: float) -> float | None:
    return figure if np.isfinite(figure) else None
