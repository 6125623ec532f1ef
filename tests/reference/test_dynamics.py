"""Figures of the source texts on one row over the turn, and the flywheel of the published compressor."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.mechanics.gas import Chambers, gas_forces, switching_angles
from optimizer.mechanics.inertia import reciprocating
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.rod import rod_forces
from optimizer.mechanics.turn import fluctuation, mean, panels
from optimizer.numerics.arrays import Real
from schemas.request.requests import AnalyzeRequest
from tests.reference import compressor

_FILE = json.loads((Path(__file__).parent / "seed_dynamics.json").read_text())
ROW = np.array([1.0])


def _angle(inputs: Any) -> Real:
    return np.deg2rad(np.array(inputs["alpha_deg"], dtype=float, ndmin=1))


def _single_row(inputs: Any, mass: float = 1.0) -> Layout:
    return compressor.arrays(inputs.get("omega", 1.0), mass * ROW)  # radius 0.14 m and rod ratio 0.2 in all of them


def _kinematics(inputs: Any) -> dict[str, Real]:
    layout, angle = _single_row(inputs), _angle(inputs)
    series = motion(layout, angle, exact=False)
    return {
        "x": series.displacement[0],
        "c": series.velocity[0],
        "x_g_mm": 1e3 * motion(layout, angle).displacement[0],
        "c_m_s": series.velocity[0],
        "a_m_s2": series.acceleration[0],
    }


def _inertia(inputs: Any) -> dict[str, Real]:
    if "theta_deg" in inputs:
        wrench = reciprocating(_single_row(inputs, inputs["m_s"]), 1).times(np.asarray(inputs["omega"] ** 2))
        return {"I_first": wrench.force.at(np.deg2rad(inputs["theta_deg"]), 1).real}
    acceleration = motion(_single_row(inputs), _angle(inputs), exact=False).acceleration[0]
    return {f"I_{row}": mass * acceleration for row, mass in zip(compressor.ROWS, inputs["m_s"], strict=True)}


def _gas(inputs: Any) -> dict[str, Real]:
    def both(force: float) -> Real:
        return np.full((1, 2), force)

    layout = _single_row(inputs)
    chambers = Chambers(
        area=np.array([[inputs["A_g"], inputs["A_z"]]]),
        suction=both(inputs["ps"]),
        discharge=both(inputs["pd"]),
        clearance=both(inputs["S0"] / inputs["S"]),
        expansion_exponent=both(inputs["m_exp"]),
        compression_exponent=both(inputs["m"]),
        closed=np.ones((1, 2), dtype=bool),
    )
    side = ("head", "crank").index(inputs["chamber"])
    return {"F": gas_forces(chambers, motion(layout, _angle(inputs)), layout).force[0, side]}


def _forces(inputs: Any) -> dict[str, Real]:
    layout, angle = _single_row(inputs), _angle(inputs)
    moving = motion(layout, angle)
    force = np.array(inputs.get("P", inputs.get("P_sum", 1.0)), dtype=float) * np.ones((1, angle.size))
    forces = rod_forces(force, moving, layout)
    return {
        "N": forces.side[0],
        "P_L": forces.rod[0],
        "T": forces.tangential[0],
        "R": forces.radial[0],
        "M_c": forces.torque[0],
        "M_overturn": forces.overturning[0],
        "factor": moving.tangential_factor[0],
    }


def _flywheel(inputs: Any) -> dict[str, Any]:
    if "L_J" in inputs:
        # a torque of +A and -A over half a turn each has the fluctuation energy pi A
        half = panels(np.array([np.pi]), 0.1)
        amplitude = inputs["L_J"] / np.pi
        energy = fluctuation(half, np.where(half.angle < np.pi, amplitude, -amplitude))
        inertia = energy / (inputs["delta"] * (inputs["n_rpm"] * np.pi / 30.0) ** 2)
        return {"J": inertia, "MD2": 4.0 * inertia}
    tangential = np.array(inputs["T_total_kN_0_to_350"])
    corners = np.deg2rad(10.0 * np.arange(37))
    turn = panels(corners, 0.2)
    values = np.interp(turn.angle, corners, np.append(tangential, tangential[0]))
    radius = inputs.get("r", 1.0)
    return {"T_mean": mean(turn, values), "dE_J": fluctuation(turn, 1e3 * radius * values)}


_TOPICS = {
    "kinematics": _kinematics,
    "inertia": _inertia,
    "gas force": _gas,
    "forces": _forces,
    "tangential": _forces,
    "flywheel": _flywheel,
}


@pytest.mark.parametrize("check", [pytest.param(c, id=f"{c['label']}-{c['id']}") for c in _FILE["checks"]])
def test_check(check: Any) -> None:
    fields = _TOPICS[check["topic"]](check["inputs"])
    for name, expected in check["expected"].items():
        np.testing.assert_allclose(fields[name], expected, rtol=check["rtol"], atol=check["atol"] + 1e-9, err_msg=name)


# analytic: integrated on a grid of 0.01 degrees from the source's formulas, with its errors removed. The grid
# itself is good for about 2e-6: it steps over the angles where friction changes sign.
_WHOLE = {
    False: (176377.467, 1292914.36, 28733.207, 1048.062, 4192.247, (624389.304, 592484.631)),
    True: (176315.45, 1292459.755, 29832.632, 1088.164, 4352.656, (623909.856, 592509.474)),
}


@pytest.mark.parametrize("bored", [False, True])
def test_whole_machine(bored: bool) -> None:
    tangential, power, energy, inertia, customary, indicated = _WHOLE[bored]
    request = {"machine": compressor.machine(bored), "outputs": ["torque", "flywheel", "gas"]}
    answer = analyze(AnalyzeRequest.model_validate(request))
    assert answer.torque.mean_torque_Nm / compressor.RADIUS == pytest.approx(tangential, abs=6e-4)
    assert answer.torque.shaft_power_W == pytest.approx(power, abs=0.01)
    assert answer.torque.fluctuation_energy_J == pytest.approx(energy, rel=2e-6)
    assert answer.torque.fluctuation_energy_error_J < 1e-5 * energy
    assert answer.flywheel.inertia_J_kg_m2 == pytest.approx(inertia, rel=3e-6)
    assert answer.flywheel.inertia_MD2_kg_m2 == pytest.approx(customary, rel=3e-6)
    assert [row.indicated_power_W for row in answer.gas.rows] == pytest.approx(indicated, rel=2e-9)
    assert answer.gas.indicated_power_W == pytest.approx(answer.torque.indicated_power_W, rel=1e-14)
    # analytic: 0.7 and 0.3 of the losses
    assert answer.torque.rotating_friction_Nm * compressor.OMEGA == pytest.approx(22812.128, abs=6e-4)
    assert answer.torque.friction_power_W == pytest.approx(53228.298 + 22812.128, abs=1e-3)


def test_switching_angles() -> None:
    """Analytic: suction and discharge, head and crank side, in degrees to three decimals."""
    suction, discharge = switching_angles(compressor.chambers(), compressor.arrays())
    np.testing.assert_allclose(np.rad2deg(suction), [[36.873, 224.384], [40.102, 228.128]], atol=5.1e-4)
    np.testing.assert_allclose(np.rad2deg(discharge), [[286.5, 95.223], [286.979, 95.721]], atol=5.1e-4)


def test_posted_switching_angles() -> None:
    request = {"machine": compressor.machine(), "outputs": ["gas"]}
    gas = analyze(AnalyzeRequest.model_validate(request)).gas
    suction, discharge = switching_angles(compressor.chambers(), compressor.arrays())
    for k, row in enumerate(gas.rows):
        opens = [(chamber.suction_opens_deg, chamber.discharge_opens_deg) for chamber in row.chambers]
        np.testing.assert_allclose(opens, np.rad2deg(np.stack([suction[k], discharge[k]], axis=-1)), rtol=1e-13)
