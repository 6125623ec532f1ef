"""Genuine answers of machines of extreme scales: rounding of what cancels breaks no claim."""

import json

import pytest

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.verification import checker
from tests.hard.bodies import drawn


@pytest.mark.parametrize(
    ("mode", "number", "claim"),
    [
        # weights of 8e19 N that leave 2e14 N, and of 1e-6 N that leave 5e-9 N
        ("balance shafts", 191, "cuts"),
        ("balance shafts", 261, "cuts"),
        # a minimum of 9e-44 kg beside a budget of 35 t, whose least price of 1e-30 would cost 3e-26 kg
        ("plates", 267, "mass_lower_bound"),
    ],
)
def test_what_cancels_is_judged_by_its_parts(mode: str, number: int, claim: str) -> None:
    sent = drawn(number, 77, mode)
    assert sent is not None
    answer = optimize(OptimizeRequest.model_validate(sent))
    found = {
        one["claim"]: one["verdict"]
        for one in checker().verify(json.loads(json.dumps(sent)), json.loads(answer.model_dump_json()))["claims"]
    }
    assert found[claim] == "held"
    assert "broken" not in found.values()
