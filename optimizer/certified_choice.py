"""Certified choices over the turn and in the worst of several scenarios: from a catalogue, or at least so heavy where
they are fitted.

The searches of one machine take the statement with finitely many cuts, and begin with what is proven of any masses.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from optimizer.arrays import Complex
from optimizer.balance_shafts import chosen
from optimizer.certified_discrete import certified_discrete
from optimizer.certified_fitted import certified_fitted, fitted_search
from optimizer.certified_robust import certified_any_mass, with_worst_case
from optimizer.certified_turn import told
from optimizer.choice_rounds import Choice, Sought, in_rounds
from optimizer.discrete.options import EQUAL
from optimizer.discrete.search import Known
from optimizer.discrete.search import search as discrete_search
from optimizer.figures.counterweights import unbalance
from optimizer.mechanics.layout import stacked
from optimizer.out_of_reach import out_of_reach, unreachable
from optimizer.program.cuts import Found, Unkept
from optimizer.program.reference.solver import Solver
from optimizer.proven_turn import CertifiedTurn
from optimizer.robust import Robust
from optimizer.scene import Prepared
from optimizer.searched import continuous, told_status
from optimizer.stock import stock
from schemas.answers import Certificate
from schemas.requests import OptimizeRequest


def certified_choice(request: OptimizeRequest, scene: Prepared, solver: Solver, in_full: bool = True) -> CertifiedTurn:
    """Of what can be chosen the best, over the turn and in the worst of all scenarios.

    Parameters
    ----------
    in_full : with what misplaced counterweights may cost.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    MissingInput
        if a machine lacks what the objective needs.
    """
    if request.machine.semicontinuous:
        free = certified_any_mass(request, scene, in_full)
        if free.chosen is None or _heavy_enough(request, free.chosen):
            return free
    any_mass = continuous(request)
    usual = any_mass.accuracy.model_copy(update={"time_limit_s": request.accuracy.time_limit_s})
    any_mass = any_mass.model_copy(update={"accuracy": usual})
    robust = Robust(any_mass, scene)
    asked, best = robust.solved()
    if isinstance(best, Unkept):
        return out_of_reach(any_mass, scene, asked, best)
    size = float(asked.program.yardsticks[-1])
    search = (_from_stock if request.machine.discrete else _fitted)(request, best, size, solver)
    gap = request.accuracy.relative_gap * size
    picked, found = in_rounds(asked.program, best, search, gap, EQUAL * size, lambda: robust.left_s)
    if not found.kept and found.lower_bound == np.inf:
        shown = chosen(request, picked.mass, picked.angle)
        status, reason = told_status(found, "infeasible", "", True)
        return replace(unreachable(any_mass, scene, asked, shown, best.limits, None), status=status, reason=reason)
    judged = any_mass.model_copy(update={"accuracy": request.accuracy})
    answer = told(judged, scene, asked, best, picked.mass, picked.angle, found.lower_bound, in_full)
    certificate = answer.fields["certificate"]
    assert isinstance(certificate, Certificate)
    proven = certificate.lower_bound is not None
    any_lower = (
        min(max(best.proof.bound, 0.0) * scene.omega_squared, certificate.lower_bound or 0.0) if proven else None
    )
    certificate = certificate.model_copy(
        update={
            "continuous_lower_bound": any_lower,
            "nodes": found.nodes,
            "method": found.method,
            "rounds": best.rounds + found.rounds,
            "cuts": found.cuts,
        }
    )
    status, reason = told_status(found, answer.status, answer.reason, proven)
    answer = replace(
        answer,
        status=status,
        reason=reason,
        # what holds those of any mass up says nothing of what can be chosen
        fields={**answer.fields, "certificate": certificate},
    )
    if not request.robust:
        return answer
    return with_worst_case(robust, answer, *_nominal_choice(request, scene, robust.left_s, solver))


def _heavy_enough(request: OptimizeRequest, u: Complex) -> bool:
    webs = request.machine.webs
    mass = np.abs(u) / stacked([web.radius_m for web in webs])
    return bool(np.all((mass == 0) | (mass >= stacked([web.min_fitted_mass_kg or 0.0 for web in webs]))))


def _from_stock(request: OptimizeRequest, best: Found, size: float, solver: Solver) -> Callable[[Sought], Choice]:
    held, radius = stock(request.machine), best.limits.radius

    def search(sought: Sought) -> Choice:
        relaxed, *known = sought.points
        found = discrete_search(
            sought.statement,
            held.options,
            relaxed,
            sought.at_least,
            sought.gap / size,
            size,
            sought.time_limit_s,
            Known(known, sought.below),
        )
        mass, angle = held.fitted(found.chosen)
        return Choice(mass, angle, unbalance(mass, angle, radius), found)

    return search


def _fitted(request: OptimizeRequest, best: Found, size: float, solver: Solver) -> Callable[[Sought], Choice]:
    radius = best.limits.radius

    def search(sought: Sought) -> Choice:
        relaxed, *known = sought.points
        accuracy = {"relative_gap": sought.gap / size, "time_limit_s": sought.time_limit_s}
        asked = request.model_copy(update={"accuracy": request.accuracy.model_copy(update=accuracy)})
        mass, angle, found = fitted_search(asked, sought.below, relaxed, sought.at_least, size, solver, known)
        return Choice(mass, angle, unbalance(mass, angle, radius), found)

    return search


def _nominal_choice(
    request: OptimizeRequest, scene: Prepared, left_s: float, solver: Solver
) -> tuple[Complex | None, bool]:
    """The best choice for the machine as it is given, if it is found; whether the limit of time left it open."""
    if left_s == 0.0:
        return None, True
    accuracy = request.accuracy.model_copy(update={"time_limit_s": left_s})
    alone = request.model_copy(update={"scenarios": (), "accuracy": accuracy})
    if alone.objective.over_the_turn:
        of_turn = certified_choice(alone, scene, solver, in_full=False)
        return of_turn.chosen if of_turn.status == "optimal" else None, of_turn.status == "inaccurate"
    certify = certified_discrete if request.machine.discrete else certified_fitted
    best = certify(alone, scene.responses, np.array([scene.omega_squared]), solver)
    status = str(best.status[0])
    return best.unbalance[0] if status == "optimal" else None, status == "inaccurate"
