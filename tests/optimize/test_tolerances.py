"""Tolerances: the best worst case of counterweights and masses that are off, certified, and what it costs."""

import itertools
from copy import deepcopy
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from optimizer.program.optimum import optimum
from optimizer.solve import uncertain_program
from optimizer.solve.uncertain_program import scatter_of
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.request.scenarios import Tolerances
from tests.hard_turn.machines import twin
from tests.night import part
from tests.optimize.machines import random_machine
from tests.optimize.robust import answered, crank, scenario, six_rows, worst
from tests.optimize.whole_turn import ALONE, inline_six, single_throw


def test_what_mass_and_angle_may_make_of_a_counterweight() -> None:
    """Analytic: the farthest of the corners of a sector of a ring from its middle."""
    corners = [(1 + d) * np.exp(1j * np.deg2rad(a)) - 1 for d in (-0.02, 0.02) for a in (-2, 2)]
    assert scatter_of(Tolerances(mass_relative=0.02, angle_deg=2)).share == pytest.approx(max(map(abs, corners)))
    assert scatter_of(Tolerances(mass_relative=1, angle_deg=1e6)).share == pytest.approx(3.0)
    assert scatter_of(Tolerances(angle_deg=1e-9)).share == pytest.approx(np.deg2rad(1e-9), rel=1e-12)
    assert not any(scatter_of(Tolerances()))


def test_a_counterweight_that_is_off_leaves_its_error() -> None:
    """Analytic: |200 - u| + rho u is least where nothing is left but the error, and from rho = 1 on without any."""
    rho = np.hypot(0.02, 2 * np.sqrt(1.02) * np.sin(np.deg2rad(1.0)))
    answer = answered(crank(), objective={"moment_weight": 0}, tolerances={"mass_relative": 0.02, "angle_deg": 2})
    assert answer.status == "optimal"
    assert worst(answer) == pytest.approx(200.0 * rho, abs=4e-4)
    assert answer.counterweights[0].mass_kg == pytest.approx(20.0, rel=2e-6)
    answer = answered(crank(), objective={"moment_weight": 0}, tolerances={"angle_deg": 180})
    assert (worst(answer), answer.total_mass_kg) == (pytest.approx(200.0), 0.0)
    answer = answered(crank(), objective={"moment_weight": 0}, tolerances={"unbalance_kg_m": 0.05})
    assert worst(answer) == pytest.approx(5.0, abs=4e-4)
    assert answer.price_of_robustness is not None
    assert answer.price_of_robustness.nominal == pytest.approx(0.0, abs=4e-4)


def test_tolerances_of_nothing_are_none() -> None:
    machine = random_machine(5)
    plain, stated = answered(machine), answered(machine, tolerances={})
    assert stated.counterweights == plain.counterweights
    assert stated.certificate == plain.certificate
    assert plain.worst_case is None
    assert stated.worst_case is not None
    assert stated.residual.after is not None
    after = stated.residual.after
    assert (stated.worst_case.force_peak_N, stated.worst_case.moment_peak_Nm) == pytest.approx(
        (after.force.peak_N, after.moment.peak_Nm)
    )
    # the machine as the only scenario is the same program, found in another way
    listed = answered(machine, scenarios=[{"name": "as it is"}])
    assert plain.certificate is not None
    assert worst(listed) == pytest.approx(plain.certificate.objective, abs=1e-6 * plain.certificate.yardstick)
    assert listed.total_mass_kg == pytest.approx(plain.total_mass_kg, rel=1e-4)


@pytest.mark.parametrize("seed", part(2, range(4)))
def test_errors_in_the_worst_direction_come_to_the_worst_case_of_the_larger_peak_and_none_to_more(seed: int) -> None:
    """Independent: every counterweight off by its largest error, in the direction of what is left."""
    machine = random_machine(seed)
    objective = {"combine": "max", "force_weight": 1.0, "moment_weight": 0.7}
    answer = answered(machine, objective=objective, tolerances={"mass_relative": 0.03, "angle_deg": 3})
    assert answer.status == "optimal"
    share = scatter_of(Tolerances(mass_relative=0.03, angle_deg=3)).share
    radius = np.array([web["counterweight_radius_m"] for web in machine["webs"]])
    u = np.array([counterweight.x_kg_m + 1j * counterweight.y_kg_m for counterweight in answer.counterweights])
    rng, larger_peaks = np.random.default_rng(seed), []
    for way in range(3602):
        turns = rng.uniform(0, 2 * np.pi, u.size) if way >= 3600 else np.full(u.size, np.deg2rad(0.1 * way))
        for arms in (
            np.ones(u.size),
            np.sign([web["position_m"] - answer.reference_plane_m for web in machine["webs"]]),
        ):
            off = u + share * np.abs(u) * arms * np.exp(1j * turns)
            if way % 60 and way < 3600:
                continue
            larger_peaks.append(_larger_peak(machine, off, radius))
    assert max(larger_peaks) <= worst(answer) * (1 + 1e-12)
    assert max(larger_peaks) == pytest.approx(worst(answer), rel=2e-3)


def _larger_peak(machine: dict[str, Any], u: Any, radius: Any) -> float:
    fitted = [
        {"web": web["name"], "mass_kg": abs(unbalance) / r, "angle_deg": np.rad2deg(np.angle(unbalance))}
        for web, unbalance, r in zip(machine["webs"], u, radius, strict=True)
    ]
    after = analyze(AnalyzeRequest.model_validate({"machine": machine, "counterweights": fitted})).residual
    assert after is not None
    assert after.after is not None
    return float(max(after.after.force.peak_N, 0.7 * after.after.moment.peak_Nm))


def _scattered(machine: dict[str, Any], share: float) -> list[dict[str, Any]]:
    """The machine at every corner of what its reciprocating masses may be."""
    places = [(t, r) for t, throw in enumerate(machine["throws"]) for r in range(len(throw["rows"]))]
    values = []
    for signs in itertools.product([-1.0, 1.0], repeat=len(places)):
        variant = deepcopy(machine)
        for (t, r), sign in zip(places, signs, strict=True):
            variant["throws"][t]["rows"][r]["reciprocating_mass_kg"] *= 1.0 + sign * share
        values.append(variant)
    return values


@pytest.mark.parametrize("across", part(2, [{"x": 1, "y": 1}, {"x": 1, "y": 0.3}, {"x": 0, "y": 1}]))
def test_all_corners_of_the_masses_as_scenarios_are_their_scatter(across: dict[str, float]) -> None:
    """Independent: 2^6 machines analysed one by one, and given as scenarios where that is the same program."""
    rows = six_rows()
    objective = {"combine": "max", "moment_weight": 2.0, "direction_weights": across, "least_mass": False}
    answer = answered(rows, objective=objective, tolerances={"reciprocating_mass_relative": 0.08})
    assert answer.status == "optimal"
    fitted = [
        counterweight.model_dump(include={"web", "mass_kg", "angle_deg"}) for counterweight in answer.counterweights
    ]
    corners = [
        analyze(AnalyzeRequest.model_validate({"machine": fields, "counterweights": fitted})).residual
        for fields in _scattered(rows, 0.08)
    ]
    after = [corner.after for corner in corners if corner is not None and corner.after is not None]
    assert len(after) == 64
    assert answer.worst_case is not None
    assert answer.worst_case.force_peak_N == pytest.approx(max(order.force.peak_N for order in after), rel=1e-9)
    assert answer.worst_case.moment_peak_Nm == pytest.approx(max(order.moment.peak_Nm for order in after), rel=1e-9)
    if across["x"] == across["y"]:
        peaks = [max(order.force.peak_N, 2.0 * order.moment.peak_Nm) for order in after]
        assert worst(answer) == pytest.approx(max(peaks), rel=1e-9)
    listed = [
        scenario(
            str(n),
            **{
                f"throws__{t}__rows__{r}__reciprocating_mass_kg": machine["throws"][t]["rows"][r][
                    "reciprocating_mass_kg"
                ]
                for t in range(2)
                for r in range(3)
            },
        )
        for n, machine in enumerate(_scattered(rows, 0.08))
    ]
    # a request takes 32: the corners with the first row heavy, which the others mirror only in the scatter itself
    half = answered(rows, objective=objective, scenarios=listed[32:])
    assert worst(half) <= worst(answer) * (1 + 1e-9)


def test_a_sum_counts_every_peak_at_its_own_worst() -> None:
    rows = six_rows()
    answer = answered(rows, objective={"moment_weight": 2.0}, tolerances={"reciprocating_mass_relative": 0.08})
    assert answer.worst_case is not None
    assert worst(answer) == pytest.approx(
        answer.worst_case.force_peak_N + 2.0 * answer.worst_case.moment_peak_Nm, rel=1e-12
    )


def test_ceilings_hold_for_all_masses_and_errors() -> None:
    rows = six_rows()
    free = answered(rows, tolerances={"reciprocating_mass_relative": 0.05, "mass_relative": 0.02})
    assert free.worst_case is not None
    most = {"force_ceiling_N": 0.99 * free.worst_case.force_peak_N, "force_ceiling_x_N": free.worst_case.force_peak_N}
    answer = answered(rows, objective=most, tolerances={"reciprocating_mass_relative": 0.05, "mass_relative": 0.02})
    assert answer.status == "optimal"
    assert answer.worst_case is not None
    assert answer.worst_case.force_peak_N <= most["force_ceiling_N"] * (1 + 1e-9)
    assert answer.active_limits == ("force_ceiling",)


def test_bearings_in_the_worst_of_several_speeds_with_tolerances() -> None:
    """Metamorphic: between the optima of the highest speed alone, without errors, and its answer's worst case."""
    six, goal = inline_six(), {**ALONE, "bearing_weight": 1, "least_mass": False}
    two = [scenario("as it is"), scenario("slow", speed_rpm=0.7 * six["speed_rpm"])]
    alone = answered(six, objective=goal)
    assert alone.certificate is not None
    answer = answered(six, objective=goal, scenarios=two, tolerances={"mass_relative": 0.02, "angle_deg": 2})
    assert answer.status == "optimal"
    assert answer.worst_case is not None
    assert answer.worst_case.bearing_peak_N == pytest.approx(worst(answer), rel=1e-9)
    price = answer.price_of_robustness
    assert price is not None
    assert price.nominal_optimum == pytest.approx(alone.certificate.objective, rel=1e-6)
    assert alone.certificate.objective <= price.nominal + 1e-6 * alone.certificate.yardstick
    assert price.nominal <= worst(answer)
    assert worst(answer) <= (price.nominal_optimum_worst_case or 0.0) * (1 + 1e-9)
    assert answer.certificate is not None
    assert {term.scenario for term in answer.certificate.multipliers.objective.terms} == {"as it is", "slow"}


def test_the_bound_is_what_its_multipliers_prove_by_hand() -> None:
    """Independent: the formula of the documentation, with what a kilogram metre is off by as a cost."""
    machine = random_machine(2) | {"max_total_mass_kg": None}
    for web in machine["webs"]:
        web["sector"] = None
    answer = answered(machine, objective={"combine": "max", "moment_weight": 1.0}, tolerances={"mass_relative": 0.05})
    proof, omega = answer.certificate, machine["speed_rpm"] * np.pi / 30
    assert proof is not None
    assert proof.lower_bound is not None
    before = answer.residual.orders.before[0]
    pairs = {"force": before.force, "moment": before.moment}
    rows = {row.name: row.value for row in proof.multipliers.objective.rows}
    assert sum(rows.values()) == pytest.approx(1.0)
    bound = sum(rows[name] * abs(_complex(pairs[name].counter_rotating)) for name in pairs)
    slope, spread = np.zeros(len(machine["webs"]), complex), np.zeros(len(machine["webs"]))
    for term in proof.multipliers.objective.terms:
        arms = np.array([plane["position_m"] - answer.reference_plane_m for plane in machine["webs"]])
        arms = np.ones(arms.size) if term.response == "force" else arms
        y = term.x + 1j * term.y
        assert abs(y) <= rows[term.row]
        bound += (np.conj(y) * _complex(pairs[term.response].co_rotating)).real
        slope, spread = slope + omega**2 * arms * y, spread + 0.05 * omega**2 * np.abs(arms) * rows[term.row]
    most = np.array([plane["max_mass_kg"] * plane["counterweight_radius_m"] for plane in machine["webs"]])
    bound -= np.sum(most * np.maximum(np.abs(slope) - spread, 0.0))
    assert proof.lower_bound == pytest.approx(bound, rel=1e-9)
    assert 0 < proof.objective - bound <= 1.01e-6 * proof.yardstick


def _complex(phasor: Any) -> complex:
    first, second = [component for name, component in phasor.model_dump().items() if name.startswith(("real", "imag"))]
    return complex(first, second)


@pytest.mark.parametrize(
    ("tolerances", "field"),
    [
        ({"mass_relative": 1.01}, "mass_relative"),
        ({"reciprocating_mass_relative": 2}, "reciprocating_mass_relative"),
        ({"angle_deg": -1}, "angle_deg"),
        ({"unbalance_kg_m": -1}, "unbalance_kg_m"),
        ({"unbalance": 0}, "unbalance"),
    ],
)
def test_tolerances_that_are_none_are_refused_by_name(tolerances: dict[str, float], field: str) -> None:
    with pytest.raises(ValidationError, match=field):
        OptimizeRequest.model_validate({"machine": crank(), "tolerances": tolerances})


def test_scatter_of_masses_is_of_peaks() -> None:
    body = {"machine": single_throw(), "objective": {"bearing_weight": 1, "bearing_measure": "rms"}}
    with pytest.raises(ValidationError, match=r"of peaks only: .*bearing_measure rms"):
        OptimizeRequest.model_validate({**body, "tolerances": {"reciprocating_mass_relative": 0.01}})


@pytest.mark.parametrize("share", [0.05, 1.0])
def test_a_bearing_that_suits_the_heaviest_and_the_lightest_piston(share: float) -> None:
    """Analytic: circles of radius (1 +- p) m_rec/4 that meet in one point; the larger holds the smaller."""
    answer = answered(
        single_throw(), objective={**ALONE, "bearing_weight": 1}, tolerances={"reciprocating_mass_relative": share}
    )
    assert answer.status == "optimal"
    assert answer.worst_case is not None
    assert answer.certificate is not None
    assert worst(answer) == pytest.approx((1 + share) / 4, abs=1.01e-6 * answer.certificate.yardstick)
    assert answer.worst_case.bearing_peak_N == pytest.approx(worst(answer), rel=1e-9)
    assert answer.total_mass_kg == pytest.approx(1 + (1 + share) / 2, rel=1e-5)
    assert answer.price_of_robustness is not None
    # with u for the nominal masses the heavy piston's circle is beside the origin by p m_rec/4
    assert answer.price_of_robustness.nominal_optimum_worst_case == pytest.approx((1 + 2 * share) / 4, rel=1e-5)


@pytest.mark.parametrize(
    "objective", part(2, [{**ALONE, "bearing_weight": 1}, {"combine": "max", "orders": "all", "bending_weight": 2.0}])
)
def test_all_corners_of_the_masses_as_scenarios_are_their_scatter_over_the_turn(objective: dict[str, Any]) -> None:
    """Independent: the four corners of two masses, each a machine of its own."""
    actual_twin = twin(gas=True)
    listed = [
        scenario(
            str(n),
            **{
                f"throws__{t}__rows__0__reciprocating_mass_kg": throw["rows"][0]["reciprocating_mass_kg"]
                for t, throw in enumerate(machine["throws"])
            },
        )
        for n, machine in enumerate(_scattered(actual_twin, 0.1))
    ]
    for design in (actual_twin, *(fields for fields in _scattered(actual_twin, 0.1))):
        for design_throw in design["throws"]:
            design_throw["rows"][0]["connecting_rod"]["reciprocating_share"] = 0.0
    answer = answered(actual_twin, objective=objective, tolerances={"reciprocating_mass_relative": 0.1})
    corners = answered(actual_twin, objective=objective, scenarios=listed)
    assert (answer.status, corners.status) == ("optimal", "optimal")
    assert corners.certificate is not None
    assert worst(answer) == pytest.approx(worst(corners), abs=2e-6 * corners.certificate.yardstick)
    assert answer.total_mass_kg == pytest.approx(corners.total_mass_kg, rel=1e-3)
    assert answer.worst_case is not None
    assert corners.worst_case is not None
    assert answer.worst_case.force_peak_N == pytest.approx(corners.worst_case.force_peak_N, rel=1e-2)


def test_a_bearing_ceiling_that_only_some_masses_exceed_is_out_of_reach() -> None:
    """Analytic: the floor is (1 + p) m_rec/4."""
    body = {"objective": {"bearing_ceiling_N": 0.26}, "tolerances": {"reciprocating_mass_relative": 0.05}}
    answer = answered(single_throw(), **body)
    assert answer.status == "infeasible"
    assert answer.infeasibility is not None
    (first, _) = answer.infeasibility.smallest
    assert (first.ceiling_field, first.ceiling) == ("bearing_ceiling_N", 0.26)
    assert first.lower_bound <= 1.05 / 4 * (1 + 1e-9)
    assert first.smallest == pytest.approx(1.05 / 4, rel=1e-6)


@pytest.mark.parametrize(
    "tolerances",
    [
        {"mass_relative": 1e-12},
        {"unbalance_kg_m": 1e15},
        {"mass_relative": 1, "angle_deg": 1e6, "reciprocating_mass_relative": 1},
    ],
)
def test_tiny_and_huge_tolerances_are_answered(tolerances: dict[str, float]) -> None:
    answer = answered(six_rows(), tolerances=tolerances)
    assert answer.status == "optimal"
    assert answer.certificate is not None
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= worst(answer)


def test_a_limit_that_is_over_at_once_leaves_the_price_open_and_says_so() -> None:
    actual_twin, objective = twin(), {**ALONE, "bearing_weight": 1}
    tolerances = {"reciprocating_mass_relative": 1.0}
    answer = answered(actual_twin, objective=objective, tolerances=tolerances, accuracy={"time_limit_s": 1e-9})
    assert "before the nominal optimum of price_of_robustness" in answer.status_reason
    price, case = answer.price_of_robustness, answer.worst_case
    assert price is not None
    assert case is not None
    assert case.bearing_peak_N is not None
    assert (price.nominal_optimum, price.nominal_optimum_worst_case) == (None, None)
    assert 0.0 < price.nominal < case.objective
    # analytic: bearings alone count, so that the objective is the largest of their peaks
    assert case.bearing_peak_N == pytest.approx(case.objective, rel=1e-8)
    in_time = answered(actual_twin, objective=objective, tolerances=tolerances, accuracy={"time_limit_s": 30})
    assert "price_of_robustness" not in in_time.status_reason
    assert in_time.price_of_robustness is not None
    assert in_time.price_of_robustness.nominal_optimum is not None
    assert worst(in_time) <= case.objective * (1 + 1e-9)


def test_out_of_time_the_worst_masses_are_those_of_its_own_counterweights(monkeypatch: pytest.MonkeyPatch) -> None:
    """Independent: the peak at all corners of the masses, which the worst case lists by itself."""
    monkeypatch.setattr(uncertain_program, "optimum", lambda *posed: replace(optimum(*posed), timed_out=True))
    answer = answered(six_rows(), objective={"moment_weight": 0}, tolerances={"reciprocating_mass_relative": 0.1})
    assert answer.worst_case is not None
    assert worst(answer) == pytest.approx(answer.worst_case.force_peak_N, rel=1e-12)
