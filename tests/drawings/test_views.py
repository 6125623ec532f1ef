"""The views: names clear of each other and of shapes, plates as they are cut, weights where they are."""

import math
from itertools import combinations
from typing import Any
from xml.etree import ElementTree

import pytest

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.documents.examples import bodies
from service.drawings.front import front
from service.drawings.layout import layout_of
from service.drawings.side import OBLIQUE, side
from service.drawings.svg import Drawing

MACHINES = bodies()
SVG = "{http://www.w3.org/2000/svg}"
EXAMPLES = ("2d12", "plate-single", "inline-six", "m-type-four", "v8-cross-plane", "scroll-three-pins")
Box = tuple[float, float, float, float]


def drawn(name: str, dimensions: bool | None = None) -> Drawing:
    """The front view, or the side view with or without dimensions."""
    request = OptimizeRequest.model_validate(MACHINES[name])
    layout = layout_of(request.machine, optimize(request).counterweights)
    return front(layout) if dimensions is None else side(layout, dimensions)


def texts(drawing: Drawing) -> list[tuple[str, Box]]:
    """Names, each with the room that letters of usual width take."""
    (names,) = ElementTree.fromstring(drawing.svg()).findall(f"{SVG}g[@class='names']")
    found = []
    for one in names.iter(f"{SVG}text"):
        size, x, y = (float(one.attrib[name]) for name in ("font-size", "x", "y"))
        half = 0.28 * size * len(one.text or "")
        found.append((one.text or "", (x - half, y - 0.75 * size, x + half, y + 0.2 * size)))
    return found


def outlines(drawing: Drawing) -> list[list[tuple[float, float]]]:
    root = ElementTree.fromstring(drawing.svg())
    weights = [one for one in root.iter(f"{SVG}g") if "counterweight" in one.attrib["class"].split()]
    paths = [[path.attrib["d"] for path in one.iter(f"{SVG}path") if path.attrib["fill"] != "none"] for one in weights]
    corners = [path[1:-1].split("L") for (path,) in paths]
    return [[(float(x), float(y)) for x, _, y in (one.partition(" ") for one in corner)] for corner in corners]


def overlap(one: Box, other: Box) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.parametrize("dimensions", [None, False, True])
def test_no_name_is_over_another(name: str, dimensions: bool | None) -> None:
    drawing = drawn(name, dimensions)
    found = texts(drawing)
    assert len(found) > 1
    assert [pair for pair in combinations(found, 2) if overlap(pair[0][1], pair[1][1])] == []
    for _, (left, up, right, down) in found:
        assert left >= 0
        assert up >= 0
        assert right <= drawing.width
        assert down <= drawing.height


@pytest.mark.parametrize("name", ["2d12", "plate-single", "v8-cross-plane"])
def test_names_of_webs_stand_clear_of_counterweights(name: str) -> None:
    drawing = drawn(name)
    webs = {web["name"] for web in MACHINES[name]["machine"]["webs"]}
    names = [box for text, box in texts(drawing) if set(text.split(", ")) & webs]
    shapes = outlines(drawing)
    assert names
    for left, up, right, down in names:
        for shape in shapes:
            assert not any(left < x < right and up < y < down for x, y in shape)


def test_names_are_above_all_shapes() -> None:
    classes = [one.get("class") for one in ElementTree.fromstring(drawn("2d12").svg())]
    assert classes[-1] == "names"


def test_plates_are_drawn_as_they_are_cut() -> None:
    """Independent: mass and centre of mass of the polygon (shoelace) are those of the answer."""
    body: Any = MACHINES["plate-single"]
    request = OptimizeRequest.model_validate(body)
    answer = optimize(request)
    layout = layout_of(request.machine, answer.counterweights)
    drawing = front(layout)
    (throw,) = request.machine.throws
    root = ElementTree.fromstring(drawing.svg())
    (pin,) = root.iterfind(f"{SVG}g[@class='throw']/{SVG}circle")
    per_m = (drawing.height / 2 - float(pin.attrib["cy"])) / throw.crank_radius_m
    fitted = sorted(answer.counterweights, key=lambda one: -one.mass_kg)
    for shape, one in zip(outlines(drawing), fitted, strict=True):
        corners = [((x - 200) / per_m, (200 - y) / per_m) for x, y in shape]
        sides = list(zip(corners, corners[1:] + corners[:1], strict=True))
        twice = [a[0] * b[1] - b[0] * a[1] for a, b in sides]
        area = sum(twice) / 2
        centre = [sum((a[k] + b[k]) * t for (a, b), t in zip(sides, twice, strict=True)) / 6 / area for k in (0, 1)]
        (web,) = (web for web in request.machine.webs if web.name == one.web)
        assert web.envelope is not None
        # a polygon, and hundredths of a px
        assert abs(area) * web.envelope.thickness_m * 7850 == pytest.approx(one.mass_kg, rel=5e-3)
        assert math.hypot(*centre) == pytest.approx(one.radius_m, rel=5e-3)


def test_what_stands_towards_the_reader_is_drawn_down_and_to_the_left() -> None:
    """Analytic: a crank a quarter of a turn behind the first one, obliquely; straight from the side it is a circle."""
    throws = [{"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": angle} for z, angle in ((0, 90), (0.4, 0))]
    machine = {"kind": "reciprocating", "speed_rpm": 500, "throws": throws}
    layout = layout_of(OptimizeRequest.model_validate({"machine": machine}).machine, ())
    flat, oblique = (ElementTree.fromstring(side(layout, dimensions).svg()) for dimensions in (True, False))
    assert len(list(flat.iterfind(f"{SVG}g[@class='throw']/{SVG}circle"))) == 1
    assert not list(oblique.iterfind(f"{SVG}g[@class='throw']/{SVG}circle"))
    _, group = oblique.iterfind(f"{SVG}g[@class='throw']")
    cheek, *_, last = group.iter(f"{SVG}path")
    pin = last.attrib["d"][1:].split("L")
    (x1, y1), (x2, y2) = (map(float, end.split()) for end in pin)
    foot, shaft = map(float, cheek.attrib["d"][1:].split("L")[0].split())
    # of the reach of the machine
    assert ((x1 - foot) / 100, (y1 - shaft) / 100) == pytest.approx(OBLIQUE, abs=0.01)
    assert (x2 > x1, y2) == (True, y1)


def test_pieces_of_a_drawing_say_what_they_are() -> None:
    titles = [one.text for one in ElementTree.fromstring(drawn("2d12").svg()).iter(f"{SVG}title")]
    assert "throw 1 at 0°" in titles
    assert any((title or "").startswith("1a: ") for title in titles)
