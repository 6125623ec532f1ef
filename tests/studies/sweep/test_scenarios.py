"""Rows of a sweep of several scenarios: each as the answer to its design alone."""

import json
from typing import Any

import pytest

from service.common.validation import InvalidRequest
from service.verification import checker
from tests.night import part
from tests.optimize.robust import crank, scenario
from tests.optimize.whole_turn import single_throw
from tests.studies.pareto.cases import four_webs
from tests.studies.sweep import test_crank_orders as cranks
from tests.studies.sweep.single import assert_row_is_the_single_answer, sweep, table

FASTER = [scenario("as it is"), scenario("fast", 0.8, speed_rpm=900.0)]


def test_between_two_cranks_by_their_angle() -> None:
    """Analytic: half of the difference of 200 N at 0 and at an angle remains, 200 N times the sine of half of it."""
    base = {"machine": crank(), "objective": {"moment_weight": 0}}
    base["scenarios"] = [scenario("as it is"), scenario("turned", throws__0__crank_angle_deg=60.0)]
    rows = table(sweep(base, {"path": "/machine/throws/0/crank_angle_deg", "values": [0, 60, 120]})).to_pylist()
    assert [row["status"] for row in rows] == ["optimal"] * 3
    for row, left in zip(rows, (100.0, 0.0, 100.0), strict=True):
        assert row["objective"] == pytest.approx(left, abs=1e-3)
        assert row["worst_case_force_peak_N"] == pytest.approx(left, abs=1e-3)
        # the unchanged machine alone is balanced, and then the other has what lies between both
        assert row["nominal_optimum"] == pytest.approx(0.0, abs=1e-3)
        assert row["nominal_optimum_worst_case"] == pytest.approx(2.0 * left, abs=2e-3)


@pytest.mark.parametrize(
    ("more", "axis"),
    part(
        2,
        [
            ({"machine": four_webs()}, {"path": "/machine/speed_rpm", "values": [300, 600]}),
            ({"machine": four_webs(), "tolerances": {"unbalance_kg_m": 0.01}},
             {"path": "/objective/force_ceiling_N", "values": [100, 60000]}),
            ({"machine": single_throw(4.0), "objective": {"bearing_weight": 1.0}},
             {"path": "/machine/throws/0/rows/0/reciprocating_mass_kg", "values": [5, 8]}),
        ],
        rows=True,
    ),
)  # fmt: skip
def test_a_row_is_the_answer_to_its_design_whatever_its_chunk(more: dict[str, Any], axis: dict[str, Any]) -> None:
    base = {**more, "scenarios": FASTER}
    request = sweep(base, axis)
    rows = table(request).to_pylist()
    for row in rows:
        assert_row_is_the_single_answer(request, row)
    assert [row for k in range(len(rows)) for row in table(request, k, k + 1).to_pylist()] == rows
    proven = {"base": base, "axes": [axis], "multipliers": True}
    document = json.loads(json.dumps(table(sweep(base, axis, multipliers=True)).to_pylist()))
    verdict = checker().verify(proven, document)
    assert not [claim for claim in verdict["claims"] if claim["verdict"] == "broken"]
    assert {claim["claim"] for claim in verdict["claims"] if claim["verdict"] == "held"} >= {"worst_case", "objective"}
    first = next(row for row in document if row["status"] == "optimal")
    for name in ("worst_case_force_peak_N", "nominal_objective"):
        assert checker().verify(proven, [{**first, name: first[name] * 0.999}])["verdict"] == "broken", name


def test_a_design_whose_scenario_breaks_a_rule_says_so() -> None:
    base = {"machine": single_throw(4.0), "scenarios": [scenario("long", throws__0__crank_radius_m=3.0)]}
    axis = {"path": "/machine/throws/0/rows/0/connecting_rod/length_m", "values": [2.0, 5.0]}
    bad, good = table(sweep(base, axis)).to_pylist()
    assert (bad["status"], good["status"]) == ("invalid", "optimal")
    assert bad["message"].startswith("/scenarios/0/changes")


def test_a_scenario_that_lacks_what_the_goal_needs_is_a_row_that_says_so() -> None:
    base = {"machine": single_throw(4.0), "objective": {"bearing_weight": 1.0, "bearing_measure": "specific"}}
    for bearing in base["machine"]["bearings"]:
        bearing.update({"diameter_m": 0.1, "length_m": 0.1})
    base["scenarios"] = [scenario("no size", bearings__0__diameter_m=None)]
    (row,) = table(sweep(base, {"path": "/machine/speed_rpm", "values": [300]})).to_pylist()
    assert row["status"] == "invalid"
    assert row["message"].startswith("/scenarios/0/changes: ")


def test_of_cranks_in_order_scenarios_of_other_parts_leave_no_two_alike() -> None:
    """Analytic: four angles make 4! sequences, and fewer machines where all throws are alike."""
    angles = cranks.once(4)
    design = {"design": "crank_orders", "angles_deg": angles}
    alike = {"machine": cranks.body(angles)["base"]["machine"]}
    plain = sweep(alike, **design)
    fast = sweep({**alike, "scenarios": [scenario("fast", speed_rpm=900.0)]}, **design)
    heavy = sweep({**alike, "scenarios": [scenario("heavy", throws__0__rotating_mass_kg=9.0)]}, **design)
    assert fast.total == plain.total < heavy.total == 24


def test_cheaper_choices_are_refused_by_name() -> None:
    base = {"machine": crank(), "scenarios": FASTER, "alternatives": [0.1]}
    with pytest.raises(InvalidRequest) as refusal:
        sweep(base, {"path": "/machine/speed_rpm", "values": [300]})
    assert "alternatives" in {problem.path[-1] for problem in refusal.value.problems}
