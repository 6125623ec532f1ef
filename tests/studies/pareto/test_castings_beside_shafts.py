"""Fronts of castings on the crankshaft beside any masses on balance shafts, and how many castings are worth it."""

import itertools
from copy import deepcopy
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from optimizer.studies.accuracy.measure import accuracy
from optimizer.studies.pareto.choice_search import ChoiceSearch
from service.report.chapters.counts import count_table
from tests.optimize.machines import web
from tests.optimize.shafts import WHOLE, at, shaft, single
from tests.studies.pareto.cases import ask, front

ARM = 0.3
#: one casting of 4 kg at the radius of the crank, opposite to it; the shaft in another plane takes up to 4 kg
CASTING = single([shaft("back", -1, ARM, 4.0)]) | {
    "webs": [web("a", 0.0, None, throw=0, catalogue_masses_kg=[4.0], hole_angles_deg=[270.0])]
}
FORCE = {"moment_weight": 0}


def forces(point: dict[str, Any]) -> tuple[float, float]:
    """Independent: force and couple of the first order, masses times accelerations."""
    turn = np.array([at(CASTING, point, theta, first=True) for theta in range(0, 360, 2)])
    force, moment = np.max(np.abs(turn), axis=0)
    return float(force), float(moment)


def test_force_and_moment_are_traded_by_the_shaft_alone() -> None:
    # analytic: beside the casting 1 of 5 kg is left that turns with the crank and 5 - m against it: F = 6 - m, M = m d
    pareto_front = front(CASTING, points=5)
    assert pareto_front.status == "optimal"
    assert len(pareto_front.points) == 5
    for point in pareto_front.points[:-1]:
        assert (point.total_mass_kg, point.counterweights[0].angle_deg) == (4.0, 270.0)
        assert point.force_peak_N + point.moment_peak_Nm / ARM == pytest.approx(0.6 * WHOLE, rel=2e-3)
        assert forces(point.model_dump()) == pytest.approx((point.force_peak_N, point.moment_peak_Nm), rel=2e-3)
    assert pareto_front.points[0].force_peak_N == pytest.approx(0.2 * WHOLE, rel=2e-3)
    # the shaft alone makes the moment, and without it the casting leaves the least force
    assert pareto_front.points[-1].moment_peak_Nm == pytest.approx(0.0, abs=1e-9 * WHOLE)
    assert pareto_front.points[-1].force_peak_N == pytest.approx(0.6 * WHOLE, rel=1e-6)
    assert pareto_front.ends is not None
    assert pareto_front.ends.force_at_smallest_moment_N == pareto_front.points[-1].force_peak_N
    assert pareto_front.points[-1].certificate.force_N == pytest.approx(0.6 * WHOLE, rel=1e-3)


def test_an_end_is_the_least_of_the_other_peak_though_time_ends_its_search(monkeypatch: pytest.MonkeyPatch) -> None:
    """Analytic: the same; the sum of both peaks proves nothing, and the end stays certified by its own peak."""
    search = ChoiceSearch.optimum

    def in_haste(self: ChoiceSearch, *places: Any, **fields: Any) -> Any:
        point = search(self, *places, **fields)
        if fields.get("combine") != "sum":
            return point
        proof = point.solution.certificate.model_copy(update={"lower_bound": None})
        return replace(point, solution=replace(point.solution, status="inaccurate", certificate=proof))

    monkeypatch.setattr(ChoiceSearch, "optimum", in_haste)
    pareto_front = front(CASTING, points=5)
    assert pareto_front.status == "optimal"
    last = pareto_front.points[-1]
    assert last.moment_peak_Nm == pytest.approx(0.0, abs=1e-9 * WHOLE)
    assert last.force_peak_N == pytest.approx(0.6 * WHOLE, rel=1e-6)
    assert last.certificate.relative_gap is not None
    assert last.certificate.relative_gap <= 1e-3


@pytest.mark.parametrize("orders", ["first", "all"])
def test_force_is_traded_for_the_mass_of_castings_and_shafts(orders: str) -> None:
    # analytic: a kilogram on either shaft takes a tenth of the first order of 10 kg
    (trade,) = ask(CASTING, points=5, responses=["force", "mass"], objective={"orders": orders} | FORCE).trades
    assert trade.status == "optimal"
    for point in trade.points:
        assert point.total_mass_kg in (0.0, 4.0)
        mass = point.total_mass_kg + point.balance_shafts_mass_kg
        assert point.values[1] == pytest.approx(mass, abs=1e-12)
        assert orders == "all" or point.values[0] == pytest.approx((1.0 - 0.1 * mass) * WHOLE, rel=2e-3)
    # the lightest is nothing, under a budget of nothing
    assert min(point.values[1] for point in trade.points) == pytest.approx(0.0, abs=1e-6)


def test_castings_are_counted_on_the_crankshaft_alone() -> None:
    # analytic: without a casting the shaft takes 4 of 10 kg, with it 8
    (count,) = ask(CASTING, counts={"of": "weights"}, objective=FORCE).counts
    assert [(point.at_most, point.weights) for point in count.points] == [(0, 0), (1, 1)]
    for point, left in zip(count.points, (0.6, 0.2), strict=True):
        assert point.value == pytest.approx(left * WHOLE, rel=1e-3)
        assert point.balance_shafts_mass_kg == pytest.approx(4.0, rel=1e-3)
        assert forces(point.model_dump())[0] == pytest.approx(point.force_peak_N, rel=2e-3)
    titles = [column.title for column in count_table(count).columns]
    assert {"mass on the crankshaft, kg", "on balance shafts, kg"} <= {*titles}


def test_the_least_mass_of_so_few_castings_is_that_of_all_shafts() -> None:
    # analytic: half of the 8 kg that may turn along y is enough for the ceiling, and the casting is of use to both
    goal = FORCE | {"force_ceiling_y_N": 0.6 * WHOLE}
    (count,) = ask(CASTING, counts={"of": "weights", "least": "mass"}, objective=goal).counts
    assert [point.status for point in count.points] == ["optimal"] * len(count.points)
    for point in count.points:
        assert point.value == pytest.approx(4.0, rel=1e-3)
        assert point.value == pytest.approx(point.total_mass_kg + point.balance_shafts_mass_kg, rel=1e-9)


def test_castings_on_the_shaft_have_a_front_of_sets() -> None:
    # analytic: of 10 kg along y each kilogram takes one, of 1, 2 or 4 kg on the shaft and 4 on the crankshaft
    body = deepcopy(CASTING)
    body["balance_shafts"][0]["webs"][0] |= {"catalogue_masses_kg": [1.0, 2.0, 4.0], "hole_angles_deg": [270.0, 30.0]}
    both = front(body, points=9)
    assert (both.status, both.reason) == ("optimal", "complete")
    values = [(point.force_peak_N / WHOLE, point.balance_shafts_mass_kg) for point in both.points]
    assert values == [(pytest.approx(0.6 - 0.1 * mass), mass) for mass in (4.0, 2.0, 1.0, 0.0)]
    (of_mass,) = ask(body, points=6, responses=["force", "mass"], objective=FORCE).trades
    assert [point.values[1] for point in of_mass.points] == [8.0, 6.0, 4.0, 2.0, 1.0, 0.0]
    assert [point.values[0] / WHOLE for point in of_mass.points] == pytest.approx([0.2, 0.4, 0.6, 0.8, 0.9, 1.0])
    (counts,) = ask(body, counts={"of": "weights"}, objective=FORCE).counts
    assert [(point.weights, point.status) for point in counts.points] == [
        (0, "optimal"),
        (1, "optimal"),
        (2, "optimal"),
    ]
    assert [point.value / WHOLE for point in counts.points] == pytest.approx([1.0, 0.6, 0.2])


def test_the_ladder_of_castings_counts_them_apart() -> None:
    answer = accuracy({"machine": CASTING, "objective": FORCE, "repeats": 1})
    assert answer.status == "measured"
    assert answer.reference is not None
    assert answer.reference.objective == pytest.approx(0.2 * WHOLE, rel=1e-3)
    for row in answer.choices_ladder:
        if row.skipped is None:
            assert (row.pieces, row.sizes, row.limits_kept) == (1, 1, True)
            assert row.total_mass_kg == pytest.approx(8.0, rel=2e-2)


@pytest.mark.parametrize("across", [{"x": 1.0, "y": 1.0}, {"x": 1.0, "y": 0.5}])
def test_the_ends_have_the_least_of_the_other_peak_of_all_sets(across: dict[str, float]) -> None:
    """Independent: every set of castings on crankshaft and shaft, by masses times accelerations at sampled angles."""
    body = deepcopy(CASTING)
    holes = {"catalogue_masses_kg": [1.0, 4.0], "hole_angles_deg": [270.0, 200.0, 90.0]}
    body["webs"].append(web("b", 0.2, None, throw=0, catalogue_masses_kg=[1.0, 3.0], hole_angles_deg=[270.0, 120.0]))
    body["balance_shafts"][0]["webs"][0] |= holes
    options = [
        [(0.0, 0.0), *((mass, angle) for mass in masses for angle in angles)]
        for masses, angles in (((4.0,), (270.0,)), ((1.0, 3.0), (270.0, 120.0)), ((1.0, 4.0), (270.0, 200.0, 90.0)))
    ]
    peaks = []
    for weights in itertools.product(*options):
        first, second, on_shaft = ({"mass_kg": mass, "angle_deg": angle} for mass, angle in weights)
        there = {"counterweights": [first, second], "balance_shafts": [{"counterweights": [on_shaft]}]}
        turn = np.array([at(body, there, theta, first=True) for theta in range(0, 360, 3)])
        peaks.append(np.max(np.abs(across["x"] * turn.real + 1j * across["y"] * turn.imag), axis=0))
    every = np.array(peaks)
    answer = front(body, points=9, objective={"direction_weights": across})
    assert answer.status == "optimal"
    for axis, point in ((0, answer.points[0]), (1, answer.points[-1])):
        reached = np.array([point.weighted_force_peak_N, point.weighted_moment_peak_Nm])
        near = every[:, axis] <= np.min(every[:, axis]) + 3e-3 * np.max(every[:, axis])
        least = np.min(every[near, 1 - axis])
        assert reached[1 - axis] == pytest.approx(least, abs=3e-3 * np.max(every[:, 1 - axis]))
