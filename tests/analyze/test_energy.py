"""What goes into the shaft comes out as gas work and friction, for any machine."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

from tests.analyze.driven import STYLES, ask, random_driven


def omega(body: dict[str, Any]) -> float:
    return float(body["speed_rpm"]) * np.pi / 30.0


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", range(8))
def test_shaft_power_is_indicated_power_and_friction(seed: int, style: str) -> None:
    body = random_driven(seed, style)
    torque = ask(body, "torque", "gas").torque
    # analytic: inertia takes and gives back over a turn; indicated power has a closed form of its own
    assert torque.shaft_power_W == pytest.approx(torque.mean_torque_Nm * omega(body), rel=1e-14)
    assert torque.shaft_power_W == pytest.approx(torque.indicated_power_W + torque.friction_power_W, rel=1e-9)
    # analytic: the efficiency that was given
    efficiency = body["friction"]["mechanical_efficiency"]
    assert torque.indicated_power_W / torque.shaft_power_W == pytest.approx(efficiency, rel=1e-9)
    assert torque.mean_torque_error_Nm <= 1e-6 * torque.mean_torque_Nm
    rows = sum(row.mean_torque_Nm for row in torque.rows)
    assert rows + torque.rotating_friction_Nm == pytest.approx(torque.mean_torque_Nm, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_power_of_every_row(seed: int) -> None:
    body = random_driven(seed, "w", friction=None)
    answer = ask(body, "torque", "gas")
    for turned, row in zip(answer.torque.rows, answer.gas.rows, strict=True):
        assert turned.mean_torque_Nm * omega(body) == pytest.approx(row.indicated_power_W, rel=1e-9)
        assert row.indicated_power_W == pytest.approx(
            sum(chamber.indicated_work_J for chamber in row.chambers) * body["speed_rpm"] / 60.0, rel=1e-13
        )
    assert answer.torque.friction_power_W == 0.0
    assert answer.gas.indicated_power_W == pytest.approx(answer.torque.shaft_power_W, rel=1e-9)


def test_friction_given_as_forces() -> None:
    rows = 4
    force = [100.0 * (k + 1) for k in range(rows)]
    body = random_driven(3, "v", throws=2, friction={"reciprocating_force_N": force, "rotating_torque_Nm": 55.0})
    torque = ask(body, "torque").torque
    stroke = [2.0 * throw["crank_radius_m"] for throw in body["throws"] for _ in throw["rows"]]
    # analytic: each force over two strokes a turn
    losses = sum(f * 2.0 * s for f, s in zip(force, stroke, strict=True)) * body["speed_rpm"] / 60.0
    assert torque.friction_power_W == pytest.approx(losses + 55.0 * omega(body), rel=1e-13)
    assert torque.rotating_friction_Nm == 55.0
    assert torque.shaft_power_W == pytest.approx(torque.indicated_power_W + torque.friction_power_W, rel=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_masses_and_rotation_are_of_no_account_for_the_power(seed: int) -> None:
    body = random_driven(seed, "v")
    torque = ask(body, "torque").torque
    for throw in body["throws"]:
        for row in throw["rows"]:
            row["reciprocating_mass_kg"] *= 0.1
    lighter = ask(body, "torque").torque
    assert lighter.mean_torque_Nm == pytest.approx(torque.mean_torque_Nm, rel=1e-9)
    assert lighter.fluctuation_energy_J != pytest.approx(torque.fluctuation_energy_J, rel=1e-6)
    payload = {**body, "rotation": "cw" if body["rotation"] == "ccw" else "ccw"}
    assert ask(payload, "torque").torque.mean_torque_Nm == pytest.approx(torque.mean_torque_Nm, rel=1e-9)


@pytest.mark.parametrize("rod_ratio", [1e-9, 0.6, 0.9, 0.99, 0.999, 0.99999])
def test_the_estimated_error_covers_rods_hardly_longer_than_the_crank(rod_ratio: float) -> None:
    for seed in range(4):
        body = random_driven(seed, "v")
        for throw in body["throws"]:
            for row in throw["rows"]:
                row["connecting_rod"]["length_m"] = throw["crank_radius_m"] / rod_ratio
        torque = ask(body, "torque").torque
        off = abs(torque.shaft_power_W - torque.indicated_power_W - torque.friction_power_W)
        assert off <= torque.mean_torque_error_Nm * omega(body) + 1e-11 * torque.shaft_power_W
        if rod_ratio <= 0.9:
            assert off <= 1e-11 * torque.shaft_power_W


@pytest.mark.parametrize("seed", range(4))
def test_the_series_changes_the_power_little(seed: int) -> None:
    body = random_driven(seed, "v")
    series, exact = (ask(body, "torque", fidelity={"kinematics": k}).torque for k in ("order_2", "exact"))
    # regression: the gas follows the travel of the series, the levers do not
    assert series.mean_torque_Nm == pytest.approx(exact.mean_torque_Nm, rel=3e-3)
    assert series.indicated_power_W == exact.indicated_power_W
    assert series.mean_torque_Nm != exact.mean_torque_Nm


def test_means_do_not_depend_on_the_samples() -> None:
    body = random_driven(2, "v")
    fine, coarse = (ask(body, "torque", "flywheel", step_deg=step) for step in (0.5, 120.0))
    for name in ("mean_torque_Nm", "fluctuation_energy_J", "shaft_power_W", "friction_power_W"):
        assert getattr(fine.torque, name) == getattr(coarse.torque, name)
    assert fine.flywheel == coarse.flywheel
    assert fine.torque.torque_Nm[::240] == pytest.approx(coarse.torque.torque_Nm, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_fluctuation_energy_of_the_samples(seed: int) -> None:
    body = random_driven(seed, "w")
    moment = ask(body, "torque", step_deg=0.05).torque
    torque, step = np.array(moment.torque_Nm), np.deg2rad(0.05)
    closed = np.append(torque, torque[0])
    running = np.concatenate([[0.0], np.cumsum(0.5 * (closed[1:] + closed[:-1]) - torque.mean())]) * step
    # independent: the trapezoidal rule on a fine grid
    assert moment.fluctuation_energy_J == pytest.approx(np.ptp(running), rel=2e-3)
    assert moment.mean_torque_Nm == pytest.approx(torque.mean(), rel=2e-3)
    assert abs(moment.fluctuation_energy_error_J) < 1e-3 * moment.fluctuation_energy_J


@pytest.mark.parametrize("seed", range(3))
def test_irregularity_and_inertia_belong_to_each_other(seed: int) -> None:
    body = random_driven(seed, "single")
    first = ask(body, "flywheel").flywheel
    # analytic: delta = dE / (J w^2)
    assert first.inertia_J_kg_m2 * 0.02 * omega(body) ** 2 == pytest.approx(first.fluctuation_energy_J, rel=1e-13)
    assert first.inertia_MD2_kg_m2 == 4.0 * first.inertia_J_kg_m2
    again = ask({**body, "flywheel": {"inertia_kg_m2": first.inertia_J_kg_m2}}, "flywheel").flywheel
    assert again.irregularity == pytest.approx(0.02, rel=1e-13)


def test_inertia_alone_has_an_analytic_fluctuation() -> None:
    """A light gas load on an infinite rod: inertia alone turns the shaft."""
    cylinder = {
        "bore_m": 1e-6,
        "piston_rod_diameter_m": 0.0,
        "suction_pressure_Pa": 1e5,
        "discharge_pressure_Pa": 1e5,
        "relative_clearance": 0.1,
        "expansion_exponent": 1.3,
        "compression_exponent": 1.3,
    }
    row = {
        "axis_deg": 0.0,
        "reciprocating_mass_kg": 10.0,
        "connecting_rod": {"length_m": None},
        "cylinder": cylinder,
    }
    throw = {"position_m": 0.0, "crank_radius_m": 0.2, "crank_angle_deg": 33.0, "rows": [row]}
    body = {"kind": "reciprocating", "speed_rpm": 300.0, "throws": [throw]}
    torque = ask(body, "torque").torque
    # analytic: m r^2 w^2 sin phi cos phi, amplitude m r^2 w^2 / 2 at the second order: range m r^2 w^2 / 2
    expected = 0.5 * 10.0 * 0.2**2 * omega(body) ** 2
    assert torque.fluctuation_energy_J == pytest.approx(expected, rel=1e-4)
    assert torque.mean_torque_Nm == pytest.approx(0.0, abs=1e-9 * expected)


def test_torque_of_one_row_by_quadrature() -> None:
    """Independent: torque from virtual work, its integral by adaptive quadrature."""
    body = random_driven(1, "single", throws=1, friction=None)
    row = body["throws"][0]["rows"][0]
    cylinder, radius = row["cylinder"], body["throws"][0]["crank_radius_m"]
    cylinder.update(acting="double", head=None, crank=None)
    length, bore, stem = row["connecting_rod"]["length_m"], cylinder["bore_m"], cylinder["piston_rod_diameter_m"]
    low, high, clear = (cylinder[k] for k in ("suction_pressure_Pa", "discharge_pressure_Pa", "relative_clearance"))

    def travel(phi: float) -> float:
        return radius + length - radius * np.cos(phi) - np.sqrt(length**2 - (radius * np.sin(phi)) ** 2)

    def work(side: str, area: float) -> float:
        def chamber(phi: float) -> float:
            gone = travel(phi) if side == "head" else 2.0 * radius - travel(phi)
            return gone + clear * 2.0 * radius

        def power(phi: float) -> float:
            size, rate = chamber(phi), (chamber(phi + 1e-6) - chamber(phi - 1e-6)) / 2e-6
            grown, full = clear * 2.0 * radius / size, (1.0 + clear) * 2.0 * radius / size
            if rate > 0.0:
                pressure = max(high * grown ** cylinder["expansion_exponent"], low)
            else:
                pressure = min(low * full ** cylinder["compression_exponent"], high)
            return -pressure * area * rate

        return sum(quad(power, k * np.pi / 180, (k + 1) * np.pi / 180)[0] for k in range(360))

    expected = work("head", np.pi / 4 * bore**2) + work("crank", np.pi / 4 * (bore**2 - stem**2))
    torque = ask(body, "torque").torque
    assert torque.mean_torque_Nm * 2.0 * np.pi == pytest.approx(expected, rel=1e-6)
