"""Regression: every claim of answers of every kind, as wide as it was, and the verdicts on them."""

import math

import pytest

from tests.verification.recorded import Line, judgement, records

#: a claim may be so much wider or narrower: other machines round their sines in another way
_CLOSE = 0.004


@pytest.mark.parametrize("name", records())
def test_claims_are_as_wide_as_they_were(name: str) -> None:
    record = records()[name]
    found = judgement(record["request"], record["answer"])
    assert found["whole"] == record["whole"]
    differ = [pair for pair in zip(found["claims"], record["claims"], strict=True) if not _alike(*pair)]
    assert not differ, differ[:4]


def _alike(one: Line, other: Line) -> bool:
    return one[:2] == other[:2] and all(
        (a is None) == (b is None) and (a is None or math.isclose(a, b, rel_tol=_CLOSE, abs_tol=1e-300))
        for a, b in zip(one[2:], other[2:], strict=True)
    )
