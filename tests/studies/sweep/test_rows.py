"""Every row is the answer to its design alone: random fields of random machines, every kind of design."""

from typing import Any

import numpy as np
import pytest

from schemas.answer.outputs import OUTPUT_COLUMNS
from schemas.base.target import find_target
from schemas.sweep.request import SweepRequest
from tests import night
from tests.analyze.driven import STYLES, random_driven
from tests.analyze.engines import UNEVEN, cylinder, engine, trace
from tests.studies.sweep.single import assert_row_is_the_single_answer, example, numeric_paths, sweep, table

GOAL = {"moment_weight": 1.5, "direction_weights": {"x": 1.0, "y": 0.8}}
#: outputs with columns that a machine of rods answers beside its residual
DRIVE = [name for name in OUTPUT_COLUMNS if name not in ("residual", "pin_loads")]
TABLE = {"angle_deg": [0, 90, 200, 360], "torque_Nm": [10, 12, 14, 10]}


def fitted(name: str, *outputs: str, **machine: Any) -> dict[str, Any]:
    body = example(name)
    body["machine"] |= machine
    webs = body["machine"]["webs"]
    return {
        "machine": body["machine"],
        "outputs": list(outputs),
        "angles": {"step_deg": 10},
        "counterweights": [{"web": web["name"], "mass_kg": 3.0, "angle_deg": 190} for web in webs[:2]],
    }


OPTIMIZED = {
    "opposed": {**example("2d12"), "objective": GOAL},
    "eight webs, a budget": {**example("m-type-four"), "objective": {"moment_ceiling_Nm": 60000}},
    "v": {**example("v60"), "objective": {"combine": "max"}},
    "unequal v": {**example("v90-unequal"), "objective": GOAL},
    "oldham ring": {**example("scroll-oldham"), "objective": {"force_weight": 0.0}},
    "crank pins": example("scroll-three-pins"),
    "with outputs": {**example("2d12"), "outputs": DRIVE, "angles": {"step_deg": 30}},
}
ANALYZED = {
    "drive": fitted("2d12", "residual", *DRIVE),
    "pins": fitted("scroll-three-pins", "residual", "pin_loads"),
    "pins, torque over the turn": fitted("scroll-three-pins", "pin_loads", rotation_torque_Nm=TABLE),
    "pins, gas force": fitted("scroll-three-pins", "pin_loads", rotation_torque_Nm=None, tangential_gas_force_N=900),
    "indicated pressures": {
        "machine": engine([0.0, 90.0], [cylinder(UNEVEN), cylinder(trace(90.0, 1), turns=1, dead_centre_deg=90.0)]),
        "outputs": DRIVE,
        "angles": {"step_deg": 30},
    },
    "continuous shaft": {
        **fitted("2d12", "main_bearings"),
        "fidelity": {"shaft": "continuous", "kinematics": "order_2"},
    },
    **{
        f"random {style}": {"machine": random_driven(7, style), "outputs": DRIVE, "angles": {"step_deg": 30}}
        for style in STYLES
    },
}


def random_axes(rng: np.random.Generator, request: SweepRequest, fields: int, count: int) -> list[dict[str, Any]]:
    """Axes over random fields: near what the base holds, and now and then 0, of the other sign, or null."""
    body = request.base.model_dump()
    paths = numeric_paths(request)
    axes = []
    for path in rng.choice(paths, min(fields, len(paths)), replace=False):
        held: Any = body
        for part in path.split("/")[1:]:
            held = held[int(part)] if isinstance(held, tuple | list) else held[part]
        target = find_target(request.base, path)
        values = [held * rng.uniform(0.7, 1.3) + (held == 0) * rng.normal(0.0, 0.1) for _ in range(count)]
        if rng.random() < 0.3:
            values[0] = 0.0
        if rng.random() < 0.15:
            values[-1] = -held
        if target.nullable and rng.random() < 0.4:
            values[count // 2] = None
        axes.append({"path": path, "values": [round(v) if target.integer and v is not None else v for v in values]})
    return axes


def assert_rows(request: SweepRequest, rng: np.random.Generator, most: int) -> set[str]:
    """Compare some rows, each with the answer to its design alone; the statuses seen."""
    rows = table(request).to_pylist()
    assert [row["index"] for row in rows] == list(range(request.total))
    chosen = rng.choice(len(rows), min(most, len(rows)), replace=False)
    return {assert_row_is_the_single_answer(request, rows[k]) for k in chosen}


@pytest.mark.parametrize("task", ["optimize", "analyze"])
@pytest.mark.parametrize("design", night.part(3, ["grid", "paired", "latin_hypercube"]))
@pytest.mark.parametrize("sweeps", [1, pytest.param(3, marks=pytest.mark.nightly)])
def test_rows_are_the_single_answers(task: str, design: str, sweeps: int) -> None:
    # property: for every machine so many sweeps over random fields
    rng = np.random.default_rng([len(task), len(design)])
    texts: set[str] = set()
    for base in (OPTIMIZED if task == "optimize" else ANALYZED).values():
        blank = sweep(base, {"path": "/machine/speed_rpm", "values": [1]}, task=task)
        for _ in range(sweeps):
            fields, count = (int(rng.integers(1, 3)), 3) if design == "grid" else (int(rng.integers(1, 6)), 5)
            rest = {"samples": 6, "seed": int(rng.integers(100))} if design == "latin_hypercube" else {}
            request = sweep(base, *random_axes(rng, blank, fields, count), task=task, design=design, **rest)
            texts |= assert_rows(request, rng, 5)
    assert texts >= {"invalid", "optimal" if task == "optimize" else "analyzed"}


def test_a_pressure_may_vary_alone() -> None:
    path = "/machine/throws/0/rows/0/cylinder/pressure/head/pressure_Pa/5"
    request = sweep(ANALYZED["indicated pressures"], {"path": path, "values": [9e5, 11e5, 13e5]}, task="analyze")
    rows = table(request).to_pylist()
    assert {assert_row_is_the_single_answer(request, row) for row in rows} == {"analyzed"}
    assert len({row["mean_torque_Nm"] for row in rows}) == 3


@pytest.mark.parametrize(
    "seed", night.part(2, [*range(18), *(pytest.param(seed, marks=pytest.mark.nightly) for seed in range(18, 60))])
)
def test_columns_of_every_output_are_the_single_answers(seed: int) -> None:
    # property: to rounding, for as they stand machines bring no solver between
    rng = np.random.default_rng(seed)
    if seed % 6 == 5:
        base = fitted("scroll-three-pins", "residual", "pin_loads", rotation_torque_Nm=rng.uniform(1.0, 50.0))
    else:
        machine = random_driven(seed, STYLES[seed % len(STYLES)])
        shaft, motion = rng.choice(["simple_spans", "continuous"]), rng.choice(["exact", "order_2"])
        base = {
            "machine": machine,
            "outputs": ["residual", *DRIVE],
            "angles": {"step_deg": 30},
            "fidelity": {"shaft": str(shaft), "kinematics": str(motion)},
            "counterweights": [{"web": "a", "mass_kg": rng.uniform(0.0, 20.0), "angle_deg": 70}],
        }
    blank = sweep(base, {"path": "/machine/speed_rpm", "values": [1]}, task="analyze")
    axes = random_axes(rng, blank, int(rng.integers(1, 4)), 4)
    speed = {"path": "/machine/speed_rpm", "values": list(rng.uniform(100.0, 3000.0, 4))}
    actual_axes = [axis for axis in axes if axis["path"] != speed["path"]]
    request = sweep(base, speed, *actual_axes, task="analyze", design="paired")
    texts = {assert_row_is_the_single_answer(request, row, 1e-12) for row in table(request).to_pylist()}
    assert "analyzed" in texts


@pytest.mark.parametrize(
    "axes",
    night.part(
        2,
        [
            # what changes the shape of the program: terms, rows, ceilings, webs
            [("/objective/force_weight", [0, 1]), ("/objective/moment_weight", [0, 2, None])],
            [("/objective/direction_weights/x", [0, 0.5, 1]), ("/objective/direction_weights/y", [0, 1])],
            [("/objective/force_ceiling_N", [None, 100, 9000]), ("/objective/moment_ceiling_Nm", [None, 0, 30000])],
            [("/machine/webs/0/max_mass_kg", [0, 20]), ("/machine/webs/3/max_mass_kg", [0, 1e12])],
            [("/machine/max_total_mass_kg", [None, 0, 1e-6, 50, 1e12]), ("/machine/webs/1/max_mass_kg", [0, 5])],
            [("/machine/reference_plane_m", [None, 0.3]), ("/machine/throws/0/position_m", [-1, 1])],
            [("/machine/throws/0/rows/0/connecting_rod/length_m", [None, 0.1, 0.14, 0.5])],
            [("/machine/throws/1/crank_angle_deg", [0, 90, 180, 270, 360, -540])],
            [("/machine/webs/0/counterweight_radius_m", ["1e-12 m", "1e9 m", 0.2, 0])],
        ],
    ),
)
@pytest.mark.parametrize("combine", ["sum", "max"])
def test_fields_that_change_the_shape_of_the_program(axes: list[tuple[str, list[Any]]], combine: str) -> None:
    base = {**example("2d12"), "objective": {"combine": combine}}
    request = sweep(base, *({"path": path, "values": values} for path, values in axes))
    for row in table(request).to_pylist():
        assert_row_is_the_single_answer(request, row)


def test_sectors_thin_and_wide() -> None:
    base = example("2d12")
    base["machine"]["webs"][0]["sector"] = {"centre_deg": 180, "half_angle_deg": 60}
    half = {"path": "/machine/webs/0/sector/half_angle_deg", "values": [90, 60, 1e-3, 0, 91]}
    centre = {"path": "/machine/webs/0/sector/centre_deg", "values": [0, 200]}
    request = sweep(base, half, centre)
    texts = [assert_row_is_the_single_answer(request, row) for row in table(request).to_pylist()]
    assert texts == ["optimal"] * 6 + ["invalid"] * 4


def test_infeasible_designs_say_so() -> None:
    base = {**example("2d12"), "outputs": ["main_bearings", "torque"], "angles": {"step_deg": 30}}
    request = sweep(base, {"path": "/objective/force_ceiling_N", "values": [1, 1e9]})
    never, easily = table(request).to_pylist()
    assert (never["status"], easily["status"]) == ("infeasible", "optimal")
    assert "ceilings" in never["message"]
    assert easily["message"] is None
    for name in ("force_peak_N", "total_mass_kg", "mass_kg.1a", "objective", "peak_bearing_load_N"):
        assert never[name] is None
        assert easily[name] is not None
    # the torque does not ask for counterweights
    assert never["peak_torque_Nm"] == easily["peak_torque_Nm"]


def test_a_machine_without_webs() -> None:
    base = {"machine": example("2d12")["machine"] | {"webs": []}}
    request = sweep(base, {"path": "/machine/speed_rpm", "values": [300, 600]})
    texts = [assert_row_is_the_single_answer(request, row) for row in table(request).to_pylist()]
    assert texts == ["optimal", "optimal"]


def test_least_mass_left_out() -> None:
    base = {**example("2d12"), "objective": {"least_mass": False}}
    request = sweep(base, {"path": "/machine/speed_rpm", "values": [300, 600]})
    for row in table(request).to_pylist():
        assert row["status"] == "optimal"
        assert row["mass_lower_bound_kg"] is row["mass_relative_gap"] is None


def test_counterweights_of_a_row_make_its_peaks() -> None:
    # independent: the masses and angles of the row, analysed by themselves
    base = {**example("m-type-four"), "objective": {"moment_weight": 0.3}}
    request = sweep(base, {"path": "/machine/throws/2/rows/0/reciprocating_mass_kg", "values": [150, 250]})
    for row in table(request).to_pylist():
        counterweights = [
            {"web": web.name, "mass_kg": row[f"mass_kg.{web.name}"], "angle_deg": row[f"angle_deg.{web.name}"]}
            for web in request.base.machine.webs
        ]
        alone = sweep(
            {"machine": base["machine"], "counterweights": counterweights},
            {"path": "/machine/throws/2/rows/0/reciprocating_mass_kg", "values": [row[request.axes[0].path]]},
            task="analyze",
        )
        (again,) = table(alone).to_pylist()
        for name in ("force_peak_N", "moment_peak_Nm", "total_mass_kg"):
            assert again[name] == pytest.approx(row[name], rel=1e-12)
