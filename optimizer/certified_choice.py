"""Certified choices in the worst of several scenarios: from a catalogue, or at least so heavy where they are fitted.

Of the first order the program of all scenarios is a statement with a row for each: the searches of one machine take it
as it is, and begin with what is proven of any masses.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.balance_shafts import chosen
from optimizer.certified_discrete import certified_discrete
from optimizer.certified_fitted import certified_fitted, fitted_search
from optimizer.certified_robust import certified_robust, with_worst_case
from optimizer.certified_turn import told
from optimizer.discrete.search import search
from optimizer.goals import Goals
from optimizer.mechanics.layout import stacked
from optimizer.out_of_reach import unreachable
from optimizer.program.cuts import Found, Unkept
from optimizer.program.reference.solver import Solver
from optimizer.program.statement import Statement
from optimizer.proven_turn import CertifiedTurn
from optimizer.robust import Robust
from optimizer.scene import Prepared
from optimizer.searched import Found as Searched
from optimizer.searched import continuous, told_status
from optimizer.stock import stock
from schemas.answers import Certificate
from schemas.requests import OptimizeRequest


class _Chosen(NamedTuple):
    """Masses [kg] and angles [deg] (K,), and where the search for them ended."""

    mass: Real
    angle: Real
    found: Searched


def certified_choice(request: OptimizeRequest, scene: Prepared, solver: Solver) -> CertifiedTurn:
    """Of what can be chosen the best in the worst of all scenarios.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    MissingInput
        if a machine lacks what the objective needs.
    """
    if request.machine.semicontinuous:
        free = certified_robust(request, scene)
        if free.chosen is None or _heavy_enough(request, free.chosen):
            return free
    any_mass = continuous(request)
    usual = any_mass.accuracy.model_copy(update={"time_limit_s": request.accuracy.time_limit_s})
    any_mass = any_mass.model_copy(update={"accuracy": usual})
    robust = Robust(any_mass, scene)
    asked, best = robust.solved()
    if isinstance(best, Unkept):
        return certified_robust(any_mass, scene)
    statement = replace(asked.program.statement(asked.program.first), limits=best.limits)
    picked = (_from_stock if request.machine.discrete else _fitted)(request, statement, asked, best, solver)
    found = picked.found
    if not found.kept and found.lower_bound == np.inf:
        shown = chosen(request, picked.mass, picked.angle)
        status, reason = told_status(found, "infeasible", "", True)
        return replace(unreachable(any_mass, scene, asked, shown, best.limits, None), status=status, reason=reason)
    judged = any_mass.model_copy(update={"accuracy": request.accuracy})
    answer = told(judged, scene, asked, best, picked.mass, picked.angle, found.lower_bound)
    certificate = answer.fields["certificate"]
    assert isinstance(certificate, Certificate)
    proven = certificate.lower_bound is not None
    any_lower = (
        min(max(best.proof.bound, 0.0) * scene.omega_squared, certificate.lower_bound or 0.0) if proven else None
    )
    certificate = certificate.model_copy(
        update={"continuous_lower_bound": any_lower, "nodes": found.nodes, "method": found.method}
    )
    status, reason = told_status(found, answer.status, answer.reason, proven)
    answer = replace(
        answer,
        status=status,
        reason=reason,
        # what holds those of any mass up says nothing of what can be chosen
        fields={**answer.fields, "certificate": certificate},
    )
    return with_worst_case(robust, answer, *_nominal_choice(request, scene, robust.left_s, solver))


def _heavy_enough(request: OptimizeRequest, u: Complex) -> bool:
    webs = request.machine.webs
    mass = np.abs(u) / stacked([web.radius_m for web in webs])
    return bool(np.all((mass == 0) | (mass >= stacked([web.min_fitted_mass_kg or 0.0 for web in webs]))))


def _from_stock(request: OptimizeRequest, statement: Statement, asked: Goals, best: Found, solver: Solver) -> _Chosen:
    held, accuracy, size = stock(request.machine), request.accuracy, float(asked.program.yardsticks[-1])
    u, bound = best.point.unbalance, best.proof.bound
    found = search(statement, held.options, u, bound, accuracy.relative_gap, size, accuracy.time_limit_s)
    return _Chosen(*held.fitted(found.chosen), found)


def _fitted(request: OptimizeRequest, statement: Statement, asked: Goals, best: Found, solver: Solver) -> _Chosen:
    size = float(asked.program.yardsticks[-1])
    return _Chosen(*fitted_search(request, statement, best.point.unbalance, best.proof.bound, size, solver))


def _nominal_choice(
    request: OptimizeRequest, scene: Prepared, left_s: float, solver: Solver
) -> tuple[Complex | None, bool]:
    """The best choice for the machine as it is given, if it is found; whether the limit of time left it open."""
    if left_s == 0.0:
        return None, True
    accuracy = request.accuracy.model_copy(update={"time_limit_s": left_s})
    alone = request.model_copy(update={"scenarios": (), "accuracy": accuracy})
    certify = certified_discrete if request.machine.discrete else certified_fitted
    best = certify(alone, scene.responses, np.array([scene.omega_squared]), solver)
    status = str(best.status[0])
    return best.unbalance[0] if status == "optimal" else None, status == "inaccurate"
