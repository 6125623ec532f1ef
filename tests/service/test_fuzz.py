"""Whatever is sent, the service answers as it says it does: never with a 5xx, and never with what is no JSON."""

import copy
import json
from collections.abc import Callable, Mapping
from typing import Any, get_args

from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from starlette.testclient import TestClient

from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.answer.outputs import OutputName
from schemas.answer.problem import Problem
from schemas.base.model import Model
from schemas.rating.answer import RatingAnswer
from service.documents.examples import bodies
from tests.service.test_dynamics import OVER_THE_TURN

MACHINES = bodies()
BODIES: dict[str, dict[str, Any]] = {"/v1/optimize": MACHINES, "/v1/analyze": MACHINES, "/v1/rating": bodies("rating")}
ANSWERS: Mapping[str, type[Model]] = {
    "/v1/optimize": OptimizeAnswer,
    "/v1/analyze": AnalyzeAnswer,
    "/v1/rating": RatingAnswer,
}
OUTPUTS = get_args(OutputName)
RECIPROCATING = sorted(name for name, body in MACHINES.items() if body["machine"]["kind"] == "reciprocating")
FIRST_ORDER = ["residual", "hodograph", "orders", "stages"]

#: numbers at and beyond the edges of what the fields take
NUMBERS = st.one_of(
    st.floats(),
    st.integers(-(10**400), 10**400),
    st.sampled_from([0, -0.0, 5e-324, 1e-300, 1e-160, 1e-9, 1e6, 1e9, 1e12, 1e15, 1e30, 1e154, 1.7e308, 360, 90, 0.1]),
)
TEXTS = st.one_of(
    st.text(max_size=20),
    st.sampled_from(
        ["", "\ud800", "\x00", "1e9 m", "-5 mm", "1e999 kg", "9**9**9 m", "1" * 60, "scroll", "reciprocating"]
    ),
    st.sampled_from(["ccw", "cw", "kind", "crank_pins", "oldham", "sum", "max", "order_2", *OUTPUTS]),
)
VALUES = st.recursive(
    st.one_of(st.none(), st.booleans(), NUMBERS, TEXTS),
    lambda inner: st.one_of(st.lists(inner, max_size=4), st.dictionaries(TEXTS, inner, max_size=4)),
    max_leaves=8,
)


def places(node: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Paths of everything inside a JSON value."""
    pairs = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    return [place for key, value in pairs for place in [(*path, key), *places(value, (*path, key))]]


@st.composite
def mutated(draw: st.DrawFn) -> tuple[str, dict[str, Any]]:
    """A route, and a valid request to it with up to three places changed, removed, doubled or added."""
    route = draw(st.sampled_from(sorted(BODIES)))
    body = copy.deepcopy(BODIES[route][draw(st.sampled_from(sorted(BODIES[route])))])
    if "machine" in body:
        body.setdefault("objective", {"force_ceiling_N": 5000, "direction_weights": {"x": 1, "y": 1}})
        body.setdefault("outputs", draw(st.lists(st.sampled_from(OUTPUTS), min_size=1, max_size=3)))
        body.setdefault("angles", {"step_deg": 30})
    for _ in range(draw(st.integers(1, 3))):
        path = draw(st.sampled_from(places(body)))
        node: Any = body
        for key in path[:-1]:
            node = node[key]
        last = path[-1]
        change = draw(st.sampled_from(["replace", "number", "scale", "scale", "remove", "double", "add"]))
        if change == "replace":
            node[last] = draw(VALUES)
        elif change == "number":
            node[last] = draw(NUMBERS)
        elif change == "scale":
            node[last] = scaled(node[last], lambda _: 10.0 ** draw(st.integers(-12, 6)))
        elif change == "remove":
            del node[last]
        elif isinstance(node, list):
            node.insert(last, copy.deepcopy(node[last]))
        else:
            node[draw(TEXTS)] = draw(VALUES)
    return route, body


@st.composite
def extreme(draw: st.DrawFn) -> dict[str, Any]:
    """A valid machine with very large and very small units, and one number out of proportion."""
    body = copy.deepcopy(MACHINES[draw(st.sampled_from(sorted(MACHINES)))])
    powers = {"m": st.integers(-10, 8), "kg": st.integers(-300, 11), "rpm": st.integers(-11, 5)}
    factors = {unit: 10.0 ** draw(st.one_of(st.just(0), power)) for unit, power in powers.items()}
    body["machine"] = scaled(body["machine"], lambda name: factors.get(name.rpartition("_")[2], 1.0))
    body |= {"outputs": FIRST_ORDER, "angles": {"step_deg": 60}}
    path = draw(st.sampled_from(places(body["machine"]["webs"])))
    node: Any = body["machine"]["webs"]
    for key in path[:-1]:
        node = node[key]
    node[path[-1]] = scaled(node[path[-1]], lambda _: 10.0 ** draw(st.integers(-300, 9)))
    return body


CYLINDER = MACHINES["2d12"]["machine"]["throws"][0]["rows"][0]["cylinder"]
CYLINDERS = [
    CYLINDER,
    CYLINDER | {"acting": "head", "ambient_pressure_Pa": 101325},
    CYLINDER | {"acting": "crank", "ambient_pressure_Pa": 0},
    CYLINDER | {"head": {"relative_clearance": 0.3}, "crank": {"discharge_pressure_Pa": 900000}},
    CYLINDER | {"suction_pressure_Pa": 852000},
]
FRICTION: list[Any] = [
    None,
    {"mechanical_efficiency": 0.94},
    {"mechanical_efficiency": 0.01, "reciprocating_share": 1},
    {"rotating_torque_Nm": 400},
]


@st.composite
def driven(draw: st.DrawFn) -> dict[str, Any]:
    """A machine with gas, friction and bearings in large and small units, and some numbers out of proportion."""
    body = copy.deepcopy(MACHINES[draw(st.sampled_from(RECIPROCATING))])
    machine = body["machine"]
    for throw in machine["throws"]:
        throw["crank_radius_m"] = 0.14
        for row in throw["rows"]:
            row["connecting_rod"] = {"length_m": draw(st.sampled_from([0.7, 0.1401, 1e6, None])), "mass_kg": 80}
            row["cylinder"] = copy.deepcopy(draw(st.sampled_from(CYLINDERS)))
    planes = draw(st.lists(st.integers(-9, 9), min_size=2, max_size=5, unique=True))
    machine["bearings"] = [{"name": str(plane), "position_m": plane / 10} for plane in planes]
    machine["friction"] = draw(st.sampled_from(FRICTION))
    machine["flywheel"] = draw(st.sampled_from([{"irregularity": 0.01}, {"inertia_kg_m2": 1000}]))
    powers = {"m": (-9, 8), "kg": (-100, 11), "rpm": (-11, 5), "Pa": (-7, 5)}
    factors = {unit: 10.0 ** draw(st.one_of(st.just(0), st.integers(*power))) for unit, power in powers.items()}
    body["machine"] = scaled(machine, lambda name: factors.get(name.rpartition("_")[2], 1.0))
    for _ in range(draw(st.integers(0, 2))):
        tweak(draw, body["machine"])
    sample = draw(st.lists(st.sampled_from([*FIRST_ORDER, *OVER_THE_TURN]), min_size=1, unique=True))
    shaft = draw(st.sampled_from(["simple_spans", "continuous"]))
    return body | {"outputs": sample, "angles": {"step_deg": 60}, "fidelity": {"shaft": shaft}}


@st.composite
def out_of_proportion(draw: st.DrawFn) -> dict[str, Any]:
    """A compressor to be rated, with numbers that do not go together."""
    body = copy.deepcopy(BODIES["/v1/rating"][draw(st.sampled_from(sorted(BODIES["/v1/rating"])))])
    body["suction_pressure_Pa"], body["discharge_pressure_Pa"], body["stroke_m"] = 3e5, 2.1e6, 0.28
    for _ in range(draw(st.integers(1, 3))):
        tweak(draw, body)
    return body


def tweak(draw: st.DrawFn, body: dict[str, Any]) -> None:
    """Scale one number, mostly by so little that the body stays valid, and sometimes by very much."""
    path = draw(st.sampled_from([place for place in places(body) if isinstance(at(body, place), (int, float))]))
    factor = draw(st.one_of(st.floats(0.5, 2), st.integers(-12, 12).map(lambda power: 10.0**power)))
    at(body, path[:-1])[path[-1]] = scaled(at(body, path), lambda _: factor)


def at(body: Any, path: tuple[Any, ...]) -> Any:
    """What stands at a path."""
    for key in path:
        body = body[key]
    return body


def scaled(node: Any, factor: Callable[[str], float], name: str = "") -> Any:
    """A JSON value whose numbers are multiplied by a factor that depends on the name of the field."""
    if isinstance(node, dict):
        return {key: scaled(value, factor, key) for key, value in node.items()}
    if isinstance(node, list):
        return [scaled(value, factor, name) for value in node]
    is_number = isinstance(node, (int, float)) and not isinstance(node, bool)
    # a number of more than 308 digits has no float, and is sent as it is
    return node * factor(name) if is_number and abs(node) < 1e300 else node


def question(path: str, body: Any) -> bytes:
    """The body for a route: an analysis has neither objective nor accuracy."""
    if path == "/v1/analyze" and isinstance(body, dict):
        body = {key: value for key, value in body.items() if key not in ("objective", "accuracy")}
    return json.dumps(body).encode()


def answered_properly(client: TestClient, path: str, content: bytes) -> None:
    answer = client.post(path, content=content, headers={"Content-Type": "application/json"})
    if answer.status_code == 200:
        ANSWERS[path].model_validate_json(answer.content)
    else:
        assert answer.status_code in (400, 422)
        assert answer.headers["content-type"] == "application/problem+json"
        problem = Problem.model_validate_json(answer.content)
        assert (problem.status, bool(problem.errors)) == (answer.status_code, answer.status_code == 422)


#: 40 by day, 600 at night
MANY = settings(
    max_examples=2 * settings.default.max_examples,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


@MANY
@given(pair=mutated())
def test_changed_requests(client: TestClient, pair: tuple[str, dict[str, Any]]) -> None:
    path, body = pair
    answered_properly(client, path, question(path, body))


@MANY
@given(body=extreme(), path=st.sampled_from(["/v1/analyze", "/v1/optimize"]))
def test_extreme_machines(client: TestClient, body: dict[str, Any], path: str) -> None:
    answered_properly(client, path, question(path, body))


@MANY
@given(body=driven(), path=st.sampled_from(["/v1/analyze", "/v1/analyze", "/v1/optimize"]))
def test_extreme_compressors(client: TestClient, body: dict[str, Any], path: str) -> None:
    answered_properly(client, path, question(path, body))


@MANY
@given(body=out_of_proportion())
def test_extreme_ratings(client: TestClient, body: dict[str, Any]) -> None:
    answered_properly(client, "/v1/rating", json.dumps(body).encode())


@MANY
@given(body=VALUES, path=st.sampled_from(sorted(ANSWERS)))
def test_any_json(client: TestClient, body: Any, path: str) -> None:
    answered_properly(client, path, json.dumps(body).encode())
    answered_properly(client, path, json.dumps({"machine": body}).encode())


@MANY
@example(content=b"\xef\xbb\xbf")
@example(content=b'"\\ud800"')
@given(
    content=st.one_of(st.binary(max_size=200), st.text('{}[]",:0123456789.eE+-NaInfty ', max_size=40).map(str.encode))
)
def test_any_bytes(client: TestClient, content: bytes) -> None:
    answered_properly(client, "/v1/optimize", content)
