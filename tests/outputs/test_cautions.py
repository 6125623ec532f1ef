"""Warnings, balance rates and the second order of the default answer: said where they are so, and only there."""

from typing import Any

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.optimize import optimize
from optimizer.outputs import peaks
from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from tests.analyze.driven import random_driven
from tests.builders import RADIUS, inline, machine, row, throw, web


def _optimized(design: ReciprocatingMachine, **rest: Any) -> OptimizeAnswer:
    return optimize(OptimizeRequest(machine=design, **rest))


def _codes(answer: OptimizeAnswer | AnalyzeAnswer) -> list[str]:
    return [caution.code for caution in answer.warnings]


def _four(**rest: Any) -> ReciprocatingMachine:
    webs = [web(f"{k}{side}", k + end) for k in range(4) for side, end in (("a", -0.2), ("b", 0.2))]
    return machine(*inline([0.0, 180.0, 180.0, 0.0], [0.0, 1.0, 2.0, 3.0]), webs=webs, **rest)


def test_an_inline_four_is_told_of_its_second_order_and_its_bare_crank() -> None:
    # analytic: 4 m r w^2 A_2 with A_2 = 0.2 + 0.2^3/4 + 15 0.2^5/128 + ..., and nothing of first order
    answer = _optimized(_four())
    assert _codes(answer) == ["second_order_remains", "bare_crank"]
    assert [rate.rate for rate in answer.balance_rate] == pytest.approx([0.0] * 4, abs=1e-6)
    first, second = answer.residual.orders.after
    assert first.force.peak_N == answer.residual.after.force.peak_N
    assert second.force.peak_N == pytest.approx(
        4 * 10 * RADIUS * 50.0**2 * (0.2 + 0.2**3 / 4 + 15 * 0.2**5 / 128), rel=1e-5
    )
    assert second == answer.residual.orders.before[1]
    assert answer.warnings[1].pointer == "/objective"


def test_without_rods_the_second_order_is_null_and_nothing_is_said_of_it() -> None:
    bare = machine(throw(0.0, row(0.0).model_copy(update={"connecting_rod": None}), rotating_kg=5.0))
    answer = _optimized(bare)
    assert answer.residual.orders.before[1] is None
    assert answer.residual.orders.after[1] is None
    assert _codes(answer) == []


def test_a_balanced_crank_is_not_told_that_it_is_bare() -> None:
    # analytic: rotating mass alone, balanced opposite the crank
    answer = _optimized(machine(throw(30.0, rotating_kg=8.0), webs=[web("a", -0.1), web("b", 0.1)]))
    assert _codes(answer) == []
    (rate,) = answer.balance_rate
    assert (rate.rate, rate.sideways) == pytest.approx((1.0, 0.0), abs=1e-6)


def test_a_horizontal_machine_is_told_that_it_will_jump() -> None:
    # analytic: the half of the reciprocating mass that is balanced comes back across
    answer = _optimized(machine(throw(0.0, row(0.0), rotating_kg=1.0), webs=[web("a", 0.0)]))
    cautions = [caution for caution in answer.warnings if caution.code == "component_grows"]
    assert [caution.pointer for caution in cautions] == ["/objective/direction_weights/y"]


def test_a_far_web_decides_the_span_only_where_the_weight_is_not_given() -> None:
    design = machine(
        throw(0.0, rotating_kg=5.0), throw(90.0, z=1.0, rotating_kg=5.0), webs=[web("near", 0.0), web("flywheel", 4.0)]
    )
    assert "span_of_a_far_web" in _codes(_optimized(design))
    (actual_caution,) = (caution for caution in _optimized(design).warnings if caution.code == "span_of_a_far_web")
    assert actual_caution.pointer == "/machine/webs/1/position_m"
    assert "span_of_a_far_web" not in _codes(_optimized(design, objective={"moment_weight": 1.0}))


def test_bearing_loads_that_counterweights_raise_are_told() -> None:
    # analytic: a counterweight in line with its crank adds to what the bearings carry
    design = machine(
        throw(0.0, rotating_kg=5.0),
        webs=[web("a", -0.1), web("b", 0.1)],
        bearings=[{"name": "A", "position_m": -0.5}, {"name": "B", "position_m": 0.5}],
    )

    def loaded(angle_deg: float) -> AnalyzeAnswer:
        fitted = [{"web": name, "mass_kg": 1.0, "angle_deg": angle_deg} for name in ("a", "b")]
        body = {"machine": design.model_dump(), "counterweights": fitted, "outputs": ["main_bearings"]}
        return analyze(AnalyzeRequest.model_validate(body))

    # twice each: above the bare crank, and above the customary one, which carries nothing
    assert _codes(loaded(0.0)) == ["bearing_load_grows"] * 2 + ["bending_moment_grows"] * 2
    assert _codes(loaded(180.0)) == ["bearing_load_grows", "bending_moment_grows"]


def test_figures_of_warnings_have_no_exponent() -> None:
    # analytic: half of 10 kg at 0.1 m and 50 rad/s comes back across, here ten thousand times as heavy
    design = machine(throw(0.0, row(0.0, mass_kg=1e5)), webs=[web("a", 0.0, max_mass_kg=1e6)])
    (actual_caution,) = (caution for caution in _optimized(design).warnings if caution.code == "component_grows")
    assert str(round(1e5 / 2 * RADIUS * 50.0**2)) in actual_caution.message


def test_a_ceiling_of_specific_loads_looks_at_the_bearings_too() -> None:
    bearings = [{"name": n, "position_m": z, "diameter_m": 0.1, "length_m": 0.1} for n, z in (("A", -1.0), ("B", 4.0))]
    answer = _optimized(_four(bearings=bearings), objective={"specific_load_ceiling_Pa": 1e9})
    assert "bare_crank" not in _codes(answer)


def test_rows_without_cylinders_are_told_where_gas_would_count() -> None:
    design = machine(throw(0.0, row(0.0)), throw(180.0, row(0.0), z=1.0))
    body = {"machine": design.model_dump(), "outputs": ["torque"]}
    (warning,) = analyze(AnalyzeRequest.model_validate(body)).warnings
    assert (warning.code, warning.pointer) == ("no_gas", "/machine/throws/0/rows/0/cylinder")
    assert warning.message.startswith("2 rows")
    assert analyze(AnalyzeRequest.model_validate({**body, "outputs": ["kinematics"]})).warnings == ()


TURNING = ["rod_loads", "torque", "main_bearings", "piston_force", "overturning"]


def test_peaks_that_are_left_open_are_told_and_those_that_are_closed_are_not(monkeypatch: pytest.MonkeyPatch) -> None:
    # analytic: where a tenth will do, brackets stay as wide as the first pieces leave them
    body = AnalyzeRequest.model_validate({"machine": random_driven(3), "outputs": TURNING})
    assert "peak_not_closed" not in _codes(analyze(body))
    monkeypatch.setattr(peaks, "TOLERANCE", 0.1)
    answer = analyze(body)
    messages = [caution.message for caution in answer.warnings if caution.code == "peak_not_closed"]
    assert {message.split()[3] for message in messages} == set(TURNING)
    low, high = answer.torque.peak_bracket_Nm
    assert high > low * (1.0 + 1e-6)
    actual_message = next(message for message in messages if "torque" in message)
    assert [float(word) for word in actual_message.split()[10:13:2]] == pytest.approx([low, high], rel=1e-6)
    assert "e+" not in actual_message


def test_a_peak_that_cancels_is_no_open_one() -> None:
    # analytic: opposed pistons in one plane load their pins alike and oppositely, and the bearings with rounding
    throws = [throw(angle, row(angle, length_m=1.0)) for angle in (33.0, 213.0)]
    bearings = [{"name": "A", "position_m": -1.0}, {"name": "B", "position_m": 4.0}]
    design = machine(*throws, bearings=bearings)
    answer = analyze(AnalyzeRequest.model_validate({"machine": design.model_dump(), "outputs": ["main_bearings"]}))
    low, high = answer.main_bearings.bearings[0].before.peak_bracket_N
    assert high > low * (1.0 + 1e-6)
    # as wide as of a peak of a thousandth of the loads of one piston, and no wider
    single = machine(throws[0], bearings=bearings).model_dump()
    load = analyze(AnalyzeRequest.model_validate({"machine": single, "outputs": ["main_bearings"]})).main_bearings
    size = sum(bearing.before.peak_N for bearing in load.bearings)
    assert high - low <= 4e-12 * size
    assert _codes(answer) == ["no_gas"]


def test_an_infeasible_answer_has_no_rates() -> None:
    answer = _optimized(_four(), objective={"moment_ceiling_Nm": 1e-3, "force_ceiling_N": 1e9})
    assert answer.status in ("optimal", "infeasible")
    never = machine(throw(0.0, row(0.0)), webs=[web("a", 0.0)])
    answer = _optimized(never, objective={"force_ceiling_N": 1.0})
    assert answer.status == "infeasible"
    assert answer.balance_rate == ()
    assert answer.residual.orders.after is None
    assert np.isfinite(answer.residual.orders.before[1].force.peak_N)
