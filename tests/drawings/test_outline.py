"""Outlines against the closed forms of their plates, by Green's theorem."""

from math import cos, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from schemas.machine.webs import Envelope
from service.drawings.outline import Arc, Line, Outline, outline, points, rotation
from tests.drawings.plates import HALF_ANGLES, mechanics_of, plates


def area_and_moment(edges: Outline) -> tuple[float, float]:
    """Area and its first moment about the x axis: half the sum of x dy - y dx, minus half the sum of y^2 dx."""
    area = moment = 0.0
    for edge in edges:
        (x, y), (u, v) = edge.start, edge.end
        if isinstance(edge, Line):
            area += 0.5 * (x * v - u * y)
            moment -= 0.5 * (u - x) * (y * y + y * v + v * v) / 3.0
        else:
            r, a, b = edge.radius, edge.first, edge.last
            area += 0.5 * r * r * (b - a)
            # dx = -r sin t dt, and the integral of sin^3 is cos^3 / 3 - cos
            moment += 0.5 * r**3 * (cos(b) ** 3 / 3.0 - cos(b) - cos(a) ** 3 / 3.0 + cos(a))
    return area, moment


@given(plates(), HALF_ANGLES)
def test_area_and_moment_are_those_of_the_plate(plate: Envelope, half_angle: float) -> None:
    area, moment = area_and_moment(outline(plate, half_angle))
    envelope = mechanics_of(plate)
    # independent: closed forms of mass and unbalance, of a mass of 1 kg/m^2
    scale = plate.outer_radius_m
    assert area == pytest.approx(float(envelope.mass(half_angle)), rel=1e-9, abs=1e-14 * scale**2)
    assert moment == pytest.approx(float(envelope.unbalance(half_angle)), rel=1e-9, abs=1e-14 * scale**3)


@given(plates(), HALF_ANGLES, st.floats(-10.0, 10.0))
def test_edges_follow_one_another_also_when_turned(plate: Envelope, half_angle: float, angle: float) -> None:
    for edges in (outline(plate, half_angle), rotation(outline(plate, half_angle), angle)):
        for edge, following in zip(edges, (*edges[1:], edges[0]), strict=True):
            assert edge.end == pytest.approx(following.start, abs=1e-12 * plate.outer_radius_m)


@given(plates(), HALF_ANGLES)
def test_a_polygon_is_as_close_as_asked(plate: Envelope, half_angle: float) -> None:
    edges, tolerance = outline(plate, half_angle), 1e-4
    corners = list(points(edges, tolerance))
    shoelace = 0.5 * sum(x * v - u * y for (x, y), (u, v) in zip(corners, [*corners[1:], corners[0]], strict=True))
    around = sum(edge.radius * abs(edge.last - edge.first) for edge in edges if isinstance(edge, Arc))
    assert abs(shoelace - area_and_moment(edges)[0]) <= around * tolerance


def test_a_chord_beyond_the_hub_has_two_edges() -> None:
    plate = Envelope(shape="segment", inner_radius_m=0.06, outer_radius_m=0.25, thickness_m=0.04)
    beyond = outline(plate, 1.0)
    assert [type(edge) for edge in beyond] == [Arc, Line]
    # analytic: h = R cos a
    assert beyond[1].start[1] == pytest.approx(0.25 * cos(1.0), rel=1e-14)
    assert beyond[1].start[0] == pytest.approx(-0.25 * sin(1.0), rel=1e-14)


def test_a_chord_through_the_shaft_meets_the_hub() -> None:
    plate = Envelope(shape="segment", inner_radius_m=0.06, outer_radius_m=0.25, thickness_m=0.04)
    through = outline(plate, pi / 2)
    assert [type(edge) for edge in through] == [Arc, Line, Arc, Line]
    # analytic: half a ring
    assert area_and_moment(through)[0] == pytest.approx(0.5 * pi * (0.25**2 - 0.06**2), rel=1e-14)


def test_a_sector_without_a_hub_comes_to_a_point() -> None:
    plate = Envelope(shape="sector", outer_radius_m=0.25, thickness_m=0.04)
    assert [type(edge) for edge in outline(plate, 1.0)] == [Arc, Line, Line]
