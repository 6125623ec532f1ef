"""Regression: every claim of answers of every kind, and of others made up of them, as wide as it was."""

import math

import pytest

from tests.night import ALL, part
from tests.verification.recorded import Line, judgement, records, submissions

#: a claim may be so much wider or narrower: other machines round their sines in another way
_CLOSE = 0.004


@pytest.mark.parametrize(("number", "name"), part(2, enumerate(records()), rows=True), ids=[*records()])
def test_claims_are_as_wide_as_they_were(number: int, name: str) -> None:
    record = records()[name]
    # of an answer and what is made up of it by day one, of the next that is tried by day the next; at night and under
    # mutants all
    actual_submissions = submissions(name, record["request"], record["answer"])
    for place, (actual_submission, recorded) in enumerate(zip(actual_submissions, record["judgements"], strict=True)):
        if not ALL and place != number // 2 % len(actual_submissions):
            continue
        verdict = judgement(*actual_submission)
        differ = [pair for pair in zip(verdict["claims"], recorded["claims"], strict=False) if not _alike(*pair)]
        assert not differ, differ[:4]
        assert verdict["whole"] == recorded["whole"]
        assert len(verdict["claims"]) == len(recorded["claims"])


def _alike(first: Line, second: Line) -> bool:
    return first[:2] == second[:2] and all(
        (a is None) == (b is None) and (a is None or math.isclose(a, b, rel_tol=_CLOSE, abs_tol=1e-300))
        for a, b in zip(first[2:], second[2:], strict=True)
    )
