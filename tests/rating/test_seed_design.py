"""The design of seed 004 from end to end: its own choices give its own figures, within its rounding.

The seed rounds the intermediate pressure to 0.79 MPa, takes pi = 3.14 and a mean piston speed of 4.0 m/s.
"""

import pytest

from optimizer.rating.rate import rate
from schemas.rating.answer import RatingAnswer
from tests.rating.design import near, request, rods


def as_the_seed(rod_m: float = 0.11, **more: object) -> RatingAnswer:
    return rate(request(*rods(rod_m), mean_piston_speed_m_s=4.0, **more))


ANSWER = as_the_seed()
#: with the seed's intermediate pressure in place of 0.7937 MPa
ROUNDED = as_the_seed(interstage_pressures_Pa=["0.79 MPa"])


def test_pressures_and_temperatures_published() -> None:
    assert ANSWER.total_pressure_ratio == pytest.approx(7.0)
    assert [stage.nominal.pressure_ratio for stage in ANSWER.stages] == near([2.646, 2.646], 5e-4)
    assert ANSWER.stages[0].nominal.discharge_pressure_Pa == near(0.79e6, 5e3)
    assert [stage.nominal.discharge_temperature_K for stage in ANSWER.stages] == near([413.0, 413.0], 0.5)


def test_coefficients_published() -> None:
    first, second = (stage.design_coefficients for stage in ANSWER.stages)
    assert [first.volumetric, second.volumetric] == near([0.8822, 0.8664], 5e-5)
    # stage I carries the packing leak of stage II: nu = 0.058 and 0.0574
    assert [first.leakage, second.leakage] == pytest.approx([1 / 1.058, 1 / 1.0574], rel=1e-14)
    # from leakage coefficients rounded to three digits
    assert [first.delivery, second.delivery] == near([0.7763, 0.7790], 3.5e-4)
    assert [stage.condensate_coefficient for stage in ANSWER.stages] == near([1.0, 0.9846], 1e-4)


def test_swept_volumes_and_bores_published() -> None:
    # the seed's leakage coefficients are rounded: 0.05 percent
    volumes = [stage.calculated.swept_volume_m3 for stage in ROUNDED.stages]
    assert volumes == near([0.2319, 0.0864], 3.5e-4)
    for answer in (ANSWER, ROUNDED):
        assert [stage.calculated.bore_m for stage in answer.stages] == near([0.730, 0.450], 1e-3)
        assert [stage.actual.bore_m for stage in answer.stages] == [0.73, 0.45]
        assert [stage.actual.swept_volume_m3 for stage in answer.stages] == near([0.2316, 0.0864], 1.5e-4)


def test_areas_with_the_provisional_rod_published() -> None:
    stages = as_the_seed(0.09, interstage_pressures_Pa=["0.79 MPa"]).stages
    # 0.15 percent of area come with the swept volumes
    assert [stage.calculated.head_area_m2 for stage in stages] == pytest.approx([0.41729, 0.15747], rel=2e-3)
    assert [stage.calculated.crank_area_m2 for stage in stages] == pytest.approx([0.41092, 0.1511], rel=2e-3)
    outer = [stage.nominal_loads.outer.gas_force_N for stage in stages]
    inner = [stage.nominal_loads.inner.gas_force_N for stage in stages]
    assert outer == pytest.approx([-206383.1, -211318.0], rel=2e-3)
    assert inner == pytest.approx([199439.8, 192908.7], rel=2e-3)


def test_areas_as_built_analytic() -> None:
    """Exact pi; the seed prints 0.41833, 0.408831, 0.15896, 0.14946 with 3.14 (erratum E004-3)."""
    sizes = [stage.actual for stage in ANSWER.stages]
    assert [size.head_area_m2 for size in sizes] == pytest.approx([0.4185386812745001, 0.1590431280879833], rel=1e-14)
    assert [size.crank_area_m2 for size in sizes] == pytest.approx([0.409035363497391, 0.14953981031087415], rel=1e-13)


def test_corrected_pressures_published() -> None:
    for answer in (ANSWER, ROUNDED):
        first, second = (stage.corrected for stage in answer.stages)
        assert first.suction_pressure_Pa == 0.3e6
        assert first.discharge_pressure_Pa == second.suction_pressure_Pa == near(0.789e6, 2.6e3)
        assert second.discharge_pressure_Pa == 2.1e6
        # erratum E004-7: 2.63 and 2.66, not 2.62 and 2.67
        assert [first.pressure_ratio, second.pressure_ratio] == near([2.63, 2.66], 0.01)
    rating, two = ANSWER.stages
    assert rating.discharge_pressure_correction == two.suction_pressure_correction == near(0.9987, 4e-3)


def test_losses_and_pressures_in_the_cylinder_published() -> None:
    first, second = ANSWER.stages
    losses = [first.losses.suction, first.losses.discharge, second.losses.suction, second.losses.discharge]
    assert losses == near([0.047, 0.0797, 0.0366, 0.0588], 5e-5)
    pressures = [
        (stage.in_cylinder.suction_pressure_Pa / 1e6, stage.in_cylinder.discharge_pressure_Pa / 1e6)
        for stage in ANSWER.stages
    ]
    assert pressures[0] == near((0.286, 0.852), 1e-3)
    assert pressures[1] == near((0.760, 2.224), 1.2e-3)
    assert [stage.in_cylinder.pressure_ratio for stage in ANSWER.stages] == near([2.98, 2.93], 0.01)
    assert [stage.in_cylinder.discharge_temperature_K for stage in ANSWER.stages] == near([427.0, 425.0], 1.0)


def test_discharge_temperature_by_the_polytropic_exponent_published() -> None:
    """(1-26): 389 and 388 K for 1.25, beside 427 and 425 K for 1.4."""
    cooled = rate(
        request(
            *rods(0.11),
            ("stages/0/polytropic_exponent", 1.25),
            ("stages/1/polytropic_exponent", 1.25),
            mean_piston_speed_m_s=4.0,
        )
    )
    assert [stage.polytropic_temperature_K for stage in cooled.stages] == near([389.0, 388.0], 1.0)
    assert [stage.polytropic_temperature_K for stage in ANSWER.stages] == [None, None]
    # nothing else changes
    assert cooled.shaft_power_W == ANSWER.shaft_power_W


def test_gas_forces_as_built_published() -> None:
    first, second = (stage.actual_loads for stage in ANSWER.stages)
    assert [first.outer.gas_force_N, second.outer.gas_force_N] == pytest.approx([-239491.5, -239937.4], rel=3e-3)
    assert first.inner.gas_force_N == pytest.approx(228681.6, rel=3e-3)
    # 24 t, where the type says 12 (erratum E004-23)
    assert ANSWER.largest_rod_load_N / 9.80665e3 == near(24.5, 0.1)


def test_capacity_and_powers_published() -> None:
    assert ANSWER.capacity_m3_per_min == near(87.67, 0.06)
    assert ANSWER.stages[0].actual_coefficients.volumetric == near(0.8605, 3e-4)
    assert [stage.indicated_power_W / 1e3 for stage in ANSWER.stages] == near([608.3, 583.0], 1.5)
    assert ANSWER.indicated_power_W / 1e3 == near(1191.3, 0.4)


def test_shaft_power_analytic() -> None:
    """Erratum E004-16: 1267.3 kW, not the indicated 1191.3."""
    assert ANSWER.shaft_power_W / 1e3 == near(1267.3, 0.5)
    assert ANSWER.motor_power_W == pytest.approx(1.1 * ANSWER.shaft_power_W)


def test_the_seeds_motor_fits_free_air_published() -> None:
    """Erratum E004-23: 90 m3/min of free air would take some 422 kW at the shaft, and 450 kW are installed."""
    free = as_the_seed(capacity_pressure_Pa=1e5, capacity_temperature_K=313)
    assert free.shaft_power_W / 1e3 == near(422.0, 8.0)
    assert free.capacity_m3_per_min == pytest.approx(90.0, rel=0.05)


def test_piston_speed_of_the_machine_regression() -> None:
    """Erratum E004-6: with S n/30 in place of 4.0 m/s there is more to lose, and stage I gets too hot."""
    right = rate(request())
    assert right.mean_piston_speed_m_s == pytest.approx(14 / 3)
    assert right.indicated_power_W > ANSWER.indicated_power_W
    assert right.capacity_m3_per_min < ANSWER.capacity_m3_per_min
    assert [(warning.code, warning.stage) for warning in right.warnings] == [("discharge_temperature", 1)]
    assert [warning.code for warning in ANSWER.warnings] == ["mean_piston_speed"]
    assert [right.capacity_m3_per_min, right.indicated_power_W / 1e3] == near([86.8422, 1210.2516], 1e-3)
