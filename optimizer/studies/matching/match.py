"""From weighed parts to rows: parts -> vectors -> assignments -> bound -> answer."""

import time
from collections.abc import Iterator
from typing import Any, NamedTuple, cast

import numpy as np

from optimizer.analyze import analyze
from optimizer.errors import refuse
from optimizer.formulation.balance_shafts import design_space, in_program
from optimizer.formulation.counterweights import mass_and_angle, too_heavy, unbalance
from optimizer.formulation.formulate import responses
from optimizer.formulation.goals import cone_program
from optimizer.mechanics.fixed_weights import beside
from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.layout import layout, web_radii
from optimizer.mechanics.shapes import fitted_masses
from optimizer.numerics.arrays import Real
from optimizer.optimize import optimize
from optimizer.program.verdict import Claim, verdict
from optimizer.solve.solution import Solution
from optimizer.solve.statuses import LATE
from optimizer.studies.matching.assignment_search import SearchOutcome, search_assignments
from optimizer.studies.matching.counterweight_optima import with_masses
from optimizer.studies.matching.fitted import BestAssignment, as_fitted
from optimizer.studies.matching.problem import Problem, stated
from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer, Timing
from schemas.answer.counterweights import every_counterweight
from schemas.answer.first_order import FirstOrder, Residual
from schemas.base.mappings import or_mapping
from schemas.base.variation import with_fields
from schemas.machine.fitted import GivenCounterweight
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.match.answer import Assignment, MatchAnswer, MatchCertificate, Matched, MatchedRow, Spare
from schemas.match.request import MatchRequest
from schemas.request.requests import Accuracy, AnalyzeRequest, OptimizeRequest

_LEFT = (
    "No exchange of the search gives a better assignment, and there are too many assignments to compare all of them."
    " The certificate states the gap to the proven lower bound, which more time would not change."
)


@or_mapping(MatchRequest)
def match(request: MatchRequest) -> MatchAnswer:
    """The rows that weighed parts go on, each once, so that the weighted peaks are small; with a certified bound."""
    start = time.perf_counter()
    fitted, angle = mass_and_angle(request.machine, request.counterweights)
    # what is cut from a plate has the radius that its mass gives it
    cut = fitted_masses(request.machine, fitted)
    if not request.choose_counterweights:
        refuse(too_heavy(request.machine, request.counterweights, "counterweights"))
        # without counterweights as variables, castings of a group are no variables either
        cut = with_fields(cut, {("web_groups",): ()})
        request = with_fields(request, {("machine",): cut})
    problem = stated(request, cut, fitted, angle)
    searching = time.perf_counter()
    choice = request.choose_counterweights and any(web.max_mass_kg != 0 for web in request.machine.every_web)
    near = request.accuracy.relative_gap * float(problem.peaks.at(problem.vectors(problem.input_order)))
    if choice:
        result = search_assignments(request, problem, near)
    else:
        best = as_fitted(problem, near, request.accuracy.time_limit_s, bool(request.balance_nuts_kg))
        result = SearchOutcome(best, None, None)
    reporting = time.perf_counter()
    fields = _answer(request, problem, result)
    end = time.perf_counter()
    return MatchAnswer(
        **fields,
        timing=Timing(
            total_ms=(end - start) * 1e3,
            solve_ms=(reporting - searching) * 1e3,
            mechanics_ms=(searching - start) * 1e3,
            certificate_ms=0.0,
            report_ms=(end - reporting) * 1e3,
        ),
    )


def _answer(request: MatchRequest, problem: Problem, result: SearchOutcome) -> dict[str, Any]:
    """Names for masses, and every figure evaluated anew by the mechanics."""
    machine, best = request.machine, result.best
    before = _evaluated(request, with_masses(machine, problem.row_masses(problem.input_order)), result.input_order)
    heavier = with_masses(machine, problem.row_masses(best.mass))
    after = _evaluated(request, heavier, result.fitted)
    omega_squared = (machine.speed_rpm * np.pi / 30.0) ** 2
    value, size = after.objective, before.at_rest if request.choose_counterweights else before.objective
    judged = verdict(
        Claim(
            value=np.array([value]),
            # a sum of lengths is no less than nothing
            lower_bound=np.array([max(best.lower_bound, 0.0) * omega_squared]),
            rounding=np.array([after.rounding + problem.rounding * omega_squared]),
            yardstick=np.array([size]),
            excess=np.asarray(-np.inf),
            mass=np.asarray(0.0),
            mass_resolution=np.asarray(0.0),
            mass_lower_bound=None,
        ),
        request.accuracy.relative_gap,
    )
    assignments, spares = _assignments(request, problem, best.mass)
    nothing = bool(np.isnan(judged.relative_gap))
    rows = [row for throw in heavier.throws for row in throw.rows]
    return {
        "status": str(judged.status),
        "status_reason": _reason(best, str(judged.status), str(judged.reason)),
        "assignments": assignments,
        "spares": spares,
        "rows": tuple(
            MatchedRow(throw=at.throw, row=at.row, name=row.name, reciprocating_mass_kg=row.reciprocating_mass_kg)
            for at, row in zip(request.places, rows, strict=True)
        ),
        "counterweights": after.answer.counterweights,
        "total_mass_kg": after.answer.total_mass_kg,
        "balance_shafts": after.answer.balance_shafts,
        "balance_shafts_mass_kg": after.answer.balance_shafts_mass_kg,
        "residual": Matched(before=before.first_order, after=after.first_order),
        "certificate": MatchCertificate(
            objective=value,
            objective_as_listed=before.objective,
            lower_bound=None if nothing else float(judged.lower_bound[0]),
            gap=None if nothing else float(judged.gap[0]),
            relative_gap=None if nothing or not np.isfinite(judged.relative_gap) else float(judged.relative_gap),
            yardstick=size,
            method="exhaustion" if best.exhausted else "sorting",
        ),
    }


def _reason(best: BestAssignment, status: str, judged: str) -> str:
    """Why the answer is what it is: a gap that is left is the search's, or of the arithmetic if all were compared."""
    if status == "inaccurate" and best.late:
        return LATE
    return judged if status != "inaccurate" or best.exhausted else _LEFT


class _Evaluated(NamedTuple):
    """A machine with its parts, and the counterweights that are on it or best for it."""

    answer: AnalyzeAnswer | OptimizeAnswer
    first_order: FirstOrder
    objective: float
    at_rest: float  # the objective with fixed weights alone
    rounding: float  # of the objective


def _evaluated(request: MatchRequest, machine: ReciprocatingMachine, solution: Solution | None) -> _Evaluated:
    """A machine with its parts.

    Parameters
    ----------
    solution : counterweights that were searched; None: those of the request, or those of any masses that are best.
    """
    goal = request.objective
    answer: AnalyzeAnswer | OptimizeAnswer
    if request.choose_counterweights and solution is None:
        close = {"relative_gap": min(request.accuracy.relative_gap, 1e-6)}
        answer = optimize(OptimizeRequest(machine=machine, objective=goal, accuracy=Accuracy(**close)))
    else:
        weights = tuple(GivenCounterweight(**counterweight) for counterweight in _counterweights(request, solution))
        answer = analyze(AnalyzeRequest(machine=machine, counterweights=weights))
    fitted = every_counterweight(answer)
    mass, angle = np.array([weight.mass_kg for weight in fitted]), np.array([weight.angle_deg for weight in fitted])
    cut = fitted_masses(machine, mass)
    plan, space = layout(cut), design_space(cut, goal)
    first = responses(plan, rotating(plan).plus(reciprocating(plan, 1)), goal)
    square, radius = plan.omega**2, web_radii(space.machine)
    program = cone_program(*space, first, square)
    u = in_program(cut, goal, unbalance(mass, angle, radius))
    alone = unbalance(*beside(machine, np.zeros(mass.shape), np.zeros(mass.shape)), radius)
    residual = cast(Residual, answer.residual)
    return _Evaluated(
        answer,
        cast(FirstOrder, residual.after),
        float(program.objective(u) * square),
        float(program.objective(alone) * square),
        float(program.rounding(u) * square),
    )


def _counterweights(request: MatchRequest, solution: Solution | None) -> Iterator[dict[str, Any]]:
    """Counterweights that are on the machine: those of the optimum, or those of the request."""
    if solution is None:
        yield from (counterweight.model_dump() for counterweight in request.counterweights)
        return
    for weight in solution.placement.every_weight:
        if weight.mass_kg > 0.0 and not weight.fixed:
            yield {"web": weight.web, "mass_kg": weight.mass_kg, "angle_deg": weight.angle_deg}


def _assignments(
    request: MatchRequest, problem: Problem, mass: Real
) -> tuple[tuple[Assignment, ...], tuple[Spare, ...]]:
    """Parts for masses: of equal ones the first that is listed goes to the first row."""
    assignments, spares, rows = [], [], [place.model_dump() for place in request.places]
    for group, part in zip(problem.classes, problem.slices, strict=True):
        free = list(range(group.mass.size))
        for row, weight in zip(group.row.tolist(), mass[part].tolist(), strict=True):
            number = next(k for k in free if group.mass[k] == weight)
            free.remove(number)
            name = group.names[number]
            if name is None:
                continue
            fields = {"kind": group.kind, "part": name, "mass_kg": weight}
            if row < 0:
                spares.append(Spare(**fields))
            else:
                assignments.append(Assignment(**fields, **rows[row]))
    return tuple(assignments), tuple(spares)
