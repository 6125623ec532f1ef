"""Fronts and the rows of sweeps, each point and each row with its claims."""

import json
from typing import Any

import pytest

from optimizer.optimize import optimize
from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.sweep.rows import rows
from optimizer.studies.sweep.table import result_schema, result_table
from schemas.front.pareto import ParetoRequest
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.verification import checker
from tests.night import every, part
from tests.pairs.asking import body_of
from tests.verification.answers import pair
from tests.verification.checking import broken, is_broken, verdict
from tests.verification.kinds import SINGLE

FRONTS: dict[str, dict[str, Any]] = {
    "plain": {**SINGLE["sum"], "points": 4, "multipliers": True},
    "budgets": {
        **SINGLE["direction weights"],
        "points": 3,
        "multipliers": True,
        "total_mass_budgets_kg": [2.0, "6 lb"],
    },
    "scroll": {**SINGLE["scroll-oldham"], "points": 3, "multipliers": True},
    "infeasible": {**SINGLE["infeasible"], "points": 3, "multipliers": True},
}
SWEEPS: dict[str, dict[str, Any]] = {
    "masses and texts": {
        "multipliers": True,
        "base": SINGLE["texts with units"],
        "axes": [
            {"path": "/machine/throws/0/rows/0/reciprocating_mass_kg", "values": [3.0, "20 lb"]},
            {"path": "/objective/force_ceiling_N", "values": [None, "8 kN", 100]},
            {"path": "/machine/webs/1/sector/half_angle_deg", "start": 5, "stop": 60, "count": 2},
        ],
    },
    "scroll": {
        "multipliers": True,
        "base": SINGLE["scroll-oldham"],
        "axes": [{"path": "/machine/speed_rpm", "values": [900, 1800]}],
    },
}


def swept(body: dict[str, Any]) -> list[dict[str, Any]]:
    """The rows as NDJSON has them."""
    request = SweepRequest.model_validate(body)
    table = result_table(rows(request, 0, request.total), result_schema(request, b"{}"))
    return [json.loads(json.dumps(row)) for row in table.to_pylist()]


def claims(request: Any, answer: Any) -> dict[str, str]:
    return {claim["claim"]: claim["verdict"] for claim in checker().verify(request, answer)["claims"]}


@pytest.fixture(scope="module", params=FRONTS)
def front(request: pytest.FixtureRequest) -> tuple[dict[str, Any], dict[str, Any]]:
    body = FRONTS[request.param]
    return body, json.loads(pareto(ParetoRequest.model_validate(body)).model_dump_json())


def test_a_front(front: tuple[dict[str, Any], dict[str, Any]]) -> None:
    body, answer = front
    assert not broken(body, answer)
    assert verdict(body, answer) == "held"
    if answer["status"] != "infeasible":
        assert {"objective", "gap", "status", "ceilings", "counterweights"} - {"ceilings"} <= claims(
            body, answer
        ).keys()


def test_falsified_points_are_caught(front: tuple[dict[str, Any], dict[str, Any]]) -> None:
    body, answer = front
    for position in (point for frontier in answer["fronts"] for point in frontier["points"]):
        for name in ("force_peak_N", "weighted_moment_peak_Nm", "total_mass_kg"):
            right = position[name]
            position[name] = right * (1 + 1e-6)
            assert not right or is_broken(body, answer), name
            position[name] = right


def test_a_front_without_its_proofs_is_not_covered() -> None:
    # nor is a bound of its masses false for want of a proof
    body = {**SINGLE["sum"], "points": 2}
    answer = json.loads(pareto(ParetoRequest.model_validate(body)).model_dump_json())
    statements = claims(body, answer)
    assert (statements["corner"], statements["mass_lower_bound"]) == ("not covered", "not covered")
    assert verdict(body, answer) == "not covered"


@pytest.mark.parametrize("uncertain", [{}, {"tolerances": {"mass_relative": 0.02}}])
@pytest.mark.parametrize("field", ["force_N", "moment_Nm"])
def test_a_corner_that_nothing_proves_is_named(field: str, uncertain: dict[str, Any]) -> None:
    # that a point is no farther from it than it says proves nothing of it
    body = {**SINGLE["sum"], "points": 2, **uncertain}
    answer = json.loads(pareto(ParetoRequest.model_validate(body)).model_dump_json())
    place = f"/answer/fronts/*/points/*/certificate/{field}"
    missing = checker().verify(body, answer)["not_covered"]
    assert {place, "/answer/fronts/*/ends/smallest_force_lower_bound_N"} <= {*missing}
    proven = {**body, "multipliers": True}
    answer = json.loads(pareto(ParetoRequest.model_validate(proven)).model_dump_json())
    assert verdict(proven, answer) == "held"


@pytest.mark.parametrize("more", [{}, {"tolerances": {"mass_relative": 0.02}}, {"objective": {"orders": "all"}}])
def test_masses_of_fixed_weights_are_added_in_doubles(more: dict[str, Any]) -> None:
    # analytic: 0.1 + 0.1 + 0.1 + 0.4 kg come to 0.7000000000000001 kg
    body = json.loads(json.dumps(body_of("twin", ["all fixed"]))) | more
    body["machine"]["webs"][3]["fixed"]["mass_kg"] = 0.4
    answer = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    assert answer["certificate"]["mass_lower_bound_kg"] == 0.7000000000000001
    assert not broken(body, answer)
    if "objective" not in more:
        front = {**body, "points": 2, "multipliers": True}
        assert verdict(front, json.loads(pareto(ParetoRequest.model_validate(front)).model_dump_json())) == "held"
    answer["certificate"]["mass_lower_bound_kg"] *= 1 + 1e-12
    assert is_broken(body, answer)


@pytest.mark.parametrize("name", SWEEPS)
def test_the_rows_of_a_sweep(name: str) -> None:
    body, table = SWEEPS[name], swept(SWEEPS[name])
    assert not broken(body, table)
    assert verdict(body, table) == "held"
    assert claims(body, table)["objective"] == "held"
    mass = f"mass_kg.{body['base']['machine']['webs'][0]['name']}"
    for row in table:
        for column in ("force_peak_N", "objective", "total_mass_kg", mass):
            right = row[column]
            # what is less than 1e-8 of the whole is seen in it by no double
            if right and (column != mass or right > 1e-6 * row["total_mass_kg"]):
                row[column] = right * (1 + 1e-6)
                assert is_broken(body, table), column
                row[column] = right


_SPEEDS = [{"path": "/machine/speed_rpm", "values": [500, 700]}]


@pytest.mark.parametrize("features", [("bearing weight",), ("orders all",)])
def test_rows_over_the_turn_are_held_with_reference_values_and_loads(features: tuple[str, ...]) -> None:
    body = {"base": body_of("twin", features, 1.0), "axes": _SPEEDS, "multipliers": True}
    table = swept(body)
    assert verdict(body, table) == "held"
    columns = ["yardstick", *(name for name in table[0] if name.startswith(("bearing_peak_N", "peak_b")))]
    assert len(columns) > 3 or features == ("orders all",)
    for row in table:
        for column in columns:
            for wrong in (row[column] * (1 + 1e-6), row[column] * (1 - 1e-6)):
                right, row[column] = row[column], wrong
                assert is_broken(body, table), column
                row[column] = right


@pytest.mark.parametrize("more", part(3, [{"multipliers": True}, {}, {"details": True}]))
@pytest.mark.parametrize(
    "features", [("bearing weight",), ("plates, sectors",), ("ceilings out of reach",), ("priorities", "orders all")]
)
def test_rows_over_the_turn(features: tuple[str, ...], more: dict[str, Any]) -> None:
    """Regression: a row was broken for fields that no row has, or refused for them."""
    body = {"base": body_of("twin", features, 1.0), "axes": _SPEEDS, **more}
    table = swept(body)
    assert not broken(body, table)
    assert verdict(body, table) in ("held", "not covered")


def test_what_multipliers_prove_of_rows_over_the_turn() -> None:
    body = {"base": body_of("twin", ("bearing weight",), 1.0), "axes": _SPEEDS, "multipliers": True}
    table = swept(body)
    bound = claims(body, table)
    assert (bound["lower_bound"], bound["mass_lower_bound"], bound["objective"]) == ("held",) * 3
    for column in ("force_peak_N", "objective", "lower_bound", "total_mass_kg", "mass_kg.1a"):
        right = table[0][column]
        table[0][column] = right * 1.001
        assert is_broken(body, table), column
        table[0][column] = right
    without = [{name: value for name, value in row.items() if name != "multipliers"} for row in table]
    assert verdict(body, without) == "not covered"
    body["base"] = body_of("twin", ("ceilings out of reach",), 1.0)
    assert verdict(body, swept(body)) == "held"


@pytest.mark.parametrize(
    "features",
    [
        ("tolerances of masses and angles",),
        ("scenario of speed", "balance shaft backwards"),
        ("tolerances of masses and angles", "orders all"),
    ],
)
def test_the_best_of_the_machine_as_it_is_given_is_proven_in_a_row(features: tuple[str, ...]) -> None:
    base = body_of("twin", features)
    body = {"base": base, "axes": [{"path": "/machine/speed_rpm", "values": [700]}], "multipliers": True}
    table = swept(body)
    assert verdict(body, table) == "held"
    for column in ("nominal_optimum", "nominal_optimum_worst_case"):
        for factor in (1 - 1e-6, 1 + 1e-6):
            assert is_broken(body, [table[0] | {column: factor * table[0][column]}]), column
    proof = json.loads(table[0]["multipliers"])
    proof["nominal"]["lower_bound"] *= 1 + 1e-6
    assert is_broken(body, [table[0] | {"multipliers": json.dumps(proof)}])
    without = json.dumps(proof | {"nominal": None})
    assert claims(body, [table[0] | {"multipliers": without}])["nominal_optimum"] == "not covered"


@pytest.mark.parametrize("columns", [["total_mass_kg", "objective"], ["/machine/speed_rpm", "objective"]])
def test_a_row_of_chosen_columns_is_not_covered(columns: list[str]) -> None:
    body = {"base": SINGLE["ceilings"], "axes": _SPEEDS, "columns": columns}
    assert verdict(body, swept(body)) == "not covered"


def test_chosen_columns_are_checked_as_far_as_they_go() -> None:
    webs = [f"{of}.{web['name']}" for web in SINGLE["ceilings"]["machine"]["webs"] for of in ("mass_kg", "angle_deg")]
    body = {"base": SINGLE["ceilings"], "axes": _SPEEDS, "columns": ["/machine/speed_rpm", "force_peak_N", *webs]}
    table = swept(body)
    assert not broken(body, table)
    table[0][webs[0]] *= 1.001
    assert is_broken(body, table)


def test_a_row_that_is_called_infeasible_is_not_covered_without_a_proof() -> None:
    body = {"base": SINGLE["ceilings"], "axes": _SPEEDS}
    table = swept(body)
    for row in table:
        for column in row.keys() - {"index", "/machine/speed_rpm"}:
            row[column] = "infeasible" if column == "status" else None
    assert verdict(body, table) == "not covered"


@pytest.mark.parametrize(
    ("features", "axes"),
    [
        (("bearing weight",), [{"path": "/objective/bearing_ceiling_N", "values": [None, 0.4]}]),
        (("gap of 1e-3",), [{"path": "/objective/bending_ceiling_Nm", "values": [1.5]}]),
        # a ceiling over the turn that the optimum touches
        (("moment alone", "bearing_ceiling_N near"), [{"path": "/objective/moment_ceiling_y_Nm", "values": [0.7]}]),
    ],
)
@pytest.mark.parametrize("base", every(2, ["vee", "twin"]))
def test_axes_of_ceilings_over_the_turn(base: str, features: tuple[str, ...], axes: list[dict[str, Any]]) -> None:
    """Regression: rows were broken for ceilings of loads that conflict, and for limits that no row names."""
    body = {"base": body_of(base, features, 1.0), "axes": axes, "multipliers": True}
    assert not broken(body, swept(body))


def test_the_bound_of_a_search_is_not_covered_in_a_row() -> None:
    """Regression: heavy enough or nothing is proven by a tree; without the column of the method neither."""
    *webs, last = SINGLE["sum"]["machine"]["webs"]
    webs = [*webs, {**last, "max_mass_kg": 60.0, "min_fitted_mass_kg": 50.0}]
    base = {**SINGLE["sum"], "machine": {**SINGLE["sum"]["machine"], "webs": webs}}
    names = [f"{of}.{web['name']}" for web in webs for of in ("mass_kg", "angle_deg")]
    for columns in (None, ["/machine/speed_rpm", "objective", "lower_bound", *names]):
        body = {"base": base, "axes": _SPEEDS, "multipliers": True, "columns": columns}
        table = swept(body)
        assert not broken(body, table)
        assert claims(body, table)["lower_bound"] == "not covered"


def test_axes_through_lists_take_texts() -> None:
    """Regression: the unit of a mass in a list was sought in its number there, and the sweep could not be read."""
    base = body_of("twin", ("own masses",), 1.0)
    place, web = next((n, plane) for n, plane in enumerate(base["machine"]["webs"]) if plane.get("catalogue_masses_kg"))
    path = f"/machine/webs/{place}/catalogue_masses_kg/{len(web['catalogue_masses_kg']) - 1}"
    body = {"base": base, "axes": [{"path": path, "values": ["20 lb", "9.5 kg", 11]}], "multipliers": True}
    table = swept(body)
    assert not broken(body, table)
    assert claims(body, table)["axis"] == "held"
    table[1][path] = 20.0
    assert claims(body, table)["axis"] == "broken"


@pytest.mark.parametrize("angles", every(4, [["400 deg", "-0.3 rad"], [0.0, 90.0], [120.0, 120.0]]))
def test_orders_of_cranks(angles: list[Any]) -> None:
    """Regression: rows were held against the unchanged machine."""
    body = {"base": SINGLE["sum"], "design": "crank_orders", "angles_deg": angles, "multipliers": True}
    table = swept(body)
    assert verdict(body, table) == "held"
    # a whole turn more is the same machine, though no angle that a service gives
    table[0]["/machine/throws/1/crank_angle_deg"] += 1e-3
    assert claims(body, table)["axis"] == "broken"
    assert verdict(body | {"angles_deg": [0.0, 33.0]}, swept(body)) == "broken"


@pytest.mark.parametrize("factor", [1.001, 0.999, 2.0, -1.0])
def test_the_knee_of_a_front_is_the_number_of_a_point(factor: float) -> None:
    """Regression: the fraction of a number was cut off."""
    request, answer = pair("front")
    assert answer["fronts"][0]["knee"] > 0
    answer["fronts"][0]["knee"] *= factor
    assert any(claim.startswith("front") for claim in broken(request, answer))


@pytest.mark.parametrize("tolerances", [None, {"mass_relative": 0.02}])
def test_a_front_is_optimal_only_where_its_ends_are_closed(tolerances: dict[str, float] | None) -> None:
    """Regression: a smallest peak of which nothing was proven was held in an optimal front."""
    body = {**SINGLE["budget and ceiling"], "points": 2, "multipliers": True, "tolerances": tolerances}
    answer = json.loads(pareto(ParetoRequest.model_validate(body)).model_dump_json())
    assert not broken(body, answer)
    for field in ("smallest_force_lower_bound_N", "smallest_moment_lower_bound_Nm"):
        ends = answer["fronts"][0]["ends"]
        right, ends[field] = ends[field], 0.0
        assert is_broken(body, answer), field
        ends[field] = right


@pytest.mark.parametrize("budget", [0.0, 5.0])
def test_a_budget_of_a_front_that_nobody_asked_for_is_broken(budget: float) -> None:
    """Regression: one of 0 kg was held."""
    request, answer = pair("front")
    answer["fronts"][0]["max_total_mass_kg"] = budget
    assert any(claim.startswith("max_total_mass") for claim in broken(request, answer))
