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
from service.report.chapters.balance import carried
from tests.optimize.machines import throw
from tests.optimize.shafts import shaft, single

MACHINES = bodies()
SVG = "{http://www.w3.org/2000/svg}"
EXAMPLES = (
    "2d12", "plate-single", "inline-six", "m-type-four", "v8-cross-plane", "scroll-three-pins", "lanchester-four",
    "single-balance-shaft",
)  # fmt: skip
Box = tuple[float, float, float, float]


def drawn(name: str, dimensions: bool | None = None) -> Drawing:
    """The front view, or the side view with or without dimensions."""
    request = OptimizeRequest.model_validate(MACHINES[name])
    layout = layout_of(request.machine, carried(optimize(request)))
    return front(layout) if dimensions is None else side(layout, dimensions)


def texts(drawing: Drawing) -> list[tuple[str, Box]]:
    """Names, each with the room that letters of usual width take."""
    (names,) = ElementTree.fromstring(drawing.svg()).findall(f"{SVG}g[@class='names']")
    values = []
    for element in names.iter(f"{SVG}text"):
        size, x, y = (float(element.attrib[name]) for name in ("font-size", "x", "y"))
        half = 0.28 * size * len(element.text or "")
        values.append((element.text or "", (x - half, y - 0.75 * size, x + half, y + 0.2 * size)))
    return values


def outlines(drawing: Drawing) -> list[list[tuple[float, float]]]:
    root = ElementTree.fromstring(drawing.svg())
    weights = [element for element in root.iter(f"{SVG}g") if "counterweight" in element.attrib["class"].split()]
    paths = [
        [path.attrib["d"] for path in weight.iter(f"{SVG}path") if path.attrib["fill"] != "none"] for weight in weights
    ]
    corners = [path[1:-1].split("L") for (path,) in paths]
    return [[(float(x), float(y)) for x, _, y in (text.partition(" ") for text in corner)] for corner in corners]


def overlap(first: Box, second: Box) -> bool:
    return first[0] < second[2] and second[0] < first[2] and first[1] < second[3] and second[1] < first[3]


@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.parametrize("dimensions", [None, False, True])
def test_no_name_is_over_another(name: str, dimensions: bool | None) -> None:
    drawing = drawn(name, dimensions)
    actual_texts = texts(drawing)
    assert len(actual_texts) > 1
    assert [pair for pair in combinations(actual_texts, 2) if overlap(pair[0][1], pair[1][1])] == []
    for _, (left, up, right, down) in actual_texts:
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
    classes = [element.get("class") for element in ElementTree.fromstring(drawn("2d12").svg())]
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
    fitted = sorted(answer.counterweights, key=lambda counterweight: -counterweight.mass_kg)
    for shape, weight in zip(outlines(drawing), fitted, strict=True):
        corners = [((x - 200) / per_m, (200 - y) / per_m) for x, y in shape]
        sides = list(zip(corners, corners[1:] + corners[:1], strict=True))
        twice = [a[0] * b[1] - b[0] * a[1] for a, b in sides]
        area = sum(twice) / 2
        centre = [sum((a[k] + b[k]) * t for (a, b), t in zip(sides, twice, strict=True)) / 6 / area for k in (0, 1)]
        (web,) = (web for web in request.machine.webs if web.name == weight.web)
        assert web.envelope is not None
        # a polygon, and hundredths of a px
        assert abs(area) * web.envelope.thickness_m * 7850 == pytest.approx(weight.mass_kg, rel=5e-3)
        assert math.hypot(*centre) == pytest.approx(weight.radius_m, rel=5e-3)


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
    titles = [element.text for element in ElementTree.fromstring(drawn("2d12").svg()).iter(f"{SVG}title")]
    assert "throw 1 at 0°" in titles
    assert any((title or "").startswith("1a: ") for title in titles)


def _circles(group: ElementTree.Element) -> list[tuple[float, float]]:
    return [(float(element.attrib["cx"]), float(element.attrib["cy"])) for element in group.iter(f"{SVG}circle")]


def test_balance_shafts_stand_in_their_places_analytic() -> None:
    """Front view: the first circle is the axis, the last one the centre of mass of what it carries."""
    body = single([shaft("one", -1, 0.2, radius=0.05, x_m=-0.12, y_m=0.07)])
    machine = OptimizeRequest.model_validate({"machine": body}).machine
    counterweights: Any = [{"web": "one web", "mass_kg": 3.0, "angle_deg": 30.0, "radius_m": 0.05}]
    layout = layout_of(machine, counterweights)
    root = ElementTree.fromstring(front(layout).svg())
    (pin,) = root.iterfind(f"{SVG}g[@class='throw']/{SVG}circle")
    per_m = (200.0 - float(pin.attrib["cy"])) / 0.1
    (group,) = root.iterfind(f"{SVG}g[@class='balancer']")
    places = [((x - 200.0) / per_m, (200.0 - y) / per_m) for x, y in _circles(group)]
    assert places[0] == pytest.approx((-0.12, 0.07), abs=1e-4)
    centre = (-0.12 + 0.05 * math.cos(math.radians(30.0)), 0.07 + 0.05 * 0.5)
    assert places[-1] == pytest.approx(centre, abs=1e-4)
    title = group.find(f"{SVG}title")
    assert title is not None
    assert title.text == "one, against, n: one web 3 kg at 30°"
    assert "one: against, n" in [text for text, _ in texts(front(layout))]


@pytest.mark.parametrize("place", [(-0.12, 0.07), (0.0, 0.0)])
def test_balance_shafts_stand_beside_the_crankshaft_from_the_side_analytic(place: tuple[float, float]) -> None:
    """The first crank points upwards, along y here; an axis in that of the crankshaft is not drawn twice."""
    body = single([shaft("one", 2, 0.2, radius=0.05, x_m=place[0], y_m=place[1])])
    body["throws"].append(throw(0.4, 90.0, []))
    machine = OptimizeRequest.model_validate({"machine": body}).machine
    counterweights: Any = [{"web": "one web", "mass_kg": 3.0, "angle_deg": 90.0, "radius_m": 0.05}]
    root = ElementTree.fromstring(side(layout_of(machine, counterweights), dimensions=True).svg())
    group, _ = root.iterfind(f"{SVG}g[@class='throw']")
    cheek = next(group.iter(f"{SVG}path")).attrib["d"][1:].split("L")
    (_, shaft_y), (_, pin_y) = (map(float, end.split()) for end in cheek)
    per_m = (shaft_y - pin_y) / 0.1
    (on_shaft,) = root.iterfind(f"{SVG}g[@class='balancer']")
    ((_, y),) = _circles(on_shaft)
    assert (shaft_y - y) / per_m == pytest.approx(place[1] + 0.05, abs=1e-4)
    axes = on_shaft.findall(f"{SVG}path")
    assert len(axes) == (1 if any(place) else 0)
    for axis in axes:
        assert (shaft_y - float(axis.attrib["d"].split()[-1])) / per_m == pytest.approx(0.07, abs=1e-4)
