"""Columns of counterweights of designs that are no batch of cone programs: every design is a problem of its own."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.numerics.arrays import Complex
from optimizer.outputs.registry import prepare
from optimizer.solve.solution import Infeasible, Solution
from optimizer.solve.solve import solve
from optimizer.solve.worst_case import nothing_off
from schemas.answer.answers import GoalReached
from schemas.answer.proof import DesignMultipliers, NominalProof
from schemas.answer.robust import PriceOfRobustness
from schemas.base.responses import RESPONSES
from schemas.machine.reciprocating import balance_shafts
from schemas.request.requests import OptimizeRequest
from schemas.sweep.columns import CERTIFICATE, MULTIPLIERS, PRICE, WORST_LOAD, goal_columns, worst_peak


def single_optima(requests: Sequence[OptimizeRequest], multipliers: bool) -> tuple[dict[str, Any], Complex]:
    """Columns of certified optima, and the unbalance of the counterweights (count, places) kg m; nan where none.

    Parameters
    ----------
    requests : of one machine with other numbers; none lacks what its objective needs.
    multipliers : whether rows hold their proofs, as text.
    """
    alone = [prepare(request, ("residual",)) for request in requests]
    # a row has no column for prices and sensitivities
    solutions = [_solved(Task.of(request), scene) for request, scene in zip(requests, alone, strict=True)]
    rows = [_row(request, solution, multipliers) for request, solution in zip(requests, solutions, strict=True)]
    columns = {
        name: np.array([row[name] for row in rows], dtype=object if isinstance(first, str | None) else float)
        for name, first in rows[0].items()
    }
    nothing = np.full(len(requests[0].machine.every_web), complex(np.nan))
    return columns, np.array(
        [solution.placement.unbalance if isinstance(solution, Solution) else nothing for solution in solutions]
    )


def _solved(task: Task, scene: Prepared) -> Solution | Infeasible:
    """The optimum of one design; of tolerances that are all 0 too with what it comes to in the worst case."""
    best = solve(task, scene, in_full=False)
    if isinstance(best, Infeasible) or not task.uncertain or task.robust:
        return best
    return replace(best, fields=best.fields | nothing_off(task, scene, best.unbalance, best.certificate.objective))


def _worst(request: OptimizeRequest, best: Solution | Infeasible) -> dict[str, float]:
    """What a design comes to in the worst case, and what that costs."""
    fields: Mapping[str, Any] = best.fields if isinstance(best, Solution) else {}
    worst, price = fields.get("worst_case"), fields.get("price_of_robustness")
    peaks = {
        "force_peak_N": getattr(worst, "force_peak_N", None),
        "moment_peak_Nm": getattr(worst, "moment_peak_Nm", None),
    }
    for response in () if worst is None else worst.responses:
        peaks[RESPONSES[response.response].peak] = response.peak
    row = {worst_peak(name): _or_nan(peak) for name, peak in peaks.items()}
    if request.objective.of_the_shaft:
        row[WORST_LOAD] = _or_nan(getattr(worst, "bearing_peak_N", None))
    return row | {column.name: _or_nan(getattr(price, field, None)) for field, column in PRICE.items()}


def _row(request: OptimizeRequest, best: Solution | Infeasible, multipliers: bool) -> dict[str, str | float | None]:
    """One design by the names of its columns; what is not there is nan."""
    placement, certificate = (best.placement, best.certificate) if isinstance(best, Solution) else (None, None)
    row: dict[str, str | float | None] = {
        "status": best.status,
        "message": "" if best.status == "optimal" else best.reason,
        "method": best.method,
        "total_mass_kg": np.nan if placement is None else placement.total_mass_kg,
    }
    if balance_shafts(request.machine):
        row["balance_shafts_mass_kg"] = (
            np.nan if placement is None else _or_nan(placement.fields["balance_shafts_mass_kg"])
        )
    for name in CERTIFICATE:
        row[name] = _or_nan(getattr(certificate, name, None))
    if request.uncertain:
        row |= _worst(request, best)
    goals = () if certificate is None else certificate.goals
    by_name: dict[str, GoalReached] = {goal.goal: goal for goal in goals}
    for column in goal_columns(request.objective):
        field, _, goal = column.name.removeprefix("goal_").partition(".")
        row[column.name] = _or_nan(getattr(by_name.get(goal), field, None))
    fitted = () if placement is None else placement.every_weight
    masses = {weight.web: (weight.mass_kg, weight.angle_deg) for weight in fitted}
    openings = {weight.web: weight.shape.half_angle_deg for weight in fitted if weight.shape is not None}
    for web in request.machine.every_web:
        if web.envelope is not None:
            row[f"half_angle_deg.{web.name}"] = openings.get(web.name, np.nan)
        row[f"mass_kg.{web.name}"], row[f"angle_deg.{web.name}"] = masses.get(web.name, (np.nan, np.nan))
    if multipliers:
        row[MULTIPLIERS] = _as_text(best)
    return row


def _as_text(best: Solution | Infeasible) -> str:
    """The proof of one design as JSON."""
    if isinstance(best, Solution):
        certificate = best.certificate
        proof = DesignMultipliers(
            objective=certificate.multipliers.objective,
            mass=certificate.multipliers.mass,
            mass_objective_limit=certificate.mass_objective_limit,
            conflict=None,
            implied_max_mass_kg=certificate.implied_max_mass_kg,
            nominal=_nominal_proof(best.fields.get("price_of_robustness")),
        )
    else:
        proof = DesignMultipliers(
            objective=None,
            mass=None,
            mass_objective_limit=None,
            conflict=best.infeasibility.multipliers.conflict,
            implied_max_mass_kg=best.infeasibility.implied_max_mass_kg,
        )
    return proof.model_dump_json()


def _nominal_proof(price: object) -> NominalProof | None:
    """What proves the optimum of the unchanged machine, where a price has it."""
    if not isinstance(price, PriceOfRobustness) or not price.nominal_counterweights:
        return None
    return NominalProof(
        lower_bound=price.nominal_lower_bound,
        counterweights=price.nominal_counterweights,
        balance_shafts=price.nominal_balance_shafts,
        multipliers=price.nominal_multipliers,
        implied_max_mass_kg=price.nominal_implied_max_mass_kg,
    )


def _or_nan(value: object) -> float:
    return float(value) if isinstance(value, int | float) else np.nan
