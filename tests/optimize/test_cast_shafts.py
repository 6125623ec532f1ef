"""Castings on balance shafts, beside any masses or castings on the crankshaft."""

from itertools import product
from typing import Any

import numpy as np
import pytest

from schemas.request.requests import OptimizeRequest
from service.common.validation import InvalidRequest, check
from tests.night import part
from tests.optimize.machines import throw, web
from tests.optimize.shafts import WHOLE, at, shaft, single
from tests.optimize.test_catalogue_shafts import FORCE, answer, proof_of
from tests.verification.checking import sound_answer


def cast_shaft(angle_deg: float = 265.0, **more: Any) -> dict[str, Any]:
    """A shaft that turns backwards with castings of 9 kg at half the radius."""
    own = {"catalogue_masses_kg": [9.0, 13.0], "hole_angles_deg": [angle_deg, 90.0]}
    return shaft("back", -1, radius=0.05, max_mass=50.0, **own, **more)


def test_castings_on_a_shaft_beside_any_masses_on_the_crankshaft() -> None:
    # analytic: of 10 kg at half the radius 9 kg at 5 degrees from where they are called for leave |10 - 9 e^{j5}| / 20;
    # along the crank nothing is left
    machine = single([cast_shaft()], webs=2)
    optimum = sound_answer({"machine": machine, "objective": FORCE})
    left = abs(10.0 - 9.0 * np.exp(1j * np.deg2rad(5.0))) / 20.0
    assert proof_of(optimum).objective == pytest.approx(left * WHOLE, rel=3e-5)
    (counterweight,) = optimum.balance_shafts[0].counterweights
    assert (counterweight.mass_kg, counterweight.angle_deg) == (9.0, pytest.approx(265.0, abs=1e-9))
    assert optimum.total_mass_kg == pytest.approx(5.0, rel=1e-5)


@pytest.mark.parametrize("orders", ["first", "all"])
@pytest.mark.parametrize("rotation", part(2, ["cw", "ccw"]))
def test_castings_on_all_shafts_are_the_best_of_all_sets(orders: str, rotation: str) -> None:
    # independent: all sets, by forces from the definitions at every second degree
    machine = single([cast_shaft(250.0)], webs=1) | {"rotation": rotation}
    machine["webs"][0] |= {"hole_angles_deg": [240.0, 280.0], "max_mass_kg": 20.0}
    machine["catalogue"] = {"masses_kg": [3.0, 5.5]}
    optimum = answer(
        machine, {"orders": orders, "moment_weight": 0}, accuracy={"relative_gap": 1e-6, "time_limit_s": 20}
    )
    best = np.inf
    crank = [(0.0, 0.0), *product([3.0, 5.5], [240.0, 280.0])]
    on_shaft = [(0.0, 0.0), *product([9.0, 13.0], [250.0, 90.0])]
    for own, pair in product(crank, on_shaft):
        of = [[{"mass_kg": mass, "angle_deg": angle}] for mass, angle in (own, pair)]
        body = {"counterweights": of[0], "balance_shafts": [{"counterweights": of[1]}]}
        turn = [abs(at(machine, body, theta, first=orders == "first")[0]) for theta in range(0, 360, 2)]
        best = min(best, max(turn))
    assert optimum.status == "optimal"
    assert best * (1 - 1e-9) <= proof_of(optimum).objective <= best * 1.001


def test_steps_of_angle_count_from_the_x_axis_on_a_shaft() -> None:
    machine = single([shaft("back", -1, radius=0.05, max_mass=50.0, catalogue_masses_kg=[10.0])], webs=1)
    machine["webs"][0] |= {"max_mass_kg": 20.0}
    machine["catalogue"] = {"masses_kg": [5.0], "angle_step_deg": 90}
    optimum = answer(machine, FORCE)
    # analytic: both halves are there
    assert proof_of(optimum).objective == pytest.approx(0.0, abs=1e-9 * WHOLE)
    assert optimum.balance_shafts[0].counterweights[0].angle_deg == 270.0


def test_counts_are_of_castings_wherever_they_are() -> None:
    machine = single([cast_shaft(270.0)], webs=2, max_counterweights=1)
    machine["webs"] = [web(name, 0.0, 20.0) for name in ("a", "b")]
    machine["catalogue"] = {"masses_kg": [2.5, 5.0], "angle_step_deg": 90}
    optimum = answer(machine, FORCE)
    counterweights = [*optimum.counterweights, *optimum.balance_shafts[0].counterweights]
    # analytic: 5 kg on the crankshaft leave what turns backwards, and are better by a tenth than 9 kg on the shaft
    assert [counterweight.mass_kg for counterweight in counterweights if counterweight.mass_kg > 0] == [5.0]
    assert proof_of(optimum).objective == pytest.approx(0.5 * WHOLE, rel=1e-9)


@pytest.mark.parametrize(
    ("fields", "change", "path"),
    [
        ({}, {"hole_angles_deg": None}, ("balance_shafts", 0, "webs", 0, "hole_angles_deg")),
        ({}, {"catalogue_masses_kg": None}, ("balance_shafts", 0, "webs", 0, "catalogue_masses_kg")),
        ({"web_groups": [{"name": "pair", "webs": ["a", "b"]}]}, {}, ("web_groups",)),
    ],
)
def test_what_castings_on_shafts_lack_is_named(
    fields: dict[str, Any], change: dict[str, Any], path: tuple[object, ...]
) -> None:
    machine = single([cast_shaft()], webs=2) | fields
    machine["webs"] = [web(name, 0.0, 20.0, throw=0) for name in ("a", "b")]
    machine["balance_shafts"][0]["webs"][0] |= change
    with pytest.raises(InvalidRequest) as refused:
        check(OptimizeRequest, {"machine": machine})
    assert [problem.path for problem in refused.value.problems] == [("machine", *path)]


def test_a_choice_may_use_the_tolerance_of_a_ceiling() -> None:
    """Regression: a choice above a ceiling by its tolerance comes to less than what keeps it, which is no fault."""
    castings = {"catalogue_masses_kg": [1.0, 2.0], "hole_angles_deg": [0, 90, 180, 270]}
    machine = {
        "kind": "reciprocating",
        "speed_rpm": 1e5,
        "throws": [throw(0.0, 180.0, [], rotating=5.76) | {"crank_radius_m": 1e3}],
        "webs": [{"name": "a", "position_m": -500.0, "counterweight_radius_m": 500.0, "max_mass_kg": None}],
        "balance_shafts": [shaft("b", -2, -490.0, 4.0, x_m=1e3, y_m=3e3, radius=500.0, **castings)],
    }
    goal = {"roll_weight": 1e-4, "force_weight": 1e-9, "moment_weight": 1e-4, "force_ceiling_x_N": 0.0}
    optimum = sound_answer({"machine": machine, "objective": goal})
    assert optimum.status == "optimal"
    # analytic: what turns is taken in another plane
    assert optimum.counterweights[0].mass_kg == pytest.approx(11.52, rel=1e-8)
