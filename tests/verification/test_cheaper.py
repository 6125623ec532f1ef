"""Cheaper choices beside balance shafts, over a revolution and in several cases: each is checked as the best one is."""

import json
from functools import cache
from typing import Any

import pytest

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.verification import checker
from tests.optimize.shafts import shaft, single
from tests.optimize.test_alternatives import small
from tests.verification.checking import is_broken
from tests.verification.falsified import replaced

_BESIDE = single([shaft("back", -1, 0.3, 4.0)], catalogue={"masses_kg": [1.0, 2.0, 3.5], "angle_step_deg": 45})
_ACCURACY = {"relative_gap": 1e-3, "time_limit_s": 4.0}
_REQUESTS: dict[str, dict[str, Any]] = {
    "shafts": {"machine": _BESIDE, "alternatives": [0.1, 0.5]},
    "shafts, all orders": {"machine": _BESIDE, "objective": {"orders": "all"}, "alternatives": [0.5]},
    "cases": {
        "machine": small(),
        "alternatives": [0.1, 0.5],
        "scenarios": [{"name": "slow", "changes": [{"path": "/machine/speed_rpm", "value": 100.0}]}],
        "tolerances": {"unbalance_kg_m": 0.01},
    },
}


@cache
def _text(name: str) -> str:
    request = OptimizeRequest.model_validate({**_REQUESTS[name], "accuracy": _ACCURACY})
    return optimize(request).model_dump_json()


def _pair(name: str) -> tuple[Any, Any]:
    return json.loads(json.dumps({**_REQUESTS[name], "accuracy": _ACCURACY})), json.loads(_text(name))


@pytest.mark.parametrize("name", _REQUESTS)
def test_all_but_the_search_is_held(name: str) -> None:
    request, answer = _pair(name)
    assert answer["alternatives"]
    verdict = checker().verify(request, answer)
    assert verdict["verdict"] != "broken"
    left = [where for where in verdict["not_covered"] if "/alternatives" in where]
    assert all(where.endswith("lower_bound") for where in left), left


@pytest.mark.parametrize("name", _REQUESTS)
def test_what_is_falsified_is_broken(name: str) -> None:
    request, answer = _pair(name)
    first = ("alternatives", 0)
    alternative = answer["alternatives"][0]
    for field in ("objective", "total_mass_kg", "pieces", "sizes"):
        assert is_broken(request, replaced(answer, (*first, field), alternative[field] * 1.001 + 1e-9)), field
    bound = alternative["lower_bound"]
    assert bound is None or is_broken(request, replaced(answer, (*first, "lower_bound"), 1.001 * bound + 1e-3))
    shafts = alternative["balance_shafts"]
    if shafts:
        where = (*first, "balance_shafts", 0, "counterweights", 0, "mass_kg")
        assert is_broken(request, replaced(answer, where, 0.5 + shafts[0]["counterweights"][0]["mass_kg"]))
