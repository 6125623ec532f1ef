"""The multipliers of a front prove its corners, its masses and its ends, evaluated again from request and answer."""

import json
from pathlib import Path
from typing import Any

import pytest

from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoRequest
from tests.night import part
from tests.optimize import by_hand
from tests.optimize.machines import random_machine

EXAMPLES = Path(__file__).parents[3] / "examples"
#: a corner is lowered to the peaks of its point where it is above one of them: at an end by the slack that is left
CLOSE = 1e-6
OBJECTIVES: dict[str, dict[str, Any]] = {
    "plain": {},
    "direction weights": {"direction_weights": {"x": 1, "y": 0.3}},
    "any optimum": {"least_mass": False},
}


def proven(body: dict[str, Any]) -> list[dict[str, Any]]:
    """The fronts of a body, each of their bounds recomputed in 60 digits (independent)."""
    request = ParetoRequest.model_validate({**body, "multipliers": True})
    answer = json.loads(pareto(request).model_dump_json())
    filled = json.loads(request.model_dump_json())
    for front in answer["fronts"]:
        recomputed = by_hand.of_front(filled, front, answer["reference_plane_m"])
        assert len(recomputed) == 2 + len(front["points"]) * (1 + request.objective.least_mass)
        for name, (exact, printed) in recomputed.items():
            assert 0 <= exact - printed <= CLOSE * abs(printed), name
    fronts: list[dict[str, Any]] = answer["fronts"]
    return fronts


@pytest.mark.parametrize("objective", OBJECTIVES.values(), ids=OBJECTIVES)
@pytest.mark.parametrize("name", ["2d12", "v90-equal", "scroll-oldham"])
def test_every_point_of_an_example_carries_its_proof(name: str, objective: dict[str, Any]) -> None:
    body = json.loads((EXAMPLES / f"{name}.json").read_text())["machine"]
    assert {front["status"] for front in proven({"machine": body, "objective": objective, "points": 4})} == {"optimal"}


@pytest.mark.parametrize("seed", part(2, range(3)))
def test_points_under_budgets_and_ceilings_carry_their_proofs(seed: int) -> None:
    body = random_machine(seed)
    free = proven({"machine": body, "points": 3, "total_mass_budgets_kg": [12.0, 60.0]})
    highest = max(point["force_peak_N"] for front in free for point in front["points"])
    lowest = max(front["ends"]["smallest_force_N"] for front in free)
    goal = {"force_ceiling_N": 0.5 * (lowest + highest) + 1.0}
    proven({"machine": body, "objective": goal, "points": 3, "total_mass_budgets_kg": [12.0, 60.0]})


def test_a_front_shows_its_multipliers_only_if_asked() -> None:
    body = json.loads((EXAMPLES / "2d12.json").read_text())["machine"]
    (front,) = pareto(ParetoRequest.model_validate({"machine": body, "points": 2})).fronts
    assert {point.multipliers for point in front.points} == {None}
    assert front.ends is not None
    assert front.ends.multipliers is None
