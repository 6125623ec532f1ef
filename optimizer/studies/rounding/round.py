"""The best rounding of an optimum to steps of mass and angle: a choice from a catalogue of what is on either side."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from optimizer.errors import NotComputable
from optimizer.formulation.balance_shafts import fitted, in_program, web_paths
from optimizer.formulation.counterweights import unbalance
from optimizer.formulation.task import Task
from optimizer.mechanics.fixed_weights import beside
from optimizer.mechanics.layout import stacked
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from optimizer.optimize import optimize
from optimizer.outputs.registry import prepare
from optimizer.outputs.requirements import effects_of_objective
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.solve.uncertain_program import Robust
from optimizer.studies.rounding.neighbours import Sides, nearest, sides
from schemas.answer.answers import Certificate, OptimizeAnswer
from schemas.answer.counterweights import every_counterweight
from schemas.base.mappings import or_mapping
from schemas.base.model import FieldProblem
from schemas.base.rules import Path
from schemas.base.variation import with_fields
from schemas.machine.catalogue import Catalogue
from schemas.machine.machine import Machine
from schemas.request.objective import Objective
from schemas.request.requests import OptimizeRequest
from schemas.request.rounding import RoundAnswer, Rounding, RoundRequest, StepRise, Weights

#: width of the brackets by which sets are judged, as a share of goals and ceilings
_CLOSE = 1e-10
#: all roundings are compared: a gap at which searches tell equals apart
_EXACT = 1e-9
#: what a set is the best of
_ALONE = "The sets are all roundings of the optimum to these steps."
#: of a total mass, relative: by which sums are rounded
_ROUNDING = 1e-12
#: of an angle, by which that of a mirror image is rounded
_ROUNDED_DEG = 1e-9


@or_mapping(RoundRequest)
def round_weights(request: RoundRequest) -> RoundAnswer:
    """The best rounding of the optimum of a request, certified among all of them, and what the steps cost.

    Raises
    ------
    MissingInput
        if the machine lacks what an output, or the objective, needs.
    OutOfRange
        where webs have no crank to count angles from, or no step in their sector.
    """
    try:
        return _rounding(request)
    except NotComputable as error:
        inside = [FieldProblem(("request", *path), message) for path, message in error.problems]
        raise type(error)(inside) from None


class _Set(NamedTuple):
    """Counterweights that are not fixed, those on balance shafts behind those of the crankshaft."""

    mass: Real  # (K + S,) kg
    angle: Real  # (K + S,) degrees, as drawn

    @classmethod
    def of(cls, answer: OptimizeAnswer) -> "_Set":
        every = every_counterweight(answer)
        free = [not counterweight.fixed for counterweight in every]
        return cls(
            np.where(free, [counterweight.mass_kg for counterweight in every], 0.0),
            np.where(free, [counterweight.angle_deg for counterweight in every], 0.0),
        )


@record(frozen=True)
class _Judge:
    """What sets come to, by the program of a request."""

    machine: Machine
    goal: Objective
    program: Problem
    omega_squared: float

    @classmethod
    def of(cls, request: OptimizeRequest) -> "_Judge":
        effects = effects_of_objective(request.objective)
        scene = prepare(request, ("residual", *request.outputs), () if request.cases else effects)
        task = Task.of(request)
        program = Robust(task, scene, task.demand).goals().program
        return cls(request.machine, request.objective, program, scene.omega_squared)

    def values(self, weights: _Set) -> tuple[float, float]:
        """Objective, and the largest excess over a ceiling."""
        radius = stacked([web.radius_m for web in self.machine.every_web])
        values = self.program.values(in_program(self.machine, self.goal, unbalance(*weights, radius)), _CLOSE)
        return float(values.goals[-1]) * self.omega_squared, values.excess

    def objective(self, weights: _Set) -> float:
        return self.values(weights)[0]

    def weights(self, weights: _Set) -> Weights:
        """As it is answered."""
        mass, angle = beside(self.machine, *weights)
        (objective, excess), placement = self.values(weights), fitted(self.machine, mass, angle)
        budget = self.machine.max_total_mass_kg
        return Weights(
            objective=objective,
            limits_kept=excess <= CEILING_TOLERANCE
            and (budget is None or placement.total_mass_kg <= budget * (1.0 + _ROUNDING)),
            **placement.fields,
        )


def _rounding(request: RoundRequest) -> RoundAnswer:
    problem = request.request
    free = optimize(problem)
    if free.certificate is None:
        return _answer(free, None)
    optimum, judge = _Set.of(free), _Judge.of(problem)
    near = sides(problem.machine, *optimum, request.mass_step_kg, request.angle_step_deg)
    answer = _on_steps(optimize(_among(problem, near)), problem.machine, near)
    if answer.certificate is None:
        return _answer(answer, None)
    plain, certificate = judge.weights(_Set(*nearest(near))), answer.certificate
    better = plain.limits_kept and plain.objective < certificate.objective
    if better and len(judge.program.goals) == 1:
        # the time ended the search before it came to what is nearest
        only = _on_steps(optimize(_among(problem, [web.nearest for web in near])), problem.machine, near)
        if only.certificate is not None:
            answer = with_fields(only, _of_search(answer, certificate, only.certificate))
    return _answer(answer, _cost(request, judge, free, answer, plain))


def _answer(answer: OptimizeAnswer, rounding: Rounding | None) -> RoundAnswer:
    fields = {name: getattr(answer, name) for name in type(answer).model_fields}
    if rounding is not None:
        fields["status_reason"] = f"{_ALONE} {answer.status_reason}"
    return RoundAnswer.model_construct(**fields, rounding=rounding)


def _among(request: OptimizeRequest, every: list[Sides]) -> OptimizeRequest:
    """The request with what is on either side as all that there is."""
    values: dict[Path, Any] = {("machine", "catalogue"): Catalogue(), ("accuracy", "relative_gap"): _EXACT}
    machine = request.machine
    for path, web, (masses, angles) in zip(web_paths(machine), machine.every_web, every, strict=True):
        if not web.fixed:
            place = ("machine", *path)
            values |= {(*place, "catalogue_masses_kg"): masses, (*place, "hole_angles_deg"): angles}
    return with_fields(request, values)


def _on_steps(answer: OptimizeAnswer, machine: Machine, every: list[Sides]) -> OptimizeAnswer:
    """The answer with the original angles on balance shafts: a mirror image loses the last digits."""
    values: dict[Path, Any] = {}
    for place, (_, angles) in zip(web_paths(machine), every, strict=True):
        if place[0] == "webs" or not answer.balance_shafts or not angles:
            continue
        _, n, _, k = place
        path = ("balance_shafts", n, "counterweights", k)
        weight = answer.balance_shafts[int(n)].counterweights[int(k)]
        if weight.mass_kg > 0.0:
            off, angle = min((abs(angle - weight.angle_deg), angle) for angle in angles)
            # any other angle is no step, and is shown as it is
            if off <= _ROUNDED_DEG:
                values[(*path, "angle_deg")] = angle
    return with_fields(answer, values) if values else answer


def _of_search(search: OptimizeAnswer, of_all: Certificate, own: Certificate) -> dict[Path, Any]:
    """What a search has proven of all steps, for an answer of the nearest alone.

    Parameters
    ----------
    of_all, own : certificates of the search, and of that answer.
    """
    bound = of_all.lower_bound
    gap = None if bound is None else own.objective - bound
    proof = {
        "lower_bound": bound,
        "gap": gap,
        "relative_gap": None if gap is None else gap / own.yardstick,
        "nodes": of_all.nodes,
        "method": of_all.method,
    }
    return {
        ("status",): search.status,
        ("status_reason",): search.status_reason,
        **{("certificate", name): value for name, value in proof.items()},
    }


def _cost(
    request: RoundRequest, judge: _Judge, free: OptimizeAnswer, answer: OptimizeAnswer, plain: Weights
) -> Rounding:
    """What rounding costs."""
    optimum, best = _Set.of(free), _Set.of(answer)
    least, value = (judge.objective(choice) for choice in (optimum, best))
    there = np.where(best.mass > 0.0, best.angle, optimum.angle)
    rise, proof = value - least, free.certificate
    # of what may be nothing, as far as is proven, there is no share
    something = least > (proof.gap if proof is not None and proof.gap is not None else 0.0)
    return Rounding(
        optimum=judge.weights(optimum),
        nearest=plain,
        objective_rise=rise,
        relative_rise=rise / least if something else None,
        mass_rise_kg=float(np.sum(best.mass) - np.sum(optimum.mass)),
        masses_alone_rise=judge.objective(_Set(best.mass, optimum.angle)) - least,
        angles_alone_rise=judge.objective(_Set(optimum.mass, there)) - least,
        steps=tuple(_steps(request, judge, best, value)),
    )


def _steps(request: RoundRequest, judge: _Judge, best: _Set, value: float) -> Iterator[StepRise]:
    """What a step off costs, of every counterweight alone."""
    mass_step, angle_step, webs = request.mass_step_kg, request.angle_step_deg, judge.machine.every_web
    for k in np.flatnonzero(best.mass > 0.0).tolist():

        def rise(mass: float, angle: float, web: int = k) -> float:
            masses, angles = best.mass.copy(), best.angle.copy()
            masses[web], angles[web] = max(masses[web] + mass, 0.0), angles[web] + angle
            return judge.objective(_Set(masses, angles)) - value

        yield StepRise(
            web=webs[k].name,
            lighter=rise(-mass_step, 0.0),
            heavier=rise(mass_step, 0.0),
            backward=rise(0.0, -angle_step),
            forward=rise(0.0, angle_step),
        )
