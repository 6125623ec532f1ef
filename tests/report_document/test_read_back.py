"""Drawings read back (analytic): angles, sides and senses are those of the machine and of the answer."""

import cmath
import io
import math
import re
from collections.abc import Iterator
from itertools import pairwise
from math import degrees
from typing import Any
from xml.etree import ElementTree

import ezdxf
import pytest

from optimizer.optimize import optimize
from schemas.answer.counterweights import Counterweight
from schemas.machine.webs import Envelope
from service.drawings.dxf import dxf
from service.drawings.front import front
from service.drawings.layout import layout_of
from service.drawings.outline import outline
from service.drawings.svg import AFTER, INK, MUTED, Drawing
from tests.report_document.conftest import request_of

_NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"


def shapes(drawing: Drawing, tag: str, **attributes: str) -> Iterator[ElementTree.Element]:
    """Shapes of a kind that have these attributes."""
    fields = {name.replace("_", "-"): value for name, value in attributes.items()}
    for element in ElementTree.fromstring(drawing.svg()).iter():
        if element.tag.endswith(tag) and fields.items() <= element.attrib.items():
            yield element


def from_the_shaft(drawing: Drawing, x: float, y: float) -> complex:
    """A point of the drawing about its middle, y upwards, px."""
    return complex(x - drawing.width / 2, drawing.height / 2 - y)


def line(drawing: Drawing, shape: ElementTree.Element) -> list[complex]:
    numbers = [float(match) for match in re.findall(_NUMBER, shape.get("d") or "")]
    return [from_the_shaft(drawing, x, y) for x, y in zip(numbers[::2], numbers[1::2], strict=True)]


def apart(first: float, second: float) -> float:
    """The angle between two directions, deg."""
    return abs((first - second + 180) % 360 - 180)


def direction(point: complex) -> float:
    return degrees(cmath.phase(point))


def fitted(angles: tuple[float, ...]) -> list[Counterweight]:
    pairs = zip(optimize(request_of("2d12")).counterweights, angles, strict=True)
    return [counterweight.model_copy(update={"mass_kg": 20.0, "angle_deg": angle}) for counterweight, angle in pairs]


@pytest.mark.parametrize("angles", [(20.0, 75.0, 160.0, 290.0), (355.0, 95.0, 181.0, 225.0)])
def test_counterweights_are_drawn_on_the_side_where_they_are(angles: tuple[float, ...]) -> None:
    drawing = front(layout_of(request_of("2d12").machine, fitted(angles)))
    rings = [line(drawing, shape) for shape in shapes(drawing, "path", fill=AFTER)]
    assert len(rings) == len(angles)
    for ring, angle in zip(rings, angles, strict=True):
        assert apart(direction(sum(ring)), angle) < 0.5
        # to both sides of it alike
        sides = [(degrees(cmath.phase(point / cmath.rect(1, math.radians(angle))))) for point in ring]
        assert max(sides) == pytest.approx(-min(sides), abs=0.5)
    dots = list(shapes(drawing, "circle", fill=AFTER))
    places = [from_the_shaft(drawing, float(element.get("cx", 0)), float(element.get("cy", 0))) for element in dots]
    assert [direction(place) % 360 for place in places] == pytest.approx(list(angles), abs=0.2)
    assert len({round(abs(place), 1) for place in places}) == 1


def with_sector(centre: float, half: float) -> Any:
    machine = request_of("2d12").machine
    body = machine.model_dump(mode="json", exclude_none=True)
    body["webs"][0]["sector"] = {"centre_deg": centre, "half_angle_deg": half}
    return request_of("2d12", machine=body).machine


@pytest.mark.parametrize(("centre", "half"), [(100.0, 30.0), (250.0, 12.0), (0.0, 45.0)])
def test_the_angles_that_a_web_allows_are_drawn_where_they_are(centre: float, half: float) -> None:
    plain = {shape.get("d") for shape in shapes(front(layout_of(request_of("2d12").machine, ())), "path")}
    drawing = front(layout_of(with_sector(centre, half), ()))
    drawn = (shape for shape in shapes(drawing, "path", stroke_dasharray="4 4") if shape.get("d") not in plain)
    (wedge,) = (line(drawing, element) for element in drawn)
    shaft, *arc = wedge
    assert abs(shaft) < 0.01
    assert apart(direction(arc[0]), centre - half) < 0.2
    assert apart(direction(arc[-1]), centre + half) < 0.2
    assert apart(direction(arc[len(arc) // 2]), centre) < half / 2


@pytest.mark.parametrize(("rotation", "sense"), [("ccw", 1), ("cw", -1)])
def test_the_arrow_turns_as_the_machine_does(rotation: str, sense: int) -> None:
    body = request_of("2d12").machine.model_dump(mode="json", exclude_none=True)
    drawing = front(layout_of(request_of("2d12", machine={**body, "rotation": rotation}).machine, ()))
    (arc,) = (line(drawing, shape) for shape in shapes(drawing, "path", stroke=MUTED, stroke_width="1.2", fill="none"))
    (head,) = (line(drawing, shape) for shape in shapes(drawing, "path", fill=MUTED))
    middle = from_the_shaft(drawing, 32.0, 32.0)
    steps = [cmath.phase((after - middle) / (before - middle)) for before, after in pairwise(arc)]
    assert all(step * sense > 0 for step in steps)
    # the head is at the end of the arc, and its wings are behind it
    assert head[0] == arc[-1]
    wings = (head[1] + head[2]) / 2 - middle
    assert cmath.phase((arc[-1] - middle) / wings) * sense > 0
    assert [shape.text for shape in shapes(drawing, "text") if shape.text in ("ccw", "cw")] == [rotation]


def test_cranks_end_at_their_pins() -> None:
    machine = request_of("v90-unequal").machine
    drawing = front(layout_of(machine, ()))
    drawn = (line(drawing, shape) for shape in shapes(drawing, "path", stroke=INK, stroke_width="4"))
    cranks = {round(direction(values[-1]) % 360, 1) for values in drawn}
    assert cranks == {round(throw.crank_angle_deg % 360, 1) for throw in machine.throws}


@pytest.mark.parametrize(("rotation", "sense"), [("ccw", 1), ("cw", -1)])
def test_pins_of_a_scroll_follow_each_other_in_the_sense_of_rotation(rotation: str, sense: int) -> None:
    body = request_of("scroll-three-pins").machine.model_dump(mode="json", exclude_none=True)
    drawing = front(layout_of(request_of("scroll-three-pins", machine={**body, "rotation": rotation}).machine, ()))
    pins = [
        from_the_shaft(drawing, float(shape.get("cx", 0)), float(shape.get("cy", 0)))
        for shape in shapes(drawing, "circle", fill="white", stroke_width="1.4")
    ]
    assert len(pins) == 3
    turns = [direction(pin / pins[0]) for pin in pins[1:]]
    assert [apart(turn, sense * angle) < 0.2 for turn, angle in zip(turns, (120, 240), strict=True)] == [True, True]


@pytest.mark.parametrize("half", [0.4, 1.1])
def test_arcs_of_a_cut_sector_in_an_exchange_file(half: float) -> None:
    """A sector about the shaft, symmetric about +y: its outer arc between its edges, the hub within."""
    plate = Envelope(shape="sector", inner_radius_m=0.07, outer_radius_m=0.21, thickness_m=0.03)
    read = ezdxf.read(io.StringIO(dxf(outline(plate, half)).decode("ascii"))).modelspace()
    arcs = {entity.dxf.radius: entity.dxf for entity in read.query("ARC") if entity.dxf.layer == "OUTLINE"}
    assert sorted(arcs) == pytest.approx([70.0, 210.0])
    for arc in arcs.values():
        assert (arc.center.x, arc.center.y) == (0, 0)
        assert (arc.start_angle % 360, arc.end_angle % 360) == pytest.approx((90 - degrees(half), 90 + degrees(half)))
    edges = [entity.dxf for entity in read.query("LINE") if entity.dxf.layer == "OUTLINE"]
    assert len(edges) == 2
    for edge in edges:
        assert sorted(abs(complex(end.x, end.y)) for end in (edge.start, edge.end)) == pytest.approx([70.0, 210.0])
