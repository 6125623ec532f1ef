"""Counterweights cut from a plate: masses, unbalances and inertias of sectors and segments."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from optimizer.mechanics.envelope import AnnularSector, Envelope, Segment, opened_for

RIGHT = np.pi / 2
SHAPES = (AnnularSector, Segment)


def integral(function: Callable[[float], float], low: float, high: float) -> float:
    return float(quad(function, low, high, epsabs=0, epsrel=1e-13, limit=200)[0])


def test_a_published_sector() -> None:
    # published: Staneuski, a full opening of 148.7349 degrees for 0.0589960 kg m
    plate = AnnularSector(0.03585, 0.087, 0.01909 * 7860.0, RIGHT)
    assert float(np.rad2deg(plate.opened(0.0589960))) == pytest.approx(148.7349 / 2, abs=2e-4)


@pytest.mark.parametrize("angle", [1e-4, 0.3, 1.0, RIGHT])
@pytest.mark.parametrize("inner", [0.0, 0.06, 0.2])
def test_sectors_by_quadrature(inner: float, angle: float) -> None:
    # independent, ring by ring
    plate = AnnularSector(inner, 0.25, 300.0, RIGHT)
    figures = (
        (1, angle, plate.mass(angle)),
        (2, float(np.sin(angle)), plate.unbalance(angle)),
        (3, angle, plate.inertia(angle)),
    )
    for power, half, values in figures:
        rings = 300.0 * integral(lambda r, power=power, half=half: 2 * half * r**power, inner, 0.25)  # type: ignore[misc]
        assert rings == pytest.approx(float(values), rel=1e-12)


@pytest.mark.parametrize("angle", [0.05, 0.3, 1.0, 1.4, RIGHT])
@pytest.mark.parametrize("inner", [0.0, 0.06, 0.2])
def test_segments_by_quadrature(inner: float, angle: float) -> None:
    # independent, ring by ring, each as far as it lies beyond the chord
    plate = Segment(inner, 0.25, 300.0, RIGHT)
    height = float(plate.chord(angle))
    low = max(inner, height)

    def rings(power: int, of_angle: Callable[[float], float]) -> float:
        def ring(x: float) -> float:
            # r = low + x^2 takes the root at the chord away
            radius = low + x * x
            half = float(np.arccos(min(height / radius, 1.0))) if radius > 0 else 0.0
            return 2 * x * radius**power * 2 * of_angle(half)

        return 300.0 * integral(ring, 0.0, float(np.sqrt(0.25 - low)))

    assert rings(1, float) == pytest.approx(float(plate.mass(angle)), rel=1e-9)
    assert rings(2, lambda half: float(np.sin(half))) == pytest.approx(float(plate.unbalance(angle)), rel=1e-9)
    assert rings(3, float) == pytest.approx(float(plate.inertia(angle)), rel=1e-9)


def test_half_a_disc_in_closed_form() -> None:
    # analytic
    plate = Segment(0.0, 2.0, 3.0, RIGHT)
    assert float(plate.unbalance(RIGHT)) == pytest.approx(3.0 * 2.0 / 3.0 * 8.0, rel=1e-15)
    assert float(plate.mass(RIGHT)) == pytest.approx(3.0 * np.pi * 4.0 / 2.0, rel=1e-14)
    assert float(plate.inertia(RIGHT)) == pytest.approx(3.0 * np.pi * 16.0 / 4.0, rel=1e-14)


def test_the_segment_is_lighter_by_as_much_as_published() -> None:
    sector, segment = (shape(0.06, 0.25, 300.0, RIGHT) for shape in SHAPES)
    most = float(segment.unbalance(RIGHT))
    assert float(sector.unbalance(RIGHT)) == pytest.approx(most, rel=1e-14)
    share = np.array([0.05, 0.5, 0.9]) * most
    # published with three figures
    ratio = sector.mass(sector.opened(share)) / segment.mass(segment.opened(share))
    assert ratio == pytest.approx([1.37, 1.16, 1.03], abs=5e-3)
    assert most / float(segment.mass(RIGHT)) == pytest.approx(0.111, abs=5e-4)


@st.composite
def plates(draw: st.DrawFn) -> Envelope:
    outer = draw(st.floats(0.01, 10.0))
    shape = draw(st.sampled_from(SHAPES))
    return shape(outer * draw(st.floats(0.0, 0.98)), outer, draw(st.floats(1.0, 1e4)), draw(st.floats(0.05, RIGHT)))


@given(plates(), st.floats(1e-3, 1.0), st.floats(0.0, 1.2))
def test_openings_are_found_again(plate: Envelope, share: float, more: float) -> None:
    half_angle = share * plate.most
    assert float(plate.opened(plate.unbalance(half_angle))) == pytest.approx(half_angle, rel=1e-6)
    assert float(opened_for(plate, plate.mass(half_angle))) == pytest.approx(half_angle, rel=1e-9)
    most = float(plate.unbalance(plate.most))
    unbalance = float(plate.unbalance(plate.opened(more * most)))
    assert unbalance == pytest.approx(min(more, 1.0) * most, rel=1e-12, abs=1e-15 * most)


def test_chords_through_the_hub_and_beside_it_are_found_to_the_last_digits() -> None:
    # analytic: the inverse is closed, but for a quartic; at cos a = R1 / R2 the chord touches the hub
    for inner in (0.0, 1e-3, 0.2, 0.9, 0.999):
        plate = Segment(inner, 1.0, 300.0, RIGHT)
        touching = float(np.arccos(inner))
        angle = np.unique(np.clip([1e-5, 0.3, *(touching * np.array([0.9, 1 - 1e-6, 1, 1 + 1e-6, 1.1])), 1.4], 0, 1.4))
        assert plate.opened(plate.unbalance(angle)) == pytest.approx(angle, rel=1e-13)
        # regression: at a right angle an unbalance says less of the opening, but a full plate is full
        assert float(plate.opened(plate.unbalance(RIGHT))) == RIGHT


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("inner", [5e-324, 1e-309, 1e-301, 1e-160])
def test_a_hub_too_small_to_divide_by_is_none(shape: type[Segment], inner: float) -> None:
    # analytic: beside the outer radius it is nothing, to the last digit
    plate, without = shape(inner, 1.0, 300.0, RIGHT), shape(0.0, 1.0, 300.0, RIGHT)
    angle = np.array([0.0, 1e-3, 0.5, 1.5, RIGHT])
    for name in ("mass", "unbalance", "inertia", "lever"):
        assert getattr(plate, name)(angle) == pytest.approx(getattr(without, name)(angle), rel=1e-15)
    assert plate.opened(without.unbalance(angle)) == pytest.approx(without.opened(without.unbalance(angle)), rel=1e-15)


@given(plates(), st.floats(0.01, 0.99), st.floats(0.0, 1.0))
def test_masses_are_convex_with_their_levers_as_tangents(plate: Envelope, share: float, value: float) -> None:
    # analytic: a convex function is above its tangents
    there, here = share * plate.most, value * plate.most
    gained = float(plate.unbalance(here)) - float(plate.unbalance(there))
    tangent = float(plate.mass(there)) + gained / float(plate.lever(there))
    assert float(plate.mass(here)) >= tangent - 1e-12 * float(plate.mass(plate.most)) - 1e-12 * abs(tangent)
    step = 1e-5 * share
    added = (
        float(function(there + step)) - float(function(there - step)) for function in (plate.unbalance, plate.mass)
    )
    unbalance, mass = added
    assert unbalance / mass == pytest.approx(float(plate.lever(there)), rel=1e-4)


def test_plates_broadcast() -> None:
    outer = np.array([[0.1], [0.2]])
    for shape in SHAPES:
        many = shape(np.full((2, 1), 0.05), outer, 100.0, np.full((2, 1), RIGHT))
        sector = shape(0.05, 0.2, 100.0, RIGHT)
        angle = np.array([0.1, 0.5, 1.5])
        for name in ("mass", "unbalance", "inertia", "lever"):
            assert getattr(many, name)(angle).shape == (2, 3)
            assert getattr(many, name)(angle)[1] == pytest.approx(getattr(sector, name)(angle), rel=1e-14)
        unbalance = many.unbalance(angle)
        assert many.opened(unbalance) == pytest.approx(np.array([angle, angle]), rel=1e-9)
