"""Columns of the counterweights of many designs of one shape: optimal ones, or those of the request."""

from typing import Any

import numpy as np

from optimizer.formulation.balance_shafts import design_space, in_drawing
from optimizer.formulation.counterweights import mass_and_angle, unbalance
from optimizer.formulation.formulate import responses, shape_facts
from optimizer.formulation.task import Task
from optimizer.mechanics.fixed_weights import laden
from optimizer.mechanics.inertia import first_order
from optimizer.mechanics.layout import layout as layout_of
from optimizer.mechanics.layout import stacked
from optimizer.numerics.arrays import Complex, Real
from optimizer.solve.certify import Certified, certified
from optimizer.studies.sweep.proofs import multipliers_as_text
from schemas.machine.machine import Machine
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.sweep.columns import MULTIPLIERS

Columns = dict[str, Any]


def shape_keys(request: OptimizeRequest, count: int) -> np.ndarray:
    """Number of the shape of program that each design has (count,): which terms and rows it is made of."""
    facts = shape_facts(*design_space(request.machine, request.objective))
    return sum((np.broadcast_to(fact, (count,)) << k for k, fact in enumerate(facts)), np.zeros(count, dtype=np.int64))


def optimal(request: OptimizeRequest, count: int, multipliers: bool = False) -> tuple[Columns, Complex]:
    """Columns of certified optima, and the unbalance of the counterweights (count, places) kg m.

    Parameters
    ----------
    request : of columns (count,); its designs have one shape of program.
    multipliers : whether rows hold their proofs, as text.
    """
    layout = laden(layout_of(request.machine), request.machine)
    turning, moving = first_order(layout)
    baseline = turning.plus(moving)
    square = np.broadcast_to(layout.omega**2, (count,))
    task = Task.of(request)
    machine, objective = task.space
    best = certified(machine, objective, responses(layout, baseline, objective), square, task.demand)
    return columns_of(request, best, multipliers)


def columns_of(request: OptimizeRequest, best: Certified, multipliers: bool) -> tuple[Columns, Complex]:
    """The same of what was certified; the request is of the radii that it has."""
    machine, every = request.machine, request.machine.every_web
    mass, angle = in_drawing(machine, request.objective, best.mass_kg, best.angle_deg)
    optimal, none = best.status == "optimal", best.status == "infeasible"
    columns: Columns = {
        **best.certificate,
        "status": best.status,
        "message": np.broadcast_to("", optimal.shape) if optimal.all() else np.where(optimal, "", best.reason),
        **_total_masses(machine, mass),
    }
    if multipliers:
        columns[MULTIPLIERS] = multipliers_as_text(request, best)
    # one after the other, as the table has them
    for web, of_web, towards in zip(every, mass.T.copy(), angle.T.copy(), strict=True):
        columns[f"mass_kg.{web.name}"], columns[f"angle_deg.{web.name}"] = of_web, towards
    if none.any():
        for name, column in columns.items():
            if column.dtype == float:
                columns[name] = blank = np.array(column)
                blank[none] = np.nan
    if angle is best.angle_deg:
        return columns, best.unbalance
    return columns, unbalance(mass, angle, stacked([web.radius_m for web in every]))


def _total_masses(machine: Machine, mass: Real) -> Columns:
    """Of counterweights (..., places) kg: on the crankshaft, and on the balance shafts where there are any."""
    own = len(machine.webs)
    columns = {"total_mass_kg": np.sum(mass[..., :own], axis=-1)}
    if mass.shape[-1] > own:
        columns["balance_shafts_mass_kg"] = np.sum(mass[..., own:], axis=-1)
    return columns


def fixed_columns(request: AnalyzeRequest, count: int) -> tuple[Columns, Complex]:
    """Total mass, and the unbalance of the counterweights (count, places) kg m."""
    mass, angle = mass_and_angle(request.machine, request.counterweights)
    radius = stacked([web.radius_m for web in request.machine.every_web])
    shape = (count, radius.shape[-1])
    columns: Columns = {
        "status": np.broadcast_to("analyzed", count),
        "message": np.broadcast_to("", count),
    }
    columns |= {name: np.broadcast_to(column, count) for name, column in _total_masses(request.machine, mass).items()}
    return columns, np.broadcast_to(unbalance(mass, angle, radius), shape)
