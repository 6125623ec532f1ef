"""Columns of designs that are certified each by itself: from catalogues, at least so heavy, of plates, or alike."""

import numpy as np

from optimizer.formulation.formulate import responses
from optimizer.mechanics.fixed_weights import laden
from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.layout import layout
from optimizer.mechanics.shapes import plates
from optimizer.numerics.arrays import Complex
from optimizer.program.reference.solver import Solver
from optimizer.solve.certify import Certified
from optimizer.solve.design import certified_one
from optimizer.studies.sweep.counterweights import Columns, columns_of
from schemas.request.requests import OptimizeRequest


def optimal_alone(request: OptimizeRequest, solver: Solver, multipliers: bool) -> tuple[Columns, Complex]:
    """Columns of one design whose objective is about the first order, (1,), and its unbalance (1, webs) kg m.

    Parameters
    ----------
    multipliers : whether the proof is wanted, as text.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    """
    plan = laden(layout(request.machine), request.machine)
    baseline = rotating(plan).plus(reciprocating(plan, 1))
    every = responses(plan, baseline, request.objective)
    asked, best = certified_one(request, every, np.atleast_1d(plan.omega**2), solver)
    columns, unbalance = columns_of(asked, best, multipliers)
    return columns | _openings(asked, best), unbalance


def _openings(request: OptimizeRequest, best: Certified) -> Columns:
    """Half-angles of what is cut from plates, deg; nan where nothing is."""
    cut = plates(request.machine)
    if cut is None:
        return {}
    u = np.abs(best.unbalance[:, cut.webs])
    fits = (best.status != "infeasible")[:, None] & (u > 0)
    openings = np.where(fits, np.rad2deg(cut.opened(u)), np.nan)
    return {f"half_angle_deg.{request.machine.webs[k].name}": openings[:, n] for n, k in enumerate(cut.webs)}
