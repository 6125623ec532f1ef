"""Goals over the whole turn in sweeps: every row is the single answer, with its certificate."""

import json
from typing import Any

import pytest

from optimizer.errors import MissingInput
from optimizer.studies.sweep import plan
from schemas.answer.proof import DesignMultipliers
from tests.pairs.asking import body_of
from tests.studies.sweep.single import assert_row_is_the_single_answer, example, single, sweep, table

MASS = "/machine/throws/0/rows/0/reciprocating_mass_kg"


def opposed(**objective: Any) -> dict[str, Any]:
    """Two webs of one throw on two bearings: a small program."""
    body = example("opposed-pair")
    body["machine"]["bearings"] = [
        {"name": "A", "position_m": -0.2, "diameter_m": 0.12, "length_m": 0.05},
        {"name": "B", "position_m": 0.3, "diameter_m": 0.12, "length_m": 0.05},
    ]
    return {"machine": body["machine"], "objective": objective}


@pytest.mark.parametrize(
    "objective",
    [
        {"bearing_weight": 1.0, "bearing_ceiling_N": 1e9},
        {"orders": "all", "combine": "max", "force_ceiling_N": 1e9},
        {"bending_weight": 2.0, "least_mass": False},
        {
            "bearing_weight": 1.0,
            "bearing_measure": "specific",
            "priorities": [{"goal": "external", "allowance": 0.01}, {"goal": "bearings"}, {"goal": "mass"}],
        },
    ],
)
def test_rows_are_the_single_answers(objective: dict[str, Any]) -> None:
    # property: what decides is every single answer
    request = sweep(opposed(**objective), {"path": MASS, "values": [40, 90]})
    texts = [assert_row_is_the_single_answer(request, row) for row in table(request).to_pylist()]
    assert texts == ["optimal"] * 2


def test_designs_with_and_without_goals_over_the_turn_in_one_sweep() -> None:
    request = sweep(opposed(), {"path": "/objective/bearing_weight", "values": [0, 1, -1]})
    first, cut, wrong = table(request).to_pylist()
    assert [row["status"] for row in (first, cut, wrong)] == ["optimal", "optimal", "invalid"]
    assert (first["method"], cut["method"]) == ("interior point, compiled", "cuts, clarabel")
    # analytic: more may be had of the bearings where they count
    assert cut["peak_bearing_load_N"] <= first["peak_bearing_load_N"] * (1.0 + 1e-6)
    assert_row_is_the_single_answer(request, cut)


def test_ceilings_out_of_reach_and_proofs() -> None:
    request = sweep(opposed(), {"path": "/objective/bearing_ceiling_N", "values": [1, 1e9]}, multipliers=True)
    never, easily = table(request).to_pylist()
    assert (never["status"], easily["status"]) == ("infeasible", "optimal")
    assert never["total_mass_kg"] is never["peak_bearing_load_N"] is never["objective"] is None
    proofs = [DesignMultipliers.model_validate(json.loads(row["multipliers"])) for row in (never, easily)]
    assert [proof.conflict is None for proof in proofs] == [False, True]
    assert [proof.objective is None for proof in proofs] == [True, False]


def test_what_the_goals_need_is_asked_for_before_anything_runs() -> None:
    body = opposed(bearing_weight=1.0, bearing_measure="specific")
    del body["machine"]["bearings"][1]["length_m"]
    request = sweep(body, {"path": MASS, "values": [40]})
    with pytest.raises(MissingInput) as lacking:
        plan(request)
    assert [problem.path for problem in lacking.value.problems] == [("base", "machine", "bearings", 1, "length_m")]
    # an axis that fills it is enough, and a design that does not is a row that says so
    length = {"path": "/machine/bearings/1/length_m", "values": [None, 0.05]}
    request = sweep(body, length)
    plan(request)
    lacks, has = table(request).to_pylist()
    assert (lacks["status"], has["status"]) == ("invalid", "optimal")
    assert [lacks["message"]] == single(request, lacks)


def test_the_estimate_counts_with_the_cuts() -> None:
    axis = {"path": MASS, "start": 40, "stop": 90, "count": 1000}
    cheap, dear = plan(sweep(opposed(), axis)).estimate, plan(sweep(opposed(bearing_weight=1.0), axis)).estimate
    assert dear.cpu_s > 100 * cheap.cpu_s
    assert dear.chunks > cheap.chunks


@pytest.mark.parametrize(
    ("features", "field", "values"),
    [
        ("no rods", "bearing_weight", [0, 1]),
        ("no rods", "bearing_ceiling_N", [None, 1e5]),
        ("no bearings", "bending_weight", [0, 1]),
        ("masses of a catalogue", "bearing_weight", [0, 1]),
    ],
)
def test_a_row_that_asks_nothing_of_the_shaft_needs_none_of_its_data(
    features: str, field: str, values: list[float | None]
) -> None:
    """Property: what decides is the answer to the design alone; a sweep is refused where no design can be answered."""
    base = body_of("vee", [features] if features.startswith("no") else [features, "no rods"])
    assert base is not None
    request = sweep(base, {"path": f"/objective/{field}", "values": values})
    plan(request)
    sheet = table(request).to_pylist()
    assert [assert_row_is_the_single_answer(request, row) for row in sheet] == ["optimal", "invalid"]
    assert f"needed by objective.{field}" in sheet[1]["message"]
    never = sweep(base, {"path": f"/objective/{field}", "values": values[1:]})
    with pytest.raises(MissingInput):
        plan(never)


def test_bearing_loads_come_along_where_there_are_bearings() -> None:
    base = body_of("vee", [])
    assert base is not None
    rows = table(sweep(base, {"path": "/objective/bearing_weight", "values": [0, 1]})).to_pylist()
    assert all(row["bearing_peak_N.A"] > 0 for row in rows)
