"""What is demanded of an answer, and by how much it is missed.

Peaks, objective and limits are evaluated in 100-digit numbers from the masses and angles of the answer; what the
answer says of them has to agree.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from schemas.answer.answers import OptimizeAnswer
from schemas.answer.counterweights import Counterweight
from tests.hard.cases.case import Case
from tests.hard.interior import ZERO, Number, mp
from tests.hard.program import EPS, NOTHING, Goal, Machine, Pair, goal, machine, unit
from tests.hard.reference import CEILING_TOLERANCE, Reference

#: least mass, and with it the unbalances, are proven this closely in an optimal answer (docs/mathematics.md section 5)
MASS_GAP = 1e-4
#: rounding of an answer's own arithmetic, relative to what it is made of
ROUNDING = 1e-13
#: half-angles of sectors may be exceeded by the rounding of an angle, degrees
_ANGLE = 1e-12


@dataclass
class Verdict:
    """What became of one case; errors are 0 where they do not apply."""

    case: Case
    status: str = "exception"
    method: str = ""
    seconds: float = 0.0
    relative_gap: float = 0.0
    mass_gap: float = 0.0
    objective_error: float = 0.0  # above the reference, relative to the objective without counterweights
    peak_error: float = 0.0  # of force or moment, relative to what adds up to them
    mass_error: float = 0.0  # relative to the least mass
    faults: list[str] = field(default_factory=list)

    def demand(self, met: bool, fault: str) -> None:
        if not met:
            self.faults.append(fault)


def judge(case: Case, answer: OptimizeAnswer, expected: Reference | None) -> Verdict:
    """Hold an answer against its reference; without one, against its own claims only."""
    verdict = Verdict(case, answer.status)
    for path, value in _numbers(answer.model_dump(), ""):
        verdict.demand(math.isfinite(value), f"{path} is {value}")
    data = machine(case.body)
    objective = goal(case.body, data)
    if expected is not None:
        text = "optimal" if expected.feasible else "infeasible"
        verdict.demand(answer.status == text, f"{answer.status}, must be {text}")
    if answer.status == "infeasible":
        _judge_infeasible(verdict, answer, data, objective, expected)
    else:
        _judge_counterweights(verdict, answer, data, objective, expected)
    return verdict


def _numbers(value: Any, path: str) -> Iterator[tuple[str, float]]:
    if isinstance(value, float):
        yield path, value
    elif isinstance(value, dict):
        for name, part in value.items():
            yield from _numbers(part, f"{path}/{name}")
    elif isinstance(value, list | tuple):
        for index, part in enumerate(value):
            yield from _numbers(part, f"{path}/{index}")


def _unbalance(data: Machine, weights: tuple[Counterweight, ...]) -> list[Any]:
    return [
        mp.mpf(weight.mass_kg) * web.radius * unit(weight.angle_deg)
        for weight, web in zip(weights, data.webs, strict=True)
    ]


def _sizes(data: Machine, u: list[Any]) -> tuple[Number, Number]:
    """What adds up to force and moment: rounding is relative to these."""
    base = [(noise + NOTHING) / EPS for noise in data.noise]
    force = base[0] + sum((abs(v) for v in u), ZERO)
    moment = base[1] + sum((abs(v * web.arm) for v, web in zip(u, data.webs, strict=True)), ZERO)
    return force, moment


def _weights(objective: Goal) -> tuple[Number, Number]:
    return tuple(max((abs(t.share) for t in objective.terms if t.response == r), default=ZERO) for r in (0, 1))


def _peaks(pair: Pair) -> tuple[Number, Number]:
    return tuple(abs(co) + abs(counter) for co, counter in (pair.force, pair.moment))


def _judge_counterweights(
    verdict: Verdict, answer: OptimizeAnswer, data: Machine, objective: Goal, expected: Reference | None
) -> None:
    case, certificate, square = verdict.case, answer.certificate, data.omega_squared
    assert certificate is not None
    assert answer.residual.after is not None
    relative_gap = case.body.get("accuracy", {}).get("relative_gap", 1e-6)
    verdict.method, verdict.relative_gap = certificate.method, certificate.relative_gap
    verdict.mass_gap = certificate.mass_relative_gap or 0.0
    verdict.demand(
        certificate.relative_gap <= relative_gap,
        f"certified gap {certificate.relative_gap:.2e}, asked {relative_gap:g}",
    )
    verdict.demand(verdict.mass_gap <= MASS_GAP, f"certified gap of the mass {verdict.mass_gap:.2e}")

    u = _unbalance(data, answer.counterweights)
    _judge_limits(verdict, answer, data, objective, u)
    after = data.after(u)
    sizes = [size * square for size in _sizes(data, u)]
    noise = 16 * EPS * sum((w * s for w, s in zip(_weights(objective), sizes, strict=True)), ZERO)
    objective_value = objective.value(after) * square
    rest = objective.value(data.baseline) * square
    verdict.demand(
        abs(objective_value - certificate.objective) <= ROUNDING * rest + noise,
        f"objective {certificate.objective!r} is {mp.nstr(objective_value, 17)}",
    )
    peaks = [peak * square for peak in _peaks(after)]
    pair = (answer.residual.after.force.peak_N, answer.residual.after.moment.peak_Nm)
    for name, peak, number, size in zip(("force", "moment"), peaks, pair, sizes, strict=True):
        verdict.demand(abs(peak - number) <= 32 * EPS * size, f"peak {name} {number!r} is {mp.nstr(peak, 17)}")
    if expected is None or not expected.feasible:
        return
    assert expected.objective is not None
    assert expected.relaxed is not None
    noise += expected.noise
    # where there is nothing without counterweights (and a ceiling asks for some), their own effect is the measure
    rest = rest or sum((w * s for w, s in zip(_weights(objective), sizes, strict=True)), ZERO)
    verdict.objective_error = _share(objective_value - expected.objective, rest, noise)
    above, below = objective_value - expected.objective, expected.relaxed - objective_value
    verdict.demand(
        above <= relative_gap * rest * (1 + ROUNDING) + noise, f"objective {verdict.objective_error:.2e} above"
    )
    verdict.demand(below <= ROUNDING * rest + noise, f"objective {verdict.objective_error:.2e} below the optimum")
    over = certificate.lower_bound - expected.objective
    verdict.demand(over <= ROUNDING * rest + noise, f"lower bound {_share(over, rest, noise):.2e} above the optimum")
    _judge_mass(verdict, answer, expected, noise)
    if case.peaks_unique and expected.force is not None and expected.moment is not None:
        for name, peak, right, size in zip(
            ("force", "moment"), peaks, (expected.force, expected.moment), sizes, strict=True
        ):
            error = float(abs(peak - right) / size) if size else 0.0
            verdict.peak_error = max(verdict.peak_error, error)
            verdict.demand(error <= MASS_GAP, f"peak {name} {mp.nstr(peak, 9)}, must be {mp.nstr(right, 9)}")


def _share(error: Number, rest: Number, noise: Number) -> float:
    """A difference of objectives relative to rest; 0 where it is rounding of the machine's own data."""
    return 0.0 if abs(error) <= noise or rest == 0 else float(error / rest)


def _judge_limits(verdict: Verdict, answer: OptimizeAnswer, data: Machine, objective: Goal, u: list[Any]) -> None:
    webs = verdict.case.body["machine"].get("webs", ())
    for weight, web in zip(answer.counterweights, webs, strict=True):
        most = math.inf if web["max_mass_kg"] is None else web["max_mass_kg"]
        verdict.demand(0 <= weight.mass_kg <= most * (1 + ROUNDING), f"web {web['name']}: {weight.mass_kg!r} kg")
        sector = web.get("sector")
        if sector is not None and weight.mass_kg > 0:
            off = abs((weight.angle_deg - sector["centre_deg"] + 180) % 360 - 180)
            mask = off <= sector["half_angle_deg"] + _ANGLE + 4e-16 * abs(sector["centre_deg"])
            verdict.demand(mask, f"web {web['name']}: {off!r} degrees from its centre")
    total = sum(weight.mass_kg for weight in answer.counterweights)
    if data.budget is not None:
        verdict.demand(total <= float(data.budget) * (1 + ROUNDING), f"{total!r} kg exceed the budget")
    if answer.status != "optimal":
        return
    excess = _excess(data, objective, u)
    verdict.demand(excess is None or excess <= CEILING_TOLERANCE * 1.001, f"ceiling exceeded by {mp.nstr(excess, 3)}")


def _excess(data: Machine, objective: Goal, u: list[Any]) -> Number | None:
    """Largest excess over a ceiling, relative to the larger of itself and what is there without counterweights."""
    after = data.after(u)
    before, now = (data.baseline.force[0], data.baseline.moment[0]), (after.force[0], after.moment[0])
    maxima = []
    for response, cap in objective.ceilings:
        size = max(abs(cap), abs(before[response]))
        over = abs(now[response]) - cap
        # with nothing to measure by, the rounding of the counterweights themselves
        maxima.append(over / size if size else max(ZERO, over - 16 * EPS * _sizes(data, u)[response]))
    return max(maxima, default=None)


def _judge_mass(verdict: Verdict, answer: OptimizeAnswer, expected: Reference, noise: Number) -> None:
    if expected.mass is None:
        verdict.demand(answer.certificate.mass_lower_bound_kg is None, "a bound of the mass that was not asked for")
        return
    assert answer.total_mass_kg is not None
    mass, right, allowed = mp.mpf(answer.total_mass_kg), expected.mass, expected.mass_price * noise
    verdict.mass_error = 0.0 if abs(mass - right) <= allowed or not right else float((mass - right) / right)
    most = right * (1 + mp.mpf(MASS_GAP)) + allowed
    verdict.demand(mass <= most, f"{answer.total_mass_kg!r} kg, least is {mp.nstr(right, 12)}")
    least = expected.mass_relaxed * (1 - mp.mpf(MASS_GAP)) - allowed
    verdict.demand(mass >= least, f"{answer.total_mass_kg!r} kg is less than the least {mp.nstr(right, 12)}")
    bound = answer.certificate.mass_lower_bound_kg
    if bound is None:
        verdict.faults.append("no bound of the mass")
    else:
        proven = right * (1 + mp.mpf(ROUNDING)) + allowed
        verdict.demand(bound <= proven, f"bound of the mass {bound!r} above the least {mp.nstr(right, 17)}")


def _judge_infeasible(
    verdict: Verdict, answer: OptimizeAnswer, data: Machine, objective: Goal, expected: Reference | None
) -> None:
    report = answer.infeasibility
    verdict.demand(report is not None and len(report.conflict) > 0, "no conflict is named")
    verdict.demand(not answer.counterweights, "counterweights of an infeasible machine")
    if report is None or expected is None or expected.excess is None:
        return
    smallest = (
        (report.smallest_force_lower_bound_N, report.smallest_force_N, abs(data.baseline.force[1])),
        (report.smallest_moment_lower_bound_Nm, report.smallest_moment_Nm, abs(data.baseline.moment[1])),
    )
    for bound, smallest_peak, floor in smallest:
        verdict.demand(bound <= smallest_peak, f"lower bound {bound!r} above the value {smallest_peak!r}")
        limit = float(floor * data.omega_squared)
        verdict.demand(
            smallest_peak >= limit * (1 - 1e-12), f"smallest peak {smallest_peak!r} below the floor {limit!r}"
        )
    excess = _excess(data, objective, _unbalance(data, report.closest.counterweights))
    assert excess is not None
    verdict.objective_error = float(excess - expected.excess)
    verdict.demand(verdict.objective_error <= 1e-6, f"the closest is {verdict.objective_error:.2e} from the closest")
