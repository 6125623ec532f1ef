"""Shadow prices against finite differences of the smallest objective, which the service certifies itself."""

import copy
from typing import Any

import numpy as np
import pytest

from schemas.answer.answers import OptimizeAnswer
from schemas.answer.limits import ShadowPrice
from tests.night import part
from tests.optimize.machines import machine, row, throw, web
from tests.verification.checking import optimized

#: relative step of a limit, and what the difference quotient is worth
STEP, TOLERANCE = 1e-5, 1e-3


def answer(body: dict[str, Any]) -> OptimizeAnswer:
    return optimized(body)


def tight(seed: int, **objective: Any) -> dict[str, Any]:
    """Three throws with unequal axes; six webs, too small, half of them in sectors that are too narrow."""
    rng = np.random.default_rng(seed)
    throws, webs = [], []
    for i in range(3):
        crank = rng.uniform(0.0, 360.0)
        throws.append(
            throw(
                0.3 * i, crank, [row(rng.uniform(0.0, 360.0), rng.uniform(5.0, 20.0))], rotating=rng.uniform(5.0, 20.0)
            )
        )
        for side in (-1, 1):
            plane = web(f"{i}{side}", 0.3 * i + 0.08 * side) | {"max_mass_kg": rng.uniform(0.5, 4.0)}
            if side > 0:
                plane["sector"] = {
                    "centre_deg": crank + 180.0 + rng.uniform(-50.0, 50.0),
                    "half_angle_deg": rng.uniform(10.0, 60.0),
                }
            webs.append(plane)
    return {"machine": machine(throws, webs), "objective": objective, "accuracy": {"relative_gap": 1e-10}}


def limit(body: dict[str, Any], price: ShadowPrice) -> tuple[dict[str, Any], str]:
    """Where the limit of a price stands in a request."""
    webs = {plane["name"]: plane for plane in body["machine"]["webs"]}
    return {
        "max_mass": lambda: (webs[price.web], "max_mass_kg"),
        "sector": lambda: (webs[price.web]["sector"], "half_angle_deg"),
        "max_total_mass": lambda: (body["machine"], "max_total_mass_kg"),
        "force_ceiling": lambda: (body["objective"], "force_ceiling_N"),
        "moment_ceiling": lambda: (body["objective"], "moment_ceiling_Nm"),
    }[price.limit]()


def slope(body: dict[str, Any], price: ShadowPrice) -> float:
    """Fall of the smallest objective per unit of a limit, as a central difference."""
    objectives = []
    for sign in (1.0, -1.0):
        moved = copy.deepcopy(body)
        moved["objective"]["least_mass"] = False
        at, field = limit(moved, price)
        step = STEP * at[field]
        at[field] += sign * step
        objectives.append(answer(moved).certificate.objective)
    return (objectives[1] - objectives[0]) / (2.0 * step)


@pytest.mark.parametrize("combine", part(2, ["sum", "max"]))
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_prices_of_webs_are_finite_differences(seed: int, combine: str) -> None:
    body = tight(seed, combine=combine)
    optimum = answer(body)
    assert {price.limit for price in optimum.shadow_prices} >= {"max_mass"}
    for price in optimum.shadow_prices:
        # independent: a difference of certified objectives
        assert price.value == pytest.approx(slope(body, price), rel=TOLERANCE, abs=1e-3)


def test_price_of_the_budget_is_a_finite_difference() -> None:
    body = tight(4)
    body["machine"]["max_total_mass_kg"] = 5.0
    optimum = answer(body)
    (price,) = [shadow_price for shadow_price in optimum.shadow_prices if shadow_price.limit == "max_total_mass"]
    assert price.unit == "N/kg"
    assert price.value > 1.0
    assert price.value == pytest.approx(slope(body, price), rel=TOLERANCE)


def test_price_of_a_ceiling_is_a_finite_difference() -> None:
    # the moment counts more than the force, so that the force has to be held down
    body = tight(5, force_weight=0.1)
    smallest = answer(tight(5, moment_weight=0.0)).residual.after.force.peak_N
    body["objective"]["force_ceiling_N"] = 0.5 * (smallest + answer(body).residual.after.force.peak_N)
    optimum = answer(body)
    (price,) = [shadow_price for shadow_price in optimum.shadow_prices if shadow_price.limit == "force_ceiling"]
    assert price.unit == "N/N"
    assert price.value > 0.01
    assert price.value == pytest.approx(slope(body, price) / 0.1, rel=TOLERANCE)


def test_one_web_too_small_is_worth_its_own_force() -> None:
    # analytic: one plane, rotating mass only, so that each kilogram at R takes R omega^2 off the peak force
    body = machine([throw(0.0, 0.0, [], rotating=10.0)], [web("a", 0.0) | {"max_mass_kg": 3.0}])
    optimum = answer({"machine": body})
    (price,) = optimum.shadow_prices
    radius, omega = body["webs"][0]["counterweight_radius_m"], body["speed_rpm"] * np.pi / 30.0
    assert (price.limit, price.web, price.unit) == ("max_mass", "a", "N/kg")
    assert price.value == pytest.approx(radius * omega**2, rel=1e-9)


def test_without_a_force_weight_prices_are_moments() -> None:
    body = tight(6, force_weight=0.0)
    optimum = answer(body)
    assert {price.unit for price in optimum.shadow_prices} <= {"N m/kg", "N m/deg"}
    for price in optimum.shadow_prices:
        weight = 1.0 / 0.76  # 1/L, from the first web to the last
        assert price.value == pytest.approx(slope(body, price) / weight, rel=TOLERANCE, abs=1e-3)


def test_limits_that_hold_nothing_up_have_no_price() -> None:
    roomy = machine([throw(0.0, 0.0, [row(90.0, 20.0)])], [web("a", -0.1), web("b", 0.1)])
    assert answer({"machine": roomy}).shadow_prices == ()


def test_a_limit_of_zero_has_a_price() -> None:
    # analytic: what the first kilogram would be worth, R omega^2
    body = machine([throw(0.0, 0.0, [], rotating=10.0)], [web("a", 0.0, max_mass=0.0), web("b", 0.0, max_mass=1.0)])
    optimum = answer({"machine": body})
    worth = body["webs"][0]["counterweight_radius_m"] * (body["speed_rpm"] * np.pi / 30.0) ** 2
    assert [price.web for price in optimum.shadow_prices] == ["a", "b"]
    assert [price.value for price in optimum.shadow_prices] == pytest.approx([worth, worth], rel=1e-9)
