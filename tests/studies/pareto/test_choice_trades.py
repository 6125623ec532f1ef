"""Fronts of named responses where counterweights are chosen or heavy enough; every set by hand."""

from typing import Any

import numpy as np
import pytest

from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoRequest
from schemas.front.trade import TradedFront
from tests.hard.cases.case import Body
from tests.night import every
from tests.studies.pareto.test_counts import Sets, body, every_set
from tests.studies.pareto.test_trades import ROTOR

STEP_DEG, MASSES = 45.0, (7.5, 16.0)


@pytest.fixture(scope="module")
def sets() -> Sets:
    """Independent: 83,521 sets."""
    return every_set(STEP_DEG, MASSES)


def front(request: Body) -> TradedFront:
    (trade,) = pareto(ParetoRequest.model_validate(request)).trades
    return trade


def columns(sets: Sets, names: tuple[str, ...]) -> np.ndarray:
    """(D, sets)"""
    return np.array([{"force": sets.force, "moment": sets.moment, "mass": sets.mass}[name] for name in names])


@pytest.mark.parametrize("names", [("force", "mass"), ("moment", "force"), ("force", "moment", "mass")])
def test_no_set_is_below_a_corner_or_beats_a_point(sets: Sets, names: tuple[str, ...]) -> None:
    traded_front, every = front(body(STEP_DEG, MASSES, responses=names, points=6)), columns(sets, names)
    assert traded_front.status == "optimal"
    assert len(traded_front.points) >= 3
    for i, response in enumerate(traded_front.responses):
        assert response.lower_bound == pytest.approx(np.min(every[i]), rel=1e-9, abs=1e-9)
        assert response.smallest == pytest.approx(np.min(every[i]), rel=1e-9, abs=1e-9)
    for point in traded_front.points:
        corner, values = np.array(point.certificate.corner, dtype=float), np.array(point.values)
        assert not np.any(np.all(every < corner[:, None] * (1.0 - 1e-9), axis=0))
        assert not np.any(np.all(every < values[:, None] * (1.0 - 1e-9), axis=0))
        # it is one of the sets
        near = np.abs(every - values[:, None]) <= 1e-9 * np.max(every, axis=1)[:, None]
        assert np.any(np.all(near, axis=0))
        assert point.certificate.relative_gap is not None
        over = (values - corner) / [reply.yardstick for reply in traded_front.responses]
        assert point.certificate.relative_gap == pytest.approx(max(np.max(over), 0.0), abs=1e-12)
        assert point.beaten_by is None


def test_ceilings_hold_for_the_lightest_as_well(sets: Sets) -> None:
    force, moment, mass = columns(sets, ("force", "moment", "mass"))
    most = 8e3
    traded_front = front(
        body(STEP_DEG, MASSES, responses=("moment", "mass"), points=4, objective={"force_ceiling_N": most})
    )
    mask = force <= most
    least = traded_front.responses[1]
    # independent: the lightest set that keeps the ceiling; what is proven is nearer to it than the next mass
    assert least.smallest == np.min(mass[mask])
    assert np.min(mass[mask]) - 0.1 < least.lower_bound <= np.min(mass[mask])
    for point in traded_front.points:
        corner = np.array(point.certificate.corner, dtype=float)
        assert not np.any(mask & (moment < corner[0] * (1.0 - 1e-9)) & (mass < corner[1] * (1.0 - 1e-9)))
        assert point.force_peak_N <= most * (1.0 + 1e-9)


def test_ceilings_out_of_reach_are_told() -> None:
    traded_front = front(body(STEP_DEG, MASSES, responses=("moment", "mass"), objective={"force_ceiling_N": 1.0}))
    assert (traded_front.status, traded_front.points) == ("infeasible", ())
    assert traded_front.infeasibility is not None
    assert traded_front.infeasibility.conflict == ("force_ceiling_N",)


def test_bearing_loads_are_traded_for_whole_weights() -> None:
    # analytic: of 1e4 N on the shaft every kilogram takes 0.2, and 3/4 of the rest are on bearing A by the lever rule
    machine: Body = {**ROTOR, "catalogue": {"masses_kg": [1, 2, 3, 4, 5, 6], "angle_step_deg": 45}}
    traded_front = front({"machine": machine, "responses": ["bearings", "mass"], "points": 6})
    values = np.array([point.values for point in traded_front.points])
    assert traded_front.status == "optimal"
    assert values[:, 1].tolist() == [5, 4, 3, 2, 1, 0]
    assert values[:, 0] == pytest.approx(7.5e3 * (1.0 - 0.2 * values[:, 1]), abs=1e-6)


def test_heavy_enough_or_not_there() -> None:
    # analytic: 3 kg or more of 5 kg that are worth it, or none
    machine: Body = {**ROTOR, "webs": [{**ROTOR["webs"][0], "min_fitted_mass_kg": 3.0}]}
    traded_front = front({"machine": machine, "responses": ["force", "mass"], "points": 6})
    values = np.array([point.values for point in traded_front.points])
    assert traded_front.status == "optimal"
    assert np.all((values[:, 1] == 0.0) | (values[:, 1] > 3.0 - 1e-9))
    # the budgets between hold nothing but the bare shaft
    assert values[:, 0] == pytest.approx(1e4 * (1.0 - 0.2 * values[:, 1]), abs=5.0)
    assert values[-1].tolist() == pytest.approx([1e4, 0.0])


@pytest.mark.parametrize("names", every(2, [("force", "bearings"), ("force", "bending", "mass"), ("moment", "mass")]))
def test_a_fixed_weight_is_an_unbalance_of_the_shaft(names: tuple[str, ...]) -> None:
    """Metamorphic: the same front as with its unbalance, but for the mass."""
    mass, angle = 5.0, np.radians(200.0)

    def weighted_body(**fields: Any) -> Body:
        request = body(STEP_DEG, responses=names, points=3)
        machine = request["machine"]
        del machine["catalogue"], request["accuracy"]
        machine["bearings"] = [{"name": "A", "position_m": -0.6}, {"name": "B", "position_m": 0.6}]
        for throw in machine["throws"]:
            throw["rows"][0]["connecting_rod"] = {"length_m": 0.5}
        machine["webs"][1] |= fields
        return request

    with_it, without = weighted_body(fixed={"mass_kg": mass, "angle_deg": 200.0}), weighted_body(max_mass_kg=0.0)
    web = without["machine"]["webs"][1]
    size, place = mass * web["counterweight_radius_m"], web["position_m"]
    by = {"x_kg_m": size * float(np.cos(angle)), "y_kg_m": size * float(np.sin(angle))}
    without["machine"]["unbalances"] = [{"name": "weight", "position_m": place, **by}]
    traded_front, second_front = front(with_it), front(without)
    heavier = np.array([mass if name == "mass" else 0.0 for name in names])
    assert (traded_front.status, second_front.status) == ("optimal", "optimal")
    for here, there in zip(traded_front.responses, second_front.responses, strict=True):
        more = mass if here.response == "mass" else 0.0
        assert here.lower_bound == pytest.approx(there.lower_bound + more, abs=2e-6 * there.yardstick)
    for point, like in zip(traded_front.points, second_front.points, strict=True):
        close = 2e-6 * np.array([response.yardstick for response in second_front.responses])
        assert np.all(np.abs(np.array(point.values) - np.array(like.values) - heavier) <= close)
        assert point.total_mass_kg == pytest.approx(like.total_mass_kg + mass, abs=1e-4)
        assert (point.counterweights[1].fixed, point.counterweights[1].mass_kg) == (True, mass)
