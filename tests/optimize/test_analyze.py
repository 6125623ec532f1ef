"""The machine as it stands, or with given counterweights."""

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.formulation.simulation import turns_over
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import AnalyzeRequest
from tests.optimize.machines import first_order, machine, random_machine, row, throw, web
from tests.verification.checking import optimized

OUTPUTS = ["residual", "hodograph", "orders", "stages"]


@pytest.mark.parametrize("seed", range(10))
def test_an_optimum_analysed_is_the_optimum(seed: int) -> None:
    body = random_machine(seed)
    answer = optimized({"machine": body, "outputs": OUTPUTS})
    weights = [
        counterweight.model_dump(include={"web", "mass_kg", "angle_deg"}) for counterweight in answer.counterweights
    ]
    again = analyze(
        AnalyzeRequest.model_validate({"machine": body, "counterweights": weights[::-1], "outputs": OUTPUTS})
    )
    assert again.residual == answer.residual
    assert again.hodograph == answer.hodograph
    assert again.orders == answer.orders
    assert again.stages == answer.stages
    assert again.floor == answer.floor
    assert again.counterweights == answer.counterweights
    assert again.total_mass_kg == pytest.approx(answer.total_mass_kg, rel=1e-14)


@pytest.mark.parametrize("seed", range(10))
def test_hodographs_follow_the_machine_over_the_turn(seed: int) -> None:
    body = random_machine(seed)
    weights = [{"web": plane["name"], "mass_kg": 3.0, "angle_deg": 50.0 * k} for k, plane in enumerate(body["webs"])]
    request = {"machine": body, "counterweights": weights, "outputs": ["hodograph"], "angles": {"step_deg": 7.5}}
    hodograph = analyze(AnalyzeRequest.model_validate(request)).hodograph
    assert hodograph.angle_deg == tuple(7.5 * k for k in range(48))
    for state, fitted in ((hodograph.before, []), (hodograph.after, weights)):
        force, moment = first_order(body, fitted, hodograph.angle_deg)  # independent
        scale = max(np.abs(force).max(), np.abs(moment).max()) + 1e-9
        np.testing.assert_allclose(np.array(state.force_x_N), force.real, atol=1e-12 * scale)
        np.testing.assert_allclose(np.array(state.force_y_N), force.imag, atol=1e-12 * scale)
        np.testing.assert_allclose(np.array(state.moment_x_Nm), moment.real, atol=1e-12 * scale)
        np.testing.assert_allclose(np.array(state.moment_y_Nm), moment.imag, atol=1e-12 * scale)


def test_counterweights_change_the_first_order_alone_and_fidelity_the_higher_ones() -> None:
    rod = {"length_m": 0.5, "mass_kg": 0.0}
    body = machine([throw(0.0, 0.0, [row(90.0, 20.0, connecting_rod=rod)])], [web("a", 0.1)])
    weights = [{"web": "a", "mass_kg": 10.0, "angle_deg": 180.0}]
    request = {"machine": body, "counterweights": weights, "outputs": ["orders"]}
    exact = analyze(AnalyzeRequest.model_validate(request)).orders
    assert [order.order for order in exact.before] == [1, 2, 4, 6]
    assert exact.before[1:] == exact.after[1:]
    assert exact.after[0].force.co_rotating.magnitude_N == pytest.approx(0.0, abs=1e-9)
    series = analyze(AnalyzeRequest.model_validate(request | {"fidelity": {"kinematics": "order_2"}})).orders
    first = series.before[0].force.peak_N
    # published: lam = 0.2, exact second harmonic 0.202038 (seed 004), series 0.2, then nothing
    assert exact.before[1].force.peak_N / first == pytest.approx(0.202038, abs=1e-6)
    assert series.before[1].force.peak_N / first == pytest.approx(0.2, rel=1e-12)
    assert [order.force.peak_N for order in series.before[2:]] == [0.0, 0.0]


def test_only_what_was_asked_for_is_answered() -> None:
    answer = analyze(AnalyzeRequest.model_validate({"machine": random_machine(2), "outputs": ["orders"]}))
    assert (answer.residual, answer.hodograph, answer.stages) == (None, None, None)
    ran = {name for name, use in answer.effects.items() if use.simulated}
    assert ran == {"rotating_inertia", "reciprocating_inertia", "second_order", "higher_orders"}
    assert {use.needed_by for name, use in answer.effects.items()} == {("orders",), ()}


@pytest.mark.parametrize(("needs", "turns"), [(["kinematics"], 1), (["gas"], 2), (["torque"], 2), ([], 1)])
def test_results_go_over_two_revolutions_only_where_they_hold_gas(needs: list[str], turns: int) -> None:
    """Of a pressure that repeats after two; what holds none of it repeats after one."""
    table = {"angle_deg": [0, 180, 360, 540, 720], "pressure_Pa": [9e5, 3e5, 1e5, 1e5, 9e5]}
    cylinder = {"bore_m": 0.1, "ambient_pressure_Pa": 1e5, "pressure": {"head": table, "cycle_turns": 2}}
    rod = {"length_m": 0.4, "mass_kg": 2.0}
    body = machine([throw(0.0, 0.0, [row(0.0, 3.0, connecting_rod=rod, cylinder=cylinder)])], [])
    assert turns_over(ReciprocatingMachine.model_validate(body), needs) == turns
