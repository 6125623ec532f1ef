"""Sweeps of machines with balance shafts: every row is the answer to its design alone, whatever varies and is shown."""

import json
from typing import Any

import numpy as np
import pytest

from service.verification import checker
from tests import night
from tests.analyze.driven import STYLES, random_driven
from tests.analyze.engines import UNEVEN, cylinder, engine
from tests.optimize.shafts import WHOLE, in_line_four, shaft
from tests.optimize.shafts import single as upright
from tests.studies.sweep.single import assert_row_is_the_single_answer, sweep, table
from tests.studies.sweep.test_rows import DRIVE
from tests.verification.checking import broken, verdict

Axes = list[tuple[str, list[Any]]]

BACKWARDS = upright([shaft("back", -1, radius=0.05)])
FORWARDS = upright([shaft("on", 1, max_mass=2.0)])
TWICE = in_line_four([shaft("a", -2, x_m=0.1, radius=0.05), shaft("b", 2, y_m=-0.1, radius=0.05)])
MIXED = in_line_four([shaft("a", -1), shaft("b", 2, position=0.2)], ratio=0.25)
WITHIN = upright([shaft("back", -1, max_mass=20.0, sector={"centre_deg": 250.0, "half_angle_deg": 15.0})])
LATER = {"outputs": DRIVE, "angles": {"step_deg": 30}}


def checked(base: dict[str, Any], axes: Axes, **rest: Any) -> list[dict[str, Any]]:
    """Rows of a sweep, each held against the answer to its design, and those of optima by the independent checker."""
    survey = {"base": base, "axes": [{"path": path, "values": values} for path, values in axes], **rest}
    request = sweep(base, *survey["axes"], **rest)
    rows: list[dict[str, Any]] = table(request).to_pylist()
    assert {assert_row_is_the_single_answer(request, row) for row in rows} <= {"optimal", "infeasible", "analyzed"}
    if request.task == "optimize":
        assert not broken(json.loads(request.model_dump_json()), rows)
    return rows


@pytest.mark.parametrize(
    ("machine", "axes"),
    [
        (BACKWARDS, [("/machine/speed_rpm", [500, 700]), ("/machine/throws/0/crank_angle_deg", [0, 30])]),
        (
            BACKWARDS,
            [("/machine/balance_shafts/0/webs/0/max_mass_kg", [None, 2, 0]), ("/machine/webs/0/position_m", [0, 0.2])],
        ),
        (BACKWARDS, [("/objective/direction_weights/x", [0, 0.5, 1]), ("/machine/throws/0/position_m", [0, 0.3])]),
        (FORWARDS, [("/objective/force_ceiling_N", [None, 1e-3 * WHOLE, WHOLE])]),
        (FORWARDS, [("/machine/balance_shafts/0/webs/0/counterweight_radius_m", [0.02, 0.2])]),
        (WITHIN, [("/machine/balance_shafts/0/webs/0/sector/centre_deg", [0, 100, 250])]),
        (WITHIN, [("/objective/force_ceiling_x_N", [1.0, None]), ("/objective/force_ceiling_y_N", [1.0, None])]),
        (
            MIXED,
            [("/machine/balance_shafts/0/webs/0/position_m", [-0.1, 0.3]), ("/objective/moment_weight", [0, None])],
        ),
    ],
)
@pytest.mark.parametrize("combine", ["sum", "max"])
def test_rows_are_the_single_answers(machine: dict[str, Any], axes: Axes, combine: str) -> None:
    checked({"machine": machine, "objective": {"combine": combine}}, axes)


@pytest.mark.parametrize(
    ("machine", "goal", "axes"),
    [
        (TWICE, {"orders": "all"}, [("/machine/speed_rpm", [500, 700])]),
        (TWICE, {"orders": "all"}, [("/objective/roll_weight", [0.5, 2]), ("/machine/balance_shafts/0/x_m", [0, 0.3])]),
        (MIXED, {}, [("/objective/roll_weight", [0, 1]), ("/machine/balance_shafts/1/y_m", [0.1, 0.4])]),
    ],
)
def test_rows_over_the_turn_are_the_single_answers(machine: dict[str, Any], goal: dict[str, Any], axes: Axes) -> None:
    checked({"machine": machine, "objective": goal, "outputs": ["roll"]}, axes)


def test_the_roll_moment_comes_along_where_it_counts() -> None:
    request = sweep(
        {"machine": TWICE, "objective": {"roll_weight": 1.0}}, {"path": "/machine/speed_rpm", "values": [500]}
    )
    assert "peak_roll_Nm" in {column.name for column in request.all_columns}
    (row,) = table(request).to_pylist()
    assert_row_is_the_single_answer(request, row)


def test_some_designs_may_weigh_bearings_and_others_the_roll_moment() -> None:
    # a machine without bearings: what weighs them is refused, what does not has no columns of them
    axes = [{"path": f"/objective/{name}", "values": [0, 1]} for name in ("bearing_weight", "roll_weight")]
    rows = table(sweep({"machine": TWICE}, *axes)).to_pylist()
    assert [row["status"] for row in rows] == ["optimal", "optimal", "invalid", "invalid"]
    assert [row["peak_bearing_load_N"] for row in rows] == [None] * 4
    assert [row["peak_roll_Nm"] is not None for row in rows] == [True, True, False, False]


def drives() -> dict[str, dict[str, Any]]:
    shafts = [shaft("one", -1, x_m=0.1, radius=0.05), shaft("other", 2, x_m=-0.1, radius=0.05)]
    machines = {style: random_driven(7, style) for style in STYLES}
    machines["indicated"] = engine([0.0, 90.0], [cylinder(UNEVEN), cylinder(UNEVEN)])
    return {
        name: {**machine, "balance_shafts": shafts, "max_total_mass_kg": None} for name, machine in machines.items()
    }


_DRIVES = drives()
_VARIED: Axes = [("/machine/speed_rpm", [500, 900]), ("/machine/balance_shafts/0/x_m", [0.1, -0.3])]


@pytest.mark.parametrize("name", night.part(4, list(_DRIVES)))
def test_all_columns_are_those_of_single_answers(name: str) -> None:
    base = {"machine": _DRIVES[name], **LATER}
    checked(base, _VARIED, details=True)
    fitted = [
        {"web": "one web", "mass_kg": 3.0, "angle_deg": 9.0},
        {"position_m": 0.1, "radius_m": 0.2, "mass_kg": 2.0, "angle_deg": 40.0},
    ]
    actual_base = {**base, "outputs": ["residual", *DRIVE], "counterweights": fitted}
    rows = checked(actual_base, [*_VARIED, ("/counterweights/0/mass_kg", [0.0, 3.0])], task="analyze", details=True)
    assert {row["balance_shafts_mass_kg"] for row in rows} == {0.0, 3.0}


def test_proofs_of_rows_are_checked_and_figures_of_shafts_too() -> None:
    survey = {
        "base": {"machine": WITHIN},
        "axes": [{"path": "/machine/throws/0/crank_angle_deg", "values": [80, 100]}],
        "multipliers": True,
    }
    rows = table(sweep(survey["base"], *survey["axes"], multipliers=True)).to_pylist()
    held = {claim["claim"] for claim in checker().verify(survey, rows)["claims"] if claim["verdict"] == "held"}
    assert held >= {"lower_bound", "mass_lower_bound", "sector", "total_mass", "after", "counterweights"}
    assert not broken(survey, rows)
    for name, factor in (("mass_kg.back web", 1.001), ("angle_deg.back web", 1.001), ("balance_shafts_mass_kg", 0.999)):
        false = [{**rows[0], name: factor * rows[0][name]}, rows[1]]
        assert verdict(survey, false) == "broken", name


def test_infeasible_designs_carry_nothing() -> None:
    (row,) = checked({"machine": FORWARDS}, [("/objective/force_ceiling_N", [1e-3 * WHOLE])])
    names = ("balance_shafts_mass_kg", "total_mass_kg", "mass_kg.on web", "angle_deg.on web", "force_peak_N")
    assert (row["status"], [row[name] for name in names]) == ("infeasible", [None] * 5)


def test_a_shaft_takes_its_half_in_every_design() -> None:
    # published: half of the reciprocating mass on either shaft, whatever the mass
    masses = np.linspace(1.0, 20.0, 100)
    axis = {"path": "/machine/throws/0/rows/0/reciprocating_mass_kg", "values": masses.tolist()}
    rows = table(sweep({"machine": BACKWARDS}, axis))
    assert set(rows["status"].to_pylist()) == {"optimal"}
    assert rows["balance_shafts_mass_kg"].to_numpy() == pytest.approx(masses, rel=1e-5)
    assert rows["total_mass_kg"].to_numpy() == pytest.approx(0.5 * masses, rel=1e-5)


@pytest.mark.parametrize(("sector", "count"), [(None, 2), ({"centre_deg": 90.0, "half_angle_deg": 20.0}, 6)])
def test_orders_of_cranks_are_told_apart_by_what_is_on_shafts(sector: dict[str, float] | None, count: int) -> None:
    # analytic: of three angles 3! sequences; a common turn of all cranks makes three of them one, unless a weight may
    # stand at some angles only; ends and mirrors count for nothing beside shafts
    throws = [{**MIXED["throws"][k], "crank_angle_deg": 0.0} for k in range(3)]
    more = {} if sector is None else {"sector": sector}
    machine = {**MIXED, "throws": throws, "balance_shafts": [shaft("a", -1, position=0.1, **more)]}
    request = sweep({"machine": machine}, design="crank_orders", angles_deg=[0, 120, 240])
    assert request.total == count
    for row in table(request).to_pylist():
        assert assert_row_is_the_single_answer(request, row) == "optimal"
