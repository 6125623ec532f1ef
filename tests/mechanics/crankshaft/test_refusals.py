"""Lists that are no shaft: each refused at the face that is wrong, or that shows it."""

import contextlib
import json
from math import cos, radians, sin
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError
from starlette.testclient import TestClient

from optimizer.errors import OutOfRange
from optimizer.mechanics.crankshaft.read import read_shaft
from schemas.request.shaft import ShaftRequest
from tests.mechanics.crankshaft.shafts import RADIUS, Drawing, Json, cylinder, moved
from tests.night import by_day

FACES = Drawing().faces()
BODY: Json = {"mass_kg": 352.0, "centre_m": [0, 0, 0]}
#: of a face of a web, and its place
PIN = next(n for n, face in enumerate(FACES) if face.get("ends_m") == [-0.245, -0.105])


def changed(number: int, **fields: Any) -> Json:
    faces = [dict(face) for face in FACES]
    faces[number].update(fields)
    return {"faces": faces}


def second_shaft(turn: np.ndarray | None = None, away: float = 0.0) -> Json:  # type: ignore[type-arg]
    place = np.array([away, 0.0, 0.0])
    values = [moved(face, np.eye(3) if turn is None else turn, place, 0.9) for face in FACES]
    return {"faces": [*FACES, *values]}


TILT = np.array([[1, 0, 0], [0, cos(radians(20)), -sin(radians(20))], [0, sin(radians(20)), cos(radians(20))]])
IN_MM = {"radius_m": 75.0, "ends_m": [-245.0, -105.0], "centre_m": [140.0, 0, 0]}
SHEAR = [[1, 2, 0], [0, 1, 0], [0, 0, 1]]
WRONG: dict[str, tuple[Json, str, str]] = {
    "nothing": ({}, "/faces", "list the faces of a shaft"),
    "no face": ({"faces": []}, "/faces", "list the faces of a shaft"),
    "planes only": ({"faces": [face for face in FACES if face["type"] == "plane"]}, "/faces", "no outer cylinder"),
    "bores only": (
        {"faces": [{**face, "outer": False} for face in FACES if face["type"] == "cylinder"]},
        "/faces",
        "no outer cylinder",
    ),
    "a bar": ({"faces": [cylinder(0, 0, 0.05, 0, 1)]}, "/faces", "there is no crank pin"),
    "a face in mm": (changed(PIN, **IN_MM), f"/faces/{PIN}/radius_m", "is its unit that of the others?"),
    "a radius in mm": (changed(PIN, radius_m=75.0), f"/faces/{PIN}/radius_m", "937.5 times"),
    "ends in mm": (changed(PIN, ends_m=[-245.0, -105.0]), f"/faces/{PIN}/ends_m", "are both in one unit?"),
    "a centre in mm": (changed(PIN, centre_m=[140.0, 0, 0]), f"/faces/{PIN}/centre_m", "as far away as the others"),
    "a second shaft beside": (second_shaft(away=1.0), f"/faces/{len(FACES)}", "beside the shaft"),
    "a second shaft across": (second_shaft(TILT), f"/faces/{len(FACES)}/axis", "leans by 20 degrees"),
    "no length": (changed(PIN, ends_m=[0.1, 0.1]), f"/faces/{PIN}/ends_m", "a cylinder without length"),
    "no radius": (changed(PIN, radius_m=0), f"/faces/{PIN}/radius_m", "must be at least"),
    "no direction": (changed(PIN, axis=[0, 0, 0]), f"/faces/{PIN}/axis", "must not be zero"),
    "two numbers": (changed(PIN, centre_m=[0, 0]), f"/faces/{PIN}/centre_m/2", "required"),
    "a mass as a length": (changed(PIN, radius_m="75 kg"), f"/faces/{PIN}/radius_m", "unit must be one of"),
    "a torus": (changed(PIN, type="torus"), f"/faces/{PIN}/type", "must be one of"),
    "10,000 faces": ({"faces": [{"type": "other"}] * 10_000}, "/faces", "at most 5000"),
    "an axis that is none": (
        {"faces": FACES, "frame": {"origin_m": [0, 0, 0], "z": [1, 0, 0], "x": [0, 0, 1]}},
        "/frame/z",
        "no outer cylinder is along it",
    ),
    "x along z": (
        {"faces": FACES, "frame": {"origin_m": [0, 0, 0], "z": [0, 0, 1], "x": [0, 0, 2]}},
        "/frame/x",
        "nor along z",
    ),
    "zero volume": ({"faces": FACES, "bodies": [{**BODY, "volume_m3": 0}]}, "/bodies/0/volume_m3", "greater than 0"),
    "no mass": ({"faces": FACES, "bodies": [{**BODY, "mass_kg": 0}]}, "/bodies/0/mass_kg", "greater than 0"),
    "a centre in mm of a body": (
        {"faces": FACES, "bodies": [{**BODY, "centre_m": [0, 0, 310.0]}]},
        "/bodies/0/centre_m",
        "are its units those of the faces?",
    ),
    "an inertia in kg mm2": (
        {"faces": FACES, "bodies": [{**BODY, "inertia_kg_m2": np.diag([2.2e7, 2.3e7, 3.6e6]).tolist()}]},
        "/bodies/0/inertia_kg_m2",
        "is it in kg m2?",
    ),
    "an inertia of no body": (
        {"faces": FACES, "bodies": [{**BODY, "inertia_kg_m2": np.diag([1.0, 1.0, 3.0]).tolist()}]},
        "/bodies/0/inertia_kg_m2",
        "belongs to no body",
    ),
    "an inertia of one triangle": (
        {"faces": FACES, "bodies": [{**BODY, "inertia_kg_m2": SHEAR}]},
        "/bodies/0/inertia_kg_m2",
        "must be symmetric",
    ),
    "bodies only": ({"bodies": [BODY]}, "/frame", "without faces nothing shows where the axis is"),
    "one plane": ({"faces": FACES, "bodies": [BODY], "planes_m": [0.1, 0.1]}, "/planes_m", "bear no couple"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_no_shaft_is_refused_at_its_face(client: TestClient, name: str) -> None:
    body, pointer, words = WRONG[name]
    answer = client.post("/v1/shaft", json=body)
    assert answer.status_code == 422, answer.text[:500]
    errors = {error["pointer"]: error["message"] for error in answer.json()["errors"]}
    assert pointer in errors, errors
    assert words in errors[pointer]


@pytest.mark.parametrize("text", ["NaN", "Infinity", "1e999", "-1e999"])
def test_numbers_that_are_none_are_refused_at_their_face(client: TestClient, text: str) -> None:
    body = json.dumps(changed(PIN, radius_m="X")).replace('"X"', text)
    answer = client.post("/v1/shaft", content=body, headers={"Content-Type": "application/json"})
    assert answer.status_code == 422
    assert [error["pointer"] for error in answer.json()["errors"]] == [f"/faces/{PIN}/radius_m"]


def test_five_thousand_faces_at_one_height_are_read() -> None:
    """As many as are taken: what is quadratic in them stays in arrays, a second in all."""
    many = [cylinder(RADIUS * cos(n), RADIUS * sin(n), 0.01 + 1e-6 * n, 0.0, 0.1) for n in range(4_990)]
    request = ShaftRequest.model_validate({"faces": [cylinder(0, 0, 0.05, -0.2, 0.3), *many]})
    with pytest.raises(OutOfRange, match="beside the shaft"):
        read_shaft(request)


def test_extreme_sizes_are_answered_or_refused(client: TestClient) -> None:
    """Nothing that is sent is a fault of the service."""
    for scale in (1e-11, 1e-6, 1e6, 1e8):
        faces = [moved(face, np.eye(3), np.zeros(3), scale) for face in FACES]
        for body in ({"faces": faces}, {"faces": faces, "bodies": [BODY]}, {"faces": faces, "tolerance_m": 1e9}):
            assert client.post("/v1/shaft", json=body).status_code in (200, 422)
    for tolerance in (1e-12, 1.0, 1e9):
        assert client.post("/v1/shaft", json={"faces": FACES, "tolerance_m": tolerance}).status_code in (200, 422)


EXTREMES = st.sampled_from([0.0, 1e-12, 1e-9, 1e-300, 0.14, -0.245, 1e3, 1e6, 1e9, -1e9])


@given(st.lists(st.tuples(st.integers(0, len(FACES) - 1), st.integers(0, 20), EXTREMES), min_size=1, max_size=4))
@by_day(60, 150)
def test_any_number_is_answered_refused_or_invalid(changes: list[tuple[int, int, float]]) -> None:
    """No number of a face leads to one that is none, nor to a fault."""
    faces = json.loads(json.dumps(FACES))
    for number, place, value in changes:
        slots = [
            (holder, key)
            for name, holder_or_value in faces[number].items()
            for holder, key in (
                [(holder_or_value, k) for k in range(len(holder_or_value)) if name != "points_m"]
                if isinstance(holder_or_value, list)
                else [(faces[number], name)]
            )
            if isinstance(holder[key], float | int)
        ]
        holder, key = slots[place % len(slots)]
        holder[key] = value
    # what is no request is invalid, what is no shaft out of range; an answer holds finite numbers only
    with contextlib.suppress(ValidationError, OutOfRange):
        read_shaft(ShaftRequest.model_validate({"faces": faces, "bodies": [BODY]}))
