"""Fronts of any two or three responses: analytic lines, corners, what single optima say, and what is refused."""

from typing import Any

import numpy as np
import pytest

from optimizer.errors import MissingInput
from optimizer.optimize import optimize
from optimizer.studies.pareto import pareto as home
from schemas.front.pareto import ParetoAnswer, ParetoRequest
from schemas.front.trade import TradedFront
from schemas.request.requests import OptimizeRequest
from service.common.validation import InvalidRequest, check
from tests.studies.sweep.test_over_turn import opposed

#: a rotating mass with a web in its plane, and bearings to its left and right
ROTOR: dict[str, Any] = {
    "kind": "reciprocating",
    "speed_rpm": 3000 / np.pi,
    "throws": [{"position_m": 0.0, "crank_radius_m": 0.1, "crank_angle_deg": 0, "rotating_mass_kg": 10.0, "rows": []}],
    "webs": [{"name": "a", "position_m": 0.0, "counterweight_radius_m": 0.2, "max_mass_kg": 60}],
    "bearings": [{"name": "A", "position_m": -0.1}, {"name": "B", "position_m": 0.3}],
}


def ask(body: dict[str, Any], **more: Any) -> ParetoAnswer:
    return home.pareto(check(ParetoRequest, {**body, **more}))


def front(body: dict[str, Any], **more: Any) -> TradedFront:
    answer = ask(body, **more)
    (trade,) = answer.trades
    assert answer.fronts == ()
    assert trade.status == answer.status == "optimal"
    for point in trade.points:
        corner = np.array(point.certificate.corner, dtype=float)
        yardstick = np.array([response.yardstick for response in trade.responses])
        # property: nothing is claimed that the gap does not tell
        gap = point.certificate.relative_gap
        assert gap is not None
        assert np.all(np.array(point.values) - corner <= (gap + 1e-14) * yardstick)
    return trade


@pytest.mark.parametrize("response", ["force", "bearings", "bending"])
def test_a_rotating_mass_is_traded_for_iron_along_a_line(response: str) -> None:
    # analytic: omega = 100 rad/s, 1 kg m of which every kilogram of iron takes 0.2; by the lever rule 3/4 on bearing A,
    # and 3/4 * 0.1 m of bending
    share = {"force": 1.0, "bearings": 0.75, "bending": 0.075}[response]
    traded_front = front({"machine": ROTOR}, responses=[response, "mass"], points=4)
    values = np.array([point.values for point in traded_front.points])
    assert values[:, 0] == pytest.approx(share * 1e4 * (1.0 - 0.2 * values[:, 1]), abs=share * 0.05)
    assert values[[0, -1], 1] == pytest.approx([5.0, 0.0], abs=1e-4)
    assert [reply.unit for reply in traded_front.responses] == [
        {"force": "N", "bearings": "N", "bending": "N m"}[response],
        "kg",
    ]
    assert [point.beaten_by for point in traded_front.points] == [None] * 4


@pytest.mark.parametrize("responses", [["force", "mass"], ["objective", "mass"], ["force", "moment", "mass"]])
@pytest.mark.parametrize("catalogue", [False, True])
def test_without_webs_the_mass_is_nothing(responses: list[str], catalogue: bool) -> None:
    # regression: an internal fault, as a sum of no terms held no anchor
    machine = {**ROTOR, "webs": [], "catalogue": {"mass_step_kg": 1.0} if catalogue else None}
    traded_front = front({"machine": machine}, responses=responses, points=3)
    # analytic: omega = 100 rad/s and 1 kg m in the plane of moments, which is that of the throw
    there = {"force": 1e4, "objective": 1e4, "moment": 0.0, "mass": 0.0}
    for point in traded_front.points:
        assert point.values == pytest.approx([there[name] for name in responses], abs=1e-6)
    assert traded_front.reason == "reached_together"


def test_ends_are_the_single_optima() -> None:
    # independent: the optimum of one objective
    body = opposed()
    traded_front = front(body, responses=["bearings", "moment"], points=3)
    for response, weights in zip(
        traded_front.responses, ({"bearing_weight": 1.0}, {"moment_weight": 1.0}), strict=True
    ):
        objective = {"force_weight": 0.0, "moment_weight": 0.0, **weights}
        alone = optimize(OptimizeRequest.model_validate({"machine": body["machine"], "objective": objective}))
        assert response.smallest == pytest.approx(alone.certificate.objective, abs=2e-6 * response.yardstick)
        assert response.lower_bound <= alone.certificate.objective * (1.0 + 1e-9)
        assert response.without_counterweights == pytest.approx(alone.certificate.objective_without_counterweights)


def test_three_responses_make_a_triangle_whose_points_do_not_beat_each_other() -> None:
    traded_front = front(opposed(), responses=["bearings", "moment", "mass"], points=6)
    assert len(traded_front.points) == 6
    values = np.array([point.values for point in traded_front.points])
    for n, point in enumerate(traded_front.points):
        better = np.all(values <= values[n], axis=1) & np.any(values < values[n], axis=1)
        assert (point.beaten_by is not None) == np.any(better)
        assert point.values[2] == pytest.approx(point.total_mass_kg, abs=1e-9)


def test_force_and_moment_by_name_are_the_usual_front() -> None:
    body = opposed()
    named, (usual,) = front(body, responses=["force", "moment"], points=2), ask(body, points=2).fronts
    ends = usual.ends
    assert ends is not None
    assert [response.smallest for response in named.responses] == pytest.approx(
        [ends.smallest_force_N, ends.smallest_moment_Nm], rel=2e-6, abs=1e-6
    )


def test_budgets_and_ceilings_out_of_reach() -> None:
    answer = ask({"machine": ROTOR}, responses=["force", "bending"], points=2, total_mass_budgets_kg=[1, 2])
    # analytic: both fall together, by what the budget allows
    assert [trade.reason for trade in answer.trades] == ["reached_together"] * 2
    assert [trade.points[0].values[0] for trade in answer.trades] == pytest.approx([8000, 6000], abs=0.02)
    light = {**ROTOR, "max_total_mass_kg": 1.0}
    never = ask({"machine": light, "objective": {"bending_ceiling_Nm": 1.0}}, responses=["force", "mass"])
    assert (never.status, never.trades[0].points) == ("infeasible", ())
    assert never.trades[0].infeasibility is not None
    assert never.trades[0].infeasibility.conflict == ("bending_ceiling_Nm",)


@pytest.mark.parametrize(
    ("more", "path"),
    [
        ({"responses": ["force"]}, ("responses",)),
        ({"responses": ["force", "force"]}, ("responses", 1)),
        ({"responses": ["force", "mass"], "points": 101}, ("points",)),
        ({"responses": ["force", "mass"], "multipliers": True}, ("multipliers",)),
        ({"objective": {"bearing_weight": 1.0}}, ("objective", "bearing_weight")),
    ],
)
def test_what_is_refused(more: dict[str, Any], path: tuple[str | int, ...]) -> None:
    with pytest.raises(InvalidRequest) as refused:
        ask({"machine": ROTOR}, **more)
    assert [problem.path for problem in refused.value.problems] == [path]


def test_bearings_are_asked_for_in_the_name_of_the_objective() -> None:
    with pytest.raises(MissingInput, match="bearings"):
        ask({"machine": {**ROTOR, "bearings": []}}, responses=["bearings", "mass"])
