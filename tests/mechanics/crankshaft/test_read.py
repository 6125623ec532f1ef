"""Faces of a drawing to the crankshaft that was drawn, wherever it is in its model and in whatever order."""

from math import cos, pi, radians, sin
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from optimizer.mechanics.crankshaft.read import read_shaft
from schemas.answer.shaft import ShaftAnswer
from schemas.request.shaft import ShaftRequest
from tests.mechanics.crankshaft.shafts import HALF, JOURNAL, RADIUS, Drawing, Json, cylinder, moved, plane
from tests.night import by_day

FRAME: Json = {"origin_m": [0, 0, 0], "z": [0, 0, 1], "x": [1, 0, 0]}
DRAWINGS = st.builds(
    Drawing, second_deg=st.floats(20.0, 340.0), fillet=st.one_of(st.just(0.0), st.floats(0.001, 0.006))
)


def read(faces: list[Json], **more: Any) -> ShaftAnswer:
    return read_shaft(ShaftRequest.model_validate({"faces": faces, **more}))


def codes(answer: ShaftAnswer) -> list[str]:
    return [doubt.code for doubt in answer.doubts]


@given(DRAWINGS)
@by_day(15, 30)
def test_what_was_drawn_is_found(drawing: Drawing) -> None:
    """Analytic: the figures of the drawing, whatever its fillets."""
    answer = read(drawing.faces())
    assert answer.doubts == ()
    assert [throw.crank_radius_m for throw in answer.throws] == pytest.approx([RADIUS] * 2, rel=1e-12)
    assert [throw.position_m for throw in answer.throws] == pytest.approx([-0.175, 0.175], rel=1e-12)
    first, second = (throw.crank_angle_deg for throw in answer.throws)
    assert first == pytest.approx(0.0, abs=1e-12)
    assert second % 360.0 == pytest.approx(drawing.second_deg, abs=1e-9)
    # not 70 mm and two fillets
    envelopes = [web.envelope for web in answer.webs]
    assert [envelope.thickness_m for envelope in envelopes] == pytest.approx([0.07] * 4, rel=1e-12)
    assert [envelope.inner_radius_m for envelope in envelopes] == pytest.approx([HALF] * 4, rel=1e-12)
    assert [envelope.outer_radius_m for envelope in envelopes] == pytest.approx([RADIUS + HALF] * 4, rel=1e-12)
    assert [(web.name, web.throw) for web in answer.webs] == [("1a", 0), ("1b", 0), ("2a", 1), ("2b", 1)]
    assert [bearing.diameter_m for bearing in answer.bearings] == pytest.approx([2 * JOURNAL] * 3, rel=1e-12)


def test_three_mm_of_fillet_leave_a_web_of_22_mm_22_mm() -> None:
    """Analytic: a web of 22 mm between cylinders that end 3 mm before it."""
    faces = [
        cylinder(0, 0, 0.03, -0.1, -0.003),
        plane(0, 0, -0.1, -1, pi * 0.03**2),
        cylinder(0.01, 0, 0.06, 0.0, 0.022),
        plane(0.01, 0, 0.0, -1, pi * (0.06**2 - 0.033**2)),
        plane(0.01, 0, 0.022, 1, pi * (0.06**2 - 0.028**2)),
        cylinder(0.035, 0, 0.025, 0.025, 0.065),
        cylinder(0.01, 0, 0.06, 0.068, 0.09),
        plane(0.01, 0, 0.068, -1, pi * (0.06**2 - 0.028**2)),
        plane(0.01, 0, 0.09, 1, pi * (0.06**2 - 0.033**2)),
        cylinder(0, 0, 0.03, 0.093, 0.2),
        plane(0, 0, 0.2, 1, pi * 0.03**2),
    ]
    answer = read(faces)
    assert [web.envelope.thickness_m for web in answer.webs] == pytest.approx([0.022] * 2, rel=1e-12)
    # a round web 10 mm off the axis: reaches sqrt(60^2 - 10^2) at right angles to its crank, 70 beside it
    assert [web.envelope.inner_radius_m for web in answer.webs] == pytest.approx([(0.06**2 - 0.01**2) ** 0.5] * 2)
    assert [web.envelope.outer_radius_m for web in answer.webs] == pytest.approx([0.07] * 2)
    assert codes(answer) == ["round_web", "round_web"]
    assert [throw.crank_radius_m for throw in answer.throws] == pytest.approx([0.035])


def turned(quaternion: list[float]) -> np.ndarray:  # type: ignore[type-arg]
    w, x, y, z = np.array(quaternion) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


TURNS = st.lists(st.floats(-1.0, 1.0), min_size=4, max_size=4).filter(lambda q: np.linalg.norm(q) > 0.1).map(turned)
ORIGINS = st.lists(st.floats(-2.0, 2.0), min_size=3, max_size=3).map(np.array)
SCALES = st.sampled_from([0.25, 1.0, 4.0])


def shaft_numbers(answer: ShaftAnswer, mirrored: bool = False) -> list[list[float]]:
    """Throws, webs and bearings as numbers."""
    sign = -1.0 if mirrored else 1.0
    circle = [radians(sign * throw.crank_angle_deg) for throw in answer.throws]
    return [
        [throw.position_m for throw in answer.throws],
        [throw.crank_radius_m for throw in answer.throws],
        [cos(angle) for angle in circle],
        [sin(angle) for angle in circle],
        [web.position_m for web in answer.webs],
        [radius for web in answer.webs for radius in (web.envelope.inner_radius_m, web.envelope.outer_radius_m)],
        [web.envelope.thickness_m for web in answer.webs],
        [
            length
            for bearing in answer.bearings
            for length in (bearing.position_m, bearing.length_m, bearing.diameter_m)
        ],
    ]


@given(DRAWINGS, TURNS, ORIGINS, SCALES)
@by_day(15, 30)
def test_it_does_not_matter_where_the_shaft_is_and_how_large(
    drawing: Drawing, turn: Any, origin: Any, scale: float
) -> None:
    faces = [moved(face, turn, origin, scale) for face in drawing.faces()]
    frame = {"origin_m": origin.tolist(), "z": turn[:, 2].tolist(), "x": turn[:, 0].tolist()}
    content, drawn = read(faces, frame=frame), read(drawing.faces(), frame=FRAME)
    lengths = [scale, scale, 1.0, 1.0, scale, scale, scale, scale]
    for figure, second_figure, factor in zip(shaft_numbers(content), shaft_numbers(drawn), lengths, strict=True):
        assert figure == pytest.approx([factor * coordinate for coordinate in second_figure], abs=1e-11 * scale)
    assert codes(content) == codes(drawn)
    # without a frame it is found: the axis is the turned one, the throws are at the same distances
    alone = read(faces)
    assert abs(np.dot(alone.axis.direction, turn[:, 2])) == pytest.approx(1.0, abs=1e-12)
    assert np.linalg.norm(np.cross(np.array(alone.axis.point_m) - origin, turn[:, 2])) < 1e-11
    places = [throw.position_m for throw in alone.throws]
    assert places[1] - places[0] == pytest.approx(0.35 * scale, rel=1e-11)
    angles = [throw.crank_angle_deg for throw in alone.throws]
    assert cos(radians(angles[1] - angles[0])) == pytest.approx(cos(radians(drawing.second_deg)), abs=1e-11)


@given(DRAWINGS)
@settings(max_examples=15)
def test_the_mirror_image_has_its_cranks_the_other_way(drawing: Drawing) -> None:
    mirror = np.diag([1.0, -1.0, 1.0])
    faces = [moved(face, mirror, np.zeros(3)) for face in drawing.faces()]
    content, drawn = read(faces, frame=FRAME), read(drawing.faces(), frame=FRAME)
    for figure, second_figure in zip(shaft_numbers(content, mirrored=True), shaft_numbers(drawn), strict=True):
        assert figure == pytest.approx(second_figure, abs=1e-12)


@given(DRAWINGS, st.randoms(use_true_random=False))
@settings(max_examples=15)
def test_the_order_of_faces_does_not_matter(drawing: Drawing, chance: Any) -> None:
    faces = drawing.faces()
    order = list(range(len(faces)))
    chance.shuffle(order)
    content, drawn = read([faces[n] for n in order]), read(faces)
    assert shaft_numbers(content) == shaft_numbers(drawn)
    assert [[order[n] for n in pin.faces] for pin in content.pins] == [list(pin.faces) for pin in drawn.pins]
    assert [sorted(order[n] for n in plate.faces) for plate in content.plates] == [
        list(plate.faces) for plate in drawn.plates
    ]


def test_faces_that_are_cut_lengthways_are_one() -> None:
    faces = []
    for face in Drawing().faces():
        whole = face["type"] == "cylinder" and "angle_deg" not in face
        faces += [{**face, "angle_deg": 180.0}, {**face, "angle_deg": 180.0}] if whole else [face]
    assert shaft_numbers(read(faces)) == shaft_numbers(read(Drawing().faces()))


def test_a_pin_with_a_groove_is_one_pin() -> None:
    faces = [face for face in Drawing().faces() if face.get("ends_m") != [-0.245, -0.105]]
    for low, high, radius in ((-0.245, -0.18, 0.075), (-0.18, -0.17, 0.07), (-0.17, -0.105, 0.075)):
        faces.append(cylinder(RADIUS, 0.0, radius, low, high))
    answer = read(faces)
    assert [throw.position_m for throw in answer.throws] == pytest.approx([-0.175, 0.175])
    assert answer.pins[0].diameter_m == pytest.approx(0.14)
    assert len(answer.webs) == 4


def test_split_pins_are_two_throws() -> None:
    """Two pins of one size beside each other at 30 degrees, without a web between them."""
    faces = [face for face in Drawing().faces() if face.get("ends_m") != [-0.245, -0.105]]
    turn = radians(30.0)
    faces += [
        cylinder(RADIUS, 0.0, 0.075, -0.245, -0.175),
        cylinder(RADIUS * cos(turn), RADIUS * sin(turn), 0.075, -0.175, -0.105),
    ]
    answer = read(faces)
    assert [throw.crank_angle_deg for throw in answer.throws] == pytest.approx([0.0, 30.0, 180.0], abs=1e-9)
    assert [throw.position_m for throw in answer.throws] == pytest.approx([-0.21, -0.14, 0.175])
    assert codes(answer) == []


def test_a_shaft_pressed_together_has_its_webs_where_parts_stick_in_them() -> None:
    """Journal and pin go 50 mm into webs of 70 mm; their hidden faces are listed too."""
    pieces = []
    for face in Drawing().faces():
        if face["type"] == "cylinder" and "angle_deg" not in face:
            low, high = face["ends_m"]
            low, high = (low if low < -0.4 else low - 0.05), (high if high > 0.4 else high + 0.05)
            x, y, _ = face["centre_m"]
            area = pi * face["radius_m"] ** 2
            pieces += [{**face, "ends_m": [low, high]}, plane(x, y, low, -1, area), plane(x, y, high, 1, area)]
        else:
            pieces.append(face)
    answer = read(pieces)
    assert [web.position_m for web in answer.webs] == pytest.approx([-0.28, -0.07, 0.07, 0.28])
    assert [web.envelope.thickness_m for web in answer.webs] == pytest.approx([0.07] * 4)
    # the pin is what is free between the webs
    assert [(pin.from_m, pin.to_m) for pin in answer.pins] == [
        pytest.approx((-0.245, -0.105)),
        pytest.approx((0.105, 0.245)),
    ]
    assert not [doubt for doubt in answer.doubts if doubt.serious]


def test_webs_that_lean_have_no_one_thickness() -> None:
    faces = []
    for face in Drawing().faces():
        if face["type"] == "plane" and face["normal"][2] and abs(face["centre_m"][2]) < 0.4:
            lean = radians(3.0)
            faces.append({**face, "normal": [sin(lean), 0.0, face["normal"][2] * cos(lean)]})
        else:
            faces.append(face)
    answer = read(faces)
    assert len(answer.throws) == 2
    assert (answer.webs, codes(answer)) == ((), ["tapered_web"] * 4)
    assert "leans by 3 degrees" in answer.doubts[0].message


def test_loose_cylinders_are_no_shaft() -> None:
    answer = read(Drawing(webs=False).faces())
    assert answer.webs == ()
    assert [(doubt.code, doubt.serious, doubt.pointer) for doubt in answer.doubts] == [
        ("air", True, f"/faces/{n}") for n in (0, 3, 6, 9)
    ]


def test_webs_whose_sides_are_not_listed_get_no_envelope() -> None:
    faces = [face for face in Drawing().faces() if face["type"] != "plane" or face["normal"][2]]
    bare = [{key: value for key, value in face.items() if key != "points_m"} for face in faces]
    answer = read(bare)
    assert (answer.webs, codes(answer)) == ((), ["outline"] * 4)
    assert [plate.thickness_m for plate in answer.plates] == pytest.approx([0.07] * 4)


def test_a_flat_sided_web_has_an_envelope() -> None:
    """Analytic: a bar of 60 x 240 mm about the axis, whose corners are farthest."""
    faces = [face for face in Drawing(second_deg=180.0).faces() if "points_m" not in face]
    for low, high, sign in ((-0.315, -0.245, 1), (-0.105, -0.035, 1), (0.035, 0.105, -1), (0.245, 0.315, -1)):
        corners = [(-0.1, -0.12), (0.24, -0.12), (0.24, 0.12), (-0.1, 0.12)]
        for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1], strict=True):
            normal = [sign * (v - y), -(u - x), 0.0]
            points = [[sign * x, y, low], [sign * u, v, high]]
            centre = [sign * (x + u) / 2, (y + v) / 2, (low + high) / 2]
            faces.append({"type": "plane", "centre_m": centre, "normal": normal, "points_m": points})
    answer = read(faces)
    assert [web.envelope.inner_radius_m for web in answer.webs] == pytest.approx([np.hypot(0.1, 0.12)] * 4)
    assert [web.envelope.outer_radius_m for web in answer.webs] == pytest.approx([np.hypot(0.24, 0.12)] * 4)


BODIES = st.lists(
    st.fixed_dictionaries(
        {
            "mass": st.floats(0.5, 100.0),
            "points": st.lists(st.lists(st.floats(-0.5, 0.5), min_size=3, max_size=3), min_size=2, max_size=5),
        }
    ),
    min_size=1,
    max_size=3,
)


@given(BODIES, TURNS, ORIGINS)
@settings(max_examples=40)
def test_the_unbalance_of_bodies_is_that_of_their_points(bodies: list[Json], turn: Any, origin: Any) -> None:
    """Independent: bodies of equal point masses, whose force and couple are sums over the points."""
    listed, first, second, total = [], 0j, 0j, 0.0
    for body in bodies:
        points = np.array(body["points"])
        mass = body["mass"] / len(points)
        first += mass * np.sum(points[:, 0] + 1j * points[:, 1])
        second += mass * np.sum((points[:, 0] + 1j * points[:, 1]) * points[:, 2])
        total += body["mass"]
        positions = points @ turn.T + origin
        centre = np.mean(positions, axis=0)
        arms = positions - centre
        tensor = mass * sum(np.dot(arm, arm) * np.eye(3) - np.outer(arm, arm) for arm in arms)
        listed.append({"mass_kg": body["mass"], "centre_m": centre.tolist(), "inertia_kg_m2": tensor.tolist()})
    frame = {"origin_m": origin.tolist(), "z": turn[:, 2].tolist(), "x": turn[:, 0].tolist()}
    answer = read([], bodies=listed, frame=frame, planes_m=[-0.4, 0.6])
    values = [complex(unbalance.x_kg_m, unbalance.y_kg_m) for unbalance in answer.unbalances]
    places = [unbalance.position_m for unbalance in answer.unbalances]
    assert places == [-0.4, 0.6]
    assert sum(values) == pytest.approx(first, abs=1e-10 * total)
    assert sum(z * unbalance for z, unbalance in zip(places, values, strict=True)) == pytest.approx(
        second, abs=1e-10 * total
    )
    assert answer.rotor is not None
    assert answer.rotor.mass_kg == pytest.approx(total)
    assert answer.rotor.unbalance_kg_m == pytest.approx(abs(first), abs=1e-10 * total)


def test_a_density_of_no_metal_is_doubted() -> None:
    body = {"mass_kg": 0.35, "centre_m": [0, 0, 0], "volume_m3": 0.0449}
    answer = read(Drawing().faces(), bodies=[body])
    assert [(doubt.code, doubt.pointer, doubt.serious) for doubt in answer.doubts] == [("density", "/bodies/0", True)]
    assert "7.795 kg/m3: shafts have 1000 to 20000" in answer.doubts[0].message
