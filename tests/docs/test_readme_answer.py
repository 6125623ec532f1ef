"""The answer that the README shows is the one that its machine gets (regression: it is printed there)."""

import json
import math
import re
from collections.abc import Iterator
from typing import Any

import pytest

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from tests.docs.reading import ROOT


def _leaves(subject: Any, answer: Any, place: str = "") -> Iterator[tuple[str, Any, Any]]:
    """What is shown, beside what is answered there; a shortened answer leaves fields out, but no entries."""
    if isinstance(subject, dict):
        for name, value in subject.items():
            yield from _leaves(value, answer[name], f"{place}/{name}")
    elif isinstance(subject, list):
        assert len(subject) == len(answer), place
        for k, (value, number) in enumerate(zip(subject, answer, strict=True)):
            yield from _leaves(value, number, f"{place}/{k}")
    else:
        yield place, subject, answer


def test_the_answer_shown_is_that_of_today() -> None:
    blocks = re.findall(r"```json\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    section = next(block for block in map(json.loads, blocks) if "counterweights" in block)
    request = OptimizeRequest.model_validate_json((ROOT / "examples" / "2d12.json").read_text())
    answer = json.loads(optimize(request).model_dump_json())
    leaves = list(_leaves(section, answer))
    assert len(leaves) > 30
    for place, figure, today in leaves:
        if place.endswith("relative_gap"):
            # what rounding leaves of a gap, which differs by machine: of the same size, and within what is asked
            assert abs(math.log10(figure / today)) < 2 or max(figure, today) < 1e-8, place
        elif isinstance(figure, float):
            decimals = len(str(figure).partition(".")[2])
            assert today == pytest.approx(figure, abs=0.51 * 10.0**-decimals), place
        else:
            assert today == figure, place
