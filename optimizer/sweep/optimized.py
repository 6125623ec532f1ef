"""Optimum counterweights of many designs of one shape, as columns."""

from dataclasses import replace
from typing import Any

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.figures.counterweights import masses_and_angles, unbalance
from optimizer.formulate import limits as limits_of
from optimizer.formulate import weights as weights_of
from optimizer.mechanics.inertia import Wrench, first_order_responses, reciprocating, rotating
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.layout import layout as layout_of
from optimizer.program.batch import Optima, all_within_reach, joined, optima
from optimizer.program.limits import Limits
from optimizer.program.reference.solver import Solver
from optimizer.program.solution import CLOSED_FORM, CONE_PROGRAM
from optimizer.program.statement import Statement, combined, statement, weighted_peak
from optimizer.program.verdict import INFEASIBLE, claim, verdict
from optimizer.response import Phasors, Response
from optimizer.sweep.proofs import multipliers_as_text
from schemas.requests import OptimizeRequest
from schemas.sweep.columns import MULTIPLIERS

Columns = dict[str, Any]


def shape_keys(request: OptimizeRequest, count: int) -> np.ndarray:
    """Number of the shape of program that each design has (count,): which terms and rows it is made of."""
    weights, across = weights_of(request.machine, request.objective), request.objective.direction_weights
    facts = (weights["force"] > 0, weights["moment"] > 0, np.asarray(across.x) == across.y)
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
    program = all_within_reach(_statement(request, layout, baseline, square), solver)
    found = _found(program, request, solver)
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


def _found(program: Statement, request: OptimizeRequest, solver: Solver) -> Optima:
    """Optima of the programs, without the webs that cannot carry anything, as of one machine."""
    carries = program.limits.reach > 0
    if np.all(carries):
        return _solved(program, request, solver)
    patterns, which = np.unique(carries, axis=0, return_inverse=True)
    parts = []
    for k, webs in enumerate(patterns):
        designs = np.flatnonzero(which.reshape(-1) == k)
        part = _solved(program.chosen(designs).only(webs), request, solver)
        everywhere = np.zeros((designs.size, webs.size), complex)
        everywhere[:, webs] = part.unbalance
        parts.append((designs, replace(part, unbalance=everywhere)))
    order = np.argsort(np.concatenate([designs for designs, _ in parts]))
    return joined([part for _, part in parts], order)


def _solved(program: Statement, request: OptimizeRequest, solver: Solver) -> Optima:
    found = optima(program, request.accuracy.relative_gap, request.objective.least_mass, solver)
    if program.limits.radius.shape[-1] == 0:
        return replace(found, method=np.full_like(found.method, CLOSED_FORM))
    # that ceilings cannot be kept is a finding of the reference solver alone
    return replace(found, method=np.where(found.unreachable, CONE_PROGRAM, found.method))


def _statement(request: OptimizeRequest, layout: Layout, baseline: Wrench, square: Real) -> Statement:
    """The programs of all designs, every array with the leading axis (count,)."""
    count, webs, goal = square.shape, len(request.machine.webs), request.objective
    weights = {name: np.broadcast_to(weight, count) for name, weight in weights_of(request.machine, goal).items()}
    across = goal.direction_weights
    weight_x, weight_y = (np.broadcast_to(np.asarray(weight), count) for weight in (across.x, across.y))
    ceilings = {"force": goal.force_ceiling_N, "moment": goal.moment_ceiling_Nm}
    responses = [_spread(response, count) for response in first_order_responses(layout, baseline)]
    return statement(
        combined(
            [
                weighted_peak(response, weights[response.name], weight_x, weight_y)
                for response in responses
                if weights[response.name][0] > 0
            ],
            goal.combine,
        ),
        [
            (response, np.broadcast_to(np.asarray(ceilings[response.name]), count) / square)
            for response in responses
            if ceilings[response.name] is not None
        ],
        _spread_limits(limits_of(request.machine), count, webs),
    )


def _spread(response: Response, count: tuple[int, ...]) -> Response:
    baseline = Phasors(np.broadcast_to(response.baseline.co, count), np.broadcast_to(response.baseline.counter, count))
    influence = np.broadcast_to(response.influence, (*count, response.influence.shape[-1]))
    return replace(response, baseline=baseline, influence=influence)  # type: ignore[arg-type]  # real or complex


def _spread_limits(limits: Limits, count: tuple[int, ...], webs: int) -> Limits:
    shape = (*count, webs)
    return Limits(
        radius=np.broadcast_to(limits.radius, shape),
        max_mass=np.broadcast_to(limits.max_mass, shape),
        free=np.broadcast_to(limits.free, shape),
        centre=np.broadcast_to(limits.centre, shape),
        half_angle_cos=np.broadcast_to(limits.half_angle_cos, shape),
        half_angle_sin=np.broadcast_to(limits.half_angle_sin, shape),
        max_total_mass=np.broadcast_to(limits.max_total_mass, count),
    )


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
        columns |= {"mass_lower_bound_kg": judged.mass_lower_bound, "mass_relative_gap": judged.mass_gap}
    columns["status"] = np.where(found.unreachable, "infeasible", judged.status)
    message = np.where(judged.status == "optimal", "", judged.reason)
    columns["message"] = np.where(found.unreachable, INFEASIBLE, message)
    return columns
