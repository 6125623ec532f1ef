"""Every error is answered with problem details, and nothing of the request comes back in them."""

import json
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from starlette.exceptions import HTTPException
from starlette.testclient import TestClient

from schemas.answer.problem import Problem
from service.app import FAULTS, create_app
from service.settings import Settings
from tests.service.conftest import MAX_BODY_BYTES

Post = Callable[..., Any]


def problem(answer: Any, status: int) -> Problem:
    assert answer.status_code == status
    assert answer.headers["content-type"] == "application/problem+json"
    program = Problem.model_validate_json(answer.content)
    assert program.status == status
    return program


@pytest.mark.parametrize("path", ["/nothing", "/v1", "/v1/optimize/", "/docs/assets/nothing.js", "/docs/assets/../x"])
def test_404(client: TestClient, path: str) -> None:
    program = problem(client.get(path), 404)
    assert (program.type, program.title) == ("/problems/not-found", "Not Found")
    assert problem(client.post("/v1/optimise", json={}), 404).instance == "/v1/optimise"


@pytest.mark.parametrize(
    ("method", "path", "allowed"),
    [
        ("GET", "/v1/optimize", "POST"),
        ("PUT", "/v1/optimize", "POST"),
        ("OPTIONS", "/v1/analyze", "POST"),
        ("POST", "/v1/examples", "GET"),
        ("DELETE", "/healthz", "GET"),
        ("PATCH", "/v1/sweeps", "GET, POST"),
        ("PUT", "/v1/sweeps/5f0c", "DELETE, GET"),
        ("BREW", "/docs", "GET"),
    ],
)
def test_405(client: TestClient, method: str, path: str, allowed: str) -> None:
    answer = client.request(method, path)
    assert problem(answer, 405).title == "Method Not Allowed"
    assert answer.headers["allow"] == allowed


def test_head(client: TestClient) -> None:
    assert client.head("/healthz").status_code == 200
    assert client.head("/v1/examples/2d12").status_code == 200
    assert client.head("/v1/optimize").status_code == 405
    assert client.head("/nothing").status_code == 404


@pytest.mark.parametrize("path", ["/v1/optimize", "/v1/analyze"])
@pytest.mark.parametrize(
    "content",
    [b"", b"  ", b"{", b"\xff{}", b"[" * 100_000, b"{}{}", b"\x1f\x8b\x08", "{}".encode("utf-16")],
)
def test_400(post: Post, path: str, content: bytes) -> None:
    program = problem(post(path, content), 400)
    assert (program.type, program.instance, program.errors) == ("/problems/unreadable-json", path, ())


@pytest.mark.parametrize(
    "kind",
    [
        "text/plain",
        "application/x-www-form-urlencoded",
        "multipart/form-data",
        "text/json",
        "application/jsonp",
        "application/",
        "json",
        "",
        "application/json; charset=latin-1",
        "application/json; charset=utf-16",
        'application/json; charset="',
    ],
)
def test_415(client: TestClient, kind: str) -> None:
    problem(client.post("/v1/optimize", content=b"{}", headers={"Content-Type": kind}), 415)


def test_415_without_a_type_or_with_an_encoding(client: TestClient, post: Post) -> None:
    problem(client.post("/v1/optimize", content=b"{}"), 415)
    assert "uncompressed" in problem(post("/v1/optimize", b"{}", content_encoding="gzip"), 415).detail
    assert post("/v1/optimize", b"{}", content_encoding="identity").status_code == 422


@pytest.mark.parametrize(
    "kind",
    [
        "application/json",
        "APPLICATION/JSON",
        "application/json; charset=utf-8",
        'application/json;charset="UTF-8"',
        "application/merge-patch+json",
        "application/vnd.machine+json; version=1",
    ],
)
def test_accepted_types(client: TestClient, body: dict[str, Any], kind: str) -> None:
    text = json.dumps(body).encode()
    assert client.post("/v1/analyze", content=text, headers={"Content-Type": kind}).status_code == 200


def test_413(post: Post, body: dict[str, Any]) -> None:
    room = MAX_BODY_BYTES - len(json.dumps(body))
    padded = json.dumps(body).encode() + b" " * room
    assert post("/v1/analyze", padded).status_code == 200
    assert str(MAX_BODY_BYTES) in problem(post("/v1/analyze", padded + b" "), 413).detail
    # a body may be announced as small or as huge, whatever it is
    problem(post("/v1/analyze", b"{}", content_length=str(MAX_BODY_BYTES + 1)), 413)
    problem(post("/v1/analyze", b"{}", content_length="9" * 5000), 413)
    problem(post("/v1/analyze", padded + b" ", content_length="10"), 413)


def test_413_of_a_body_in_chunks(post: Post, body: dict[str, Any]) -> None:
    def chunks(count: int) -> Iterator[bytes]:
        yield json.dumps(body).encode()
        yield from (b" " * 10_000 for _ in range(count))

    assert post("/v1/analyze", chunks(90)).status_code == 200
    problem(post("/v1/analyze", chunks(100)), 413)
    problem(post("/v1/analyze", chunks(2000)), 413)


def test_422(post: Post, body: dict[str, Any]) -> None:
    body["machine"]["throws"][0]["crank_radius_m"] = -1
    body["machine"]["webs"][1]["name"] = ""
    program = problem(post("/v1/optimize", json.dumps(body)), 422)
    assert (program.type, program.title, program.detail) == (
        "/problems/invalid-request",
        "Invalid request",
        "2 fields are wrong.",
    )
    assert [(error.pointer, error.message) for error in program.errors] == [
        ("/machine/webs/1/name", "must have at least 1 character"),
        ("/machine/throws/0/crank_radius_m", "must be at least 1e-12"),
    ]


@pytest.mark.parametrize("path", ["/v1/optimize", "/v1/analyze"])
@pytest.mark.parametrize("root", ["null", "[]", '"x"', "1", "NaN", "true"])
def test_422_of_a_body_that_is_no_object(post: Post, path: str, root: str) -> None:
    program = problem(post(path, root), 422)
    assert [(error.pointer, error.message) for error in program.errors] == [("", "must be an object")]
    assert program.detail == "1 field is wrong."


@pytest.mark.parametrize("text", ["NaN", "-Infinity", "1e999", "9" * 5000])
def test_422_of_numbers_that_are_none(post: Post, body: dict[str, Any], text: str) -> None:
    body["machine"]["webs"][2]["max_mass_kg"] = "?"
    program = problem(post("/v1/optimize", json.dumps(body).replace('"?"', text)), 422)
    assert [error.pointer for error in program.errors] == ["/machine/webs/2/max_mass_kg"]


@pytest.mark.parametrize("key", ["", "a b", "é".encode("latin-1"), "x" * 256])
def test_422_of_a_key_that_is_none(post: Post, body: dict[str, Any], key: Any) -> None:
    """Whether a job is asked for or not."""
    program = problem(post("/v1/optimize", json.dumps(body), Idempotency_Key=key), 422)
    assert (program.type, program.errors) == ("/problems/invalid-header", ())


@pytest.mark.parametrize("value", ["true", 1, 0, None, []])
def test_422_of_a_flag_that_is_none(post: Post, body: dict[str, Any], value: Any) -> None:
    program = problem(post("/v1/pictures/front", json.dumps({**body, "picture": {"transparent": value}})), 422)
    assert [(error.pointer, error.message) for error in program.errors] == [
        ("/picture/transparent", "must be true or false")
    ]


@pytest.mark.parametrize("output", ["orders", "stages"])
@pytest.mark.parametrize("path", ["/v1/optimize", "/v1/analyze"])
def test_422_of_an_input_that_an_output_needs(post: Post, body: dict[str, Any], path: str, output: str) -> None:
    del body["machine"]["throws"][1]["rows"][0]["connecting_rod"]
    assert post(path, json.dumps(body)).status_code == 200
    program = problem(post(path, json.dumps({**body, "outputs": [output]})), 422)
    assert (program.type, program.title) == ("/problems/missing-input", "Missing input")
    assert [error.pointer for error in program.errors] == ["/machine/throws/1/rows/0/connecting_rod"]
    assert output in program.errors[0].message


SECRET = "secret-7f3a"


@pytest.mark.parametrize(
    "wrong",
    [
        {"kind": SECRET},
        {"kind": "reciprocating", "speed_rpm": SECRET},
        {"kind": "reciprocating", "throws": [SECRET] * 9},
        {"kind": "reciprocating", "name": SECRET * 100},
        {"kind": "reciprocating", "rotation": SECRET},
        {"kind": "reciprocating", "webs": {SECRET: 1}},
        {"kind": "reciprocating", SECRET * 100: 1},
    ],
)
def test_values_are_never_echoed(post: Post, wrong: dict[str, Any]) -> None:
    answer = post("/v1/optimize", json.dumps({"machine": wrong}))
    assert problem(answer, 422).errors
    assert SECRET not in answer.text


def test_unreadable_json_is_not_echoed(post: Post) -> None:
    answer = post("/v1/optimize", f'{{"{SECRET}": {SECRET}')
    problem(answer, 400)
    assert SECRET not in answer.text


def test_at_most_fifty_errors(post: Post, body: dict[str, Any]) -> None:
    for count, detail in ((50, "50 fields are wrong."), (51, "More than 50 fields are wrong; the first are listed.")):
        answer = post("/v1/optimize", json.dumps({**body, **{f"x{k}": 0 for k in range(count)}}))
        error = problem(answer, 422)
        assert (len(error.errors), error.detail) == (50, detail)
    assert len(answer.content) < 5000


def test_a_megabyte_of_bad_items_has_a_small_answer(post: Post, body: dict[str, Any]) -> None:
    body["machine"]["webs"] = [{}] * 240_000
    answer = post("/v1/optimize", json.dumps(body))
    problem(answer, 422)
    assert len(answer.content) < 1000


@pytest.mark.parametrize(
    "path", ["/%ff%00%0a", "/" + "x" * 5000, "/%ed%a0%80", "/é ü", "/v1/examples/%0d%0aSet-Cookie:x"]
)
def test_odd_paths(client: TestClient, path: str) -> None:
    program = problem(client.get(path), 404)
    assert program.instance.isascii()
    assert program.instance.isprintable()
    assert len(program.instance) < 1000


def test_500_says_nothing_of_the_inside() -> None:
    app = create_app(Settings(), warm=False)

    @app.get("/broken")
    async def broken() -> None:
        raise RuntimeError(SECRET)

    @app.get("/teapot")
    async def teapot() -> None:
        raise HTTPException(418, SECRET)

    with TestClient(app, raise_server_exceptions=False) as client:
        answer = client.get("/broken")
        assert problem(answer, 500).title == "Internal error"
        assert SECRET not in answer.text
        assert problem(client.get("/teapot"), 418).title == "I'm a Teapot"


def test_parameters_of_later_routes() -> None:
    app = create_app(Settings(), warm=False)

    @app.get("/later")
    async def later(points: int) -> int:
        return points

    with TestClient(app) as client:
        error = problem(client.get("/later?points=many"), 422)
        assert (error.title, error.detail) == ("Invalid parameter", "Wrong parameters of path or query: points.")


def test_the_table_ends_with_the_last_resort() -> None:
    assert list(FAULTS)[-1] is Exception
