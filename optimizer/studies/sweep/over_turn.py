"""Columns of counterweights that are optimal over the whole turn: every design is a program of its own."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.outputs.registry import prepare
from optimizer.program.reference.solver import Solver
from optimizer.solve.outcome import Outcome
from optimizer.solve.solve import solve
from schemas.answer.answers import Certificate, GoalReached
from schemas.answer.infeasibility import Infeasibility
from schemas.answer.proof import DesignMultipliers
from schemas.request.requests import OptimizeRequest
from schemas.sweep.columns import CERTIFICATE, MULTIPLIERS, goal_columns


def optimal_over_turn(
    requests: Sequence[OptimizeRequest], solver: Solver, multipliers: bool
) -> tuple[dict[str, Any], Complex]:
    """Columns of certified optima, and the unbalance of the counterweights (count, webs) kg m; nan where none.

    Parameters
    ----------
    requests : of one machine with other numbers; none lacks what its objective needs.
    multipliers : whether the proofs are wanted, as text.
    """
    alone = [prepare(one, outputs=("residual",)) for one in requests]
    # a row has no column for prices and sensitivities
    results = [solve(one, scene, solver, in_full=False) for one, scene in zip(requests, alone, strict=True)]
    rows = [_row(one, each, multipliers) for one, each in zip(requests, results, strict=True)]
    columns = {
        name: np.array([row[name] for row in rows], dtype=object if isinstance(first, str | None) else float)
        for name, first in rows[0].items()
    }
    nothing = np.full(len(requests[0].machine.webs), complex(np.nan))
    return columns, np.array([nothing if each.unbalance is None else each.unbalance for each in results])


def _row(request: OptimizeRequest, best: Outcome, multipliers: bool) -> dict[str, str | float | None]:
    """One design by the names of its columns; what is not there is nan."""
    certificate, total = best.fields["certificate"], best.fields["total_mass_kg"]
    row: dict[str, str | float | None] = {
        "status": best.status,
        "message": "" if best.status == "optimal" else best.reason,
        "method": best.method,
        "total_mass_kg": _or_nan(total),
    }
    for name in CERTIFICATE:
        row[name] = _or_nan(getattr(certificate, name, None))
    goals = certificate.goals if isinstance(certificate, Certificate) else ()
    by_name: dict[str, GoalReached] = {goal.goal: goal for goal in goals}
    for column in goal_columns(request.objective):
        field, _, goal = column.name.removeprefix("goal_").partition(".")
        row[column.name] = _or_nan(getattr(by_name.get(goal), field, None))
    fitted = best.fields["counterweights"]
    assert isinstance(fitted, tuple)
    masses = {one.web: (one.mass_kg, one.angle_deg) for one in fitted}
    openings = {one.web: one.shape.half_angle_deg for one in fitted if one.shape is not None}
    for web in request.machine.webs:
        if web.envelope is not None:
            row[f"half_angle_deg.{web.name}"] = openings.get(web.name, np.nan)
        row[f"mass_kg.{web.name}"], row[f"angle_deg.{web.name}"] = masses.get(web.name, (np.nan, np.nan))
    if multipliers:
        row[MULTIPLIERS] = _as_text(certificate, best.fields.get("infeasibility"))
    return row


def _as_text(certificate: object, infeasibility: object) -> str:
    """The proof of one design as JSON."""
    if isinstance(certificate, Certificate):
        proof = DesignMultipliers(
            objective=certificate.multipliers.objective,
            mass=certificate.multipliers.mass,
            mass_objective_limit=certificate.mass_objective_limit,
            conflict=None,
            implied_max_mass_kg=certificate.implied_max_mass_kg,
        )
    else:
        assert isinstance(infeasibility, Infeasibility)  # one of the two is always there
        proof = DesignMultipliers(
            objective=None,
            mass=None,
            mass_objective_limit=None,
            conflict=infeasibility.multipliers.conflict,
            implied_max_mass_kg=infeasibility.implied_max_mass_kg,
        )
    return proof.model_dump_json()


def _or_nan(value: object) -> float:
    return float(value) if isinstance(value, int | float) else np.nan
