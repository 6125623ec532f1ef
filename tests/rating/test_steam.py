"""Saturated steam and condensation between the stages."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.rating.steam import condensate_coefficients, saturation_pressure
from schemas.rating.request import COLDEST_STEAM_K, HOTTEST_STEAM_K
from tests.rating.design import FIGURES


@pytest.mark.parametrize(
    ("kelvin", "mpa"), [(300.0, 0.353658941e-2), (500.0, 0.263889776e1), (600.0, 0.123443146e2)], ids=str
)
def test_verification_values_published(kelvin: float, mpa: float) -> None:
    """IAPWS R7-97(2012), table 35: nine digits."""
    assert saturation_pressure(kelvin) / 1e6 == pytest.approx(mpa, rel=4.1e-9)


def test_ends_of_the_line_published() -> None:
    # IAPWS R7-97(2012): 611.213 Pa at 273.15 K, the critical 22.064 MPa at 647.096 K
    assert saturation_pressure(COLDEST_STEAM_K) == pytest.approx(611.213, abs=5e-4)
    assert saturation_pressure(HOTTEST_STEAM_K) == pytest.approx(22.064e6, rel=1e-6)


def test_the_seeds_table_but_for_its_misprints_published() -> None:
    """Erratum E004-22: two entries are off by more than 0.2 percent."""
    table = FIGURES["steam"]["p_sat_kPa"]
    errors = [abs(kpa * 1e3 / saturation_pressure(273.15 + i) - 1.0) for i, kpa in enumerate(table)]
    assert [i for i, error in enumerate(errors) if error > 0.002] == FIGURES["steam"]["misprints_C"]
    # what the erratum says should stand there, as far off the formula as its neighbours
    for celsius, kpa in ((7, 1.002), (8, 1.073)):
        assert kpa * 1e3 == pytest.approx(saturation_pressure(273.15 + celsius), rel=0.002)


@given(st.floats(COLDEST_STEAM_K, HOTTEST_STEAM_K - 0.01))
def test_pressure_rises_with_temperature(kelvin: float) -> None:
    assert saturation_pressure(kelvin + 0.01) > saturation_pressure(kelvin)


def test_dry_gas_leaves_no_condensate_analytic() -> None:
    assert condensate_coefficients(0.0, [1e5, 3e5, 9e5], [5e3, 5e3, 5e3]) == [1.0, 1.0, 1.0]


@given(
    humidity=st.floats(0.0, 1.0),
    ratio=st.floats(1.0, 5.0),
    p_first=st.floats(1e3, 2e4),
    p_second=st.floats(1e3, 2e4),
)
def test_condensation_begins_where_the_seed_says(
    humidity: float, ratio: float, p_first: float, p_second: float
) -> None:
    """Analytic: (1-7) where phi p_s1 eps > p_s2, else 1."""
    p = 1e5
    condensate_coefficient = condensate_coefficients(humidity, [p, p * ratio], [p_first, p_second])[1]
    expected = 1.0
    if humidity * p_first * ratio > p_second:
        expected = (p - humidity * p_first) / (p * ratio - p_second) * ratio
    assert condensate_coefficient == pytest.approx(expected, rel=1e-12)


def test_water_once_condensed_stays_away_analytic() -> None:
    """A hot third stage takes up none of what the cooler before the second has condensed."""
    _, second, third = condensate_coefficients(1.0, [1e5, 3e5, 9e5], [7e3, 7e3, 60e3])
    assert third == second < 1.0


def test_above_boiling_nothing_condenses_analytic() -> None:
    assert condensate_coefficients(1.0, [2e5, 3e5], [1e5, 3.5e5]) == [1.0, 1.0]


@given(st.lists(st.floats(1.0, 4.0), min_size=1, max_size=5), st.floats(0.0, 1.0))
def test_moles_are_counted_one_by_one(ratios: list[float], humidity: float) -> None:
    """Independent: one mole of moist gas, cooled step by step to saturation at most."""
    pressures = [1e5]
    for ratio in ratios:
        pressures.append(pressures[-1] * ratio)
    p_s = saturation_pressure(313.15)
    vapour = humidity * p_s / pressures[0]
    dry, moles = 1.0 - vapour, [1.0]
    for p in pressures[1:]:
        if vapour / (vapour + dry) > p_s / p:
            vapour = dry * p_s / (p - p_s)
        moles.append(dry + vapour)
    assert condensate_coefficients(humidity, pressures, [p_s] * len(pressures)) == pytest.approx(moles, rel=1e-12)
