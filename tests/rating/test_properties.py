"""What holds for every compressor: any number of stages and cylinders, any acting, any bores."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.rating.curves import DISCHARGE, SUCTION
from optimizer.rating.power import indicated_power
from optimizer.rating.rate import rate
from optimizer.rating.sizes import Piston, nominal_bore
from schemas.machine.cylinder import Cylinder
from schemas.machine.throws import Row
from schemas.rating.answer import RatingAnswer
from schemas.rating.request import RatingRequest
from tests.rating.design import body, request, requests


def with_stages(query: RatingRequest, **changes: object) -> RatingRequest:
    """The request with every stage changed."""
    return query.model_copy(update={"stages": tuple(stage.model_copy(update=changes) for stage in query.stages)})


@given(requests())
def test_pressure_ratios_multiply_to_the_whole(query: RatingRequest) -> None:
    answer = rate(query)
    for states in zip(*[(s.nominal, s.corrected) for s in answer.stages], strict=True):
        product = math.prod(state.pressure_ratio for state in states)
        assert product == pytest.approx(answer.total_pressure_ratio, rel=1e-12)
        assert states[0].suction_pressure_Pa == query.suction_pressure_Pa
        assert states[-1].discharge_pressure_Pa == query.discharge_pressure_Pa
        for before, after in pairwise(states):
            assert before.discharge_pressure_Pa == pytest.approx(after.suction_pressure_Pa, rel=1e-14)
    nominal = [stage.nominal.pressure_ratio for stage in answer.stages]
    assert nominal == pytest.approx([nominal[0]] * len(nominal), rel=1e-12)


@given(requests(bore_series="none"))
def test_capacity_is_recovered_without_rounding_and_losses(query: RatingRequest) -> None:
    answer = rate(with_stages(query, suction_pressure_loss=0.0, discharge_pressure_loss=0.0))
    assert answer.capacity_m3_per_min == pytest.approx(query.capacity_m3_per_min, rel=1e-12)
    for stage in answer.stages:
        assert stage.actual.bore_m == stage.calculated.bore_m
        assert stage.corrected.pressure_ratio == pytest.approx(stage.nominal.pressure_ratio, rel=1e-12)
        assert stage.in_cylinder == stage.corrected
    assert not [warning for warning in answer.warnings if warning.code == "capacity"]


@given(requests())
def test_moles_are_conserved_from_stage_to_stage(query: RatingRequest) -> None:
    """Independent of (1-9): p V lam_d / T of a stage is that of the first, less condensate, with side flows."""
    stages = rate(query).stages

    def moles(i: int) -> float:
        stage, kelvin = stages[i], query.stages[i].suction_temperature_K
        volume = stage.calculated.swept_volume_m3 * stage.design_coefficients.delivery
        return stage.nominal.suction_pressure_Pa * volume / kelvin

    for i, stage in enumerate(stages):
        share = stage.condensate_coefficient * query.stages[i].side_flow_coefficient
        assert moles(i) / moles(0) == pytest.approx(share, rel=1e-12)
        assert 0.0 < stage.condensate_coefficient <= 1.0


@given(requests())
def test_cylinders_fit_into_the_rows_of_a_machine(query: RatingRequest) -> None:
    answer = RatingAnswer.model_validate_json(rate(query).model_dump_json())
    for stage in answer.stages:
        posted = stage.cylinder.model_dump_json()
        row = Row.model_validate({"axis_deg": 0, "reciprocating_mass_kg": 1, "cylinder": stage.cylinder.model_dump()})
        assert row.cylinder == stage.cylinder == Cylinder.model_validate_json(posted)


@given(requests())
def test_every_figure_is_a_number_of_its_sign(query: RatingRequest) -> None:
    answer = rate(query)
    assert answer.motor_power_W >= answer.shaft_power_W >= answer.indicated_power_W > 0.0
    for stage in answer.stages:
        for coefficients in (stage.design_coefficients, stage.actual_coefficients):
            assert 0.0 < coefficients.delivery <= coefficients.volumetric <= 1.0
        for size in (stage.calculated, stage.actual):
            assert size.head_area_m2 >= size.crank_area_m2 > 0.0
            assert size.swept_volume_m3 > 0.0
        inside, outside = stage.in_cylinder, stage.corrected
        assert inside.suction_pressure_Pa <= outside.suction_pressure_Pa
        assert inside.discharge_pressure_Pa >= outside.discharge_pressure_Pa


@given(st.floats(1e-3, 10.0), st.sampled_from(["double", "head", "crank"]), st.integers(1, 6), st.floats(0.0, 0.2))
def test_a_bore_sweeps_the_volume_that_it_was_calculated_for(
    volume: float, acting: str, count: int, rod: float
) -> None:
    piston = Piston(count=count, acting=acting, rod=rod, stroke=0.2)  # type: ignore[arg-type]
    assert piston.size(piston.bore(volume)).swept_volume_m3 == pytest.approx(volume, rel=1e-12)


@pytest.mark.parametrize("acting", ["double", "head", "crank"])
def test_a_single_stage_analytic(acting: str) -> None:
    payload = body(discharge_pressure_Pa=0.9e6, mean_piston_speed_m_s=3.5, bore_series="none", ambient_pressure_Pa=1e5)
    payload["stages"] = [{**payload["stages"][0], "acting": acting, "bore_m": 0.5, "piston_rod_diameter_m": 0.1}]
    (stage,) = rate(RatingRequest.model_validate(payload)).stages
    p_s, p_d = 0.3e6 * (1 - 0.036), 0.9e6 * (1 + 0.061)
    head, crank = math.pi * 0.0625, math.pi * (0.0625 - 0.0025)
    outer = {"double": p_s * crank - p_d * head, "head": 1e5 * crank - p_d * head, "crank": p_s * crank - 1e5 * head}
    inner = {"double": p_d * crank - p_s * head, "head": 1e5 * crank - p_s * head, "crank": p_d * crank - 1e5 * head}
    assert stage.actual_loads.outer.gas_force_N == pytest.approx(outer[acting], rel=1e-12)
    assert stage.actual_loads.inner.gas_force_N == pytest.approx(inner[acting], rel=1e-12)
    swept = {"double": head + crank, "head": head, "crank": crank}[acting] * 0.28
    assert stage.actual.swept_volume_m3 == pytest.approx(swept, rel=1e-12)
    assert stage.nominal == stage.corrected


def test_indicated_power_is_the_area_of_the_diagram_independent() -> None:
    """Work of one turn integrated over the volume, expansion and compression of the same exponent, where (1-29) is
    exact."""
    p_s, p_d, volume, clearance, n = 0.28e6, 0.85e6, 0.2, 0.1, 1.3
    small, large = clearance * volume, (1 + clearance) * volume

    def work(p: float, v: float, p_end: float) -> float:
        v_end = v * (p / p_end) ** (1 / n)
        x = np.linspace(math.log(v), math.log(v_end), 200_001)
        return float(np.trapezoid(p * (v / np.exp(x)) ** n * np.exp(x), x))

    taken = small * (p_d / p_s) ** (1 / n)
    clearance_gas = large * (p_s / p_d) ** (1 / n)
    total = work(p_d, small, p_s) + p_s * (large - taken) + work(p_s, large, p_d) + p_d * (small - clearance_gas)
    lam_v = 1 - clearance * ((p_d / p_s) ** (1 / n) - 1)
    assert indicated_power(p_s, volume, lam_v, p_d / p_s, n, 600.0) == pytest.approx(-10 * total, rel=1e-9)


def test_isothermal_limit_analytic() -> None:
    power = indicated_power(1e5, 1.0, 1.0, 2.0, 1.0 + 2**-52, 60.0)
    assert power == pytest.approx(1e5 * math.log(2.0), rel=1e-14)


@pytest.mark.parametrize(
    ("path", "low", "high", "figure"),
    [
        ("stages/0/relative_clearance", 0.05, 0.2, lambda a: a.stages[0].calculated.bore_m),
        ("capacity_m3_per_min", 80, 100, lambda a: a.stages[1].calculated.bore_m),
        ("discharge_pressure_Pa", 1.8e6, 2.4e6, lambda a: a.indicated_power_W),
        ("isentropic_exponent", 1.2, 1.4, lambda a: a.stages[0].nominal.discharge_temperature_K),
        ("relative_density", 0.5, 1.5, lambda a: a.indicated_power_W),
        ("mean_piston_speed_m_s", 3, 5, lambda a: -a.capacity_m3_per_min),
        ("relative_humidity", 0.5, 1, lambda a: -a.stages[1].calculated.bore_m),
        ("stages/1/relative_leaks/packing", 0, 0.02, lambda a: a.stages[0].calculated.bore_m),
        ("stages/1/suction_temperature_K", 300, 330, lambda a: a.stages[1].calculated.bore_m),
        ("stages/1/side_flow_coefficient", 0.8, 1.2, lambda a: a.stages[1].calculated.bore_m),
        ("mechanical_efficiency", 0.9, 0.95, lambda a: -a.shaft_power_W),
        ("drive_efficiency", 0.9, 0.95, lambda a: -a.motor_power_W),
        ("speed_rpm", 450, 550, lambda a: -a.stages[0].calculated.bore_m),
    ],
    # a function has no name that is the same in every process
    ids=lambda value: "" if callable(value) else str(value),
)
def test_figures_grow_as_physics_says(path: str, low: float, high: float, figure: object) -> None:
    values = [rate(request((path, x), bore_series="none")) for x in np.linspace(low, high, 5).tolist()]
    figures = [figure(answer) for answer in values]  # type: ignore[operator]
    assert all(after > before for before, after in pairwise(figures))


def test_cylinders_share_the_volume_analytic() -> None:
    alone, shared = (rate(request(("stages/0/cylinders", n), bore_series="none")).stages[0] for n in (1, 2))
    assert shared.calculated.swept_volume_m3 == pytest.approx(alone.calculated.swept_volume_m3, rel=1e-14)
    areas = [rating.calculated.head_area_m2 + rating.calculated.crank_area_m2 for rating in (alone, shared)]
    assert areas[1] == pytest.approx(areas[0] / 2, rel=1e-14)
    assert shared.indicated_power_W == pytest.approx(alone.indicated_power_W, rel=1e-12)


@pytest.mark.parametrize(
    ("bore", "series", "expected"),
    [
        (0.73015, "R80", 0.73),
        (0.44906, "R80", 0.45),
        (0.73015, "R40", 0.75),
        (0.73015, "R20", 0.71),
        (0.73015, "none", 0.73015),
        (0.9880, "R80", 1.0),
        (0.9999, "R20", 1.0),
        (0.1, "R20", 0.1),
        (0.1, "R80", 0.1),
        (1e-4, "R80", 1e-4),
        (0.0313, "R40", 0.0315),
    ],
)
def test_nominal_bores_of_iso_3_published(bore: float, series: str, expected: float) -> None:
    assert nominal_bore(bore, series) == expected


@given(st.floats(1e-4, 100.0), st.sampled_from([("R20", 20), ("R40", 40), ("R80", 80)]))
def test_no_bore_is_rounded_by_more_than_half_a_step(bore: float, series: tuple[str, int]) -> None:
    # a preferred number is within 1.4 percent of the geometric series that it stands for
    name, count = series
    assert abs(nominal_bore(bore, name) / bore - 1.0) <= (10 ** (1 / count) - 1.0) / 2 + 0.014


def test_pressures_keep_the_rounded_bores_fed_analytic() -> None:
    """A second stage built a percent larger draws its suction pressure down by as much."""
    exact = rate(request(bore_series="none"))
    piston = Piston(count=1, acting="double", rod=0.11, stroke=0.28)
    first, second = (stage.calculated for stage in exact.stages)
    larger = rate(
        request(("stages/0/bore_m", first.bore_m), ("stages/1/bore_m", piston.bore(1.01 * second.swept_volume_m3)))
    )
    assert larger.stages[1].suction_pressure_correction == pytest.approx(1 / 1.01, rel=1e-12)
    assert larger.stages[0].suction_pressure_correction == 1.0
    assert larger.stages[1].discharge_pressure_correction == 1.0


def test_the_law_of_the_losses_meets_its_readings_published() -> None:
    assert [SUCTION.at(0.3e6), SUCTION.at(0.79e6)] == pytest.approx([0.036, 0.028], rel=1e-14)
    assert [DISCHARGE.at(0.79e6), DISCHARGE.at(2.1e6)] == pytest.approx([0.061, 0.045], rel=1e-14)
    assert 0.0 < DISCHARGE.at(1e10) < SUCTION.at(1.0) < 1.0
