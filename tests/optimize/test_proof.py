"""The multipliers of an answer prove its bounds: each is evaluated again from request and answer alone."""

import json
from pathlib import Path
from typing import Any

import pytest

from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from tests.night import part
from tests.optimize import by_hand
from tests.optimize.machines import machine, random_machine, row, throw, web
from tests.verification.checking import optimized

#: by hand the proofs are those of the crankshaft alone, of counterweights of any mass at known radii
EXAMPLES = sorted(
    path
    for path in (Path(__file__).parents[2] / "examples").glob("*.json")
    if "balance_shafts" not in json.loads(path.read_text())["machine"]
    and path.stem not in ("catalogue-twin", "plate-single")
)
#: how far the printed bound may lie below the exact one, relative
CLOSE = 1e-9
#: of a machine that balances itself: what the bound is in newtons where the sums of the service are exactly 0
NOTHING = 1e-11
OBJECTIVES: dict[str, dict[str, Any]] = {
    "sum": {},
    "max": {"combine": "max"},
    "direction weights": {"direction_weights": {"x": 1, "y": 0.25}},
    "one direction, max": {"combine": "max", "direction_weights": {"x": 0, "y": 1}},
    "force alone": {"moment_weight": 0},
    "moment alone": {"force_weight": 0},
    "any optimum": {"least_mass": False},
}


def proven(body: dict[str, Any]) -> OptimizeAnswer:
    """The answer to a body, each of its bounds recomputed in 60 digits (independent)."""
    request = OptimizeRequest.model_validate(body)
    answer = optimized(body)
    recomputed = by_hand.of_answer(json.loads(request.model_dump_json()), json.loads(answer.model_dump_json()))
    assert len(recomputed) == (3 if answer.status == "infeasible" else 1 + request.objective.least_mass)
    for name, (exact, printed) in recomputed.items():
        if name == "conflict":
            assert exact > 0
        else:
            assert 0 <= exact - printed <= CLOSE * abs(printed) + tolerated(answer, name) + NOTHING, name
    return answer


def tolerated(answer: OptimizeAnswer, name: str) -> float:
    """By what a bound is lower that holds for all that counts as keeping the ceilings: 1e-9 of their size, priced."""
    if answer.certificate is None:
        return 0.0
    multipliers = answer.certificate.multipliers
    before = answer.residual.before
    size = {"force": before.force.peak_N, "moment": before.moment.peak_Nm}
    proof = multipliers.objective if name == "objective" else multipliers.mass
    assert proof is not None
    return 2e-9 * sum(abs(complex(ceiling.x, ceiling.y)) * size[ceiling.response] for ceiling in proof.ceilings)


def peaks(answer: OptimizeAnswer) -> tuple[float, float]:
    assert answer.residual.after is not None
    return answer.residual.after.force.peak_N, answer.residual.after.moment.peak_Nm


@pytest.mark.parametrize("objective", OBJECTIVES.values(), ids=OBJECTIVES)
@pytest.mark.parametrize("path", part(2, EXAMPLES), ids=lambda path: path.stem)
def test_every_example_carries_the_proof_of_its_bounds(path: Path, objective: dict[str, Any]) -> None:
    body = json.loads(path.read_text())["machine"]
    assert proven({"machine": body, "objective": objective}).status == "optimal"


@pytest.mark.parametrize("seed", range(12))
def test_machines_with_sectors_budgets_and_ceilings_carry_the_proof_of_their_bounds(seed: int) -> None:
    """Sectors, budgets and unused limits as they come; ceilings a little above and far below what is reached."""
    body, combine = random_machine(seed), ("sum", "max")[seed % 2]
    objective = {"combine": combine, "direction_weights": {"x": 1, "y": (1, 0.3)[seed // 2 % 2]}}
    free = proven({"machine": body, "objective": objective})
    force, moment = peaks(free)
    fields = {"force_ceiling_N": 1.02 * force + 1, "moment_ceiling_Nm": 1.1 * moment + 1}
    proven({"machine": body, "objective": objective | fields})
    broken = {"force_ceiling_N": 0.3 * force, "moment_ceiling_Nm": 0.3 * moment}
    proven({"machine": body, "objective": objective | broken})


def test_a_budget_that_binds_has_the_price_of_its_last_kilogram() -> None:
    """Analytic: 20 kg at 0.1 m turn at 10 rad/s; the budget pays 8 kg at 0.2 m, 20 N each."""
    body = machine(
        [throw(0.0, 0.0, [], radius=0.1, rotating=20.0)],
        [web("far", 0.0, 5.0, radius=0.2), web("near", 0.0, 1e15, radius=0.1)],
        speed_rpm=95.49296585513721,
        max_total_mass_kg=8.0,
    )
    answer = proven({"machine": body, "objective": {"least_mass": False}})
    assert answer.certificate is not None
    assert answer.certificate.multipliers.objective.budget == pytest.approx(10.0)
    assert answer.certificate.objective == pytest.approx(200 - 5 * 20 - 3 * 10)


def test_a_ceiling_that_binds_has_a_price_and_one_that_does_not_has_none() -> None:
    body = machine([throw(-0.2, 0.0, [row(0.0, 20.0)]), throw(0.2, 90.0, [row(0.0, 30.0)])], [web("a", 0.1)])
    goal = {"force_weight": 0.01}
    force, moment = peaks(proven({"machine": body, "objective": goal}))
    goal |= {"force_ceiling_N": 0.97 * force, "moment_ceiling_Nm": 9 * moment}
    tight = proven({"machine": body, "objective": goal})
    assert tight.certificate is not None
    of_force, of_moment = tight.certificate.multipliers.objective.ceilings
    assert (of_force.response, of_moment.response) == ("force", "moment")
    assert abs(complex(of_force.x, of_force.y)) > 0.1
    assert abs(complex(of_moment.x, of_moment.y)) < 1e-6


def test_a_ceiling_below_the_floor_is_a_conflict_whatever_the_vectors() -> None:
    """Where the ceiling is below the counter-rotating phasor no direction proves it, but the row does."""
    answer = proven(
        {"machine": machine([throw(0, 0, [row(0, 20.0)])], [web("a", 0)]), "objective": {"force_ceiling_N": 1}}
    )
    assert answer.infeasibility is not None
    (force,) = answer.infeasibility.multipliers.conflict.rows
    assert force.name == "force"
    assert force.value > 0


@pytest.mark.parametrize("webs", [[], [web("a", 0.0, 0.0)]], ids=["no webs", "a web that carries nothing"])
def test_an_answer_with_nothing_to_choose_carries_its_proof(webs: list[dict[str, Any]]) -> None:
    body = machine([throw(0.0, 30.0, [row(0.0, 20.0)])], webs)
    answer = proven({"machine": body})
    assert answer.certificate is not None
    assert answer.certificate.multipliers.mass is not None
    assert {row.value for row in answer.certificate.multipliers.mass.rows} == {0.0}
