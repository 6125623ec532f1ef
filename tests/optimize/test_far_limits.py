"""Limits that lie far beyond what is needed: the answer and its proof are those of the limits that count."""

import copy

import numpy as np
import pytest

from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.sweep import run_chunk
from schemas.front.pareto import ParetoRequest
from schemas.request.requests import OptimizeRequest
from service.common.validation import InvalidRequest, check
from tests.hard.cases.case import Body, machine, row, throw, web
from tests.night import but
from tests.studies.sweep.single import sweep
from tests.verification.checking import optimized

#: 1 rad/s, so that forces are mass-radius products
ONE = {"omega": 1.0}
FAR = "/machine/webs/1/max_mass_kg"


def issued(far: float | None) -> Body:
    """10 kg m, and 1 kg for 0.32 kg at 2 m and the rest at 1 m: 10 - 0.64 - 0.68 = 8.68 by hand."""
    webs = [web("A", 0.0, 0.32, 2.0), web("B", 0.0, far, 1.0)]
    return {"machine": machine([throw(0.0, 0.0, [], radius=1.0, rotating=10.0)], webs, max_total_mass_kg=1.0, **ONE)}


@pytest.mark.parametrize("far", [1.0, 1e3, 1e7, 1e12, 1e15, 1e300, None])
def test_a_budget_beside_a_far_limit(far: float | None) -> None:
    answer = optimized(issued(far))
    proof = answer.certificate
    assert answer.status == "optimal"
    assert proof.objective == pytest.approx(8.68, abs=1.1e-5)  # analytic; optima differ by 1e-6 of 10
    assert 8.68 * (1 - 1e-9) <= proof.lower_bound <= 8.68
    assert [counterweight.mass_kg for counterweight in answer.counterweights] == pytest.approx([0.32, 0.68], rel=2e-5)
    # the budget is what holds the objective up: a kilogram more goes to B
    prices = {(price.limit, price.web): price.value for price in answer.shadow_prices}
    assert prices == {("max_mass", "A"): pytest.approx(1.0), ("max_total_mass", None): pytest.approx(1.0)}


def test_the_same_in_a_sweep_and_as_what_can_be_reached() -> None:
    limits = [1.0, 1e7, 1e15]
    request = sweep(issued(1.0), {"path": FAR, "values": limits})
    rows = run_chunk(request.model_dump_json().encode(), 0, len(limits)).to_pylist()
    assert [row["status"] for row in rows] == ["optimal"] * 3
    assert [row["lower_bound"] for row in rows] == pytest.approx([8.68] * 3, rel=1e-9)  # analytic
    infeasible = issued(1e15) | {"objective": {"force_ceiling_N": 8.6}}
    infeasibility = optimized(infeasible).infeasibility
    assert 8.68 * (1 - 1e-9) <= infeasibility.smallest_force_lower_bound_N <= 8.68
    assert infeasibility.smallest_force_N == pytest.approx(8.68, rel=1e-9)


def test_forty_limits_up_to_1e300_beside_a_budget() -> None:
    limits = np.geomspace(1e3, 1e300, 40).tolist()
    request = sweep(issued(1.0), {"path": FAR, "values": limits})
    table = run_chunk(request.model_dump_json().encode(), 0, len(limits)).to_pydict()
    bound, objective = np.array(table["lower_bound"]), np.array(table["objective"])
    assert table["status"] == ["optimal"] * len(limits)
    assert np.all((bound <= 8.68) & (bound >= 8.68 * (1 - 1e-9)))  # analytic
    assert np.all((objective >= 8.68 * (1 - 1e-12)) & (objective <= 8.68 + 1.1e-5))


def test_the_same_in_a_front() -> None:

    answer = pareto(ParetoRequest.model_validate(issued(1e15) | {"points": 3}))
    assert answer.status == "optimal"
    assert answer.fronts[0].ends.smallest_force_lower_bound_N == pytest.approx(8.68, rel=1e-6)  # analytic
    assert answer.fronts[0].ends.smallest_force_lower_bound_N <= 8.68 * (1 + 1e-15)


def _random(seed: int, sectors: bool, budget: bool, ceiling: bool) -> Body:
    rng = np.random.default_rng(seed)
    throws = [
        throw(z, rng.uniform(0, 360), [row(rng.uniform(0, 360), rng.uniform(1, 20))], rotating=rng.uniform(0, 10))
        for z in (-0.3, 0.4)
    ]
    webs = [
        web(
            str(k),
            rng.uniform(-0.5, 0.5),
            None if rng.random() < 0.6 else rng.uniform(1, 5),
            rng.uniform(0.1, 0.4),
            (rng.uniform(0, 360), rng.choice([2.0, 40.0, 90.0])) if sectors and rng.random() < 0.7 else None,
        )
        for k in range(rng.integers(1, 6))
    ]
    body = {"machine": machine(throws, webs, max_total_mass_kg=8.0 if budget else None), "objective": {}}
    if ceiling:
        before = optimized(body).residual
        body["objective"] = {"force_ceiling_N": 0.5 * (before.before.force.peak_N + before.after.force.peak_N)}
    return body


def _limited(body: Body, most: float) -> Body:
    changed = copy.deepcopy(body)
    for plane in changed["machine"]["webs"]:
        plane["max_mass_kg"] = most if plane["max_mass_kg"] is None else plane["max_mass_kg"]
    return changed


@pytest.mark.parametrize("seed", [*range(16), *but((), range(16, 40))])
def test_no_limit_is_any_limit_that_is_large_enough(seed: int) -> None:
    """Independent: the same machine with explicit limits, of which the smallest are the implied ones."""
    body = _random(seed, seed % 2 > 0, seed % 4 > 1, seed % 8 > 3)
    free = optimized(body)
    assert free.status == "optimal"
    proof = free.certificate
    unlimited = {plane["name"] for plane in body["machine"]["webs"] if plane["max_mass_kg"] is None}
    assert set(proof.implied_max_mass_kg) == unlimited
    for most in (max(proof.implied_max_mass_kg.values(), default=1.0), 1e5, 1e12, 1e300):
        answer = optimized(_limited(body, most))
        size = proof.yardstick
        assert answer.status == "optimal"
        assert answer.certificate.objective == pytest.approx(proof.objective, abs=2e-6 * size)
        assert answer.certificate.lower_bound <= proof.objective
        assert proof.lower_bound <= answer.certificate.objective
        assert answer.total_mass_kg == pytest.approx(free.total_mass_kg, rel=3e-4, abs=1e-9)


def test_no_limit_in_a_sweep_and_in_a_front() -> None:
    body = _random(3, True, False, False)
    free = optimized(body)
    request = sweep(body, {"path": "/machine/speed_rpm", "values": [body["machine"]["speed_rpm"]]})
    alone = run_chunk(request.model_dump_json().encode(), 0, 1).to_pylist()[0]
    assert alone["status"] == "optimal"
    assert alone["objective"] == pytest.approx(free.certificate.objective, rel=1e-9)
    assert pareto(ParetoRequest.model_validate(body | {"points": 3})).status == "optimal"
    assert pareto(ParetoRequest.model_validate(_limited(body, 1e300) | {"points": 3})).status == "optimal"


def test_a_limit_that_is_left_out_is_refused() -> None:
    body = issued(None)
    del body["machine"]["webs"][1]["max_mass_kg"]
    with pytest.raises(InvalidRequest) as refused:
        check(OptimizeRequest, body)
    assert [problem.path for problem in refused.value.problems] == [("machine", "webs", 1, "max_mass_kg")]
