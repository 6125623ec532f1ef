"""Choices from what there is for goals over the whole turn: what trying every set comes to."""

from itertools import product
from typing import Any

import numpy as np
import pytest

from optimizer.choices.discrete.search import EXHAUSTED, TREE
from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from tests.night import at_night
from tests.optimize.choices import (
    DEGREE,
    FAST,
    HOLES,
    MASSES,
    SLOW,
    Loads,
    certified,
    chosen,
    every_set,
    request_body,
    twin,
    two_webs,
)
from tests.optimize.whole_turn import ALONE
from tests.studies.sweep.single import assert_row_is_the_single_answer, sweep, table
from tests.verification.checking import optimized


@pytest.mark.parametrize(
    "goal",
    [
        {"bearing_weight": 1, **ALONE},
        {"bearing_weight": 1, "force_weight": 0.5, "moment_weight": 2.0},
        {"bearing_weight": 1, "force_weight": 0.5, "moment_weight": 2.0, "combine": "max"},
    ],
)
def test_no_set_by_hand_is_better(goal: dict[str, Any]) -> None:
    """Independent: all 2,401 sets at 360 angles by statics."""
    machine = twin()
    optimum, proof = certified(request_body(machine, **goal))
    loads, (_, u) = Loads(machine), every_set(machine)

    def value(u: np.ndarray) -> np.ndarray:
        parts = [loads.peak(u)]
        if goal["force_weight"]:
            force, moment = loads.frame(u, optimum.reference_plane_m)
            parts += [0.5 * force, 2.0 * moment]
        return np.max(parts, axis=0) if goal.get("combine") == "max" else np.sum(parts, axis=0)

    least = float(np.min(value(u)))
    assert least * (1 - 1e-9) <= proof.objective <= least * (1 + DEGREE)
    assert proof.lower_bound is not None
    assert proof.lower_bound <= least * (1 + DEGREE)
    assert float(value(chosen(optimum))[0]) == pytest.approx(proof.objective, rel=DEGREE)
    assert proof.continuous_lower_bound is not None
    assert proof.continuous_lower_bound <= proof.lower_bound
    assert optimum.shadow_prices == ()
    assert {(counterweight.mass_kg, counterweight.angle_deg) for counterweight in optimum.counterweights} <= {
        (0.0, 0.0),
        *product(MASSES, HOLES),
    }


@at_night
def test_all_orders_and_bending() -> None:
    """Independent: every set of two webs by itself, as weights that are on the crank already."""
    machine = twin(catalogue={"masses_kg": [11.0]})
    del machine["webs"][1:3]
    goal = {"bearing_weight": 1, "bending_weight": 2.0, "moment_weight": 1.0, "orders": "all"}
    optimum, proof = certified(request_body(machine, **goal))
    values = []
    for choice in every_set(machine, [11.0])[0]:
        bare = {name: value for name, value in machine.items() if name != "catalogue"}
        places = [{k: web[k] for k in ("name", "position_m", "counterweight_radius_m")} for web in machine["webs"]]
        bare["webs"] = [
            place | {"fixed": {"mass_kg": mass, "angle_deg": angle}}
            for place, (mass, angle) in zip(places, choice, strict=True)
            if mass > 0
        ]
        bare["reference_plane_m"] = optimum.reference_plane_m
        alone = optimize(OptimizeRequest.model_validate(request_body(bare, **goal)))
        assert alone.certificate is not None
        values.append(alone.certificate.objective)
    assert proof.objective == pytest.approx(min(values), rel=1e-8)


def test_ceilings_and_counts() -> None:
    """Independent: of the sets of at most two weights that keep a ceiling on the bearings the least force."""
    machine = twin(max_counterweights=2)
    loads, (sets, u) = Loads(machine), every_set(machine)
    few = np.array([sum(mass > 0 for mass, _ in choice) <= 2 for choice in sets])
    peak = loads.peak(u[few])
    ceiling = float(np.sort(peak)[12]) * (1 + DEGREE)
    goal = {"moment_weight": 0, "bearing_ceiling_N": ceiling}
    optimum, proof = certified(request_body(machine, **goal))
    force, _ = loads.frame(u[few], optimum.reference_plane_m)
    assert proof.objective == pytest.approx(float(np.min(force[peak <= ceiling])), rel=DEGREE)
    assert sum(counterweight.mass_kg > 0 for counterweight in optimum.counterweights) <= 2
    # none at all keeps what is below the best by as much as a degree may leave out, nor would any mass
    none = optimized(request_body(machine, **goal | {"bearing_ceiling_N": float(np.min(peak)) * (1 - DEGREE)}))
    assert none.status == "infeasible"
    assert none.infeasibility is not None
    assert none.infeasibility.conflict == ("bearing_ceiling_N",)


def test_least_masses() -> None:
    """Independent: both of two webs fitted, one or none, by a fine grid of masses and angles."""
    machine = two_webs()
    optimum, proof = certified(request_body(machine, 1e-4, bearing_weight=1, **ALONE))
    assert all(
        counterweight.mass_kg == 0.0 or counterweight.mass_kg >= 14.0 for counterweight in optimum.counterweights
    )
    loads = Loads(machine)
    # closer and closer about the best, from a grid of all angles
    at, step = np.array([[15.0, 0.0], [15.0, 0.0]]), np.array([1.0, 180.0])
    for grid in (13, 5, 5, 5, 5, 5, 5, 5):
        entries = []
        for mass, angle in at:
            masses = (
                np.clip(mass + step[0] * np.linspace(-1, 1, 3), 14.0, 16.0) if grid == 5 else np.linspace(14, 16, 3)
            )
            angles = angle + step[1] * np.linspace(-1, 1, grid)
            entries.append([(0.0, 0.0), *product(masses.tolist(), angles.tolist())])
        sets = np.array(list(product(*entries)))
        u = sets[..., 0] * 0.12 * np.exp(1j * np.deg2rad(sets[..., 1]))
        values = loads.peak(u)
        least, at, step = float(np.min(values)), sets[np.argmin(values)], step * 0.5
    assert 0.99 * least <= proof.objective <= least * (1 + 1e-4)


def test_in_scenarios() -> None:
    """Independent: the worst of two speeds, by statics."""
    machine = twin()
    body = request_body(machine, bearing_weight=1, **ALONE) | {"scenarios": [FAST, SLOW]}
    optimum, proof = certified(body)
    _, u = every_set(machine)
    slow, fast = Loads(machine), Loads(machine | {"speed_rpm": 1300})
    worst = np.maximum(*(w * loads.peak(u) for w, loads in ((1.0, slow), (0.5, fast))))
    assert proof.objective == pytest.approx(float(np.min(worst)), rel=DEGREE)
    assert optimum.price_of_robustness is not None
    assert optimum.price_of_robustness.nominal_optimum is not None


def test_the_time_ends_it() -> None:
    body = request_body(twin(catalogue={"mass_step_kg": 0.1}), 1e-9, bearing_weight=1)
    answer = optimized(body | {"accuracy": {"relative_gap": 1e-9, "time_limit_s": 0.05}})
    assert answer.certificate is not None
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= answer.certificate.objective
    if answer.status == "inaccurate":
        assert "time_limit_s" in answer.status_reason


def test_of_an_ample_choice_it_says_that_nothing_closer_can_be_proven() -> None:
    machine = twin(catalogue={"mass_step_kg": 0.37, "angle_step_deg": 7.5})
    machine["webs"] = [{k: v for k, v in web.items() if k != "hole_angles_deg"} for web in machine["webs"]]
    body = request_body(machine, bearing_weight=1, **ALONE)
    answer = optimized(body | {"accuracy": {"relative_gap": 1e-9, "time_limit_s": 0.3}})
    assert answer.certificate is not None
    assert answer.status == "inaccurate"
    assert answer.certificate.lower_bound == answer.certificate.continuous_lower_bound
    assert "no closer bound was proven" in answer.status_reason


def test_rows_of_a_sweep() -> None:
    """Rows are the single answers (property)."""
    request = sweep(
        request_body(twin(), bearing_weight=1, **ALONE), {"path": "/machine/speed_rpm", "values": [900, 1100]}
    )
    rows = table(request).to_pylist()
    assert [assert_row_is_the_single_answer(request, row) for row in rows] == ["optimal"] * 2
    assert all(row["method"] in (EXHAUSTED, TREE) for row in rows)


def test_choices_of_a_machine_that_only_turns_have_a_cut_for_each_load() -> None:
    """Regression: every load had a cut at each of 24 angles, all of them equal, and a tree took nine times as long."""
    throws = [
        {"position_m": 0.2 * n, "crank_radius_m": 0.1, "crank_angle_deg": 90.0 * n, "rotating_mass_kg": 9.0, "rows": []}
        for n in range(2)
    ]
    masses = {"min_fitted_mass_kg": 10.0, "max_mass_kg": 20.0}
    webs = [
        {"name": f"w{n}", "throw": n, "position_m": 0.2 * n, "counterweight_radius_m": 0.1, **masses} for n in range(2)
    ]
    ends = [{"name": f"b{n}", "position_m": 0.4 * n - 0.1} for n in range(2)]
    machine = {"kind": "reciprocating", "speed_rpm": 600, "throws": throws, "webs": webs, "bearings": ends}
    answer = optimize({"machine": machine, "objective": {"force_weight": 0, "moment_weight": 0, "bearing_weight": 1}})
    assert answer.status == "optimal"
    assert answer.certificate is not None
    assert answer.certificate.cuts == 2
