"""Ask for a combination of features, and judge what comes back."""

import json
import time
import traceback
from collections.abc import Iterator, Sequence
from copy import deepcopy
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from optimizer.errors import NotComputable
from optimizer.formulation.formulate import weights
from optimizer.optimize import optimize
from optimizer.pins.answer import pin_loads
from optimizer.program.verdict import CONTRADICTED
from schemas.answer.answers import OptimizeAnswer
from schemas.request.objective import COSTS
from schemas.request.requests import OptimizeRequest
from schemas.scroll.pin_loads import PinLoadsAnswer, PinLoadsRequest
from service.common.validation import InvalidRequest, check
from service.verification import checker
from tests.pairs.combinations import PINS, features_of
from tests.pairs.machines import BASES, Request
from tests.pairs.pins import wrong_loads
from tests.pairs.scroll_features import EVEN_PINS
from tests.pairs.subject import NoPlace, Subject

#: relative, of the yardstick: what rounding may make of a bound
_ROUNDING = 1e-9
#: relative: what a mass may exceed its limit by, as the verdict has it
_OVER = 1e-9
#: relative: what a peak may exceed its ceiling by, as the verdict has it
_SLACK = 1e-7
#: seconds of a search, where a request says nothing
TIME_LIMIT_S = 0.5

Kind = Literal["answered", "refused", "no place", "fault"]


@dataclass(frozen=True)
class Outcome:
    """What a combination came to.

    message : of a refusal the first field, of a fault what is wrong.
    cpu_s : of the answer alone; the time of this thread.
    """

    base: str
    features: tuple[str, ...]
    kind: Kind
    message: str = ""
    status: str = ""
    cpu_s: float = 0.0

    @property
    def name(self) -> str:
        return f"{self.base}: {' + '.join(self.features)}"


def body_of(base: str, features: Sequence[str], time_limit_s: float = TIME_LIMIT_S) -> Request | None:
    """A request with features in their order; None where the machine has no place for one."""
    body = deepcopy({**BASES, PINS: EVEN_PINS}[base])
    subject = Subject(base, body)
    try:
        for name in features:
            features_of(base)[name](subject)
    except NoPlace:
        return None
    if base == PINS:
        return body
    body.setdefault("accuracy", {}).setdefault("time_limit_s", time_limit_s)
    return body


def ask(base: str, features: Sequence[str], time_limit_s: float = TIME_LIMIT_S) -> Outcome:
    """The answer of a combination, judged."""
    names = tuple(features)
    body = body_of(base, features, time_limit_s)
    if body is None:
        return Outcome(base, names, "no place")
    begun = time.thread_time()
    try:
        request, answer = _answered(base, body)
        text = answer.model_dump_json()
    except (InvalidRequest, NotComputable) as refusal:
        first = next(iter(refusal.problems), None)
        if first is None or not first.path or not first.message:
            return Outcome(base, names, "fault", "refused without a field")
        return Outcome(base, names, "refused", "/".join(map(str, first.path)))
    except Exception as error:
        frame = traceback.extract_tb(error.__traceback__)[-1]
        where = f"{frame.filename.rpartition('/')[2]}:{frame.lineno} {frame.name}"
        return Outcome(base, names, "fault", f"{type(error).__name__}: {error} ({where})")
    spent = time.thread_time() - begun
    if isinstance(answer, PinLoadsAnswer):
        claims, status = wrong_loads(request, answer), "holds" if answer.equilibrium.holds else "does not hold"
    else:
        claims, status = _wrong(request, answer), answer.status
    wrong = [*_unlike_numbers(text), *claims, *_broken_claims(body, text)]
    kind: Kind = "fault" if wrong else "answered"
    return Outcome(base, names, kind, "; ".join(wrong), status, spent)


def _answered(base: str, body: Request) -> tuple[Any, OptimizeAnswer | PinLoadsAnswer]:
    """The request that a body is, and its answer."""
    if base == PINS:
        pins = check(PinLoadsRequest, body)
        return pins, pin_loads(pins)
    request = check(OptimizeRequest, body)
    return request, optimize(request)


def _unlike_numbers(text: str) -> Iterator[str]:
    if "NaN" in text or "Infinity" in text:
        yield "the answer holds no finite number"


def _broken_claims(body: Request, text: str) -> Iterator[str]:
    """What the checker, which shares no code with what computed the answer, proves to be wrong."""
    module = checker()
    for claim in module.verify(body, json.loads(text), module.PLACES)["claims"]:
        if claim["verdict"] == "broken":
            yield f"{claim['claim']} is broken by {claim['margin']}"


def _wrong(request: OptimizeRequest, answer: OptimizeAnswer) -> Iterator[str]:
    """What an answer claims that cannot be."""
    if answer.status == "infeasible":
        yield from _wrong_infeasibility(answer)
        return
    proof = answer.certificate
    if proof is None:
        yield "no certificate"
        return
    size = proof.yardstick or 1.0
    if proof.lower_bound is not None and proof.lower_bound > proof.objective + _ROUNDING * size:
        yield f"bound {proof.lower_bound} above {proof.objective}"
    if answer.status == "optimal":
        if proof.relative_gap is None or proof.relative_gap > request.accuracy.relative_gap + _left(request):
            yield f"optimal with a gap of {proof.relative_gap}"
    elif answer.status_reason == CONTRADICTED:
        yield answer.status_reason
    yield from _wrong_masses(request, answer)
    yield from _wrong_objective(request, answer, proof.objective, size)
    yield from _wrong_ceilings(request, answer)


def _left(request: OptimizeRequest) -> float:
    """What the last goal that is no cost leaves to costs after it."""
    order = request.objective.priorities
    last = max((n for n, priority in enumerate(order) if priority.goal not in COSTS), default=-1)
    return order[last].allowance if 0 <= last < len(order) - 1 else 0.0


def _wrong_infeasibility(answer: OptimizeAnswer) -> Iterator[str]:
    why = answer.infeasibility
    if why is None:
        yield "infeasible without a reason"
    elif not why.conflict:
        yield "infeasible without a conflict"


def _wrong_masses(request: OptimizeRequest, answer: OptimizeAnswer) -> Iterator[str]:
    """Counterweights outside of their limits."""
    webs = {web.name: web for web in request.machine.every_web}
    on_shafts = (counterweight for shaft in answer.balance_shafts for counterweight in shaft.counterweights)
    for weight in (*answer.counterweights, *on_shafts):
        web = webs[weight.web]
        if web.fixed is not None:
            continue
        most = web.max_mass_kg
        if most is not None and weight.mass_kg > most * (1.0 + _OVER):
            yield f"{weight.web} is heavier than its limit: {weight.mass_kg} kg"
        if weight.mass_kg == 0.0:
            continue
        least = web.min_fitted_mass_kg
        if least is not None and weight.mass_kg < least * (1.0 - _OVER):
            yield f"{weight.web} is lighter than its limit: {weight.mass_kg} kg"
        if web.sector is not None:
            off = abs((weight.angle_deg - web.sector.centre_deg + 180.0) % 360.0 - 180.0)
            if off > web.sector.half_angle_deg + 1e-7:
                yield f"{weight.web} is outside of its sector: {weight.angle_deg} deg"
    machine, total = request.machine, answer.total_mass_kg or 0.0
    if machine.max_total_mass_kg is not None and total > machine.max_total_mass_kg * (1.0 + _OVER) + 1e-12:
        yield f"the total mass is over its limit: {total} kg"
    some = sum(
        1
        for counterweight in answer.counterweights
        if counterweight.mass_kg > 0 and webs[counterweight.web].fixed is None
    )
    if machine.max_counterweights is not None and some > machine.max_counterweights:
        yield f"{some} counterweights are more than {machine.max_counterweights}"


def _wrong_objective(request: OptimizeRequest, answer: OptimizeAnswer, objective: float, size: float) -> Iterator[str]:
    """The objective of the first order is what its peaks come to."""
    goal = request.objective
    plain = goal.direction_weights.x == goal.direction_weights.y == 1.0
    if goal.over_the_turn or request.robust or not plain or answer.residual is None or answer.residual.after is None:
        return
    after, factors = answer.residual.after, weights(request.machine, goal)
    peaks = np.array([factors["force"] * after.force.peak_N, factors["moment"] * after.moment.peak_Nm])
    value = float(np.max(peaks) if goal.combine == "max" else np.sum(peaks))
    if abs(value - objective) > _ROUNDING * size:
        yield f"the objective is {objective}, and its peaks come to {value}"


def _wrong_ceilings(request: OptimizeRequest, answer: OptimizeAnswer) -> Iterator[str]:
    """An optimum keeps the ceilings of the first order."""
    goal, residual = request.objective, answer.residual
    if answer.status != "optimal" or residual is None or residual.after is None or goal.orders == "all":
        return
    after = residual.after
    entry = (
        ("force_ceiling_N", after.force.peak_N, residual.before.force.peak_N),
        ("moment_ceiling_Nm", after.moment.peak_Nm, residual.before.moment.peak_Nm),
        ("force_ceiling_x_N", after.force.peak_x_N, residual.before.force.peak_N),
        ("force_ceiling_y_N", after.force.peak_y_N, residual.before.force.peak_N),
        ("moment_ceiling_x_Nm", after.moment.peak_x_Nm, residual.before.moment.peak_Nm),
        ("moment_ceiling_y_Nm", after.moment.peak_y_Nm, residual.before.moment.peak_Nm),
    )
    for field, peak, before in entry:
        allowed = getattr(goal, field)
        if allowed is not None and peak > allowed + _SLACK * max(before, allowed):
            yield f"{field} is not kept: {peak} > {allowed}"
