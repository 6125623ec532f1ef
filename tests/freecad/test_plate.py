"""Closed forms of what is cut from a plate, against the outline itself."""

from itertools import pairwise
from math import cos, pi, sin

import pytest
from freecad.counterweight.plate import DoesNotFit, Plate
from hypothesis import given
from hypothesis import strategies as st

PLATES = st.builds(
    Plate,
    st.sampled_from(["sector", "segment"]),
    st.one_of(st.just(0.0), st.floats(0.01, 0.25)),
    st.floats(0.26, 0.5),
    st.floats(0.01, 0.2),
    st.floats(1e3, 1e4),
    st.floats(0.1, pi / 2),
)
SHARES = st.floats(0.01, 1.0)


@given(PLATES, SHARES, st.floats(-7.0, 7.0))
def test_mass_and_unbalance_are_those_of_the_outline(plate: Plate, share: float, towards: float) -> None:
    half = share * plate.largest
    area, first = 0.0, 0j
    for edge in plate.outline(half, towards):
        # independent: Green's theorem along a polygon that follows the arcs
        corners = polygon(edge)
        for p, q in pairwise(corners):
            cross = p.real * q.imag - p.imag * q.real
            area += cross / 2
            first += cross * (p + q) / 6
    density = plate.density_kg_m3 * plate.thickness_m
    assert plate.mass_kg(half) == pytest.approx(density * area, rel=1e-4)
    direction = complex(cos(towards), sin(towards))
    assert density * first / direction == pytest.approx(plate.unbalance_kg_m(half), rel=1e-4, abs=1e-9)


def polygon(edge: tuple) -> list[complex]:  # type: ignore[type-arg]
    kind, *rest = edge
    if kind == "line":
        return [complex(*point) for point in rest]
    radius, first, last = rest
    # a chord is short of its arc by its eighth of angle squared
    angles = [first + (last - first) * k / 1000 for k in range(1001)]
    return [radius * complex(cos(angle), sin(angle)) for angle in angles]


@given(PLATES, SHARES)
def test_the_opening_has_the_unbalance(plate: Plate, share: float) -> None:
    portion = share * plate.unbalance_kg_m(plate.largest)
    assert plate.unbalance_kg_m(plate.half(portion)) == pytest.approx(portion, rel=1e-13)


@given(PLATES, st.floats(0.0, 2 * pi))
def test_the_outline_is_closed(plate: Plate, towards: float) -> None:
    edges = [polygon(edge) for edge in plate.outline(plate.largest, towards)]
    for single_edge, following in zip(edges, [*edges[1:], edges[0]], strict=True):
        assert single_edge[-1] == pytest.approx(following[0], abs=1e-12)


def test_a_half_disc() -> None:
    plate = Plate("sector", 0.0, 0.3, 0.05, 7850.0)
    # analytic: pi r^2 / 2 and 2 r^3 / 3; segment and sector are the same there
    for counterweight in (plate, Plate("segment", 0.0, 0.3, 0.05, 7850.0)):
        assert counterweight.mass_kg(pi / 2) == pytest.approx(7850 * 0.05 * pi * 0.09 / 2)
        assert counterweight.unbalance_kg_m(pi / 2) == pytest.approx(7850 * 0.05 * 2 * 0.027 / 3)


def test_more_than_fits_is_refused() -> None:
    plate = Plate("sector", 0.1, 0.3, 0.05, 7850.0, 0.5)
    most = plate.unbalance_kg_m(0.5)
    with pytest.raises(DoesNotFit, match="the most that fits"):
        plate.half(1.001 * most)
    with pytest.raises(DoesNotFit):
        plate.half(0.0)
    assert plate.half(most) == pytest.approx(0.5)


def test_an_envelope_is_read_as_the_service_has_it() -> None:
    fields = {"shape": "segment", "outer_radius_m": 0.3, "thickness_m": 0.05, "max_half_angle_deg": 60.0}
    assert Plate.of(fields) == Plate("segment", 0.0, 0.3, 0.05, 7850.0, pytest.approx(pi / 3))
