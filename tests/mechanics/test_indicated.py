"""Indicated pressures: values between the entries, work, breaks, series, and batches."""

from typing import Any

import numpy as np
import pytest

from optimizer.mechanics.curve_series import forces
from optimizer.mechanics.cylinders import chambers, cycle_turns, gas_problems, traces
from optimizer.mechanics.gas import gas_forces
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.layout import layout, spread
from optimizer.mechanics.row_data import row_data
from optimizer.mechanics.row_series import RowSeries
from optimizer.mechanics.whole_turn import WholeTurn, break_angles, whole_turn
from optimizer.numerics.arrays import Real
from schemas.machine.reciprocating import ReciprocatingMachine
from tests.analyze.engines import FOUR, RADIUS, UNEVEN, cylinder, engine, trace

TURN = 2.0 * np.pi
CYCLE = {
    "suction_pressure_Pa": 1e5,
    "discharge_pressure_Pa": 4e5,
    "relative_clearance": 0.1,
    "expansion_exponent": 1.3,
    "compression_exponent": 1.3,
}


def machine(body: dict[str, Any]) -> ReciprocatingMachine:
    return ReciprocatingMachine.model_validate(body)


def pressures(body: dict[str, Any], angle_deg: Real) -> Real:
    """Of all chambers, (rows, 2, T) Pa."""
    design = machine(body)
    plan = layout(design)
    moving = motion(plan, np.deg2rad(angle_deg))
    return gas_forces(chambers(design), moving, plan, traces(design, plan)).pressure


def work(design: ReciprocatingMachine, leading: tuple[int, ...] = ()) -> Real:
    """Work of the only trace of the first row, (...) J."""
    plan = spread(layout(design), leading)
    (record,) = traces(design, plan)
    rows, area = plan.reciprocating, chambers(design, leading).area[..., 0, record.side]
    return record.work(area, rows.crank_radius[..., 0], rows.rod_ratio[..., 0], rows.rod_margin[..., 0])


def turn_of(body: dict[str, Any]) -> WholeTurn:
    design = machine(body)
    plan = layout(design)
    actual_traces = traces(design, plan)
    data = row_data(plan, True, np.full(plan.reciprocating.mass.shape, 200.0), chambers(design), actual_traces)
    return whole_turn(data, break_angles(plan, (), actual_traces))


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
@pytest.mark.parametrize("start", [0.0, 100.0, 460.0, 620.0])
def test_pressure_is_linear_between_the_entries_of_two_turns(start: float, rotation: str) -> None:
    body = engine([start], [cylinder(UNEVEN, dead_centre_deg=start)], rotation=rotation)
    angle = np.linspace(-300.0, 1500.0, 1801)
    # independent: the interpolation of numpy
    expected = np.interp(angle - start, UNEVEN["angle_deg"], UNEVEN["pressure_Pa"], period=720.0)
    actual_pressures = pressures(body, angle)
    np.testing.assert_allclose(actual_pressures[0, 0], expected, rtol=1e-11)
    np.testing.assert_array_equal(actual_pressures[0, 1], 1.1e5)


def test_angles_count_from_the_first_outer_dead_centre_by_default() -> None:
    angle = np.linspace(0.0, 719.0, 720)
    # 1/3 is no binary fraction: the first dead centre is at 0, not short of a turn
    for first in (0.0, 100.0, 359.9, 1.0 / 3.0, 1e-13, 360.0, -90.0, 90.0 - 1e-14):
        expected = np.interp(angle - first % 360.0, UNEVEN["angle_deg"], UNEVEN["pressure_Pa"], period=720.0)
        actual_pressures = pressures(engine([first], [cylinder(UNEVEN)]), angle)
        np.testing.assert_allclose(actual_pressures[0, 0], expected, rtol=1e-9)  # independent


@pytest.mark.parametrize("side", ["head", "crank"])
def test_work_of_a_trace_in_closed_form(side: str) -> None:
    # analytic: with an infinite rod the volume is A r (1 -+ cos), and -integral of p dV = integral of V dp
    body = engine([0.0], [cylinder(UNEVEN)])
    body["throws"][0]["rows"][0]["connecting_rod"] = {"length_m": None}
    body["throws"][0]["rows"][0]["cylinder"]["pressure"] = {side: UNEVEN, "cycle_turns": 2}
    body["throws"][0]["rows"][0]["cylinder"]["acting"] = "head" if side == "head" else "crank"
    design = machine(body)
    plan = layout(design)
    (record,) = traces(design, plan)
    rows, area = plan.reciprocating, chambers(design).area[0, record.side]
    angle = np.deg2rad(np.append(UNEVEN["angle_deg"], UNEVEN["angle_deg"][0] + 720.0))
    pressure = np.append(UNEVEN["pressure_Pa"], UNEVEN["pressure_Pa"][0])
    slope = np.diff(pressure) / np.diff(angle)
    sign = -1.0 if side == "head" else 1.0
    volume = area * rows.crank_radius[0] * (np.diff(angle) + sign * np.diff(np.sin(angle)))
    expected = np.sum(slope * volume) / 2.0
    assert float(work(design)) == pytest.approx(float(expected), rel=1e-12)


@pytest.mark.parametrize("lam", [0.05, 0.3, 0.9, 0.9999])
def test_work_of_a_polytropic_trace_is_that_of_the_cycle(lam: float) -> None:
    # analytic: a pressure that is a function of the volume alone does no work in a turn
    angle = np.linspace(0.0, 360.0, 3601)
    turned = np.deg2rad(angle)
    moved = 1.0 - np.cos(turned) + (1.0 - np.sqrt(1.0 - (lam * np.sin(turned)) ** 2)) / lam
    pressure = 1e5 * (2.2 / (moved + 0.2)) ** 1.3
    pressure[-1] = pressure[0]
    body = engine([0.0], [cylinder({"angle_deg": angle.tolist(), "pressure_Pa": pressure.tolist()}, turns=1)])
    body["throws"][0]["rows"][0]["connecting_rod"]["length_m"] = 0.05 / lam
    design = machine(body)
    assert abs(float(work(design))) < 1e-8 * np.max(pressure) * 2.0 * RADIUS * float(chambers(design).area[0, 0])


def test_breaks_are_the_entries_of_all_turns() -> None:
    two = engine([30.0, 210.0], [cylinder(UNEVEN, dead_centre_deg=390.0), cylinder(trace(60.0, 1), turns=1)])
    design = machine(two)
    plan = layout(design)
    assert cycle_turns(design) == 2
    values = np.rad2deg(break_angles(plan, (), traces(design, plan)))
    entries = np.concatenate([np.array(UNEVEN["angle_deg"]) + 390.0, 210.0 + np.arange(0.0, 720.0, 60.0)])
    dead = 30.0 + np.arange(0.0, 720.0, 180.0)
    expected = np.unique(np.round(np.concatenate([entries, dead]) % 720.0, 6) % 720.0)
    # a break at the end of the cycle is one at its beginning
    np.testing.assert_allclose(np.unique(np.round(values % 720.0, 6) % 720.0), expected)
    assert values.size <= expected.size + 1


@pytest.mark.parametrize("step", [90.0, 7.5])
def test_no_curve_leaves_its_pieces(step: float) -> None:
    # analytic: Taylor's theorem, at angles spread over every piece of both turns
    turn = turn_of(engine(FOUR, [cylinder(trace(step), dead_centre_deg=angle) for angle in FOUR]))
    assert turn.turns == 2
    for reading in ("piston", "rod", "rod_at_rest", "tangential", "radial", "on_shaft"):
        curves = turn.curves(reading, np.eye(4)[None])  # type: ignore[arg-type]
        pieces = curves.pieces
        assert curves.period_deg == 720.0
        assert np.sum(2.0 * pieces.half[0]) == pytest.approx(2.0 * TURN, rel=1e-9)
        for place in np.linspace(-1.0, 1.0, 5):
            curve, piece = np.nonzero(pieces.half > 0)
            angle = pieces.centre[curve, piece] + place * pieces.half[curve, piece]
            left_out = np.abs(curves.values(curve, piece, angle) - pieces.cubic[curve, piece] @ place ** np.arange(4))
            assert np.all(left_out <= pieces.rest[curve, piece] + 1e-12 * np.max(np.abs(pieces.cubic))), reading


def test_series_have_the_values_of_the_samples() -> None:
    body = engine(FOUR)
    design = machine(body)
    plan = layout(design)
    turn = turn_of(body)
    angle = np.random.default_rng(3).uniform(0.0, 2.0 * TURN, 300)
    actual_forces = forces(RowSeries(turn.rows, angle[None], None, angle[None], 0), "gas")
    # independent: the forces of the samples
    expected = gas_forces(chambers(design), motion(plan, angle), plan, traces(design, plan)).total
    np.testing.assert_allclose(actual_forces[0, ..., 0].real, expected, rtol=1e-9, atol=1e-9 * np.max(np.abs(expected)))


def test_a_batch_is_the_loop() -> None:
    """Columns in angles, pressures, dead centres and cranks."""
    first, last = np.array([0.0, 20.0, 77.0]), np.array([1e5, 2e5, 3e5])
    parts = []
    for k in range(3):
        held = {**UNEVEN, "pressure_Pa": [*UNEVEN["pressure_Pa"][:-1], float(last[k])]}
        held["angle_deg"] = [*held["angle_deg"][:-1], 690.0 + k]
        parts.append(engine([float(first[k])], [cylinder(held, dead_centre_deg=float(first[k]) + 360.0)]))
    angle = np.deg2rad(np.linspace(0.0, 719.0, 144))
    design = machine(parts[0])
    throw = design.throws[0]
    row = throw.rows[0]
    assert row.cylinder is not None
    assert row.cylinder.pressure is not None
    indicated_pressure = row.cylinder.pressure
    assert indicated_pressure.head is not None
    head = indicated_pressure.head.model_copy(
        update={
            "pressure_Pa": (*indicated_pressure.head.pressure_Pa[:-1], last),
            "angle_deg": (*indicated_pressure.head.angle_deg[:-1], 690.0 + np.arange(3.0)),
        }
    )
    pressure = indicated_pressure.model_copy(update={"head": head, "dead_centre_deg": first + 360.0})
    row = row.model_copy(update={"cylinder": row.cylinder.model_copy(update={"pressure": pressure})})
    many = design.model_copy(
        update={"throws": (throw.model_copy(update={"rows": (row,), "crank_angle_deg": 90.0 - first}),)}
    )
    plan = spread(layout(many), (3,))
    actual_forces = gas_forces(chambers(many, (3,)), motion(plan, angle), plan, traces(many, plan))
    series = RowSeries(
        row_data(plan, True, None, chambers(many, (3,)), traces(many, plan)),
        np.broadcast_to(angle, (3, angle.size)),
        None,
        np.broadcast_to(angle, (3, angle.size)),
        1,
    )
    batch = work(many, (3,))
    for k, body in enumerate(parts):
        alone = machine(body)
        own = layout(alone)
        (single,) = traces(alone, own)
        expected = gas_forces(chambers(alone), motion(own, angle), own, (single,))
        np.testing.assert_allclose(actual_forces.pressure[k], expected.pressure, rtol=1e-11)
        np.testing.assert_allclose(forces(series, "gas")[k, ..., 0].real, expected.total, rtol=1e-9, atol=1e-6)
        assert float(batch[k]) == pytest.approx(float(work(alone)), rel=1e-9)


@pytest.mark.parametrize("side", ["head", "crank"])
def test_a_trace_on_one_side_leaves_the_other_open(side: str) -> None:
    """Independent: a piston whose acting side and rod are said."""
    actual_cylinder = cylinder(UNEVEN)
    actual_cylinder |= {"acting": side, "pressure": {side: UNEVEN, "cycle_turns": 2}}
    named = ("bore_m", "ambient_pressure_Pa", "pressure", *(("piston_rod_diameter_m",) if side == "crank" else ()))
    trunk = {name: actual_cylinder[name] for name in named}
    assert not list(gas_problems(machine(engine([0.0], [trunk]))))
    angle = np.linspace(0.0, 719.0, 20)
    np.testing.assert_array_equal(
        pressures(engine([0.0], [trunk]), angle), pressures(engine([0.0], [actual_cylinder]), angle)
    )
    area = chambers(machine(engine([0.0], [trunk]))).area
    np.testing.assert_array_equal(area, chambers(machine(engine([0.0], [actual_cylinder]))).area)


@pytest.mark.parametrize(
    ("fields", "missing"),
    [
        ({}, {"ambient_pressure_Pa": ": the crank side has no indicated pressure and is open"}),
        # what is begun is a cycle
        (
            {"suction_pressure_Pa": 1e5, "discharge_pressure_Pa": 4e5, "piston_rod_diameter_m": 0.02},
            dict.fromkeys(
                ("relative_clearance", "expansion_exponent", "compression_exponent"),
                " on the crank side, which has no indicated pressure",
            ),
        ),
        (
            {
                "acting": "double",
                "piston_rod_diameter_m": 0.02,
                "crank": {name: value for name, value in CYCLE.items() if name != "relative_clearance"},
            },
            {
                "relative_clearance": " on the crank side, which has no indicated pressure; it is open if acting is "
                "left out"
            },
        ),
        ({"piston_rod_diameter_m": 0.02, "crank": CYCLE}, {}),
    ],
)
def test_what_a_side_without_a_trace_needs_is_named_with_the_reason(
    fields: dict[str, Any], missing: dict[str, str]
) -> None:
    actual_fields = {"bore_m": 0.1, "pressure": {"head": UNEVEN, "cycle_turns": 2}, **fields}
    problems = gas_problems(machine(engine([0.0], [actual_fields])))
    messages = {str(problem.path[-1]): problem.message for problem in problems}
    assert messages == {name: f"gas forces need this field{words}" for name, words in missing.items()}
