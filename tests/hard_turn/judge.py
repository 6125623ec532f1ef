"""What is demanded of answers over the turn: bounds below values, values that samples agree with, and no silence.

Loads at many angles come from the simulation of samples, which shares no series with the brackets of peaks.
"""

import time
import warnings
from dataclasses import dataclass, field

import numpy as np

from optimizer.analyze import analyze
from optimizer.optimize import optimize
from optimizer.outputs.registry import MAX_SAMPLES
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from tests.hard_turn.case import Case

#: so much of the largest load may be missed between two samples a tenth of a degree apart, and beside the corners that
#: valves make
_MISSED, _MISSED_CORNERS = 2e-5, 5e-3
_STEPS = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0)


@dataclass
class Verdict:
    """What became of one case."""

    case: Case
    status: str = "exception"
    reason: str = ""
    gap: float = 0.0
    mass_gap: float = 0.0
    seconds: float = 0.0  # of computing
    faults: list[str] = field(default_factory=list)

    def demand(self, met: bool, fault: str) -> None:
        if not met:
            self.faults.append(fault)


def run(case: Case, sampled: bool = True) -> Verdict:
    """One case; an exception or a warning is a fault like any other."""
    began, verdict = time.process_time(), Verdict(case)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            request = OptimizeRequest.model_validate(case.body)
            answer = optimize(request)
            verdict.seconds = time.process_time() - began
            _judge(verdict, request, answer)
            if sampled and answer.certificate is not None:
                _sampled(verdict, request, answer)
    except Exception as error:  # whatever it is, it is what the battery looks for
        verdict.faults.append(f"{type(error).__name__}: {error}")
    return verdict


def _judge(verdict: Verdict, request: OptimizeRequest, answer: OptimizeAnswer) -> None:
    case, proof = verdict.case, answer.certificate
    verdict.status, verdict.reason = answer.status, answer.status_reason
    verdict.demand(len(answer.status_reason) > 10, "nothing is said of the status")
    if case.expected != "said":
        verdict.demand(answer.status == case.expected, f"{answer.status}: {answer.status_reason}")
    if answer.status == "infeasible":
        why = answer.infeasibility
        verdict.demand(why is not None and len(why.conflict) > 0, "no conflict is named")
        for peak in () if why is None else why.smallest:
            verdict.demand(peak.lower_bound <= peak.smallest, f"bound of {peak.response} above its value")
        return
    assert proof is not None
    verdict.demand("contradicts" not in answer.status_reason, "a bound contradicts the answer")
    if proof.lower_bound is None:
        verdict.demand(case.expected == "said", "nothing is proven")
        return
    assert proof.relative_gap is not None
    verdict.gap, verdict.mass_gap = proof.relative_gap, proof.mass_relative_gap or 0.0
    verdict.demand(proof.lower_bound <= proof.objective, "lower bound above the objective")
    if answer.status == "optimal":
        relative_gap = request.accuracy.relative_gap
        verdict.demand(verdict.gap <= relative_gap, f"gap {verdict.gap:.1e}, asked {relative_gap:g}")
        verdict.demand(verdict.mass_gap <= 1e-4, f"gap of the mass {verdict.mass_gap:.1e}")
    for web, counterweight in zip(request.machine.webs, answer.counterweights, strict=True):
        most = np.inf if web.max_mass_kg is None else web.max_mass_kg
        verdict.demand(counterweight.mass_kg <= most * (1 + 1e-13), f"{counterweight.mass_kg!r} kg on {web.name}")


def _sampled(verdict: Verdict, request: OptimizeRequest, answer: OptimizeAnswer) -> None:
    """The largest bearing load of the answer, and of counterweights near it, by samples."""
    goal, proof = request.objective, answer.certificate
    assert proof is not None
    only = goal.force_weight == 0 and goal.moment_weight == 0 and goal.bending_weight == 0 and not goal.priorities
    if not only or goal.bearing_measure != "peak" or proof.lower_bound is None:
        return
    rng = np.random.default_rng(0)
    body = verdict.case.body
    machine = body["machine"]
    rows = [row for throw in machine["throws"] for row in throw.get("rows", ())]
    # as close as an answer may hold them
    turns, series = 2.0, len(rows) + len(machine["bearings"])
    step = min(single_step for single_step in _STEPS if turns * series * 360.0 / single_step <= MAX_SAMPLES)
    corners = "friction" in machine or any("cylinder" in row for row in rows)
    missed = _MISSED_CORNERS * (step / 0.1) if corners else _MISSED * (step / 0.1) ** 2
    for off in (0.0, 1e-2):
        fitted = [
            {
                "web": counterweight.web,
                "mass_kg": counterweight.mass_kg * (1.0 - off * rng.random()),
                # sectors stay as they are
                "angle_deg": counterweight.angle_deg + (0.0 if "sector" in web else 10.0 * off * rng.normal()),
            }
            for web, counterweight in zip(body["machine"]["webs"], answer.counterweights, strict=True)
        ]
        posed = {name: body[name] for name in ("machine", "fidelity")}
        posed |= {"counterweights": fitted, "outputs": ["main_bearings"], "angles": {"step_deg": step}}
        loads = analyze(AnalyzeRequest.model_validate(posed)).main_bearings
        assert loads is not None
        # of the components that are sampled, not of the brackets that stand beside them
        peak = max(
            float(np.max(np.hypot(bearing.after.force_x_N, bearing.after.force_y_N)))
            for bearing in loads.bearings
            if bearing.after is not None
        )
        size = goal.bearing_weight * peak
        verdict.demand(proof.lower_bound <= size * (1.0 + missed), f"brute force {size!r} beats the bound")
        if off == 0.0:
            verdict.demand(size <= proof.objective * (1.0 + 1e-9), f"brute force {size!r} above the objective")
