"""Columns in detail: only where they are asked for, and each the figure of the single answer."""

from typing import Any

import numpy as np
import pytest

from optimizer.outputs.details import DETAILED
from optimizer.studies.sweep import plan
from schemas.sweep.details import DETAILS, keys_of
from schemas.sweep.request import SweepRequest
from service.common.validation import InvalidRequest
from tests.analyze.driven import STYLES, random_driven
from tests.night import part
from tests.studies.sweep.details import FIGURES
from tests.studies.sweep.single import assert_row_is_the_single_answer, example, sweep, table
from tests.studies.sweep.test_neighbours import assert_alike
from tests.studies.sweep.test_rows import DRIVE, fitted

SPEEDS = {"path": "/machine/speed_rpm", "values": [400, 500]}


def analysis(*outputs: str, **rest: Any) -> SweepRequest:
    """Two speeds of the 2D12, of which two bearings say how large they are."""
    base = fitted("2d12", *outputs)
    for bearing in base["machine"]["bearings"][1:]:
        bearing |= {"diameter_m": 0.2, "length_m": 0.1}
    return sweep(base, SPEEDS, task="analyze", **rest)


@pytest.mark.parametrize("output", DETAILS)
def test_what_is_declared_is_worked_out(output: str) -> None:
    keys = [key for group in DETAILED[output] for key in group.keys]
    assert sorted(keys) == sorted(keys_of(output))
    assert set(keys) <= set(FIGURES.values())


def test_the_others_are_as_they_were() -> None:
    usual, detailed = analysis("residual", *DRIVE), analysis("residual", *DRIVE, details=True)
    names = [column.name for column in usual.all_columns]
    assert "bearing_rms_N.A" not in names
    assert set(names) < {column.name for column in detailed.all_columns}
    assert table(detailed).select(names).equals(table(usual))


def test_one_that_is_named_comes_without_the_rest() -> None:
    named = analysis("main_bearings", columns=["bearing_rms_N.B"])
    assert [column.name for column in plan(named).columns] == ["index", "status", "bearing_rms_N.B"]
    assert table(named).equals(table(analysis("main_bearings", details=True)).select(table(named).column_names))


@pytest.mark.parametrize(
    "compared", [{"top": {"by": "bending_floor_Nm"}}, {"pareto": ["bending_floor_Nm", "bearing_peak_N.A"]}]
)
def test_what_is_compared_comes_along(compared: dict[str, Any]) -> None:
    names = [column.name for column in plan(analysis("main_bearings", **compared)).columns]
    assert {"bending_floor_Nm", "bearing_peak_N.B"} <= set(names)
    assert "bearing_floor_N.A" not in names


def test_of_an_output_that_is_not_asked_for_there_are_none() -> None:
    with pytest.raises(InvalidRequest) as refused:
        analysis("torque", columns=["bearing_rms_N.B"])
    (problem,) = refused.value.problems
    assert problem.path == ("columns", 0)


@pytest.mark.parametrize(
    ("columns", "left"),
    [
        (["bearing_peak_N.B"], ["bearings.floors", "bearings.shaft_curves"]),
        (["bearing_rms_N.B"], ["bearings.floors"]),
        (["bending_floor_Nm"], ["bearings.shaft_curves"]),
        (None, ["bearings.floors", "bearings.shaft_curves"]),
    ],
)
def test_what_nobody_asks_for_is_not_worked_out(
    columns: list[str] | None, left: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def never(*arguments: object) -> None:
        raise AssertionError("nobody asked for it")

    for name in left:
        monkeypatch.setattr(f"optimizer.outputs.details.{name}", never)
    assert table(analysis("main_bearings", columns=columns)).num_rows == 2


def test_what_takes_longer_is_estimated_to() -> None:
    usual, floors = plan(analysis("main_bearings")), plan(analysis("main_bearings", columns=["bending_floor_Nm"]))
    assert floors.cpu_s > 2 * usual.cpu_s


def test_rows_do_not_depend_on_their_neighbours(monkeypatch: pytest.MonkeyPatch) -> None:
    assert_alike(analysis("residual", *DRIVE, details=True), monkeypatch)


@pytest.mark.parametrize("seed", part(2, range(12)))
def test_they_are_the_figures_of_single_answers(seed: int) -> None:
    # property: of random machines, some of whose fields vary
    rng = np.random.default_rng([seed, 18])
    base = {
        "machine": random_driven(seed, STYLES[seed % len(STYLES)]),
        "outputs": ["residual", *DRIVE],
        "angles": {"step_deg": 15},
        "fidelity": {"shaft": str(rng.choice(["simple_spans", "continuous"]))},
        "counterweights": [{"web": "a", "mass_kg": rng.uniform(0.0, 20.0), "angle_deg": 70}],
    }
    base["machine"] |= {"gravity_deg": float(rng.choice([-90.0, 30.0])), "stationary_mass_kg": 5000}
    base["machine"]["bearings"][0] |= {"diameter_m": 0.1, "length_m": 0.05}
    speed = {"path": "/machine/speed_rpm", "values": list(rng.uniform(100.0, 3000.0, 3))}
    sizes = {"path": "/machine/bearings/0/diameter_m", "values": [0.1, None, 0.2]}
    mass = {"path": "/machine/throws/0/rows/0/reciprocating_mass_kg", "values": list(rng.uniform(1.0, 200.0, 3))}
    request = sweep(base, speed, sizes, mass, task="analyze", design="paired", details=True)
    rows = table(request).to_pylist()
    assert {assert_row_is_the_single_answer(request, row) for row in rows} == {"analyzed"}
    assert [row["specific_load_Pa.0"] is None for row in rows] == [False, True, False]


def test_optima_and_what_is_infeasible() -> None:
    base = {**example("2d12"), "outputs": ["main_bearings"], "angles": {"step_deg": 30}}
    request = sweep(base, {"path": "/objective/force_ceiling_N", "values": [1, 1e9]}, details=True)
    never, easily = table(request).to_pylist()
    assert assert_row_is_the_single_answer(request, never) == "infeasible"
    assert assert_row_is_the_single_answer(request, easily) == "optimal"
    assert never["bearing_rms_N.A"] is None
    assert never["bearing_floor_N.A"] == easily["bearing_floor_N.A"]
