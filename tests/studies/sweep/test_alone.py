"""Sweeps of designs that are certified each by itself: catalogues, least masses, plates, groups of webs."""

import json
from typing import Any

import numpy as np
import pytest

from optimizer.choices.discrete.search import EXHAUSTED, TREE
from optimizer.optimize import optimize
from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.sweep import plan
from optimizer.studies.sweep.rows import Group
from schemas.answer.proof import DesignMultipliers
from schemas.front.pareto import ParetoRequest
from schemas.request.requests import OptimizeRequest
from schemas.sweep.alone import MAX_SEARCHED
from schemas.sweep.request import SweepRequest
from service.common.validation import InvalidRequest
from tests.studies.sweep.single import assert_row_is_the_single_answer, example, sweep, table


def twin(**machine: Any) -> dict[str, Any]:
    body = example("catalogue-twin")
    body["machine"] |= machine
    return {"machine": body["machine"]}


def plain(**machine: Any) -> dict[str, Any]:
    """The same machine with counterweights of any mass."""
    body = twin(**machine)
    del body["machine"]["catalogue"]
    body["machine"].pop("max_counterweights", None)
    for web in body["machine"]["webs"]:
        for name in ("hole_angles_deg", "catalogue_masses_kg"):
            web.pop(name, None)
    return body


def answers(base: dict[str, Any], *axes: dict[str, Any], **more: Any) -> tuple[list[str], list[dict[str, Any]]]:
    """Rows of a sweep, each the answer to its design alone: property, what decides is every single answer."""
    request = sweep(base, *axes, **more)
    rows = table(request).to_pylist()
    return [assert_row_is_the_single_answer(request, row) for row in rows], rows


def test_catalogues() -> None:
    base = twin(catalogue={"masses_kg": [7.5, 16], "angle_step_deg": 60})
    replies, rows = answers(base, {"path": "/machine/max_counterweights", "values": [None, 1, 0]})
    assert replies == ["optimal"] * 3
    fitted = [sum(1 for name, mass in row.items() if name.startswith("mass_kg.") and mass > 0) for row in rows]
    assert fitted[1] <= 1
    assert fitted[2] == 0
    # analytic: fewer are no better
    assert rows[0]["objective"] <= rows[1]["objective"] <= rows[2]["objective"]


def test_catalogues_with_ceilings_out_of_reach_and_wrong_counts() -> None:
    axis = {"path": "/objective/force_ceiling_N", "values": [1, 1e6]}
    replies, rows = answers(twin(), axis)
    assert replies == ["infeasible", "optimal"]
    assert rows[0]["total_mass_kg"] is None
    optima, rows = answers(twin(), {"path": "/machine/catalogue/angle_step_deg", "values": [30, 31]})
    assert optima == ["optimal", "invalid"]
    assert "/machine/catalogue/angle_step_deg" in rows[1]["message"]


@pytest.mark.parametrize("over_the_turn", [False, True])
def test_what_proves_that_no_choice_keeps_the_ceilings_is_told(over_the_turn: bool) -> None:
    """Property: the method of a row, and of a point of a front, is that of the search whose proof it is."""
    base = twin(catalogue={"masses_kg": [7.5, 16], "angle_step_deg": 60})
    any_mass = [{**web, "catalogue_masses_kg": None, "hole_angles_deg": None} for web in base["machine"]["webs"]]
    free = {name: value for name, value in base["machine"].items() if name not in ("catalogue", "max_counterweights")}
    bearings = [{"name": name, "position_m": z} for name, z in (("A", -1.0), ("B", 1.0))]
    free |= {"webs": any_mass, "bearings": bearings}
    base["machine"]["bearings"] = bearings
    goal: dict[str, Any] = {"bending_weight": 1.0} if over_the_turn else {}
    # between what any masses reach and what the few of the catalogue do
    least = optimize(OptimizeRequest.model_validate({"machine": free, "objective": {"moment_weight": 0}}))
    assert least.residual is not None
    assert least.residual.after is not None
    cap = least.residual.after.force.peak_N + 1e-3 * least.residual.before.force.peak_N
    base["objective"] = goal | {"force_ceiling_N": cap}
    base["machine"]["max_counterweights"] = 1
    replies, rows = answers(base, {"path": "/machine/max_counterweights", "values": [1]})
    assert replies == ["infeasible"]
    assert rows[0]["method"] in (EXHAUSTED, TREE)
    front = pareto(ParetoRequest.model_validate({**base, "points": 2, "counts": {"of": "weights"}}))
    assert front.counts is not None
    none = front.counts[0].points[0]
    assert none.status == "infeasible"
    assert none.method in (EXHAUSTED, TREE)
    assert (none.nodes == 0) == (none.method == EXHAUSTED)


def test_least_masses_and_what_holds_none() -> None:
    base = plain()
    names = [web["name"] for web in base["machine"]["webs"]]
    base["accuracy"] = {"relative_gap": 1e-3}
    base["objective"] = {"least_mass": False}
    replies, rows = answers(base, {"path": "/machine/webs/0/min_fitted_mass_kg", "values": [None, 9]})
    assert set(replies) <= {"optimal", "inaccurate"}
    assert rows[1][f"mass_kg.{names[0]}"] == 0 or rows[1][f"mass_kg.{names[0]}"] >= 9
    assert rows[0]["lower_bound"] <= rows[1]["objective"]


@pytest.mark.parametrize("of_base", [None, 1])
@pytest.mark.parametrize("gap", [None, 1e-5])
def test_a_row_is_asked_for_the_gap_of_its_own_machine(of_base: int | None, gap: float | None) -> None:
    """Property: an axis that asks for a search changes the usual gap, and none that is said."""
    base = plain()
    base["machine"]["webs"][0]["min_fitted_mass_kg"] = of_base
    if gap is not None:
        base["accuracy"] = {"relative_gap": gap}
    request = sweep(base, {"path": "/machine/webs/0/min_fitted_mass_kg", "values": [None, 1]})
    # as a worker gets it
    request = SweepRequest.model_validate_json(request.model_dump_json())
    group = Group(request, request.base, [np.array([np.nan, 1.0])])
    rows = [group.single(design) for design in (0, 1)]
    # read again, as by a client who asks for the design alone
    again = [OptimizeRequest.model_validate(json.loads(row.model_dump_json())) for row in rows]
    expected = [gap or 1e-6, gap or 1e-3]
    assert [row.accuracy.relative_gap for row in rows if isinstance(row, OptimizeRequest)] == expected
    assert [optimize_request.accuracy.relative_gap for optimize_request in again] == expected


@pytest.mark.parametrize("mirror", [False, True])
def test_groups(mirror: bool) -> None:
    body = plain()
    names = [web["name"] for web in body["machine"]["webs"]]
    body["machine"]["web_groups"] = [{"name": "all", "webs": names[:2], "mirror": mirror}]
    axis = {"path": "/machine/throws/0/crank_angle_deg", "values": [0, 30]}
    wrong = {"path": "/machine/webs/1/max_mass_kg", "values": [body["machine"]["webs"][1]["max_mass_kg"], 1.0]}
    replies, rows = answers(body, axis, wrong, multipliers=False)
    assert replies == ["optimal", "invalid"] * 2
    assert "web_groups" in rows[1]["message"]
    for row in rows[::2]:
        assert row[f"mass_kg.{names[0]}"] == row[f"mass_kg.{names[1]}"]


def test_groups_over_the_turn_with_their_proofs() -> None:
    body = plain()
    names = [web["name"] for web in body["machine"]["webs"]]
    body["machine"]["web_groups"] = [{"name": "all", "webs": names[:2]}]
    for throw in body["machine"]["throws"]:
        for row in throw["rows"]:
            row["connecting_rod"] = {"length_m": 4 * 0.3}
    # whatever is compiled first
    body["accuracy"] = {"time_limit_s": 30}
    request = sweep(body, {"path": "/machine/speed_rpm", "values": [300]}, multipliers=True)
    (row,) = table(request).to_pylist()
    assert row["status"] == "optimal"
    assert DesignMultipliers.model_validate(json.loads(row["multipliers"])).objective is not None
    body["objective"] = {"orders": "all"}
    replies, _ = answers(body, {"path": "/machine/speed_rpm", "values": [300]})
    assert replies == ["optimal"]


def test_plates() -> None:
    outer = {"path": "/machine/webs/0/envelope/outer_radius_m", "values": [0.095, 0.12, 0.02]}
    replies, rows = answers({"machine": example("plate-single")["machine"]}, outer)
    assert replies == ["optimal", "optimal", "invalid"]
    assert "/machine/webs/0/envelope/inner_radius_m" in rows[2]["message"]
    # analytic: a larger plate opens less
    assert rows[1]["half_angle_deg.front"] < rows[0]["half_angle_deg.front"] <= 90.0
    assert rows[1]["total_mass_kg"] < rows[0]["total_mass_kg"]


def test_searches_take_longer_and_are_fewer() -> None:
    axis = {"path": "/machine/speed_rpm", "start": 100, "stop": 1000, "count": MAX_SEARCHED}
    searched, usual = plan(sweep(twin(), axis)), plan(sweep(plain(), axis))
    assert searched.estimate.cpu_s > 1000 * usual.estimate.cpu_s
    assert searched.chunk_rows < usual.chunk_rows
    with pytest.raises(InvalidRequest) as refusal:
        sweep(twin(), axis | {"count": MAX_SEARCHED + 1})
    assert [problem.path for problem in refusal.value.problems] == [("axes",)]


@pytest.mark.parametrize(
    ("machine", "field"),
    [
        ({}, ("base", "machine", "catalogue")),
        ({"web_groups": [{"name": "a", "webs": ["front"]}]}, ("base", "machine", "web_groups")),
    ],
)
def test_what_is_analyzed_has_none(machine: dict[str, Any], field: tuple[str, ...]) -> None:
    body = twin() if not machine else plain()
    name = body["machine"]["webs"][0]["name"]
    if machine:
        body["machine"]["web_groups"] = [{"name": "a", "webs": [name]}]
    axis = {"path": "/machine/speed_rpm", "values": [300]}
    with pytest.raises(InvalidRequest) as refusal:
        sweep({"machine": body["machine"], "counterweights": []}, axis, task="analyze")
    assert field in [problem.path for problem in refusal.value.problems]
