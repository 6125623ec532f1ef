"""From request to answer: machine -> responses -> program -> counterweights -> report."""

import time
from collections.abc import Sequence

from optimizer.errors import MissingInput, refuse
from optimizer.formulation.counterweights import too_heavy
from optimizer.formulation.task import Task
from optimizer.numerics.arrays import variant
from optimizer.outputs.registry import fields, prepare
from optimizer.outputs.requirements import effects_of_objective, missing
from optimizer.solve.alternatives import BEST, alternatives
from optimizer.solve.solution import Solution
from optimizer.solve.solve import solve
from optimizer.solve.turn_residual import with_turn
from optimizer.solve.worst_case import nothing_off
from schemas.answer.alternatives import Alternative
from schemas.answer.answers import OptimizeAnswer
from schemas.base.mappings import or_mapping
from schemas.request.objective import outputs_about
from schemas.request.requests import OptimizeRequest

#: outputs that every answer holds
_ALWAYS = ("residual",)


@or_mapping(OptimizeRequest)
def optimize(request: OptimizeRequest, outputs: Sequence[str] | None = None) -> OptimizeAnswer:
    """Counterweights that minimise what the objective weighs, with a certificate.

    Every figure is evaluated by the mechanics from the returned masses and angles.

    Parameters
    ----------
    outputs : that the answer holds beside what every answer does; None are those that the request asks for.

    Raises
    ------
    MissingInput
        if the machine lacks what a requested output, or the objective, needs.
    """
    start = time.perf_counter()
    task = Task.of(request)
    lacking = list(missing(task.machine, task.objective))
    if lacking:
        raise MissingInput(lacking)
    refuse(too_heavy(request.machine, request.fitted, "fitted"))
    always = (*_ALWAYS, *outputs_about(task.objective.over_the_turn))
    names = (*always, *(request.outputs if outputs is None else outputs))
    # of cases every one is a machine of its own, simulated for itself
    scene = prepare(request, names, () if task.scenarios else effects_of_objective(task.objective))
    solving, began = time.perf_counter(), time.thread_time()
    first = variant(task, time_limit_s=BEST * task.time_limit_s) if request.alternatives else task
    best = solve(first, scene)
    cheaper: tuple[Alternative, ...] = ()
    if request.alternatives and isinstance(best, Solution):
        left_s = task.time_limit_s - (time.thread_time() - began)
        cheaper = alternatives(task, request.alternatives, scene, best.unbalance, left_s)
    reporting = time.perf_counter()
    there, on_crank, answer, u, report_s = best.cut or scene, None, best.answer, None, 0.0
    if isinstance(best, Solution):
        there, on_crank = there.beside(best.placement.on_shafts), best.placement.on_crank
        u, report_s = best.unbalance, best.report_s
        if task.tolerances is not None and not task.robust:
            answer |= nothing_off(task, scene, u, best.certificate.objective)
    figures = fields(there, on_crank, names, answer)
    if task.objective.orders == "all":
        figures["residual"] = with_turn(figures["residual"], scene, u)
    end = time.perf_counter()
    return OptimizeAnswer.of_figures(
        {
            "status": best.status,
            "status_reason": best.reason,
            **answer,
            **figures,
            "alternatives": cheaper,
            "reference_plane_m": float(scene.layout.reference_plane),
            "effects": scene.simulated.uses,
            "timing": {
                "total_ms": (end - start) * 1e3,
                "solve_ms": (reporting - solving - best.certify_s - report_s) * 1e3,
                "mechanics_ms": scene.mechanics_ms,
                "certificate_ms": best.certify_s * 1e3,
                "report_ms": (end - reporting + report_s) * 1e3,
            },
        }
    )
