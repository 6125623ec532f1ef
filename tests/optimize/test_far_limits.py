"""Limits that lie far beyond what is needed: the answer and its proof are those of the limits that count."""

import pytest

from optimizer.optimize import optimize
from optimizer.sweep import run_chunk
from schemas.pareto import ParetoRequest
from schemas.requests import OptimizeRequest
from tests.hard.cases.case import Body, machine, throw, web
from tests.sweep.single import sweep

#: 1 rad/s, so that forces are mass-radius products
ONE = {"omega": 1.0}
FAR = "/machine/webs/1/max_mass_kg"


def issued(far: float | None) -> Body:
    """10 kg m, and 1 kg for 0.32 kg at 2 m and the rest at 1 m: 10 - 0.64 - 0.68 = 8.68 by hand."""
    webs = [web("A", 0.0, 0.32, 2.0), web("B", 0.0, far, 1.0)]
    return {"machine": machine([throw(0.0, 0.0, [], radius=1.0, rotating=10.0)], webs, max_total_mass_kg=1.0, **ONE)}


@pytest.mark.parametrize("far", [1.0, 1e3, 1e7, 1e12, 1e15])
def test_a_budget_beside_a_far_limit(far: float) -> None:
    found = optimize(OptimizeRequest.model_validate(issued(far)))
    proof = found.certificate
    assert found.status == "optimal"
    assert proof.objective == pytest.approx(8.68, abs=1.1e-5)  # analytic; optima differ by 1e-6 of 10
    assert 8.68 * (1 - 1e-9) <= proof.lower_bound <= 8.68
    assert [one.mass_kg for one in found.counterweights] == pytest.approx([0.32, 0.68], rel=2e-5)
    # the budget is what holds the objective up: a kilogram more goes to B
    prices = {(price.limit, price.web): price.value for price in found.shadow_prices}
    assert prices == {("max_mass", "A"): pytest.approx(1.0), ("max_total_mass", None): pytest.approx(1.0)}


def test_the_same_in_a_sweep_and_as_what_can_be_reached() -> None:
    limits = [1.0, 1e7, 1e15]
    request = sweep(issued(1.0), {"path": FAR, "values": limits})
    rows = run_chunk(request.model_dump_json().encode(), 0, len(limits)).to_pylist()
    assert [row["status"] for row in rows] == ["optimal"] * 3
    assert [row["lower_bound"] for row in rows] == pytest.approx([8.68] * 3, rel=1e-9)  # analytic
    infeasible = issued(1e15) | {"objective": {"force_ceiling_N": 8.6}}
    told = optimize(OptimizeRequest.model_validate(infeasible)).infeasibility
    assert 8.68 * (1 - 1e-9) <= told.smallest_force_lower_bound_N <= 8.68
    assert told.smallest_force_N == pytest.approx(8.68, rel=1e-9)


def test_the_same_in_a_front() -> None:
    from optimizer.pareto.pareto import pareto

    found = pareto(ParetoRequest.model_validate(issued(1e15) | {"points": 3}))
    assert found.status == "optimal"
    assert found.fronts[0].ends.smallest_force_lower_bound_N == pytest.approx(8.68, rel=1e-6)  # analytic
    assert found.fronts[0].ends.smallest_force_lower_bound_N <= 8.68 * (1 + 1e-15)
