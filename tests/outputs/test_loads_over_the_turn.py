"""Loads of parts are those of all angles: independent samples a fortieth of a degree apart, and analytic figures."""

from typing import Any

import numpy as np
import pytest

from optimizer.numerics.arrays import Real
from schemas.answer.answers import AnalyzeAnswer
from schemas.answer.loads import RowLoad
from tests import night
from tests.analyze.driven import ask, random_driven
from tests.analyze.engines import engine

_DENSE_DEG = 0.025


def _rows(analysis: AnalyzeAnswer) -> tuple[RowLoad, ...]:
    assert analysis.loads is not None
    return analysis.loads.rows


def _machine(name: str) -> dict[str, Any]:
    if name == "engine":
        return engine([0.0, 180.0], gravity_deg=300.0)
    if name == "slow":
        # the friction of a slow machine is large beside its inertia
        return random_driven(5, "v", gravity_deg=250.0, speed_rpm=60.0)
    return random_driven(7, name, gravity_deg=270.0)


_MACHINES = ("v", "engine", "slow", "w", "opposed")


@pytest.mark.parametrize("name", night.part(2, _MACHINES))
def test_nothing_is_larger_at_any_angle_independent(name: str) -> None:
    body = _machine(name)
    loads = _rows(ask(body, "loads", step_deg=90.0))
    dense = ask(body, "gas", "piston_force", "rod_loads", step_deg=_DENSE_DEG)
    assert dense.gas is not None
    assert dense.piston_force is not None
    assert dense.rod_loads is not None
    for row, chambers, forces, rod in zip(
        loads, dense.gas.rows, dense.piston_force.rows, dense.rod_loads.rows, strict=True
    ):
        gas, inertia = np.array(forces.gas_N), np.array(forces.inertia_N)
        _assert_largest(row.largest_gas_N, np.abs(gas))
        _assert_largest(row.largest_inertia_N, np.abs(inertia))
        _assert_largest(row.frame.tension_N, np.maximum(-gas, 0.0))
        _assert_largest(-row.frame.compression_N, np.maximum(gas, 0.0))
        assert row.piston_rod_N == max(row.largest_gas_N, row.largest_inertia_N, row.largest_piston_force_N)
        for cover, chamber in zip(row.covers, chambers.chambers, strict=True):
            _assert_largest(cover.largest_N, np.abs(chamber.force_N))
            _assert_largest(-cover.smallest_N, -np.abs(chamber.force_N))
        guide, side = row.guide, np.array(rod.side_N)
        assert guide is not None
        # which side is the lower one is in the figures of both: the mirror image is no other machine
        ways = [sign * side + guide.weight_N for sign in (1.0, -1.0)]
        force = min(ways, key=lambda values: abs(np.max(values) - guide.largest_N))
        _assert_largest(guide.largest_N, force)
        _assert_largest(-guide.smallest_N, -force)
        assert guide.lifted_share == pytest.approx(np.mean(force < 0.0), abs=20.0 / side.size)
        assert guide.lifts is (guide.smallest_N < 0.0)


def _assert_largest(value: float, samples: Real) -> None:
    """Never below the largest sample, and above it by what a kink between two samples may hide."""
    largest, size = float(np.max(samples)), float(np.max(np.abs(samples)))
    assert -1e-9 * size <= value - largest <= 1e-3 * size


@pytest.mark.parametrize("name", ["v", "engine"])
def test_loads_do_not_depend_on_the_samples(name: str) -> None:
    body = _machine(name)
    assert _rows(ask(body, "loads", step_deg=120.0)) == _rows(ask(body, "loads", step_deg=7.5))


def _single(ratio: float, **row: Any) -> dict[str, Any]:
    single = {"axis_deg": 0.0, "reciprocating_mass_kg": 10.0, "connecting_rod": {"length_m": 0.1 / ratio}, **row}
    throw = {"position_m": 0.0, "crank_radius_m": 0.1, "crank_angle_deg": 0.0, "rows": [single]}
    return {"kind": "reciprocating", "speed_rpm": 300.0 / np.pi, "throws": [throw], "webs": [], "gravity_deg": 270.0}


@pytest.mark.parametrize(("ratio", "factor"), [(0.2, 1.2), (0.5, 1.5), (0.8, 1.8)])
def test_inertia_is_largest_at_the_outer_dead_centre_analytic(ratio: float, factor: float) -> None:
    """m r omega^2 (1 + lambda)."""
    (row,) = _rows(ask(_single(ratio), "loads", step_deg=120.0))
    assert row.largest_inertia_N == pytest.approx(10.0 * 0.1 * 10.0**2 * factor, rel=1e-9)
    assert row.piston_rod_governed_by == "inertia"


def test_inertia_of_a_very_short_rod_is_largest_beside_it_independent() -> None:
    ratio = 0.98
    angle = np.linspace(0.0, np.pi, 2_000_001)
    cosine = np.sqrt(1.0 - (ratio * np.sin(angle)) ** 2)
    acceleration = np.cos(angle) + (ratio * np.cos(2.0 * angle) + ratio**3 * np.sin(angle) ** 4) / cosine**3
    assert np.max(np.abs(acceleration)) > 1.0 + ratio
    (row,) = _rows(ask(_single(ratio), "loads", step_deg=90.0))
    assert row.largest_inertia_N == pytest.approx(100.0 * np.max(np.abs(acceleration)), rel=1e-9)


def test_share_off_the_guide_analytic() -> None:
    """A frictionless row without gas and with an infinite rod has no side force; its mirror image lifts as long."""
    (row,) = _rows(ask(_single(0.2) | {"throws": _infinite()}, "loads", step_deg=90.0))
    assert row.guide is not None
    assert (row.guide.lifted_share, row.guide.lifts) == (0.0, False)
    assert row.guide.largest_N == row.guide.smallest_N == row.guide.weight_N
    # the side force is odd about the dead centres: with opposed gravity the other half of the turn lifts
    (first,), (second,) = (
        _rows(ask(_single(0.4) | {"speed_rpm": 4000.0, "gravity_deg": degrees}, "loads", step_deg=90.0))
        for degrees in (270.0, 90.0)
    )
    assert first.guide is not None
    assert second.guide is not None
    assert first.guide.lifted_share == pytest.approx(second.guide.lifted_share, rel=1e-10)
    # of the inertia alone nearly half of the turn, for the weight is nearly nothing beside it
    assert 0.45 < first.guide.lifted_share < 0.5


def _infinite() -> list[dict[str, Any]]:
    (throw,) = _single(0.2)["throws"]
    (row,) = throw["rows"]
    return [{**throw, "rows": [{**row, "connecting_rod": {"length_m": None}}]}]


def test_an_upright_row_has_no_lower_guide_analytic() -> None:
    (row,) = _rows(ask(_single(0.3) | {"gravity_deg": 180.0}, "loads", step_deg=90.0))
    assert row.guide is not None
    assert (row.guide.weight_N, row.guide.lifts, row.guide.lifted_share) == (0.0, None, 0.0)


def test_a_throw_without_rows_loads_no_guide() -> None:
    (throw,) = _single(0.2)["throws"]
    bare = {"throws": [{**throw, "rotating_mass_kg": 3.0, "rows": []}]}
    assert _rows(ask(_single(0.2) | bare, "loads", step_deg=90.0)) == ()
