"""Optimum counterweights of many designs of one shape, as columns."""

from typing import Any

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.figures.counterweights import masses_and_angles, unbalance
from optimizer.formulate import formulate, responses, shape_facts
from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.layout import layout as layout_of
from optimizer.program.optima import Optima, optima
from optimizer.program.reach import within_reach
from optimizer.program.reference.solver import Solver
from optimizer.program.statement import Statement
from optimizer.program.verdict import INFEASIBLE, claim, verdict
from optimizer.sweep.proofs import multipliers_as_text
from schemas.requests import OptimizeRequest
from schemas.sweep.columns import MULTIPLIERS

Columns = dict[str, Any]


def shape_keys(request: OptimizeRequest, count: int) -> np.ndarray:
    """Number of the shape of program that each design has (count,): which terms and rows it is made of."""
    facts = shape_facts(request.machine, request.objective)
    return sum((np.broadcast_to(fact, (count,)) << k for k, fact in enumerate(facts)), np.zeros(count, dtype=np.int64))


def optimized(
    request: OptimizeRequest, count: int, solver: Solver, multipliers: bool = False
) -> tuple[Columns, Complex]:
    """Columns of certified optima, and the unbalance of the counterweights (count, webs) kg m.

    Parameters
    ----------
    request : of columns (count,); its designs have one shape of program.
    multipliers : whether the proofs are wanted, as text.
    """
    layout = layout_of(request.machine)
    baseline = rotating(layout).plus(reciprocating(layout, 1))
    square = np.broadcast_to(layout.omega**2, (count,))
    stated = formulate(request.machine, request.objective, responses(layout, baseline), square)
    program = within_reach(stated, solver)
    found = optima(program, request.accuracy.relative_gap, request.objective.least_mass, solver)
    mass, angle = masses_and_angles(request.machine, found.unbalance, program.limits)
    u = unbalance(mass, angle, program.limits.radius)
    columns = _certified(request, program, found, u, mass, square)
    columns["total_mass_kg"] = np.sum(mass, axis=-1)
    if multipliers:
        columns[MULTIPLIERS] = multipliers_as_text(
            request.machine, program, found, square, request.objective.least_mass
        )
    for k, web in enumerate(request.machine.webs):
        columns[f"mass_kg.{web.name}"], columns[f"angle_deg.{web.name}"] = mass[:, k], angle[:, k]
    columns = {
        name: np.where(found.unreachable, np.nan, column) if column.dtype == float else column
        for name, column in columns.items()
    }
    return columns, u


def _certified(
    request: OptimizeRequest, program: Statement, found: Optima, u: Complex, mass: Real, square: Real
) -> Columns:
    """What the counterweights are worth, recomputed, and what is proven, as in the answer to one request."""
    total = np.sum(mass, axis=-1)
    least_mass = request.objective.least_mass
    mass_bound = found.mass_lower_bound if least_mass else None
    claimed = claim(program, u, total, found.lower_bound, found.multipliers, mass_bound)
    judged = verdict(claimed, request.accuracy.relative_gap)
    columns: Columns = {
        "method": found.method,
        "objective": claimed.value[:, 0] * square,
        "lower_bound": judged.lower_bound[:, 0] * square,
        "relative_gap": judged.relative_gap,
        "yardstick": claimed.yardstick[:, 0] * square,
    }
    if least_mass:
        columns |= {
            "mass_lower_bound_kg": judged.mass_lower_bound,
            "mass_relative_gap": judged.mass_gap,
            "mass_yardstick_kg": judged.mass_yardstick,
        }
    columns["status"] = np.where(found.unreachable, "infeasible", judged.status)
    message = np.where(judged.status == "optimal", "", judged.reason)
    columns["message"] = np.where(found.unreachable, INFEASIBLE, message)
    return columns
