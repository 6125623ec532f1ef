"""Cylinders as arrays, and what is missing or impossible in their data."""

from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.mechanics.cylinders import (
    chambers,
    cycle_turns,
    delivery_rules,
    entry_count,
    gas_problems,
    trace_rules,
    traces,
    without_gas,
)
from optimizer.mechanics.layout import layout
from schemas.base.variation import with_fields
from schemas.machine.cylinder import Cylinder
from schemas.machine.reciprocating import ReciprocatingMachine

FULL = {
    "bore_m": 0.5,
    "piston_rod_diameter_m": 0.1,
    "suction_pressure_Pa": 1e5,
    "discharge_pressure_Pa": 3e5,
    "relative_clearance": 0.1,
    "expansion_exponent": 1.2,
    "compression_exponent": 1.3,
}
SINGLE = {"acting": "head", "ambient_pressure_Pa": 9e4}


def machine(*cylinders: dict[str, Any] | None, rotation: str = "ccw") -> ReciprocatingMachine:
    """Rows 0 and 1 on the first throw, the others on the second."""
    rows = [
        {
            "axis_deg": 90.0 * k,
            "reciprocating_mass_kg": 1.0,
            "connecting_rod": {"length_m": 0.5},
            "cylinder": cylinder,
        }
        for k, cylinder in enumerate(cylinders)
    ]
    throws = [
        {"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": 0.0, "rows": part}
        for z, part in ((0.0, rows[:2]), (1.0, rows[2:]))
    ]
    body = {"kind": "reciprocating", "speed_rpm": 500.0, "throws": throws, "rotation": rotation}
    return ReciprocatingMachine.model_validate(body)


def without(*names: str, **rest: Any) -> dict[str, Any]:
    return {**{name: value for name, value in FULL.items() if name not in names}, **rest}


def test_areas() -> None:
    cylinders = chambers(
        machine(FULL, without("bore_m", "piston_rod_diameter_m", head_area_m2=0.2, crank_area_m2=0.19))
    )
    ring = 0.25 * np.pi * (0.25 - 0.01)  # analytic
    np.testing.assert_allclose(cylinders.area, [[0.0625 * np.pi, ring], [0.2, 0.19]], rtol=1e-15)
    assert cylinders.closed.all()


def test_rows_stand_throw_by_throw() -> None:
    values = [without("relative_clearance", relative_clearance=0.01 * (k + 1)) for k in range(4)]
    np.testing.assert_array_equal(chambers(machine(*values)).clearance[:, 0], [0.01, 0.02, 0.03, 0.04])


def test_a_side_may_have_data_of_its_own() -> None:
    fields = without(head={"suction_pressure_Pa": 2e5, "expansion_exponent": 1.1}, crank={"relative_clearance": 0.3})
    cylinders = chambers(machine(fields))
    np.testing.assert_array_equal(cylinders.suction, [[2e5, 1e5]])
    np.testing.assert_array_equal(cylinders.discharge, [[3e5, 3e5]])
    np.testing.assert_array_equal(cylinders.clearance, [[0.1, 0.3]])
    np.testing.assert_array_equal(cylinders.expansion_exponent, [[1.1, 1.2]])
    np.testing.assert_array_equal(cylinders.compression_exponent, [[1.3, 1.3]])


@pytest.mark.parametrize("side", [0, 1])
def test_single_acting(side: int) -> None:
    cylinders = chambers(machine(without(acting=("head", "crank")[side], ambient_pressure_Pa=9e4)))
    assert cylinders.closed[0].tolist() == [side == 0, side == 1]
    assert cylinders.suction[0, 1 - side] == cylinders.discharge[0, 1 - side] == 9e4
    assert cylinders.suction[0, side] == 1e5


def paths(cylinders: list[dict[str, Any] | None]) -> list[tuple[str | int, ...]]:
    return [problem.path for problem in gas_problems(machine(*cylinders))]


@pytest.mark.parametrize("field", list(FULL))
def test_a_missing_field_is_named_in_its_place(field: str) -> None:
    actual_paths = paths([FULL, FULL, without(field), FULL])
    place = ("throws", 1, "rows", 0, "cylinder")
    expected = {"bore_m": [(*place, "bore_m"), (*place, "crank_area_m2")]}.get(field, [(*place, field)])
    assert actual_paths == expected


def test_nothing_is_missing_where_it_is_not_needed() -> None:
    assert paths([FULL]) == []
    state = ("suction_pressure_Pa", "relative_clearance")
    own = {name: FULL[name] for name in state}
    assert paths([without(*state, head=own, crank=own)]) == []
    # a side that is open needs no gas
    assert paths([without(*state, head=own, **SINGLE)]) == []
    assert paths([without(*state, head=own)]) == [("throws", 0, "rows", 0, "cylinder", name) for name in state]


def test_single_acting_needs_the_ambient() -> None:
    assert paths([without(acting="crank")]) == [("throws", 0, "rows", 0, "cylinder", "ambient_pressure_Pa")]


def test_a_row_without_a_cylinder_carries_no_gas() -> None:
    design = machine(FULL, None)
    assert without_gas(design) == (("throws", 0, "rows", 1, "cylinder"),)
    assert paths([FULL, None]) == []
    assert np.all(chambers(design).area[1] == 0.0)
    assert np.all(chambers(design).area[0] > 0.0)


def test_all_that_is_missing_is_named_at_once() -> None:
    # areas of both sides, and five of the gas
    assert len(paths([{}])) == 7
    assert len(paths([{}, None, {"acting": "head"}])) == 7 + 8


@pytest.mark.parametrize(
    ("changes", "delivers"),
    [
        ({}, True),
        # analytic: re-expansion fills c (3^(1/1.2) - 1) strokes, all of it at c = 0.667
        ({"relative_clearance": 0.66}, True),
        ({"relative_clearance": 0.67}, False),
        ({"crank": {"relative_clearance": 0.67}}, False),
        ({"crank": {"relative_clearance": 0.67}, **SINGLE}, True),
        # analytic: compression by 1 + 1/c reaches at most (1 + 1/c)^1.1 = 1.94 times the suction pressure
        ({"relative_clearance": 1.2, "expansion_exponent": 9.0, "compression_exponent": 1.1}, False),
    ],
)
def test_too_much_clearance_is_named(changes: dict[str, Any], delivers: bool) -> None:
    design = machine(FULL, {**FULL, **changes})
    rules = [rule for rule in delivery_rules(design, layout(design)) if rule.broken]
    assert [rule.path for rule in rules] == (
        [] if delivers else [("throws", 0, "rows", 1, "cylinder", "relative_clearance")]
    )


@pytest.mark.parametrize(
    ("changes", "path"),
    [
        ({"discharge_pressure_Pa": 9e4}, ("discharge_pressure_Pa",)),
        ({"head": {"discharge_pressure_Pa": 9e4}}, ("head", "discharge_pressure_Pa")),
        ({"head": {"suction_pressure_Pa": 4e5}}, ("head", "suction_pressure_Pa")),
        ({"crank": {"suction_pressure_Pa": 4e5, "discharge_pressure_Pa": 3e5}}, ("crank", "discharge_pressure_Pa")),
    ],
)
def test_no_side_may_discharge_below_its_suction(changes: dict[str, Any], path: tuple[str, ...]) -> None:
    with pytest.raises(ValidationError) as refused:
        Cylinder.model_validate({**FULL, **changes})
    (error,) = refused.value.errors()
    assert [problem.path for problem in error["ctx"]["problems"]] == [path]


def recorded(turns: int = 1, start: float | None = None, **rest: Any) -> dict[str, Any]:
    """A head side with three entries, and a trunk piston behind it."""
    table = {"angle_deg": [10.0, 100.0, 250.0], "pressure_Pa": [1e5, 5e5, 2e5]}
    if turns == 2:
        table = {"angle_deg": [10.0, 100.0, 450.0, 600.0], "pressure_Pa": [1e5, 5e5, 2e5, 3e5]}
    pressure = {"head": table, "cycle_turns": turns, "dead_centre_deg": start}
    return {"bore_m": 0.5, "ambient_pressure_Pa": 1e5, "pressure": pressure, **rest}


def test_a_record_goes_from_an_entry_of_the_cycle_before_to_one_of_the_next() -> None:
    design = machine(FULL, recorded())
    (trace,) = traces(design, layout(design))
    assert (trace.row, trace.side, trace.turns) == (1, 0, 1)
    np.testing.assert_allclose(np.rad2deg(trace.angle), [[-110.0, 10.0, 100.0, 250.0, 370.0]])
    np.testing.assert_array_equal(trace.pressure, [[2e5, 1e5, 5e5, 2e5, 1e5]])
    assert trace.cycle == pytest.approx(2 * np.pi)
    assert trace.table == 0
    two = machine(recorded(2))
    (record,) = traces(two, layout(two))
    np.testing.assert_allclose(np.rad2deg(record.angle), [[-120.0, 10.0, 100.0, 450.0, 600.0, 730.0]])
    # a trunk piston is open to the crankcase: all of its area
    assert chambers(two).area[0] == pytest.approx([0.0625 * np.pi, 0.0625 * np.pi])
    assert not chambers(two).closed.any()
    assert chambers(two).suction[0].tolist() == [0.0, 1e5]


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
@pytest.mark.parametrize("start", [None, 0.0, 90.0, 270.0, 360.0, 450.0, 630.0, 720.0])
def test_a_record_begins_at_a_dead_centre_of_its_row(start: float | None, rotation: str) -> None:
    """Analytic: rows at 0 and 90 degrees, whose outer dead centres come at 0, and at 90 or 270, of the shaft."""
    for number, centre in ((0, 0.0), (1, 90.0 if rotation == "ccw" else 270.0)):
        first = centre if start is None else start
        if (first - centre) % 360.0:
            continue
        cylinders = [recorded(2, start) if k == number else None for k in range(2)]
        design = machine(*cylinders, rotation=rotation)
        (trace,) = traces(design, layout(design))
        # of a shaft that has turned to the dead centre the table is at its beginning
        own = np.deg2rad(first - 90.0 * number * (1.0 if rotation == "ccw" else -1.0))
        assert float(trace.lead) == pytest.approx(own, abs=1e-12)
        pressure, _ = trace.at(np.array([own + np.deg2rad(100.0)]))
        assert pressure == pytest.approx([5e5])


def test_cycles_and_entries_are_counted_over_all_turns() -> None:
    assert cycle_turns(machine(FULL, None)) == 1
    assert cycle_turns(machine(recorded(), FULL)) == 1
    assert cycle_turns(machine(recorded(), recorded(2))) == 2
    assert entry_count(machine(FULL)) == 0
    assert entry_count(machine(recorded(), recorded())) == 6
    # what repeats after one turn comes twice
    assert entry_count(machine(recorded(), recorded(2))) == 2 * 3 + 4


@pytest.mark.parametrize(("most", "many"), [(5, True), (6, False)])
def test_rows_times_entries_are_limited(most: int, many: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Analytic: two rows, and three entries of both, which coincide where axes do."""
    monkeypatch.setattr("optimizer.mechanics.cylinders.MAX_ENTRIES", most)
    both = machine(recorded(), recorded())
    rows = [row.model_copy(update={"axis_deg": 0.0}) for row in both.throws[0].rows]
    alike = both.model_copy(
        update={"throws": (both.throws[0].model_copy(update={"rows": tuple(rows)}), both.throws[1])}
    )
    for reciprocating_machine, entries in ((alike, 3), (both, 6)):
        (rule,) = trace_rules(reciprocating_machine, layout(reciprocating_machine))
        assert bool(rule.broken) == (2 * entries > most if reciprocating_machine is both else many)
        assert rule.path == ("throws", 0, "rows", 0, "cylinder", "pressure")
        assert f"at most {most}" in rule.message
    assert list(trace_rules(machine(FULL), layout(machine(FULL)))) == []


@pytest.mark.parametrize(
    ("cylinder", "words"),
    [
        ({"bore_m": 0.5}, dict.fromkeys(("piston_rod_diameter_m", *list(FULL)[2:]), "")),
        (without("crank_area_m2", "bore_m", head_area_m2=0.1), {"crank_area_m2": ""}),
        (
            recorded(ambient_pressure_Pa=None),
            {"ambient_pressure_Pa": ": the crank side has no indicated pressure and is open"},
        ),
        (
            recorded(piston_rod_diameter_m=0.1, acting="double", **{name: FULL[name] for name in list(FULL)[3:]}),
            {
                "suction_pressure_Pa": " on the crank side, which has no indicated pressure; it is open if acting is"
                " left out"
            },
        ),
        (
            recorded(piston_rod_diameter_m=0.1, **{name: FULL[name] for name in list(FULL)[3:]}),
            {"suction_pressure_Pa": " on the crank side, which has no indicated pressure"},
        ),
    ],
)
def test_what_is_missing_is_named_with_the_reason(cylinder: dict[str, Any], words: dict[str, str]) -> None:
    messages = {str(problem.path[-1]): problem.message for problem in gas_problems(machine(cylinder))}
    assert messages == {name: f"gas forces need this field{word}" for name, word in words.items()}


@pytest.mark.parametrize("field", ["suction_pressure_Pa", "relative_clearance", "bore_m"])
def test_a_column_of_one_cylinder_is_each_of_its_values_alone(field: str) -> None:
    column = np.array([1.0, 1.1, 1.3]) * FULL[field]
    path = ("throws", 0, "rows", 1, "cylinder", field)
    plain = machine(FULL, FULL, FULL)
    together = chambers(with_fields(plain, {path: column}))
    assert together.area.shape == (3, 3, 2)
    for n, pressure in enumerate(column):
        alone = chambers(with_fields(plain, {path: float(pressure)}))
        for name, array in vars(alone).items():
            assert np.array_equal(getattr(together, name)[n], array), name
