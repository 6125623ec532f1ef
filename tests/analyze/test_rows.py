"""A machine of many rows is the sum of its rows, each at its own phase."""

from typing import Any

import numpy as np
import pytest

from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.layout import layout
from schemas.machine.reciprocating import ReciprocatingMachine
from tests import night
from tests.analyze.driven import STYLES, ask, random_driven


def rows_of(body: dict[str, Any]) -> list[dict[str, Any]]:
    """The machine with one of its rows each, no friction, no rotating masses but the rod's."""
    parts = []
    for throw in body["throws"]:
        parts += [{**body, "throws": [{**throw, "rotating_mass_kg": 0.0, "rows": [row]}]} for row in throw["rows"]]
    return parts


@pytest.mark.parametrize("style", night.part(2, STYLES))
@pytest.mark.parametrize("seed", range(3))
def test_a_machine_is_the_sum_of_its_rows(seed: int, style: str) -> None:
    body = random_driven(seed, style, friction=None)
    for throw in body["throws"]:
        throw["rotating_mass_kg"] = 0.0
    outputs = ("torque", "overturning", "main_bearings", "gas", "kinematics", "rod_loads", "piston_force")
    whole = ask(body, *outputs, step_deg=5.0)
    parts = [ask(row, *outputs, step_deg=5.0) for row in rows_of(body)]
    near = {"rtol": 1e-10}

    def add(of: Any) -> Any:
        return np.sum([of(part) for part in parts], axis=0)

    scale = np.abs(whole.torque.torque_Nm).max()
    torque = add(lambda subject: subject.torque.torque_Nm)
    np.testing.assert_allclose(whole.torque.torque_Nm, torque, atol=1e-11 * scale, **near)
    couple = add(lambda subject: subject.overturning.couple_Nm)
    np.testing.assert_allclose(whole.overturning.couple_Nm, couple, atol=1e-11 * scale, **near)
    # analytic: without friction the overturning couple is the torque
    np.testing.assert_allclose(whole.overturning.couple_Nm, whole.torque.torque_Nm, atol=1e-11 * scale)
    assert whole.torque.mean_torque_Nm == pytest.approx(add(lambda subject: subject.torque.mean_torque_Nm), rel=1e-9)
    assert whole.gas.indicated_power_W == pytest.approx(add(lambda subject: subject.gas.indicated_power_W), rel=1e-12)
    governing = max(part.rod_loads.governing_load_N for part in parts)
    assert whole.rod_loads.governing_load_N == pytest.approx(governing, rel=1e-8)
    for k, bearing in enumerate(whole.main_bearings.bearings):
        for axis in ("force_x_N", "force_y_N"):
            load = add(lambda subject, k=k, axis=axis: getattr(subject.main_bearings.bearings[k].before, axis))
            scale = bearing.before.peak_N + 1.0
            np.testing.assert_allclose(getattr(bearing.before, axis), load, atol=1e-10 * scale, **near)


def assert_alike(mine: Any, own: Any, of: str = "") -> None:
    """Series are the same; peaks are, within their brackets, and where there are several, one of them is found."""
    if isinstance(mine, dict):
        for name, value in mine.items():
            assert_alike(value, own[name], name)
    elif of == "cases":
        for first, second in zip(mine, own, strict=True):
            assert_alike(first, second)
    elif of.startswith(("peak_", "tension_", "compression_", "governing_load")):
        if not of.endswith("_deg"):
            np.testing.assert_allclose(mine, own, rtol=1e-8)
    else:
        assert mine == own, of


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", range(2))
def test_every_row_is_what_it_is_alone(seed: int, style: str) -> None:
    body = random_driven(seed, style, friction=None)
    outputs = ("gas", "kinematics", "rod_loads", "piston_force")
    whole = ask(body, *outputs, step_deg=10.0)
    labels = [(t, i) for t, throw in enumerate(body["throws"]) for i, _ in enumerate(throw["rows"])]
    for k, part in enumerate(rows_of(body)):
        alone = ask(part, *outputs, step_deg=10.0)
        for output in outputs:
            mine, own = getattr(whole, output).rows[k], getattr(alone, output).rows[0]
            assert (mine.throw, mine.row) == labels[k]
            assert_alike(mine.model_dump(exclude={"throw", "row"}), own.model_dump(exclude={"throw", "row"}))


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_a_row_with_another_crank_or_axis_is_the_same_row_later(rotation: str) -> None:
    body = random_driven(5, "single", throws=1, rotation=rotation, friction=None)
    sense = 1.0 if rotation == "ccw" else -1.0
    throw, row = body["throws"][0], body["throws"][0]["rows"][0]
    here = ask(body, "torque", "gas", step_deg=10.0)
    for crank, axis in ((40.0, 0.0), (0.0, 70.0), (-120.0, 30.0)):
        turned_throw = {
            **throw,
            "crank_angle_deg": throw["crank_angle_deg"] + crank,
            "rows": [{**row, "axis_deg": row["axis_deg"] + axis}],
        }
        there = ask({**body, "throws": [turned_throw]}, "torque", "gas", step_deg=10.0)
        # analytic: the own angle is ahead by s (crank - axis)
        ahead = round(sense * (crank - axis) / 10.0)
        for of in (lambda subject: subject.torque.torque_Nm, lambda subject: subject.gas.rows[0].force_N):
            expected = np.roll(of(here), -ahead)
            np.testing.assert_allclose(of(there), expected, rtol=1e-9, atol=1e-10 * np.abs(expected).max())
        assert there.torque.mean_torque_Nm == pytest.approx(here.torque.mean_torque_Nm, rel=1e-10)
        assert there.torque.fluctuation_energy_J == pytest.approx(here.torque.fluctuation_energy_J, rel=1e-4)


def test_an_opposed_pair_has_equal_own_angles() -> None:
    # published: cranks and axes both half a turn apart, so both rows pass their dead centres together
    body = random_driven(1, "single", throws=2)
    first, second = body["throws"]
    second["crank_angle_deg"] = first["crank_angle_deg"] + 180.0
    second["rows"][0]["axis_deg"] = first["rows"][0]["axis_deg"] + 180.0
    rows = ask(body, "kinematics", step_deg=30.0).kinematics.rows
    turned = np.exp(1j * np.deg2rad([row.crank_angle_deg for row in rows]))
    np.testing.assert_allclose(turned[0], turned[1], atol=1e-12)


def test_series_stand_over_the_sampled_angles() -> None:
    body = random_driven(2, "v")
    answer = ask(body, "kinematics", "piston_force", "overturning", step_deg=7.5)
    angles = 7.5 * np.arange(48)
    np.testing.assert_allclose(answer.kinematics.angle_deg, angles, rtol=1e-15)
    moving = motion(layout(ReciprocatingMachine.model_validate(body)), np.deg2rad(angles))
    for k, (row, force) in enumerate(zip(answer.kinematics.rows, answer.piston_force.rows, strict=True)):
        assert all(0.0 <= angle <= 360.0 for angle in row.crank_angle_deg)
        np.testing.assert_allclose(row.velocity_m_s, moving.velocity[k], rtol=1e-12, atol=1e-12)
        total = np.array(force.gas_N) + force.inertia_N + force.friction_N
        np.testing.assert_allclose(force.total_N, total, rtol=1e-13)
        # the extremes of the turn, not of the samples
        assert max(force.total_N) <= force.peak_tension_bracket_N[1]
        assert min(force.total_N) >= force.peak_compression_bracket_N[0]
    assert max(abs(couple) for couple in answer.overturning.couple_Nm) <= answer.overturning.peak_bracket_Nm[1]


def test_load_cases() -> None:
    body = random_driven(4, "v")
    answer = ask(body, "rod_loads", "piston_force")
    for row, piston in zip(answer.rod_loads.rows, answer.piston_force.rows, strict=True):
        rod, side = np.array(row.rod_N), np.array(row.side_N)
        # analytic: the rod force has the piston force and the side force as its legs
        np.testing.assert_allclose(rod**2, np.array(piston.total_N) ** 2 + side**2, rtol=1e-11)
        cosine = np.array(piston.total_N) / rod
        idle = (np.array(piston.inertia_N) + piston.friction_N) / cosine
        expected = {"running": rod, "no_load": idle, "sudden_stop": np.array(piston.gas_N) / cosine}
        assert {case.case for case in row.cases} == set(expected)
        for case in row.cases:
            # independent: samples at 1 degree miss little of a peak, and nothing is above it
            size = np.abs(expected[case.case]).max()
            for tension_N, (low, high), sampled in (
                (case.tension_N, case.tension_bracket_N, max(expected[case.case].max(), 0.0)),
                (-case.compression_N, tuple(-end for end in case.compression_bracket_N[::-1]),
                 max(-expected[case.case].min(), 0.0)),
            ):  # fmt: skip
                assert low <= tension_N <= high <= low + 1e-8 * size
                assert sampled <= high <= sampled + 0.02 * size
        largest = {name: np.abs(force).max() for name, force in expected.items()}
        assert row.governing_load_N == pytest.approx(max(largest.values()), rel=0.02)
        assert row.governing_case == max(largest, key=lambda name: largest[name])


def test_no_common_radius_no_tangential_force() -> None:
    body = random_driven(6, "v", throws=2)
    assert ask(body, "torque").torque.tangential_N is None
    body["throws"][1]["crank_radius_m"] = body["throws"][0]["crank_radius_m"]
    for row in body["throws"][1]["rows"]:
        row["connecting_rod"]["length_m"] = 3.0
    torque = ask(body, "torque").torque
    radius = body["throws"][0]["crank_radius_m"]
    np.testing.assert_allclose(np.array(torque.tangential_N) * radius, torque.torque_Nm, rtol=1e-13)


def test_throws_without_rows() -> None:
    throws = [{"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": 0.0, "rotating_mass_kg": 5.0} for z in (0, 1)]
    bearings = [{"name": "A", "position_m": -1.0}, {"name": "B", "position_m": 2.0}]
    body = {
        "kind": "reciprocating",
        "speed_rpm": 500.0,
        "throws": throws,
        "bearings": bearings,
        "flywheel": {"irregularity": 0.01},
    }
    outputs = ("kinematics", "gas", "piston_force", "rod_loads", "torque", "flywheel", "overturning", "main_bearings")
    answer = ask(body, *outputs, step_deg=30.0)
    assert set(answer.torque.torque_Nm) == {0.0}
    assert answer.flywheel.inertia_J_kg_m2 == 0.0
    # analytic: two equal centrifugal forces, symmetric about the bearings
    loads = [bearing.before.peak_N for bearing in answer.main_bearings.bearings]
    assert loads == pytest.approx([5.0 * 0.1 * (500.0 * np.pi / 30.0) ** 2] * 2, rel=1e-12)
