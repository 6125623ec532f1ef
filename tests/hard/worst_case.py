"""``python -m tests.hard.worst_case``: every hard case once more, with scenarios or tolerances.

Of all of them something is known of the answer:

half speed   the machine and itself at half the speed: the optimum is that of the machine, known to 100 digits
opposite     the machine and itself with all cranks turned by half a turn: rest is the best for both, by convexity
tolerances   what is claimed is evaluated in 100-digit numbers, and is no less than the optimum without tolerances
masses       the same where reciprocating masses are off: no less than without, no more than proven of other answers

Nothing may be silent: an answer is right, or says that it is not certified.
"""

import math
import sys
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any

from rich.console import Console

from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from tests.hard import stored
from tests.hard.cases import all_cases
from tests.hard.cases.case import Body, Case
from tests.hard.interior import ZERO, Number, mp
from tests.hard.program import goal, machine, unit
from tests.hard.reference import Reference

MASS, ANGLE = 0.02, 2.0
#: rounding of what is claimed, relative to what it is made of
_ROUNDING = 1e-12
#: webs up to which masses that are off are asked for: with 200 of them the least mass takes seconds
_FEW = 8

Judge = Callable[[Case, Reference, OptimizeAnswer], Iterator[str]]


def _gap(case: Case) -> float:
    return float(case.body.get("accuracy", {}).get("relative_gap", 1e-6))


def half_speed(body: Body) -> Body:
    slow = {"path": "/machine/speed_rpm", "value": 0.5 * body["machine"]["speed_rpm"]}
    return {**body, "scenarios": [{"name": "as it is"}, {"name": "slow", "changes": [slow]}]}


def as_without(case: Case, reference: Reference, answer: OptimizeAnswer) -> Iterator[str]:
    text = "optimal" if reference.feasible else "infeasible"
    if answer.status not in (text, "inaccurate"):
        yield f"{answer.status}, must be {text}"
    if answer.status == "infeasible" or reference.objective is None or answer.certificate is None:
        return
    room = reference.noise + _ROUNDING * reference.rest
    relaxed = reference.objective if reference.relaxed is None else reference.relaxed
    if answer.certificate.objective < relaxed - room:
        yield f"objective {answer.certificate.objective!r} is below {mp.nstr(relaxed, 17)}"
    if answer.certificate.lower_bound is not None and answer.certificate.lower_bound > reference.objective + room:
        yield f"bound {answer.certificate.lower_bound!r} is above {mp.nstr(reference.objective, 17)}"
    if (
        answer.status == "optimal"
        and answer.certificate.objective > reference.objective + _gap(case) * _scale(answer) + room
    ):
        yield f"objective {answer.certificate.objective!r} is above {mp.nstr(reference.objective, 17)}"


def _scale(answer: OptimizeAnswer) -> float:
    assert answer.certificate is not None
    return answer.certificate.yardstick


def opposite(body: Body) -> Body | None:
    """None for a scroll, which has no crank to turn, and where ceilings or directions break the symmetry."""
    goals = body.get("objective", {})
    if body["machine"]["kind"] == "scroll" or "direction_weights" in goals or _ceilings(body):
        return None
    turned = [
        {"path": f"/machine/throws/{t}/crank_angle_deg", "value": throw["crank_angle_deg"] + 180.0}
        for t, throw in enumerate(body["machine"]["throws"])
    ]
    if len(turned) > 64:
        return None
    return {**body, "scenarios": [{"name": "as it is"}, {"name": "opposite", "changes": turned}]}


def _ceilings(body: Body) -> bool:
    return any("ceiling" in name for name in body.get("objective", {}))


def rests(case: Case, reference: Reference, answer: OptimizeAnswer) -> Iterator[str]:
    assert answer.certificate is not None
    room = float(reference.noise) + (1e-9 + _gap(case)) * _scale(answer)
    if abs(answer.certificate.objective - float(reference.rest)) > room:
        yield f"objective {answer.certificate.objective!r} must be {mp.nstr(reference.rest, 17)}"
    if answer.status == "optimal" and case.body.get("objective", {}).get("least_mass", True) and _any_mass(answer):
        yield f"{answer.total_mass_kg!r} kg where none are needed"


def _any_mass(answer: OptimizeAnswer) -> bool:
    return (answer.total_mass_kg or 0.0) > 1e-12


def tolerances(body: Body) -> Body:
    return {**body, "tolerances": {"mass_relative": MASS, "angle_deg": ANGLE}}


def evaluated(case: Case, reference: Reference, answer: OptimizeAnswer) -> Iterator[str]:
    if answer.certificate is None:
        if reference.feasible and not _ceilings(case.body):
            yield "infeasible without ceilings"
        return
    claim, size = _worst(case.body, answer)
    if abs(claim - answer.certificate.objective) > _ROUNDING * size + reference.noise:
        yield f"objective {answer.certificate.objective!r} is {mp.nstr(claim, 17)}"
    if reference.relaxed is not None and claim < reference.relaxed - reference.noise - _ROUNDING * size:
        yield f"objective {mp.nstr(claim, 17)} is below {mp.nstr(reference.relaxed, 17)}, that without tolerances"
    price = answer.price_of_robustness
    if price is None:
        yield "no price"
    elif not _ceilings(case.body) and answer.status == "optimal":
        most = (price.nominal_optimum_worst_case or math.inf) + _gap(case) * _scale(answer)
        if answer.certificate.objective > most + float(_ROUNDING * size):
            yield f"objective {answer.certificate.objective!r} is above that of the nominal optimum, {most!r}"


def _worst(body: Body, answer: OptimizeAnswer) -> tuple[Number, Number]:
    """The worst case in 100-digit numbers, and the sum of what it is made of."""
    data = machine(body)
    objective, square = goal(body, data), data.omega_squared
    u = [
        mp.mpf(counterweight.mass_kg) * web.radius * unit(counterweight.angle_deg)
        for counterweight, web in zip(answer.counterweights, data.webs, strict=True)
    ]
    after, share = data.after(u), mp.mpf(MASS)
    share = abs((1 + share) * unit(ANGLE) - 1)
    rows, size = list(objective.floors), sum(objective.floors, ZERO)
    co = (after.force[0], after.moment[0])
    for term in objective.terms:
        arms = [mp.mpf(1) if term.response == 0 else abs(web.arm) for web in data.webs]
        felt = abs(term.share) * sum((arm * abs(v) for arm, v in zip(arms, u, strict=True)), ZERO)
        rows[term.row] += abs(term.constant + term.share * co[term.response]) + share * felt
        before = (data.baseline.force[0], data.baseline.moment[0])[term.response]
        size += felt + abs(term.constant) + abs(term.share * before)
    return max(rows) * square, size * square


def masses(body: Body) -> Body | None:
    if len(body["machine"].get("webs", ())) > _FEW:
        return None
    return {**body, "tolerances": {"reciprocating_mass_relative": 0.01}}


def no_less(case: Case, reference: Reference, answer: OptimizeAnswer) -> Iterator[str]:
    if answer.certificate is None:
        return
    proof, room = answer.certificate, float(reference.noise) + _ROUNDING * float(reference.rest)
    if reference.relaxed is not None and proof.objective < float(reference.relaxed) - room:
        yield f"objective {proof.objective!r} is below {mp.nstr(reference.relaxed, 17)}, that without scatter"
    price = answer.price_of_robustness
    most = None if price is None or _ceilings(case.body) else price.nominal_optimum_worst_case
    if most is not None and (proof.lower_bound or 0.0) > most * (1 + _ROUNDING) + room:
        yield f"bound {proof.lower_bound!r} is above {most!r}, what the nominal optimum comes to"


#: how a case is asked once more, and what has to be so of the answer
KINDS: dict[str, tuple[Callable[[Body], Body | None], Judge]] = {
    "half speed": (half_speed, as_without),
    "opposite": (opposite, rests),
    "tolerances": (tolerances, evaluated),
    "masses": (masses, no_less),
}


def faults(kind: str, case: Case, reference: Reference) -> tuple[str, list[str]]:
    """Status of the answer, and what is wrong with it; an exception or a warning is a fault like any other."""
    function, judge = KINDS[kind]
    body = function(case.body)
    if body is None:
        return "not asked", []
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            answer = optimize(OptimizeRequest.model_validate(body))
    except Exception as error:  # whatever it is, it is what the battery looks for
        return "exception", [f"{type(error).__name__}: {error}"]
    judgement = list(judge(case, reference, answer))
    if not _certified(answer):
        judgement.append("a status that its certificate does not bear out")
    return answer.status, judgement


def _certified(answer: OptimizeAnswer) -> Any:
    proof = answer.certificate
    if proof is None or answer.status == "inaccurate":
        return True
    return proof.lower_bound is not None and proof.lower_bound <= proof.objective


def main() -> int:
    console, content, failed = Console(), stored.read(), 0
    for kind in KINDS:
        statuses: Counter[str] = Counter()
        for case in all_cases():
            status, texts = faults(kind, case, content[stored.digest(case.body)])
            statuses[status] += 1
            failed += bool(texts)
            for fault in texts:
                console.print(f"{kind}, {case.name}: {fault}", markup=False)
        console.print(f"{kind}: " + ", ".join(f"{name} {count}" for name, count in statuses.most_common()))
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
