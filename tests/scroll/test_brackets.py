"""Peaks of pins with clearance lie in their brackets, and these are narrow."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.numerics.arrays import Real
from optimizer.pins.brackets import TOLERANCE, enclosed_peaks
from optimizer.pins.loads import PeriodicTable, elastic_loads, peaks
from optimizer.pins.pattern import pattern_of
from schemas.scroll.pin_loads import PinLoadsAnswer, PinLoadsRequest
from tests.night import by_day
from tests.scroll.patterns import ask, pins_at, seeds
from tests.scroll.test_peaks import MICRON, STIFFNESS, random_body

GRID = np.arange(0.0, 360.25, 0.5)


def loaded_body(seed: int) -> dict[str, Any]:
    """At least three pins with play and errors, off a line, that hold a torque."""
    rng = np.random.default_rng(seed)
    body = random_body(seed)
    body["pins"] += [dict(pin) for pin in body["pins"]] if len(body["pins"]) < 3 else []
    for index, pin in enumerate(body["pins"]):
        pin["angle_deg"] = (130.0 * index + rng.uniform(0.0, 60.0)) % 360.0
    body["pins"][0]["clearance_m"] = 3.0 * MICRON
    body["rotation_torque_Nm"] = {**body["rotation_torque_Nm"], "torque_Nm": rng.uniform(-20.0, 20.0, 4).tolist()}
    return body


def carriers(answer: PinLoadsAnswer) -> list[Any]:
    return [*answer.pins, *([] if answer.drive_bearing is None else [answer.drive_bearing])]


def sizes(body: dict[str, Any], angle_deg: Real) -> Real:
    """Magnitudes of the loads at any angles."""
    request = PinLoadsRequest.model_validate(body)
    table = body["rotation_torque_Nm"]
    torque = PeriodicTable(np.array(table["angle_deg"]), np.array(table["torque_Nm"]))
    return np.abs(pattern_of(request).loads(torque.at(angle_deg), angle_deg))


@by_day(25)
@given(seed=seeds)
def test_no_load_at_any_angle_is_above_its_bracket_independent(seed: int) -> None:
    """Against many angles, the nearest ones around the peaks. Each peak is a load that there is."""
    body = loaded_body(seed)
    answer = ask(**body)
    near = np.array([carrier.peak_angle_deg for carrier in carriers(answer)])
    steps = np.concatenate([np.linspace(-1.0, 1.0, 801), np.linspace(-1e-3, 1e-3, 101)])
    angles = np.concatenate(
        [np.random.default_rng(seed).uniform(0.0, 360.0, 3000), (near[:, None] + steps).reshape(-1)]
    )
    largest, there = np.max(sizes(body, angles), axis=0), np.diagonal(sizes(body, near))
    assert answer.peak_bracket_N is not None
    for carrier, most, own in zip(carriers(answer), largest, there, strict=True):
        low, high = carrier.peak_bracket_N
        assert most <= high + 1e-12 * answer.peak_bracket_N[1]
        assert low == carrier.peak_N == pytest.approx(own, rel=1e-9)
        # near a line rounding leaves more open than the search does
        assert high - low <= 1e-8 * max(other.peak_N for other in carriers(answer))
    assert answer.peak_bracket_N[0] == answer.peak_N
    assert "peaks_not_certified" not in {warning.code for warning in answer.warnings}


@by_day(20)
@given(seed=seeds, is_rigid=st.booleans())
def test_without_clearance_the_closed_form_is_in_the_bracket_analytic(seed: int, is_rigid: bool) -> None:
    body = loaded_body(seed)
    for pin in body["pins"]:
        pin |= {"clearance_m": 0.0, "eccentricity_error_m": 0.0}
    bearing = {"type": "rigid"} if is_rigid else {"type": "elastic", "stiffness_N_per_m": 3e7}
    pattern = pattern_of(PinLoadsRequest.model_validate(body | {"drive_bearing": bearing}))
    torque = PeriodicTable(np.zeros(1), np.array([12.5]))
    exact, _ = peaks(pattern.shapes(), torque)
    # of a search that has seen nothing
    enclosed = enclosed_peaks(pattern, torque, GRID, np.zeros(exact.size), np.zeros(exact.size))
    assert enclosed.bound is not None
    slack = 1e-12 * np.max(exact)
    assert np.all((enclosed.size <= exact + slack) & (exact <= enclosed.bound + slack))
    assert np.all(enclosed.bound - enclosed.size <= 1.01 * TOLERANCE * np.max(exact))


def test_a_peak_that_a_search_misses_is_there_independent() -> None:
    """Regression: the search stayed at another peak of the rigid bearing, a thousandth below; 100 samples a degree."""
    body = random_body(374)
    answer = ask(**body)
    assert answer.drive_bearing is not None
    assert answer.drive_bearing.peak_N is not None
    largest = np.max(sizes(body, np.arange(0.0, 360.0, 0.01))[:, -1])
    assert largest == pytest.approx(answer.drive_bearing.peak_N, rel=1e-4)
    assert largest <= answer.drive_bearing.peak_N * (1.0 + 1e-9)


@pytest.mark.parametrize("size", [1e-11, 1e-3, 1e9])
def test_brackets_grow_with_torque_and_play_analytic(size: float) -> None:
    """Property: all strains grow alike."""
    body = loaded_body(3)
    large = loaded_body(3)
    large["rotation_torque_Nm"]["torque_Nm"] = [size * torque for torque in body["rotation_torque_Nm"]["torque_Nm"]]
    for pin in large["pins"]:
        # strains stay what they are, stiffnesses grow
        pin["stiffness_N_per_m"] *= size
    if body["drive_bearing"]["type"] == "elastic":
        large["drive_bearing"] = {**body["drive_bearing"], "stiffness_N_per_m": 3e7 * size}
    for first, second in zip(carriers(ask(**body)), carriers(ask(**large)), strict=True):
        assert second.peak_bracket_N == pytest.approx([size * end for end in first.peak_bracket_N], rel=1e-8)


@pytest.mark.parametrize(("clearance", "width"), [(0.0, 0.0), (MICRON, 1.01 * TOLERANCE)])
def test_three_pins_off_a_line_have_brackets(clearance: float, width: float) -> None:
    pins = pins_at([0.0, 120.0, 240.0], stiffness_N_per_m=STIFFNESS, clearance_m=clearance)
    answer = ask(pins=pins, rotation_torque_Nm=10.0)
    assert answer.peak_N is not None
    for carrier in (answer, *answer.pins):
        assert carrier.peak_bracket_N is not None
        low, high = carrier.peak_bracket_N
        assert low == carrier.peak_N
        assert 0.0 <= high - low <= width * answer.peak_N
    assert answer.warnings == ()


@pytest.mark.parametrize("torque", [10.0, 0.0])
def test_beside_dead_points_nothing_bounds_loads(torque: float) -> None:
    """With a torque there is no peak to speak of."""
    pins = pins_at([0.0, 180.0], stiffness_N_per_m=STIFFNESS, eccentricity_error_m=[4.0 * MICRON, 0.0])
    answer = ask(pins=pins, rotation_torque_Nm=torque)
    assert (answer.peak_N is None) == (torque > 0.0)
    assert [carrier.peak_bracket_N for carrier in (answer, *answer.pins)] == [None] * 3
    assert ("peaks_not_certified" in {warning.code for warning in answer.warnings}) == (torque == 0.0)


def test_where_errors_alone_strain_the_pins_the_bracket_says_how_much_is_open() -> None:
    """Without a torque the scroll is free within its play: many motions are as good, and bounds are far above."""
    body = random_body(91)
    assert set(body["rotation_torque_Nm"]["torque_Nm"]) <= {0.0}
    answer = ask(**body)
    assert answer.peak_bracket_N is not None
    assert answer.peak_bracket_N[0] == answer.peak_N
    assert answer.peak_bracket_N[1] > answer.peak_bracket_N[0] * (1.0 + 1e-6)
    assert "peaks_not_certified" in {warning.code for warning in answer.warnings}


def test_elastic_loads_are_those_of_contact_without_play_analytic() -> None:
    pattern = pattern_of(
        PinLoadsRequest.model_validate({"pins": pins_at([0.0, 75.0, 140.0]), "rotation_torque_Nm": 1.0})
    )
    load = pattern.contact(np.full(GRID.shape, 12.5), GRID).load
    np.testing.assert_allclose(load, elastic_loads(np.full(GRID.shape, 12.5), pattern.pins, GRID), atol=1e-9)
