"""A least mass of what is fitted on webs without a limit: the reach that is searched is proven, not given."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.formulation.goals import cone_program
from optimizer.outputs.registry import prepare
from optimizer.program.limits import Limits
from optimizer.program.methods.semicontinuous_bounds import within_semicontinuous_reach
from schemas.request.requests import OptimizeRequest
from service.common.validation import InvalidRequest, check
from tests.dust.machines import crankshaft
from tests.hard.cases.case import Body
from tests.night import part
from tests.program.alone import carrying_mass
from tests.verification.checking import optimized


def fitted(seed: int, most: float | None, sectors: float = 0.0, least: float = 2.0) -> Body:
    """One or two throws whose counterweights weigh at least 1 to 10^``least`` kg."""
    rng = np.random.default_rng([seed, 77])
    machine = crankshaft(rng, sectors, most_throws=2)
    for web in machine["webs"]:
        web["min_fitted_mass_kg"], web["max_mass_kg"] = float(10 ** rng.uniform(0, least)), most
    return {"machine": machine}


@pytest.mark.parametrize("sectors", part(2, [0.0, 0.8]))
@pytest.mark.parametrize("seed", range(6))
def test_no_limit_is_a_limit_that_is_far_away(seed: int, sectors: float) -> None:
    """Independent: 1e4 kg, of which the search needs no proof, and 1e12 kg come to the same."""
    near, far, none = (optimized(fitted(seed, most, sectors)) for most in (1e4, 1e12, None))
    assert near.status == far.status == none.status == "optimal"
    assert near.certificate is not None
    assert far.certificate is not None
    assert none.certificate is not None
    close = 1e-6 * none.certificate.yardstick + 1e-9
    assert none.certificate.objective == pytest.approx(near.certificate.objective, abs=close, rel=2e-3)
    assert none.certificate.objective == far.certificate.objective
    assert near.certificate.lower_bound is not None
    assert none.certificate.lower_bound is not None
    assert none.certificate.lower_bound <= near.certificate.objective + close


def test_what_is_fitted_may_be_heavier_than_any_optimum_of_any_masses() -> None:
    """Analytic: a million kilograms on one web do more harm than good, so that nothing is fitted."""
    body = fitted(0, None)
    del body["machine"]["webs"][1:]
    body["machine"]["webs"][0]["min_fitted_mass_kg"] = 1e6
    answer = optimized(body)
    assert answer.status == "optimal"
    assert answer.total_mass_kg == 0.0


def test_two_webs_in_one_plane_hold_one_another() -> None:
    """Analytic: one counterweight cannot be as light as needed, two at an angle do as much together."""
    throw = {
        "position_m": 0.0, "crank_radius_m": 0.1, "crank_angle_deg": 0.0, "rotating_mass_kg": 40.0, "rows": [],
    }  # fmt: skip
    webs = [
        {
            "name": name, "position_m": 0.0, "counterweight_radius_m": 0.2, "max_mass_kg": None,
            "min_fitted_mass_kg": 50.0,
        }
        for name in "ab"
    ]  # fmt: skip
    answer = optimized({"machine": {"kind": "reciprocating", "speed_rpm": 600, "throws": [throw], "webs": webs}})
    assert answer.status == "optimal"
    assert answer.certificate is not None
    # 4 kg m are called for, and each carries at least 10
    x, y = (
        sum(getattr(counterweight, name) for counterweight in answer.counterweights) for name in ("x_kg_m", "y_kg_m")
    )
    assert np.hypot(x + 4.0, y) <= 4.0 * 1e-3
    assert all(counterweight.mass_kg >= 50.0 for counterweight in answer.counterweights)


@pytest.mark.parametrize("seed", range(20))
def test_the_reach_holds_whatever_the_webs_are_for(seed: int) -> None:
    """Property: what some webs can carry, each at least its mass, is found again within the reach of all."""
    request = OptimizeRequest.model_validate(fitted(seed, None, sectors=0.0))
    scene = prepare(request, request.outputs)
    program = cone_program(request.machine, request.objective, scene.responses, np.array([1.0])).subset(0)
    least = np.array([web.min_fitted_mass_kg or 0.0 for web in request.machine.webs])
    bounded = within_semicontinuous_reach(program, least)
    assert np.all(np.isfinite(bounded.limits.max_mass))
    assert np.all(bounded.limits.max_mass >= least)
    # more is asked of the webs where more has to be fitted
    heavier = within_semicontinuous_reach(program, 2.0 * least)
    assert np.all(heavier.limits.max_mass >= bounded.limits.max_mass)
    # finite limits are left as they are
    statement = replace(program, limits=replace(program.limits, max_mass=np.full(least.shape, 20.0)))
    assert within_semicontinuous_reach(statement, least) is statement


@pytest.mark.parametrize("orders", ["first", pytest.param("all", marks=pytest.mark.nightly)])
@pytest.mark.parametrize("ceiling", [4200.0, 6000.0])
def test_a_web_in_the_reference_plane_carries_no_moment(orders: str, ceiling: float) -> None:
    """Independent: nothing is known to keep the ceiling at first, and the middle web has no influence on it."""
    rod = {"length_m": 0.4, "mass_kg": 3}

    def body(most: float | None) -> Body:
        throws = [
            {
                "position_m": 0.2 * (k - 1), "crank_radius_m": 0.1, "crank_angle_deg": 90 * k, "rotating_mass_kg": 5,
                "rows": [{"axis_deg": 90, "reciprocating_mass_kg": 15, "connecting_rod": rod}],
            }
            for k in range(3)
        ]  # fmt: skip
        webs = [
            {
                "name": f"w{k}", "position_m": position, "counterweight_radius_m": 0.15, "max_mass_kg": most,
                "min_fitted_mass_kg": 14,
            }
            for k, position in enumerate((-0.2, 0.0, 0.25))
        ]  # fmt: skip
        machine = {
            "kind": "reciprocating", "speed_rpm": 1000, "throws": throws, "webs": webs, "reference_plane_m": 0.0,
        }  # fmt: skip
        return {"machine": machine, "objective": {"orders": orders, "moment_ceiling_Nm": ceiling}}

    none, near = (optimized(body(most)).certificate for most in (None, 2e3))
    assert none is not None
    assert near is not None
    assert none.lower_bound is not None
    assert near.lower_bound is not None
    # some of these proofs stay open
    assert none.lower_bound <= near.objective * (1 + 1e-9)
    assert near.lower_bound <= none.objective * (1 + 1e-9)


def test_nothing_is_proven_of_a_response_that_nothing_bounds() -> None:
    """Analytic: in two planes of which one feels no moment, the other has to carry it, whatever the force."""
    none, free = np.full(2, np.inf), np.ones(2, bool)
    webs = Limits(np.ones(2), none, free, np.ones(2, complex), np.zeros(2), np.ones(2), np.array(np.inf))
    scalar = np.zeros(2, bool)
    influence = np.array([[1.0, 1.0], [0.0, 2.0]])
    assert carrying_mass(influence, webs, np.array([3.0, np.inf]), scalar) == np.inf
    assert carrying_mass(influence, webs, np.array([np.inf, 4.0]), scalar) == np.inf
    assert carrying_mass(influence, webs, np.array([3.0, 4.0]), scalar) == pytest.approx(7.0)
    # where both feel the same there is nothing else to carry
    assert carrying_mass(influence[:1], webs, np.array([3.0]), scalar) == 3.0
    sectors = replace(webs, free=~free, half_angle_cos=np.full(2, 0.5), half_angle_sin=np.full(2, np.sqrt(0.75)))
    assert carrying_mass(influence, sectors, np.array([3.0, np.inf]), scalar) == np.inf
    assert carrying_mass(influence, sectors, np.array([3.0, 4.0]), scalar) < np.inf


def test_groups_need_limits() -> None:
    body = fitted(0, None)
    machine = body["machine"]
    for web in machine["webs"]:
        web |= {"throw": 0, "min_fitted_mass_kg": 5.0, "counterweight_radius_m": 0.2}
    machine["web_groups"] = [{"name": "alike", "webs": [web["name"] for web in machine["webs"]]}]
    with pytest.raises(InvalidRequest) as refusal:
        check(OptimizeRequest, body)
    assert "the masses of all webs have a limit" in str([problem.message for problem in refusal.value.problems])


def _over_turn(seed: int, most: float | None, **objective: object) -> Body:
    """Three throws with rods, on whose webs even the lightest is heavier than any optimum of any masses."""
    throws = {
        17: ((290.4, 45, 12.24), (275.8, 90, 18.5), (100.2, 0, 11.22)),
        25: ((276.7, 0, 10.35), (313.8, 90, 16.84), (308.9, 45, 5.87)),
    }[seed]
    rod = {"length_m": 0.4, "mass_kg": 3}
    machine = {
        "kind": "reciprocating",
        "speed_rpm": 1000,
        "throws": [
            {
                "position_m": 0.2 * k, "crank_radius_m": 0.1, "crank_angle_deg": crank, "rotating_mass_kg": 5,
                "rows": [{"axis_deg": axis, "reciprocating_mass_kg": mass, "connecting_rod": rod}],
            }
            for k, (crank, axis, mass) in enumerate(throws)
        ],
        "webs": [
            {
                "name": f"w{k}", "position_m": 0.2 * k + 0.05 * (-1) ** k, "counterweight_radius_m": 0.15,
                "max_mass_kg": most, "min_fitted_mass_kg": 60 * (k + 1),
            }
            for k in range(3)
        ],
    }  # fmt: skip
    return {"machine": machine, "objective": {"orders": "all", **objective}}


# where nothing fitted keeps no ceiling, nothing is known to begin with
@pytest.mark.parametrize(
    ("seed", "objective"),
    [
        (17, {}),
        pytest.param(17, {"force_ceiling_N": 35_000}, marks=pytest.mark.nightly),
        pytest.param(25, {}, marks=pytest.mark.nightly),
        pytest.param(25, {"force_ceiling_N": 35_000}, marks=pytest.mark.nightly),
    ],
)
def test_limits_that_are_far_away_hold_the_best_choice_over_the_turn(seed: int, objective: Body) -> None:
    """Independent: 2,000 kg, of which the search needs no proof. Nothing fitted was "proven" to be best below 1e12."""
    _come_to_the_same([_over_turn(seed, most, **objective) for most in (2e3, 1e12, None)])


def test_no_limit_goes_with_scenarios() -> None:
    scenarios = [{"name": "as it is"}, {"name": "light", "changes": [{"path": "/machine/speed_rpm", "value": 700}]}]
    _come_to_the_same([{**fitted(3, most), "scenarios": scenarios} for most in (1e4, None)])


def _come_to_the_same(bodies: list[Body]) -> None:
    """All are optimal, and none is proven to be above what another reaches."""
    answers = [optimized(body) for body in bodies]
    assert [answer.status for answer in answers] == ["optimal"] * len(answers)
    proofs = [answer.certificate for answer in answers if answer.certificate is not None]
    least = min(proof.objective for proof in proofs)
    for proof in proofs:
        assert proof.lower_bound is not None
        assert proof.lower_bound <= least * (1 + 1e-9)
        assert proof.objective <= least * (1 + 2e-3)
