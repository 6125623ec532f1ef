"""What is long: by its kind, and by the size of what it is about."""

import json
from typing import Any

import pytest

from service.common.validation import check
from service.computations.computation import XLSX
from service.computations.table import COMPUTATIONS
from service.documents.examples import bodies
from service.fairness.length import long_by_size
from tests.network.bystander import TORQUE, largest

#: legal, and long: megabytes of torque
SAMPLED = json.dumps(
    {**json.loads(TORQUE), "angles": {"step_deg": 0.01}, "outputs": ["torque", "internal_moment"]}
).encode()


@pytest.mark.parametrize(
    ("name", "long"),
    [
        ("pareto", True),
        ("accuracy", True),
        ("verify", True),
        ("optimize", False),
        ("analyze", False),
        ("rating", False),
    ],
)
def test_some_kinds_are_long(name: str, long: bool) -> None:
    computation = COMPUTATIONS[name]
    assert computation.long_by_kind(computation.forms[0], workbook=False) is long
    assert computation.long_by_kind(computation.forms[0], workbook=True)
    for form in computation.forms:
        assert computation.long_by_kind(form, workbook=False) is (long or form.media_type == XLSX)


def report(throws: int, versions: int = 0) -> dict[str, Any]:
    """A document on a machine of so many throws, compared with itself."""
    return {**json.loads(largest(throws)), "versions": [{"name": str(k)} for k in range(versions)]}


@pytest.mark.parametrize(
    ("name", "body", "long"),
    [
        ("report", report(50), False),
        ("report", report(51), True),
        ("report", report(25, 1), False),
        ("report", report(25, 2), True),
        ("picture_bearings", json.loads(largest(51)), True),
        # its optimum takes hundredths of a second
        ("optimize", json.loads(largest(500)), False),
        ("analyze", json.loads(TORQUE), False),
        ("analyze", json.loads(SAMPLED), True),
        ("analyze", {**json.loads(SAMPLED), "outputs": ["residual"]}, False),
        ("pin_loads", next(iter(bodies("pin-loads").values())), False),
    ],
)
def test_large_ones_are_long(name: str, body: dict[str, Any], long: bool) -> None:
    computation = COMPUTATIONS[name]
    assert long_by_size(check(computation.request_model, body), computation.answer is None) is long
