"""Rows over the turn are the same to the bit, whichever designs are computed with them."""

from typing import Any

import pyarrow as pa
import pytest

from optimizer.program.methods import implied_bounds
from schemas.sweep.request import SweepRequest
from tests.analyze.engines import UNEVEN, cylinder, engine, trace
from tests.studies.sweep.single import example, sweep, table
from tests.studies.sweep.test_rows import DRIVE, fitted

_ROW = "/machine/throws/0/rows/0"
_MASSES = {"path": f"{_ROW}/reciprocating_mass_kg", "values": [250.0, 277.79]}
#: what the designs have in common then: all but masses and speed, the motion, the gas, nothing
_BESIDE: dict[str, dict[str, Any]] = {
    "speeds": {"path": "/machine/speed_rpm", "values": [400, 500]},
    "bores": {"path": f"{_ROW}/cylinder/bore_m", "values": [0.7, 0.73]},
    "axes": {"path": f"{_ROW}/axis_deg", "values": [0, 0.5]},
    "rods": {"path": f"{_ROW}/connecting_rod/length_m", "values": [0.7, 0.75]},
}


@pytest.mark.parametrize("beside", _BESIDE.values(), ids=_BESIDE)
def test_a_row_does_not_depend_on_its_neighbours(beside: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    # property: what designs have in common is worked out once, or for each, and comes to the same bits
    assert_alike(sweep(fitted("2d12", *DRIVE), _MASSES, beside, task="analyze"), monkeypatch)


def test_nor_does_one_with_indicated_pressures(monkeypatch: pytest.MonkeyPatch) -> None:
    machine = engine([0.0, 90.0], [cylinder(UNEVEN), cylinder(trace(90.0, 1), turns=1, dead_centre_deg=90.0)])
    pressures = {"path": f"{_ROW}/cylinder/pressure/head/pressure_Pa/5", "values": [9e5, 11e5]}
    speeds = {"path": "/machine/speed_rpm", "values": [900, 1000]}
    base = {"machine": machine, "outputs": DRIVE, "angles": {"step_deg": 30}}
    assert_alike(sweep(base, pressures, speeds, task="analyze"), monkeypatch)


def assert_alike(request: SweepRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    together = table(request)
    alone = [table(request, k, k + 1) for k in range(request.total)]
    assert pa.concat_tables(alone).equals(together)
    # places in many parts, of which what forces are made of is not kept
    monkeypatch.setattr("optimizer.mechanics.row_series.AT_ONCE", 100)
    assert table(request).equals(together)


def test_rows_that_do_the_same_later_are_worked_out_as_beside_other_designs(monkeypatch: pytest.MonkeyPatch) -> None:
    # a machine by itself expands equal rows once: a sweep of one design may not, for others stand beside it elsewhere
    row = {"axis_deg": 90, "reciprocating_mass_kg": 20, "connecting_rod": {"length_m": 0.5}}
    throws = [
        {"position_m": 0.3 * k, "crank_radius_m": 0.1, "crank_angle_deg": 90.0 * k, "rows": [row]} for k in range(4)
    ]
    machine = {"kind": "reciprocating", "speed_rpm": 500, "throws": throws}
    outputs = ["piston_force", "rod_loads", "torque", "overturning", "roll", "loads"]
    base = {"machine": machine, "outputs": outputs, "angles": {"step_deg": 30}}
    speeds = {"path": "/machine/speed_rpm", "values": [400, 500, 600]}
    assert_alike(sweep(base, speeds, task="analyze", details=True), monkeypatch)


def test_designs_without_largest_masses_are_proven_together(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(value: object) -> None:
        raise AssertionError("no design needs to be looked at by itself")

    monkeypatch.setattr(implied_bounds, "_within_reach", never)
    base = example("2d12")
    for web in base["machine"]["webs"]:
        web["max_mass_kg"] = None
    rows = table(sweep(base, {"path": "/machine/throws/0/rows/0/reciprocating_mass_kg", "values": [240, 260, 280]}))
    assert set(rows["status"].to_pylist()) == {"optimal"}
