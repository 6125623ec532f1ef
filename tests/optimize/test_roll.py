"""The roll moment about the crankshaft: balance shafts at different heights take what is left of it."""

from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from tests.analyze.driven import ask, random_driven
from tests.optimize.shafts import WHOLE, at, in_line_four, rolled, shaft, single
from tests.verification.checking import optimized

ANGLES = np.arange(0.0, 360.0, 1.0)
#: m, of the in-line four
ROD = 0.1 / 0.3


def answer(body: dict[str, Any], **objective: Any) -> OptimizeAnswer:
    return optimized({"machine": body, "objective": objective})


def four(rise: float, **more: Any) -> dict[str, Any]:
    """Two shafts side by side: the one that turns with the crankshaft is nearer to the cylinders by this many rods."""
    with_it = shaft("with", 2, 0.18, x_m=-0.06, y_m=0.05 + rise * ROD)
    return in_line_four([with_it, shaft("against", -2, 0.18, x_m=0.06, y_m=0.05)], **more)


def second_order(body: dict[str, Any], size: float) -> float:
    """Amplitude of the second order of the roll with unbalances of this size opposite the outer cranks."""
    counterweights = [
        {"web": f"{name} web", "mass_kg": 10.0 * size, "angle_deg": 270.0} for name in ("with", "against")
    ]
    request = {"machine": body, "counterweights": counterweights, "outputs": ["roll"]}
    analysis = analyze(AnalyzeRequest.model_validate(request))
    assert analysis.roll is not None
    assert analysis.roll.after is not None
    turn = np.exp(-2j * np.deg2rad(np.array(analysis.roll.angle_deg)))
    return float(2.0 * abs(np.mean(np.array(analysis.roll.after.moment_Nm) * turn)))


def test_lanchesters_pair_at_different_heights_cancels_the_second_order_of_the_roll() -> None:
    # analytic: m r A_2/2 on each; rows 4 m r^2 tau_2 sin 2 theta, shafts -2 m r A_2 (height difference) sin 2 theta
    unbalance, whole = 0.1535253, 0.1 * WHOLE
    of_rows = second_order(four(0.0), unbalance)
    assert of_rows == pytest.approx(4.0 * 0.50028 * whole, rel=2e-5)
    # published (SAE 760111): shafts at the same height leave it as it is, the upper one has to turn with the crank
    assert second_order(four(0.0), 0.0) == pytest.approx(of_rows, rel=1e-9)
    assert second_order(four(0.97758), unbalance) <= 1e-5 * of_rows
    # swapped they double it
    assert second_order(four(-0.97758), unbalance) == pytest.approx(2.0 * of_rows, rel=1e-5)


@pytest.mark.parametrize("orders", ["all", "first"])
@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_figures_are_those_of_energy_and_levers(rotation: str, orders: str) -> None:
    """Independent: power over speed, and forces times levers; a shaft at -1 is mirrored in the first order alone."""
    shafts = [shaft("p", -1, 0.0, 3.0, x_m=0.2, y_m=-0.1), shaft("q", 2, 0.1, 0.5, x_m=-0.15, y_m=0.3)]
    body = single(shafts, rotation=rotation)
    optimum = answer(body, orders=orders, moment_weight=0, roll_weight=4.0)
    assert optimum.status == "optimal"
    assert optimum.roll is not None
    assert optimum.roll.after is not None
    fields = optimum.model_dump()
    turn = np.array([rolled(body, fields, theta) for theta in ANGLES])
    np.testing.assert_allclose(optimum.roll.after.moment_Nm, turn, atol=1e-9 * np.max(np.abs(turn)))
    low, high = optimum.roll.after.peak_bracket_Nm
    assert np.max(np.abs(turn)) <= high
    assert low == pytest.approx(np.max(np.abs(turn)), rel=1e-3)
    force = optimum.residual.after.force.peak_N
    if orders == "all":
        force = max(abs(at(body, fields, theta)[0]) for theta in ANGLES)
    assert force + 4.0 * np.max(np.abs(turn)) == pytest.approx(optimum.certificate.objective, rel=1e-3)
    assert optimum.certificate.objective - optimum.certificate.lower_bound <= 1e-6 * optimum.certificate.yardstick
    assert {term.response for term in optimum.certificate.multipliers.objective.terms} >= {"force", "roll"}
    # of a number the multipliers are real
    rolls = [term for term in optimum.certificate.multipliers.objective.terms if term.response == "roll"]
    assert all(term.y == 0.0 for term in rolls)


def test_the_optimum_of_force_and_roll_is_near_the_published_arrangement() -> None:
    """Analytic but for the fourth order: at that height both go, at no height does the force alone take the roll."""
    together = {"orders": "all", "moment_weight": 0, "roll_weight": 5.0}
    best, level = answer(four(0.97758), **together), answer(four(0.0), **together)
    assert best.certificate.objective <= 0.04 * best.certificate.objective_without_counterweights
    assert level.certificate.objective >= 0.45 * level.certificate.objective_without_counterweights
    sizes = [
        counterweight.mass_radius_kg_m
        for balance_shaft in best.balance_shafts
        for counterweight in balance_shaft.counterweights
    ]
    assert sizes == pytest.approx([0.1535] * 2, rel=5e-3)


def test_nobody_near_is_better() -> None:
    body = four(0.4)
    optimum = answer(body, orders="all", combine="max", roll_weight=6.0, moment_weight=0)
    assert optimum.status == "optimal"

    def sampled(fields: dict[str, Any]) -> float:
        turn = ANGLES[::2]
        force = max(abs(at(body, fields, theta)[0]) for theta in turn)
        return max(force, 6.0 * max(abs(rolled(body, fields, theta)) for theta in turn))

    assert sampled(optimum.model_dump()) == pytest.approx(optimum.certificate.objective, rel=3e-3)
    rng = np.random.default_rng(3)
    for scale in (1e-3, 1e-2, 0.1, 0.5):
        second = optimum.model_dump()
        for balance_shaft in second["balance_shafts"]:
            for counterweight in balance_shaft["counterweights"]:
                counterweight["mass_kg"] *= 1.0 + scale * rng.normal()
                counterweight["angle_deg"] += 90.0 * scale * rng.normal()
        assert sampled(second) >= optimum.certificate.lower_bound * (1.0 - 3e-3)


def test_shafts_without_a_limit_reach_what_they_need() -> None:
    limited, free = four(0.7), four(0.7)
    for balance_shaft in free["balance_shafts"]:
        balance_shaft["webs"][0]["max_mass_kg"] = None
    fields = {"force_weight": 0, "moment_weight": 0, "roll_weight": 1.0}
    first_answer, second_answer = answer(limited, **fields), answer(free, **fields)
    assert (first_answer.status, second_answer.status) == ("optimal", "optimal")
    assert second_answer.certificate.objective == pytest.approx(first_answer.certificate.objective, rel=5e-5)
    assert set(second_answer.certificate.implied_max_mass_kg) == {"with web", "against web"}


def test_roll_is_a_part_of_the_goal_external() -> None:
    goals = [{"goal": "external", "allowance": 1e-3}, {"goal": "mass"}]
    optimum = answer(four(0.97758), orders="all", combine="max", moment_weight=0, roll_weight=5.0, priorities=goals)
    assert optimum.status == "optimal"
    free = answer(four(0.97758), orders="all", combine="max", moment_weight=0, roll_weight=5.0)
    rest = free.certificate.objective_without_counterweights
    # the larger of the two, and not their sum
    assert optimum.certificate.objective_without_counterweights == pytest.approx(rest, rel=1e-9)
    assert optimum.certificate.objective <= free.certificate.objective + 1.1e-3 * rest


@pytest.mark.parametrize("where", ["no shafts", "scroll"])
def test_a_roll_that_nothing_changes_is_refused(where: str) -> None:
    scroll: dict[str, Any] = {"kind": "scroll", "speed_rpm": 3000, "orbit_radius_m": 0.005, "orbiting_mass_kg": 1.2}
    scroll |= {"orbiting_position_m": 0.05, "anti_rotation": {"type": "oldham", "mass_kg": 0.3, "axis_deg": 90}}
    scroll["anti_rotation"]["position_m"] = 0.03
    body = scroll if where == "scroll" else in_line_four([])
    with pytest.raises(ValidationError, match="balance shafts alone change the roll moment"):
        OptimizeRequest.model_validate({"machine": body, "objective": {"roll_weight": 1}})


def test_a_roll_without_its_mean_is_the_overturning_couple_without_it() -> None:
    """Gas and friction count; what a compressor takes from its drive is no part of what shakes."""
    body = random_driven(3)
    analysis = ask(body, "roll", "overturning", step_deg=0.5)
    sense = 1.0 if body.get("rotation", "ccw") == "ccw" else -1.0
    couple, moment = sense * np.array(analysis.overturning.couple_Nm), np.array(analysis.roll.before.moment_Nm)
    whole = np.max(np.abs(couple))
    np.testing.assert_allclose(couple - moment, np.mean(couple), atol=1e-3 * whole)
    np.testing.assert_allclose(couple - moment, (couple - moment)[0], atol=1e-9 * whole)
    assert analysis.roll.after == analysis.roll.before
