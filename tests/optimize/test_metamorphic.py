"""One machine asked about in two ways: what may change in the answer, and by how much.

An optimum may lie above the smallest objective by 1e-6 of the yardstick, and both answers are at most so far above it.
So two answers to the same question differ by that much in the objective, and neither bound may be above the value of
the other answer. The pair of proofs must hold for both. The least mass is told to 1e-4 of itself in either.
"""

import copy
import json
import random
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from schemas.answer.answers import Certificate, OptimizeAnswer
from tests import night
from tests.optimize.machines import machine, random_machine, row, throw, web
from tests.verification.checking import optimized

#: what is chosen from a catalogue or cut from a plate has no halves
EXAMPLES = {
    path.stem: json.loads(path.read_text())["machine"]
    for path in sorted((Path(__file__).parents[2] / "examples").glob("*.json"))
    if path.stem not in ("catalogue-twin", "plate-single")
}
SEEDS = st.integers(0, 10**6)
OBJECTIVES = st.sampled_from([{"combine": "sum"}, {"combine": "max"}, {"direction_weights": {"x": 1, "y": 0.4}}])
#: share of the yardstick by which an answer counts as an optimum
SHARE = 1e-6
#: rounding of figures that are recomputed in double precision, relative
ROUNDING = 1e-12


def answer(body: dict[str, Any], objective: dict[str, Any] | None = None) -> OptimizeAnswer:
    return optimized({"machine": body, "objective": objective or {}})


def proof(optimum: OptimizeAnswer) -> Certificate:
    assert optimum.status == "optimal"
    assert optimum.certificate is not None
    return optimum.certificate


def agree(first_answer: OptimizeAnswer, second_answer: OptimizeAnswer) -> None:
    """Two answers to the same question: the values within the share, each proof good for both, the same mass."""
    rest = proof(first_answer).objective_without_counterweights
    assert proof(second_answer).objective_without_counterweights == pytest.approx(rest, rel=ROUNDING, abs=1e-9)
    slack = ROUNDING * rest + 1e-9
    for first, second in ((proof(first_answer), proof(second_answer)), (proof(second_answer), proof(first_answer))):
        assert first.lower_bound is not None
        assert first.lower_bound <= second.objective + slack
        assert first.objective <= second.objective + 1.01 * SHARE * rest + slack
    assert first_answer.total_mass_kg == pytest.approx(second_answer.total_mass_kg, rel=1e-4, abs=1e-9)


def with_webs(body: dict[str, Any], webs: list[dict[str, Any]]) -> dict[str, Any]:
    return {**copy.deepcopy(body), "webs": webs}


def clipped(body: dict[str, Any]) -> dict[str, Any]:
    """Every max_mass_kg no larger than the budget."""
    budget = body["max_total_mass_kg"]
    return with_webs(body, [{**plane, "max_mass_kg": min(plane["max_mass_kg"], budget)} for plane in body["webs"]])


def halved(body: dict[str, Any]) -> dict[str, Any]:
    """Every web as two halves in the same place, each with half the limit."""
    halves = []
    for plane in body["webs"]:
        for part in ("left", "right"):
            name = f"{plane['name']} {part}"
            halves.append({**plane, "name": name, "max_mass_kg": 0.5 * plane["max_mass_kg"]})
    return with_webs(body, halves)


# ---- limits that say the same


@given(SEEDS, OBJECTIVES, st.floats(1.0, 60.0))
def test_a_limit_above_the_budget_is_the_budget(seed: int, objective: dict[str, Any], budget: float) -> None:
    """The same sets of counterweights: values within 1e-6 of the yardstick, the mass within 1e-4 of itself."""
    body = {**random_machine(seed), "max_total_mass_kg": budget}
    agree(answer(body, objective), answer(clipped(body), objective))


@pytest.mark.parametrize("exponent", [3, 6, 9, 12, 15])
@pytest.mark.parametrize("seed", range(3))
def test_a_limit_far_above_the_budget_is_the_budget(seed: int, exponent: int) -> None:
    """However far: 1e3 to 1e15 kg beside a budget of a few kilograms change no more than rounding may."""
    rng = random.Random(seed)
    body = {**random_machine(seed), "max_total_mass_kg": rng.uniform(1.0, 20.0)}
    body["webs"][rng.randrange(len(body["webs"]))]["max_mass_kg"] = 10.0**exponent
    agree(answer(body), answer(clipped(body)))


def test_a_budget_beside_a_limit_of_1e15_kg_is_not_proven_wrong() -> None:
    """By hand: 10 N of unbalance; 0.32 kg take 2 N each, the other 0.68 kg 1 N each, which leaves 8.68 N."""
    body = machine(
        [throw(0.0, 0.0, [], radius=1.0, rotating=10.0)],
        [web("A", 0.0, 0.32, radius=2.0), web("B", 0.0, 1e15, radius=1.0)],
        speed_rpm=9.549296585513721,
        max_total_mass_kg=1.0,
    )
    for payload in (body, clipped(body)):
        certificate = proof(answer(payload, {"least_mass": False}))
        assert certificate.objective == pytest.approx(8.68, rel=2 * SHARE)
        assert certificate.lower_bound is not None
        assert certificate.lower_bound <= 8.68 * (1 + ROUNDING)


# ---- places that say the same


@given(SEEDS, OBJECTIVES)
def test_a_web_in_two_halves(seed: int, objective: dict[str, Any]) -> None:
    """Two halves reach what the whole reaches, with the same mass: values within 1e-6, the mass within 1e-4."""
    body = random_machine(seed)
    agree(answer(body, objective), answer(halved(body), objective))


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_examples_in_halves_and_with_limits_clipped(name: str) -> None:
    """As above, for the machines that everybody looks at."""
    body = EXAMPLES[name]
    whole = answer(body)
    if len(body["webs"]) <= 8:
        agree(whole, answer(halved(body)))
    if body.get("balance_shafts"):
        # their total has no limit
        return
    tight = {**body, "max_total_mass_kg": max(0.5 * (whole.total_mass_kg or 0.0), 1.0)}
    agree(answer(tight), answer(clipped(tight)))


@given(SEEDS, OBJECTIVES, st.integers(0, 10))
def test_a_web_that_may_carry_nothing_changes_nothing(seed: int, objective: dict[str, Any], place: int) -> None:
    """Counterweights, bounds and multipliers to the last bit: it is no part of the program.

    It lies within the span, so that no default changes. The value is a sum over more webs,
    and may be rounded otherwise.
    """
    body = random_machine(seed)
    position = body["throws"][0]["position_m"]
    idle, webs = web("idle", position, 0.0), list(body["webs"])
    webs.insert(place % (len(webs) + 1), idle)
    without, more = answer(body, objective), answer(with_webs(body, webs), objective)
    certificate, second_proof = proof(without), proof(more)
    assert second_proof.multipliers == certificate.multipliers
    assert second_proof.mass_lower_bound_kg == certificate.mass_lower_bound_kg
    assert second_proof.objective == pytest.approx(certificate.objective, rel=ROUNDING)
    # where the value is the bound, the bound that is printed follows it
    assert second_proof.lower_bound == pytest.approx(certificate.lower_bound, rel=ROUNDING)
    assert [counterweight for counterweight in more.counterweights if counterweight.web != "idle"] == list(
        without.counterweights
    )
    assert next(counterweight.mass_kg for counterweight in more.counterweights if counterweight.web == "idle") == 0.0


def test_a_web_whose_sector_points_the_wrong_way_changes_nothing_but_rounding() -> None:
    """One plane, all webs on the side of the unbalance: the best is to leave them empty, with or without the second."""
    load = [throw(0.0, 0.0, [row(0.0, 20.0)], rotating=5.0)]
    opposite, towards = {"centre_deg": 180.0, "half_angle_deg": 60.0}, {"centre_deg": 0.0, "half_angle_deg": 60.0}
    useful, useless = web("useful", 0.0, 9.0, sector=opposite), web("useless", 0.0, 1e3, sector=towards)
    alone, both = answer(machine(load, [useful])), answer(machine(load, [useful, useless]))
    agree(alone, both)
    assert both.counterweights[1].mass_kg == 0.0


@given(SEEDS, OBJECTIVES, st.randoms(use_true_random=False))
def test_the_order_of_the_webs(seed: int, objective: dict[str, Any], rng: random.Random) -> None:
    """Values within 1e-6 and the mass within 1e-4; equally light counterweights may sit on other webs."""
    body = random_machine(seed)
    webs = list(body["webs"])
    rng.shuffle(webs)
    agree(answer(body, objective), answer(with_webs(body, webs), objective))


# ---- units


def scaled(body: dict[str, Any], mass: float, length: float, speed: float) -> dict[str, Any]:
    """Every mass, length and the speed times a factor."""
    factors = {"mass_kg": mass, "_m": length, "_rpm": speed}

    def of(name: str, value: Any) -> Any:
        if isinstance(value, dict):
            return {key: of(key, value) for key, value in value.items()}
        if isinstance(value, list):
            return [of(name, value) for value in value]
        if isinstance(value, int | float):
            for suffix, factor in factors.items():
                if name.endswith(suffix):
                    return value * factor
        return value

    return {key: of(key, value) for key, value in body.items()}


@given(SEEDS, OBJECTIVES, st.integers(-20, 20), st.integers(-10, 10), st.integers(-10, 10))
def test_units_by_powers_of_two(seed: int, objective: dict[str, Any], mass: int, length: int, speed: int) -> None:
    """To the last bit: masses, angles, values, bounds, multipliers; only the exponents of two change."""
    body = random_machine(seed)
    body["reference_plane_m"] = None
    mass_factor, length_factor, speed_factor = 2.0**mass, 2.0**length, 2.0**speed
    first_answer = answer(body, objective)
    second_answer = answer(scaled(body, mass_factor, length_factor, speed_factor), objective)
    force = mass_factor * length_factor * speed_factor**2
    assert first_answer.total_mass_kg is not None
    assert second_answer.total_mass_kg == first_answer.total_mass_kg * mass_factor
    for first, second in zip(first_answer.counterweights, second_answer.counterweights, strict=True):
        assert (second.mass_kg, second.angle_deg) == (first.mass_kg * mass_factor, first.angle_deg)
    before, after = proof(first_answer), proof(second_answer)
    assert after.objective == before.objective * force
    assert before.lower_bound is not None
    assert after.lower_bound == before.lower_bound * force
    assert after.relative_gap == before.relative_gap


# ---- ceilings a little higher and lower


def ceilings_between(body: dict[str, Any], share: float) -> dict[str, Any]:
    """Ceilings between what the optimum reaches and what each peak can reach at best."""
    best, goal = answer(body), {"least_mass": False}
    assert best.residual.after is not None
    force, moment = best.residual.after.force.peak_N, best.residual.after.moment.peak_Nm
    smallest = proof(answer(body, {**goal, "moment_weight": 0.0})).objective
    ceiling = max(force - share * (force - smallest), 1.002 * smallest + 1.0)
    return {"force_ceiling_N": ceiling, "moment_ceiling_Nm": 3.0 * moment + 1.0}


def times(ceilings: dict[str, Any], factor: float) -> dict[str, Any]:
    return {name: ceiling * factor for name, ceiling in ceilings.items()}


@pytest.mark.parametrize("step", [1e-3, 1e-9])
@pytest.mark.parametrize("seed", [0, 1, 2, 3, 5, 8, 13, 21])
def test_higher_ceilings_never_hurt(seed: int, step: float) -> None:
    """All are optimal, and no higher ceiling has a bound above the value that a lower one lets be reached.

    An answer may exceed a ceiling by 1e-9 of itself, which at the price of the ceiling is what a value may lie below
    the bound of the next higher one.
    """
    body = random_machine(seed)
    ceilings = ceilings_between(body, 0.5)
    answers = [answer(body, times(ceilings, factor)) for factor in (1 - step, 1.0, 1 + step)]
    for lower, higher in pairwise(answers):
        low, high = proof(lower), proof(higher)
        prices = {
            ceiling.response: abs(complex(ceiling.x, ceiling.y)) for ceiling in low.multipliers.objective.ceilings
        }
        before = lower.residual.before
        tolerated = 1e-9 * (prices["force"] * before.force.peak_N + prices["moment"] * before.moment.peak_Nm)
        rounding = ROUNDING * low.objective_without_counterweights
        assert high.lower_bound is not None
        assert high.lower_bound <= low.objective + 1.01 * tolerated + rounding
        assert high.objective <= low.objective + 1.01 * tolerated + 1.01 * SHARE * low.objective_without_counterweights


@pytest.mark.parametrize("combine", night.part(2, ["sum", "max"]))
@pytest.mark.parametrize("seed", range(6))
def test_no_jumps_at_the_boundary_of_what_can_be_reached(seed: int, combine: str) -> None:
    """The smallest force as the ceiling, times 1 -+ 1e-3, 1 -+ 1e-9 and 1.

    Clearly above it is optimal, clearly below infeasible; within the tolerance of ceilings either is right. But it is
    decided: no answer is inaccurate, and a value is no farther from those beside it than the price of the step.
    """
    body = random_machine(seed)
    smallest = proof(answer(body, {"moment_weight": 0.0, "least_mass": False})).objective
    factors = (1 - 1e-3, 1 - 1e-9, 1.0, 1 + 1e-9, 1 + 1e-3)
    answers = [answer(body, {"combine": combine, "force_ceiling_N": smallest * factor}) for factor in factors]
    statuses = [optimum.status for optimum in answers]
    assert "inaccurate" not in statuses
    assert statuses[-1] == "optimal"
    if smallest > 1e-6:
        assert statuses[0] == "infeasible"
    # once the ceilings can be kept, higher ones can
    assert statuses == sorted(statuses, key=["infeasible", "optimal"].index)
    values = [proof(optimum).objective for optimum in answers if optimum.status == "optimal"]
    rest = proof(answers[-1]).objective_without_counterweights
    for lower, higher in pairwise(values):
        assert higher <= lower + 2 * SHARE * rest
