"""The objective against the mass: of any masses, and of choices."""

import itertools
from typing import Any

import numpy as np
import pytest

from optimizer.optimize import optimize
from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoRequest
from schemas.front.trade import TradedFront
from service.common.validation import InvalidRequest, check, pointer

Machine = dict[str, Any]


def machine(**changes: Any) -> Machine:
    throws = [
        {"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": angle, "rotating_mass_kg": 9.0,
         "rows": [{"axis_deg": 0.0, "reciprocating_mass_kg": 14.0}]}
        for z, angle in ((-0.3, 0.0), (0.3, 90.0))
    ]  # fmt: skip
    webs = [
        {"name": str(n), "throw": n, "position_m": z, "counterweight_radius_m": 0.15, "max_mass_kg": 9.0}
        for n, z in ((0, -0.4), (1, 0.4))
    ]
    return {"kind": "reciprocating", "speed_rpm": 600, "throws": throws, "webs": webs, **changes}


STOCK = {"catalogue": {"masses_kg": [2.0, 4.0, 7.0], "angle_step_deg": 60}}


def front(fields: Machine, names: tuple[str, str] = ("objective", "mass"), **more: Any) -> TradedFront:
    body = {"machine": fields, "responses": names, "points": 6, "accuracy": {"relative_gap": 1e-6}, **more}
    (trade,) = pareto(body).trades
    return trade


@pytest.mark.parametrize("objective", [{}, {"combine": "max"}, {"moment_weight": 3.0, "force_weight": 0.5}])
def test_of_any_mass_each_point_is_the_optimum_of_its_budget(objective: dict[str, Any]) -> None:
    """Independent: /v1/optimize under the mass of the point as the budget."""
    traded_front = front(machine(), objective=objective)
    assert traded_front.status == "optimal"
    assert [response.unit for response in traded_front.responses] == ["as weighed", "kg"]
    for point in traded_front.points:
        value, mass = point.values
        alone = optimize({"machine": machine(max_total_mass_kg=mass), "objective": objective}).certificate
        assert alone is not None
        size = alone.yardstick
        assert value == pytest.approx(alone.objective, abs=3e-6 * size)
        assert mass == pytest.approx(point.total_mass_kg, rel=1e-12)
    masses = [point.values[1] for point in traded_front.points]
    assert masses == sorted(masses, reverse=True)


def sets() -> np.ndarray:
    """Objective and mass (N, 2) of all 19 x 19 choices, by hand (independent)."""
    square, span = (600 * np.pi / 30) ** 2, 0.8
    options = [0.0, *(m * 0.15 * np.exp(1j * np.pi / 3 * n) for m in (2.0, 4.0, 7.0) for n in range(6))]
    crank, z, lever = np.array([1.0, 1j]), np.array([-0.3, 0.3]), np.array([-0.4, 0.4])
    turning, counter = 0.1 * (9.0 + 7.0) * crank, 0.1 * 7.0 * np.conj(crank)
    values = []
    for option, second in itertools.product(options, repeat=2):
        u = np.array([option, second * 1j])
        force = abs(np.sum(turning) + np.sum(u)) + abs(np.sum(counter))
        moment = abs(np.sum(z * turning) + np.sum(lever * u)) + abs(np.sum(z * counter))
        values.append((square * (force + moment / span), (abs(option) + abs(second)) / 0.15))
    return np.array(values)


@pytest.mark.parametrize("names", [("objective", "mass"), ("mass", "objective")])
def test_of_choices_no_set_beats_a_point(names: tuple[str, str]) -> None:
    """Brute force over 361 sets; the corners too are below none."""
    traded_front, every = front(machine(**STOCK), names, points=8), sets()
    assert traded_front.status == "optimal"
    assert len(traded_front.points) > 3
    place = names.index("objective")
    size = traded_front.responses[place].yardstick
    for point in traded_front.points:
        figure, mass = point.values[place], point.values[1 - place]
        assert np.min(np.max(np.abs((every - (figure, mass)) / (size, 1.0)), axis=-1)) < 1e-9
        within = every[every[:, 1] <= mass * (1 + 1e-9)]
        assert figure <= np.min(within[:, 0]) + 1e-5 * size
        corner = point.certificate.corner[place]
        assert corner is not None
        assert corner <= np.min(within[:, 0]) + 1e-9 * size


@pytest.mark.parametrize(
    ("changes", "where"),
    [
        ({"responses": ["objective", "force"]}, "/responses"),
        ({"responses": ["objective", "mass", "bearings"]}, "/responses"),
        ({"responses": ["objective", "objective"]}, "/responses"),
        ({"responses": ["objective", "pieces"]}, "/responses/1"),
        ({"objective": {"bearing_weight": 1.0}}, "/objective/bearing_weight"),
        ({"objective": {"orders": "all"}}, "/objective/orders"),
        ({"objective": {"priorities": [{"goal": "external"}, {"goal": "mass"}]}}, "/objective/priorities"),
        ({"counts": {"of": "weights"}}, "/counts"),
    ],
)
def test_what_does_not_go_names_its_field(changes: dict[str, Any], where: str) -> None:
    body = {"machine": machine(), "responses": ["objective", "mass"], "points": 3} | changes
    with pytest.raises(InvalidRequest) as caught:
        check(ParetoRequest, body)
    assert where in [pointer(problem.path) for problem in caught.value.problems]
