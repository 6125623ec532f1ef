"""What each peak comes to at least by itself, where cases or cuts prove it: what is falsified is caught.

Independent: the checker shares no code with what computed the answers.
"""

import copy
import json
from functools import cache
from typing import Any

import pytest

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from tests.night import part
from tests.optimize.machines import machine, row, throw
from tests.optimize.shafts import shaft
from tests.pairs.asking import body_of
from tests.pairs.machines import at_rest
from tests.verification.checking import broken, is_broken, verdict

_SHARE = 0.2
#: of a component, which counterweights can all but cancel in one case
_LITTLE = 1e-4
#: features, the ceiling that is out of reach, and whether every claim is covered
_KINDS: dict[str, tuple[tuple[str, ...], str, bool]] = {
    "tolerances": (("tolerances of masses and angles",), "force_ceiling_N", True),
    "scenarios": (("scenario of masses", "tolerances of masses and angles"), "moment_ceiling_Nm", True),
    "masses off": (("tolerances of rows",), "force_ceiling_N", True),
    "all orders": (("orders all",), "force_ceiling_N", True),
    "a component, masses off": (("tolerances of rows",), "force_ceiling_x_N", True),
    "a component of all orders": (("orders all",), "force_ceiling_x_N", True),
    "a component, scenarios": (("scenario of masses",), "force_ceiling_x_N", True),
    "bearings": ((), "bearing_ceiling_N", True),
    "specific loads": (("balance shaft forwards",), "specific_load_ceiling_Pa", True),
    "bending, a component": (("force_ceiling_x_N slack",), "bending_ceiling_Nm", True),
}


@cache
def _exchange(kind: str) -> tuple[dict[str, Any], dict[str, Any]]:
    features, field, _ = _KINDS[kind]
    body = body_of("twin", features)
    assert body is not None
    body.setdefault("objective", {})[field] = (_LITTLE if "_x_" in field or "_y_" in field else _SHARE) * at_rest(
        "twin"
    )[field]
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    assert answer["status"] == "infeasible"
    return body, answer


@pytest.mark.parametrize("kind", part(3, [*_KINDS]))
def test_what_is_smallest_is_held(kind: str) -> None:
    body, answer = _exchange(kind)
    assert not broken(body, answer)
    assert verdict(body, answer) == ("held" if _KINDS[kind][2] else "not covered")


@pytest.mark.parametrize("kind", part(3, [*_KINDS]))
def test_a_false_figure_is_broken(kind: str) -> None:
    """Every figure by a thousandth, either way where a bound may not be lower; a bound is not raised."""
    body, answer = _exchange(kind)
    why = answer["infeasibility"]
    places: list[tuple[list[Any], float]] = [
        *(([f"smallest_{name}"], factor) for name in ("force_N", "moment_Nm") for factor in (0.999, 1.001)),
        *(([f"smallest_{name}"], 1.001) for name in ("force_lower_bound_N", "moment_lower_bound_Nm")),
        *(
            (["smallest", k, field], factor)
            for k, _ in enumerate(why["smallest"])
            for field in ("smallest", "ceiling")
            for factor in (0.999, 1.001)
        ),
        *((["smallest", k, "lower_bound"], 1.001) for k, _ in enumerate(why["smallest"])),
    ]
    for place, factor in places:
        wrong = copy.deepcopy(answer)
        part: Any = wrong["infeasibility"]
        for key in place[:-1]:
            part = part[key]
        # what rounding leaves of nothing may be any number
        if part[place[-1]] > 1e-3:
            part[place[-1]] *= factor
            assert is_broken(body, wrong), (place, factor)


@pytest.mark.parametrize("kind", ["bearings", "all orders"])
def test_no_ceiling_proves_what_a_peak_comes_to_by_itself(kind: str) -> None:
    """Multipliers of the conflict beside those of the peak prove no more of it."""
    body, answer = _exchange(kind)
    wrong = copy.deepcopy(answer)
    why = wrong["infeasibility"]
    entry = why["smallest"][0]
    entry["multipliers"]["ceilings"] = [
        {**ceiling, "x": 1e9 * ceiling["x"], "y": 1e9 * ceiling["y"]}
        for ceiling in why["multipliers"]["conflict"]["ceilings"]
    ]
    assert entry["multipliers"]["ceilings"]
    entry["lower_bound"] *= 1.001
    entry["smallest"] *= 1.001
    assert is_broken(body, wrong)


def test_a_ceiling_that_nobody_stated_is_broken() -> None:
    body, answer = _exchange("bearings")
    wrong = copy.deepcopy(answer)
    wrong["infeasibility"]["smallest"][0]["ceiling_field"] = "specific_load_ceiling_Pa"
    assert is_broken(body, wrong)


@pytest.mark.parametrize("kind", ["bearings", "all orders"])
def test_no_ceiling_in_conflict_is_left_out(kind: str) -> None:
    body, answer = _exchange(kind)
    wrong = copy.deepcopy(answer)
    wrong["infeasibility"]["smallest"] = []
    assert is_broken(body, wrong)


def test_nothing_is_reached_below_what_is_proven() -> None:
    """A printed bound that is lower than what its multipliers prove hides no value below that."""
    body, answer = _exchange("bearings")
    wrong = copy.deepcopy(answer)
    for field in ("smallest", "lower_bound"):
        wrong["infeasibility"]["smallest"][0][field] *= 0.99
    assert is_broken(body, wrong)


def test_a_plate_that_could_carry_far_too_much_breaks_no_bound() -> None:
    """Regression: what multipliers round off, times all that such a plate holds, was more than the bound bears."""
    plate = {"shape": "segment", "outer_radius_m": 500.0, "thickness_m": 0.5}
    balancer = {**shaft("back", -1), "webs": [{"name": "back", "position_m": 0.1, "envelope": plate}]}
    throws = [throw(0.0, 20.0, [row(90.0, 10.0)], rotating=3.0), throw(0.3, 91.3, [row(31.0, 7.7)], rotating=3.0)]
    machine_fields = machine(throws, [], balance_shafts=[balancer])
    body = {"machine": machine_fields, "objective": {"force_ceiling_x_N": 1.0, "force_ceiling_y_N": 1.0}}
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    assert answer["status"] == "infeasible"
    assert not broken(body, answer)
    lowest = answer["infeasibility"]["smallest_force_lower_bound_N"]
    answer["infeasibility"]["smallest_force_lower_bound_N"] = lowest * (1.0 + 1e-6)
    assert is_broken(body, answer)
