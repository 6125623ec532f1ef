"""Rows of a sweep where something may be off: each as the answer to its design alone."""

import json
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service.common.validation import InvalidRequest
from service.verification import checker
from tests.hard_turn.machines import twin
from tests.optimize.machines import random_machine
from tests.optimize.robust import crank
from tests.studies.pareto.cases import four_webs
from tests.studies.sweep.single import assert_row_is_the_single_answer, sweep, table

OFF = {"mass_relative": 0.02, "angle_deg": 2.0}
MACHINES = settings(max_examples=settings.default.max_examples // 6, deadline=None)


def test_a_counterweight_that_is_off_leaves_its_error() -> None:
    """Analytic: of 200 N nothing is left but 200 N times the error; nominal nothing is left at all."""
    base = {"machine": crank(), "objective": {"moment_weight": 0}, "tolerances": {}}
    shares = [0.0, 0.01, 0.05]
    rows = table(sweep(base, {"path": "/tolerances/mass_relative", "values": shares})).to_pylist()
    assert [row["status"] for row in rows] == ["optimal"] * 3
    for row, share in zip(rows, shares, strict=True):
        assert row["/tolerances/mass_relative"] == share
        assert row["worst_case_force_peak_N"] == pytest.approx(200.0 * share, abs=1e-3)
        assert row["objective"] == pytest.approx(200.0 * share, abs=1e-3)
        assert row["nominal_objective"] == pytest.approx(0.0, abs=1e-3)
        assert row["nominal_optimum_worst_case"] == pytest.approx(200.0 * share, abs=1e-3)
        assert row["mass_kg.a"] == pytest.approx(20.0, rel=1e-5)


def test_an_angle_with_its_unit_and_an_unbalance() -> None:
    """Analytic: 0.05 kg m at 10 rad/s are 5 N; an angle of 60 degrees is an error of 1, so that nothing is gained."""
    base = {"machine": crank(), "objective": {"moment_weight": 0}, "tolerances": {"unbalance_kg_m": 0.05}}
    rows = table(sweep(base, {"path": "/tolerances/angle_deg", "values": [0, "60 deg"]})).to_pylist()
    assert [row["objective"] for row in rows] == pytest.approx([5.0, 205.0], abs=1e-3)


@pytest.mark.parametrize(
    ("base", "axis"),
    [
        ({"machine": four_webs(), "tolerances": OFF}, {"path": "/machine/speed_rpm", "values": [300, 600]}),
        ({"machine": four_webs(), "tolerances": OFF},
         {"path": "/tolerances/reciprocating_mass_relative", "values": [0, 0.02]}),
        ({"machine": four_webs(), "tolerances": {"reciprocating_mass_relative": 0.02}},
         {"path": "/objective/force_ceiling_N", "values": [100, 60000]}),
        ({"machine": twin(), "tolerances": {"reciprocating_mass_relative": 0.02}, "objective": {"bearing_weight": 1.0}},
         {"path": "/tolerances/mass_relative", "values": [0, 0.03]}),
        ({"machine": twin(), "tolerances": OFF, "outputs": ["main_bearings"]},
         {"path": "/objective/bearing_weight", "values": [0, 1]}),
    ],
)  # fmt: skip
def test_a_row_is_the_answer_to_its_design_whatever_its_chunk(base: dict[str, Any], axis: dict[str, Any]) -> None:
    request = sweep(base, axis)
    rows = table(request).to_pylist()
    for row in rows:
        assert_row_is_the_single_answer(request, row)
    assert [row for k in range(len(rows)) for row in table(request, k, k + 1).to_pylist()] == rows
    proven = {"base": base, "axes": [axis], "multipliers": True}
    verdict = checker().verify(proven, table(sweep(base, axis, multipliers=True)).to_pylist())
    assert not [claim for claim in verdict["claims"] if claim["verdict"] == "broken"]
    covered = {claim["claim"] for claim in verdict["claims"] if claim["verdict"] == "held"}
    # reciprocating masses that are off are covered in the first order
    over_turn = base["tolerances"].keys() == {"reciprocating_mass_relative"} and "bearing_weight" in str(base)
    assert over_turn or covered >= {"worst_case", "price", "objective"}


def test_a_worst_case_that_is_falsified_is_broken() -> None:
    base, axis = {"machine": four_webs(), "tolerances": OFF}, {"path": "/machine/speed_rpm", "values": [300]}
    survey = {"base": base, "axes": [axis], "multipliers": True}
    (row,) = table(sweep(base, axis, multipliers=True)).to_pylist()
    for name in ("worst_case_force_peak_N", "worst_case_moment_peak_Nm", "nominal_objective", "objective"):
        verdict = checker().verify(survey, json.loads(json.dumps([{**row, name: row[name] * 0.999}])))
        assert verdict["verdict"] == "broken", name


@given(st.integers(0, 10_000), st.floats(0.001, 0.1))
@MACHINES
def test_the_worst_case_grows_with_what_is_off(seed: int, share: float) -> None:
    """Property: what is less off is no worse, and a nominal optimum is no better in the worst case than the best."""
    base = {"machine": random_machine(seed), "tolerances": {}}
    rows = table(sweep(base, {"path": "/tolerances/mass_relative", "values": [0.0, share, 2 * share]})).to_pylist()
    values = np.array([row["objective"] for row in rows])
    size = rows[0]["yardstick"]
    assert np.all(np.diff(values) >= -2e-6 * size)
    for row in rows:
        assert row["nominal_objective"] <= row["objective"] + 1e-9 * size
        if row["nominal_optimum_worst_case"] is not None:
            assert row["nominal_optimum_worst_case"] >= row["lower_bound"] - 1e-9 * size


@pytest.mark.parametrize(
    ("base", "axis", "field"),
    [
        ({}, {"path": "/tolerances/mass_relative", "values": [0.1]}, "axes.0.path"),
        ({"tolerances": {"mass_relative": 2.0}}, {"path": "/machine/speed_rpm", "values": [300]},
         "base.tolerances.mass_relative"),
        ({"tolerances": {}}, {"path": "/tolerances/weight", "values": [0.1]}, "axes.0.path"),
        ({"scenarios": [{"name": "a"}]}, {"path": "/scenarios/0/weight", "values": [2]}, "axes.0.path"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_refused_by_its_field(base: dict[str, Any], axis: dict[str, Any], field: str) -> None:
    with pytest.raises(InvalidRequest) as refusal:
        sweep({"machine": crank(), **base}, axis)
    assert [".".join(map(str, problem.path)) for problem in refusal.value.problems] == [field]


def test_a_design_beyond_what_may_be_off_is_a_row_that_says_so() -> None:
    base = {"machine": crank(), "tolerances": {}}
    rows = table(sweep(base, {"path": "/tolerances/mass_relative", "values": [0.5, 1.5]})).to_pylist()
    assert [row["status"] for row in rows] == ["optimal", "invalid"]
    assert rows[1]["message"].startswith("/tolerances/mass_relative: must be")
