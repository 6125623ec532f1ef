"""Pictures one at a time: those of the report, and nothing in them that a page would have to fear."""

from xml.etree import ElementTree

import pytest
from starlette.testclient import TestClient

from optimizer.errors import OutOfRange
from schemas.request.requests import OptimizeRequest
from service.app import create_app
from service.computations.table import COMPUTATIONS
from service.report.blocks import Figure
from service.report.document import report
from service.settings import Settings
from tests.report_document.conftest import AT, request_of

_SVG = "{http://www.w3.org/2000/svg}"
NAMES = sorted(name.removeprefix("picture_") for name in COMPUTATIONS if name.startswith("picture_"))
#: all that a picture may be made of: no scripts, no styles, no references
_SHAPES = {"svg", "g", "path", "circle", "text", "title"}


def picture_of(name: str, machine: str) -> ElementTree.Element:
    computation = COMPUTATIONS[f"picture_{name}"]
    drawing = computation.function(request_of(machine))
    return ElementTree.fromstring(drawing.svg())


@pytest.mark.parametrize("name", [name for name in NAMES if name != "pin_loads"])
def test_a_picture_is_shapes_alone_and_says_what_it_shows(name: str) -> None:
    element = picture_of(name, "2d12")
    assert {single_element.tag.removeprefix(_SVG) for single_element in element.iter()} <= _SHAPES
    assert element.get("aria-label")
    attributes = {key for single_element in element.iter() for key in single_element.keys()}  # noqa: SIM118 - of an element, not of a mapping
    assert not {key for key in attributes if key.startswith("on") or "href" in key or key == "style"}


@pytest.mark.parametrize("name", ["front", "side", "force", "moment", "stages"])
def test_it_is_the_one_of_the_report(name: str) -> None:
    computation = COMPUTATIONS[f"picture_{name}"]
    of_report = [
        drawing.svg()
        for chapter in report(request_of("2d12"), AT).chapters
        for block in chapter.blocks
        if isinstance(block, Figure)
        for drawing in block.drawings
    ]
    assert computation.function(request_of("2d12")).svg() in of_report


@pytest.mark.parametrize("name", [name for name in NAMES if name != "pin_loads"])
def test_throws_without_rows_are_drawn_or_refused_by_their_field(name: str) -> None:
    request = request_of("2d12").alone
    throws = tuple(throw.model_copy(update={"rows": ()}) for throw in request.machine.throws)
    machine = request.machine.model_copy(update={"throws": throws, "friction": None})
    computation = COMPUTATIONS[f"picture_{name}"].function
    bare = OptimizeRequest.model_validate(request.model_copy(update={"machine": machine}).model_dump())
    if name == "indicator":
        with pytest.raises(OutOfRange) as refused:
            computation(bare)
        assert refused.value.problems[0].path == ("machine", "throws")
    else:
        assert ElementTree.fromstring(computation(bare).svg()).get("aria-label")


def test_bearings_stand_two_to_a_row() -> None:
    element = picture_of("bearings", "2d12")
    corners = [single_element.get("transform") for single_element in element if single_element.tag == f"{_SVG}g"]
    # analytic: half a page and half of the gap of 12; the height of a picture
    assert corners == ["translate(0 0)", "translate(326 0)", "translate(0 360)"]
    assert element.get("width") == "640"


def test_it_comes_by_post_and_what_is_missing_is_named() -> None:
    client = TestClient(create_app(Settings(), warm=False))
    with client:
        body = request_of("2d12").alone.model_dump(mode="json")
        response = client.post("/v1/pictures/front", json=body)
        assert (response.status_code, response.headers["content-type"]) == (200, "image/svg+xml")
        assert ElementTree.fromstring(response.content).get("font-family") == "sans-serif"
        body["machine"].pop("bearings")
        refused = client.post("/v1/pictures/bearings", json=body)
        assert refused.status_code == 422
        assert refused.json()["errors"][0]["pointer"] == "/machine/bearings"
        assert client.post("/v1/pictures/rear", json=body).status_code == 404


def test_a_picture_has_the_size_ground_and_title_that_are_asked_for() -> None:
    body = request_of("2d12").alone.model_dump(mode="json")
    style = {"width_px": 1280, "transparent": False, "title": "<front> & more"}
    with TestClient(create_app(Settings(), warm=False)) as client:
        response = client.post("/v1/pictures/front", json={**body, "picture": style})
        root = ElementTree.fromstring(response.content)
        assert root.get("width") == "1280"
        assert "<front> & more" in [element.text for element in root.iter(f"{_SVG}text")]
        assert root[0].get("fill") == "white"
        pixels = client.post("/v1/pictures/front", json={**body, "picture": style}, headers={"Accept": "image/png"})
        assert (pixels.status_code, pixels.headers["content-type"]) == (200, "image/png")
        # analytic: the width of the head of the file
        assert int.from_bytes(pixels.content[16:20], "big") == 1280
        for wrong in ({"width_px": 99}, {"width_px": 4001}, {"title": ""}, {"colour": "red"}):
            refused = client.post("/v1/pictures/front", json={**body, "picture": wrong})
            assert refused.status_code == 422
            assert refused.json()["errors"][0]["pointer"].startswith("/picture/")
