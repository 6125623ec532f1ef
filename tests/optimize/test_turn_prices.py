"""What a ceiling over the turn costs: the lengths of its multipliers, against differences of certified optima."""

from typing import Any

import pytest

from schemas.answer.answers import Certificate, OptimizeAnswer
from tests.night import part
from tests.optimize.machines import machine, row, throw, web
from tests.verification.checking import optimized


def _answer(objective: dict[str, Any], **more: Any) -> OptimizeAnswer:
    rod = {"connecting_rod": {"length_m": 0.35, "mass_kg": 3.0}}
    throws = [throw(0.0, 0.0, [row(90.0, 10.0, **rod)], rotating=5.0), throw(0.4, 110.0, [row(60.0, 8.0, **rod)])]
    bearings = [{"name": name, "position_m": place} for name, place in (("A", -0.1), ("B", 0.2), ("C", 0.5))]
    body = machine(throws, [web("a", -0.05, 30.0), web("b", 0.45, 30.0)], bearings=bearings) | more
    request = {"machine": body, "objective": {**objective, "least_mass": False}, "accuracy": {"relative_gap": 1e-9}}
    return optimized(request)


def _certificate(objective: dict[str, Any], **more: Any) -> Certificate:
    certificate = _answer(objective, **more).certificate
    assert certificate is not None
    return certificate


def _price(certificate: Certificate) -> float:
    return sum(abs(complex(ceiling.x, ceiling.y)) for ceiling in certificate.multipliers.objective.ceilings)


def test_the_price_of_a_bearing_ceiling_is_the_sum_of_its_multipliers() -> None:
    # independent: central differences; the ceiling is between what the two goals by themselves leave
    alone = _certificate({"bearing_weight": 1, "force_weight": 0, "moment_weight": 0})
    cap = 1.02 * alone.objective
    certificate, step = _certificate({"bearing_ceiling_N": cap}), 1e-3 * cap
    higher, lower = (_certificate({"bearing_ceiling_N": cap + by}).objective for by in (step, -step))
    assert _price(certificate) > 0.1
    assert _price(certificate) == pytest.approx((lower - higher) / (2.0 * step), rel=1e-3)
    assert all(
        ceiling.response.startswith("bearing:") and ceiling.angle_deg is not None
        for ceiling in certificate.multipliers.objective.ceilings
    )


def test_the_price_of_the_budget_is_its_multiplier() -> None:
    goal = {"bearing_weight": 1}
    certificate = _certificate(goal, max_total_mass_kg=2.0)
    higher, lower = (_certificate(goal, max_total_mass_kg=most).objective for most in (2.002, 1.998))
    assert certificate.multipliers.objective.budget > 0.0
    assert certificate.multipliers.objective.budget == pytest.approx((lower - higher) / 0.004, rel=1e-3)


@pytest.mark.parametrize("orders", ["first", "all"])
def test_prices_are_told_in_the_units_of_limits(orders: str) -> None:
    """Independent: central differences of certified optima."""
    sizes = {"diameter_m": 0.05, "length_m": 0.04}
    bearings = [{"name": n, "position_m": z, **sizes} for n, z in (("A", -0.1), ("B", 0.2), ("C", 0.5))]
    alone = {"bearing_weight": 1, "bearing_measure": "specific", "force_weight": 0, "moment_weight": 0}
    cap = 1.02 * _certificate(alone, bearings=bearings).objective
    goal = {"force_weight": 2.0, "orders": orders}

    def answer_at(by: float) -> OptimizeAnswer:
        return _answer(goal | {"specific_load_ceiling_Pa": cap * (1.0 + by)}, bearings=bearings)

    optimum, higher, lower = (answer_at(by) for by in (0.0, 1e-3, -1e-3))
    assert optimum.active_limits == ("specific_load_ceiling",)
    (price,) = [shadow_price for shadow_price in optimum.shadow_prices if shadow_price.limit == "specific_load_ceiling"]
    assert price.unit == "N/Pa"
    assert lower.certificate is not None
    assert higher.certificate is not None
    fall = (lower.certificate.objective - higher.certificate.objective) / (2e-3 * cap)
    assert price.value == pytest.approx(fall / 2.0, rel=1e-3)


def test_a_full_web_has_a_price_of_bearing_load() -> None:
    """Independent: central differences of certified optima."""
    goal = {"bearing_weight": 2.0, "force_weight": 0, "moment_weight": 0}
    answers = {most: _answer(goal, webs=[web("a", -0.05, most), web("b", 0.45, 30.0)]) for most in (1.0, 1.001, 0.999)}
    (price,) = [shadow_price for shadow_price in answers[1.0].shadow_prices if shadow_price.limit == "max_mass"]
    assert (price.web, price.unit) == ("a", "N/kg")
    higher, lower = (answers[most].certificate for most in (1.001, 0.999))
    assert higher is not None
    assert lower is not None
    assert price.value == pytest.approx((lower.objective - higher.objective) / 0.002 / 2.0, rel=1e-3)


_BESIDE = ("bearing_ceiling_N", "specific_load_ceiling_Pa", "bending_ceiling_Nm")


@pytest.mark.parametrize("beside", part(2, _BESIDE))
@pytest.mark.parametrize(
    ("field", "limit"), [("force_ceiling_N", "force_ceiling"), ("moment_ceiling_x_Nm", "moment_ceiling_x")]
)
def test_a_ceiling_of_the_first_order_has_its_price_beside_one_over_the_turn(
    field: str, limit: str, beside: str
) -> None:
    """Independent: central differences of certified optima; a ceiling far away (analytic) costs nothing."""
    sizes = {"diameter_m": 0.05, "length_m": 0.04}
    bearings = [{"name": n, "position_m": z, **sizes} for n, z in (("A", -0.1), ("B", 0.2), ("C", 0.5))]
    # bearings are weighed, and the ceiling is just above the least that the peak comes to by itself
    alone = {"moment_weight": 0.0} if field.startswith("force") else {"force_weight": 0.0, "moment_weight": 1.0}
    residual = _answer(alone).residual
    assert residual is not None
    assert residual.after is not None
    after = residual.after
    cap = 1.05 * (after.force.peak_N if field.startswith("force") else after.moment.peak_x_Nm)
    goal = {"force_weight": 0.0, "moment_weight": 0.0, "bearing_weight": 2.0, beside: 1e9}

    def answer_at(by: float) -> OptimizeAnswer:
        return _answer(goal | {field: cap * (1.0 + by)}, bearings=bearings)

    optimum, higher, lower = (answer_at(by) for by in (0.0, 1e-3, -1e-3))
    assert optimum.active_limits == (limit,)
    (price,) = optimum.shadow_prices
    assert price.limit == limit
    assert higher.certificate is not None
    assert lower.certificate is not None
    fall = (lower.certificate.objective - higher.certificate.objective) / (2e-3 * cap)
    assert price.value > 0.0
    assert price.value == pytest.approx(fall / 2.0, rel=1e-3)
