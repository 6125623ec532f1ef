"""``accuracy.relative_gap`` is honoured both ways, and the certificate says what was reached.

``CHECKED_ANSWERS=every HARD_SEARCH=2000 pytest tests/hard/test_asked_gap.py`` searches that many machines; otherwise a
few, always the same.
Expected numbers are analytic (what the bounds of one answer say of another) or independent (100-digit evaluation).
"""

import json
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from schemas.answer.answers import OptimizeAnswer
from tests.hard.cases.case import Body, Case
from tests.hard.judge import judge
from tests.hard.searches import search
from tests.hard.wild import requests
from tests.optimize.machines import random_machine
from tests.verification.checking import optimized

#: looser than the default, the default, tighter than it
GAPS = (1e-2, 1e-6, 1e-10)

_OBJECTIVES: st.SearchStrategy[dict[str, Any]] = st.fixed_dictionaries(
    {
        "combine": st.sampled_from(["sum", "max"]),
        "direction_weights": st.sampled_from([{"x": 1, "y": 1}, {"x": 1, "y": 0.3}, {"x": 0, "y": 1}]),
        "least_mass": st.booleans(),
    }
)


def _answers(body: Body) -> list[OptimizeAnswer]:
    """One for each gap; each keeps what it promises by itself."""
    answers = []
    for gap in GAPS:
        request = {**body, "accuracy": {"relative_gap": gap}}
        answer = optimized(request)
        answers.append(answer)
        certificate = answer.certificate
        if certificate is None:
            continue
        rest = certificate.objective_without_counterweights
        text = json.dumps(request)
        assert abs(certificate.gap - (certificate.objective - certificate.lower_bound)) <= 1e-15 * rest, text
        if rest > 0:
            assert abs(certificate.relative_gap - certificate.gap / rest) <= 1e-15, text
        reached = certificate.relative_gap <= gap and (certificate.mass_relative_gap or 0.0) <= 1e-4
        assert answer.status == ("optimal" if reached else "inaccurate") or body["objective"].keys() & _CEILINGS, text
        faults = [
            fault for fault in judge(Case("gap", "", request), answer, None).faults if "certified gap" not in fault
        ]
        assert not faults, "\n".join([*faults, text])
    return answers


_CEILINGS = {"force_ceiling_N", "moment_ceiling_Nm"}


def _consistent(body: Body, answers: list[OptimizeAnswer]) -> None:
    """No bound is above the objective of another, and no objective further above it than both gaps say."""
    proofs = [answer.certificate for answer in answers]
    assert len({proof is None for proof in proofs}) == 1, json.dumps(body)
    for certificate in proofs:
        for second_proof in proofs:
            if certificate is not None and second_proof is not None and not body["objective"].keys() & _CEILINGS:
                slack = 1e-13 * certificate.objective_without_counterweights
                assert certificate.lower_bound <= second_proof.objective + slack, json.dumps(body)


@search(24)
@given(st.integers(0, 10**9), _OBJECTIVES)
def test_machines_of_everyday_reach_every_gap(seed: int, objective: dict[str, Any]) -> None:
    """Optimal at 1e-2, 1e-6 and 1e-10: whatever is asked is reached, and proven."""
    body: Body = {"machine": random_machine(seed), "objective": objective}
    answers = _answers(body)
    _consistent(body, answers)
    for gap, answer in zip(GAPS, answers, strict=True):
        assert answer.certificate is not None
        assert answer.status == "optimal", (gap, answer.certificate, json.dumps(body))
        assert answer.certificate.relative_gap <= gap, (gap, answer.certificate, json.dumps(body))


@search(15)
@given(requests())
def test_wild_machines_say_what_was_reached(body: Body) -> None:
    """Whatever the machine: a status that follows from the certificate, and bounds that hold for all three."""
    answers = _answers(body)
    _consistent(body, answers)
