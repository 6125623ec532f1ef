"""The benchmark's cases run once on every change; times are for `make bench`."""

from collections.abc import Callable

import pytest

from optimizer.optimize import optimize
from schemas.requests import OptimizeRequest
from tests.benchmarks.cases import CASES
from tests.benchmarks.phases import PHASES, measure


@pytest.mark.parametrize("build", CASES.values(), ids=CASES)
def test_every_case_is_certified(build: Callable[[], bytes]) -> None:
    found = optimize(OptimizeRequest.model_validate_json(build()))
    assert found.status == "optimal"


def test_phases_add_up() -> None:
    times = measure(next(iter(CASES.values()))())
    assert set(times) == set(PHASES)
    parts = sum(value for name, value in times.items() if name != "total")
    assert 0 < parts <= times["total"]
