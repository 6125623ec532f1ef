"""Every figure of chapter 1 of seed 004, formula by formula; published or analytic as its label says."""

import pytest

from optimizer.rating.delivery import coefficients, expansion_exponent, leakage_coefficients, volumetric_coefficient
from optimizer.rating.loads import gas_loads
from optimizer.rating.losses import corrected_loss, mean_piston_speed, pressures_in_cylinder
from optimizer.rating.power import indicated_power, shaft_power, suction_flow
from optimizer.rating.ratios import equal_split
from optimizer.rating.sizes import Piston, stage_flow, swept_volume
from optimizer.rating.steam import condensate_coefficients
from schemas.rating.answer import CylinderSize
from schemas.rating.request import CompressionStage
from tests.rating.design import FIGURES, figure, near


def test_pressure_ratio_published() -> None:
    inputs, expected, atol = figure("004-ratio")
    pressures = equal_split(inputs["p1"], inputs["p2"], inputs["z"])
    assert pressures[1] / pressures[0] == near(expected["eps"], atol)
    assert pressures[0] == inputs["p1"]
    assert pressures[2] == inputs["p2"]


def test_volumetric_coefficients_published() -> None:
    inputs, expected, atol = figure("004-lamv")
    volumetric_coefficients = [
        volumetric_coefficient(a, inputs["eps"], m) for a, m in zip(inputs["alpha"], inputs["m"], strict=True)
    ]
    assert volumetric_coefficients == near(expected["lam_v"], atol)


def test_leakage_coefficients_published() -> None:
    inputs, expected, atol = figure("004-leak")
    stages = [
        CompressionStage(
            piston_rod_diameter_m=0.1, suction_temperature_K=313, relative_clearance=0.1, relative_leaks={"valves": nu}
        )
        for nu in inputs["nu"]
    ]
    assert leakage_coefficients(stages) == near(expected["lam_l"], atol)


def test_delivery_coefficients_published() -> None:
    inputs, expected, atol = figure("004-lamd")
    assert [coefficients(*four).delivery for four in inputs["factors"]] == near(expected["lam_d"], atol)


def test_condensate_coefficient_published() -> None:
    inputs, expected, atol = figure("004-mu-d")
    actual_condensate_coefficients = condensate_coefficients(
        inputs["phi"], [inputs["p1_I"], inputs["p1_II"]], [inputs["psat"]] * 2
    )
    assert actual_condensate_coefficients == near([1.0, expected["mu_d"]], atol)


def test_swept_volumes_published() -> None:
    inputs, expected, atol = figure("004-Vh")
    second = stage_flow(inputs["Vd"], inputs["p"][0], inputs["p"][1], 313.0, 313.0, inputs["mu_d"] * inputs["mu_0"])
    swept_volumes = [
        swept_volume(flow, inputs["n"], delivery)
        for flow, delivery in ((inputs["Vd"], inputs["lam_dI"]), (second, inputs["lam_dII"]))
    ]
    assert swept_volumes == near(expected["V"], atol)


def test_areas_of_the_provisional_rod_published() -> None:
    inputs, expected, atol = figure("004-areas-initial")
    piston = Piston(count=1, acting="double", rod=inputs["d_rod_mm"] / 1e3, stroke=0.28)
    sizes = [piston.size(piston.bore(area / 1e4 * piston.stroke)) for area in inputs["F_total_cm2"]]
    assert [size.head_area_m2 * 1e4 for size in sizes] == near(expected["A_head_cm2"], atol)
    assert [size.crank_area_m2 * 1e4 for size in sizes] == near(expected["A_crank_cm2"], atol)


def test_gas_forces_at_nominal_pressures_published() -> None:
    inputs, expected, atol = figure("004-gas-dc-nominal")
    areas, p = inputs["A"], inputs["p"]
    loads = []
    for i in range(2):
        size = CylinderSize(bore_m=0, head_area_m2=areas[2 * i], crank_area_m2=areas[2 * i + 1], swept_volume_m3=0)
        loads.append(gas_loads(p[i], p[i + 1], 101325.0, "double", size))
    assert [forces.outer.gas_force_N for forces in loads] == near(expected["P_out"], atol)
    assert [forces.inner.gas_force_N for forces in loads] == near(expected["P_in"], atol)


def test_bores_published() -> None:
    inputs, expected, atol = figure("004-bore")
    piston = Piston(count=1, acting="double", rod=inputs["d"], stroke=0.28)
    assert [piston.bore(area * piston.stroke) for area in inputs["F_total"]] == near(expected["D"], atol)


def test_corrected_losses_published() -> None:
    inputs, expected, atol = figure("004-loss")
    assert [corrected_loss(loss, inputs["Cm"], 1.0) for loss in inputs["delta"]] == near(expected["delta_c"], atol)


def test_piston_speed_is_that_of_the_machine_analytic() -> None:
    # erratum E004-6: the seed's 4.0 m/s make 1.306, its stroke and speed 1.778
    speed = mean_piston_speed(0.28, 500.0)
    assert speed == pytest.approx(14.0 / 3.0, rel=1e-15)
    assert corrected_loss(1.0, speed, 1.0) == pytest.approx(16.0 / 9.0, rel=1e-15)
    assert corrected_loss(1.0, 4.0, 1.0) == pytest.approx(64.0 / 49.0, rel=1e-15)


def test_pressures_in_the_cylinder_published() -> None:
    actual_inputs, expected, atol = figure("004-p-cyl")
    inputs = zip(*(actual_inputs[name] for name in ("p1", "p2", "ds", "dd")), strict=True)
    pressures_in_cylinders = [pressures_in_cylinder(*four) for four in inputs]
    assert [p_s for p_s, _ in pressures_in_cylinders] == near(expected["ps"], atol)
    assert [p_d for _, p_d in pressures_in_cylinders] == near(expected["pd"], atol)


def test_capacity_published() -> None:
    inputs, expected, atol = figure("004-flow")
    lam_v = volumetric_coefficient(inputs["alpha"], inputs["eps"], inputs["m"])
    flow = suction_flow(inputs["V_I"], inputs["n"], coefficients(lam_v, *inputs["others"]).delivery)
    assert flow == near(expected["V_d"], atol)


def test_indicated_powers_published() -> None:
    inputs, expected, atol = figure("004-power")
    indicated_powers = []
    for p_s, volume, alpha, m, ratio in zip(*(inputs[n] for n in ("ps", "V", "alpha", "m", "eps")), strict=True):
        lam_v = volumetric_coefficient(alpha, ratio, m)
        indicated_powers.append(indicated_power(p_s, volume, lam_v, ratio, inputs["k"], inputs["n"]) / 1e3)
    assert indicated_powers == near(expected["N_i_kW"], atol)


def test_shaft_power_analytic() -> None:
    inputs, expected, atol = figure("004-shaft-power")
    assert shaft_power(inputs["N_i_kW"], inputs["eta_m"]) == near(expected["N_z_kW"], atol)


@pytest.mark.parametrize(
    ("bar", "m"),
    [
        (1.0, 1.2),
        (1.5, 1.2),
        (1.6, 1.25),
        (4.0, 1.25),
        (7.9, 1.3),
        (10.0, 1.3),
        (20.0, 1.35),
        (30.0, 1.35),
        (31.0, 1.4),
    ],
)
def test_expansion_exponents_of_table_1_3_published(bar: float, m: float) -> None:
    """The column for k = 1.4, which the seed rounds to 0.05."""
    assert expansion_exponent(bar * 1e5, 1.4) == near(m, 0.0025)


def test_expansion_exponents_of_another_gas_analytic() -> None:
    assert [expansion_exponent(p, 1.2) for p in (1e5, 3e5, 8e5, 2e6, 4e6)] == pytest.approx(
        [1.1, 1.124, 1.15, 1.176, 1.2], rel=1e-14
    )


def test_no_figure_is_left_out() -> None:
    assert len(FIGURES["checks"]) == 14
    assert {check["label"] for check in FIGURES["checks"]} == {"published", "analytic"}
