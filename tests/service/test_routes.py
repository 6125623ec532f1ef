"""What the routes answer when all is well, by the real optimiser."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from starlette.testclient import TestClient

from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.common.examples import directory
from service.documents.examples import UnknownExample, load, names

Post = Callable[..., Any]


def test_optimize(post: Post, body: dict[str, Any]) -> None:
    answer = post("/v1/optimize", json.dumps(body))
    assert answer.status_code == 200
    assert answer.headers["content-type"] == "application/json"
    assert answer.headers["cache-control"] == "no-store"
    found = OptimizeAnswer.model_validate_json(answer.content)
    assert found.status == "optimal"
    assert [one.web for one in found.counterweights] == ["1a", "1b", "2a", "2b"]
    after = found.residual.after
    assert after is not None
    # analytic: the counter-rotating phasor of 26.07 kg at 0.14 m and 500 rpm, which counterweights cannot touch
    assert found.floor.force_N == pytest.approx(26.07 * 0.14 * (500 * 3.141592653589793 / 30) ** 2 / 2, rel=1e-12)
    assert after.force.peak_N >= found.floor.force_N * (1 - 1e-12)
    assert found.certificate is not None
    assert found.certificate.relative_gap <= 1e-6


def test_optimize_says_infeasible_with_200(post: Post, body: dict[str, Any]) -> None:
    body["objective"] = {"force_ceiling_N": 1}
    answer = post("/v1/optimize", json.dumps(body))
    assert answer.status_code == 200
    found = OptimizeAnswer.model_validate_json(answer.content)
    assert (found.status, found.counterweights) == ("infeasible", ())
    assert found.infeasibility is not None
    assert found.infeasibility.conflict == ("force_ceiling_N",)


def test_analyze_takes_what_optimize_answers(post: Post, body: dict[str, Any]) -> None:
    best = OptimizeAnswer.model_validate_json(post("/v1/optimize", json.dumps(body)).content)
    fitted = [{"web": one.web, "mass_kg": one.mass_kg, "angle_deg": one.angle_deg} for one in best.counterweights]
    outputs = ["residual", "hodograph", "orders", "stages"]
    answer = post("/v1/analyze", json.dumps({**body, "counterweights": fitted, "outputs": outputs}))
    assert answer.status_code == 200
    assert answer.headers["cache-control"] == "no-store"
    found = AnalyzeAnswer.model_validate_json(answer.content)
    assert found.residual == best.residual
    assert found.hodograph is not None
    assert len(found.hodograph.angle_deg) == 360
    assert found.orders is not None
    assert [one.order for one in found.orders.before] == [1, 2, 4, 6]
    assert found.stages is not None
    assert len(found.stages) == 8


def test_only_the_outputs_asked_for(post: Post, body: dict[str, Any]) -> None:
    found = post("/v1/analyze", json.dumps({**body, "outputs": ["hodograph"]})).json()
    assert found["hodograph"]
    assert (found["residual"], found["orders"], found["stages"]) == (None, None, None)


@pytest.mark.parametrize("name", names())
def test_every_example_can_be_posted(client: TestClient, post: Post, name: str) -> None:
    sent = client.get(f"/v1/examples/{name}")
    assert sent.headers["content-type"] == "application/json"
    assert sent.content == load(name)
    OptimizeRequest.model_validate_json(sent.content)
    answer = post("/v1/optimize", sent.content)
    assert (answer.status_code, answer.json()["status"]) == (200, "optimal")


def test_examples(client: TestClient) -> None:
    listed = client.get("/v1/examples").json()["examples"]
    assert [one["name"] for one in listed] == sorted(names())
    for one in listed:
        assert set(one) == {"name", "title", "description", "gas", "links"}
        assert isinstance(one["gas"], bool)
        assert one["title"]
        assert one["description"]
        assert one["links"] == {"self": f"/v1/examples/{one['name']}", "optimize": "/v1/optimize"}
        assert client.get(one["links"]["self"]).status_code == 200


@pytest.mark.parametrize(
    "name",
    ["nothing", "", "..", "../pyproject", "..%2fpyproject", "2d12.json", "%2e%2e%2f%2e%2e%2fetc%2fpasswd", "*"],
)
def test_no_other_file_is_an_example(client: TestClient, name: str) -> None:
    answer = client.get(f"/v1/examples/{name}")
    assert answer.status_code == 404
    assert answer.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize("name", ["../pyproject", "/etc/passwd", "2d12.json", "", "2D12", "*", "\0"])
def test_names_are_looked_up_in_the_listing(name: str) -> None:
    with pytest.raises(UnknownExample):
        load(name)


def test_examples_are_where_the_checkout_or_the_package_keeps_them() -> None:
    assert directory().is_dir()
    assert "2d12" in names()


def test_home_is_a_page(client: TestClient) -> None:
    answer = client.get("/")
    assert answer.status_code == 200
    assert answer.headers["content-type"].startswith("text/html")


def test_requests_in_parallel_get_the_answers_they_would_get_alone(post: Post) -> None:
    from concurrent.futures import ThreadPoolExecutor

    chosen = ["v60", "v90-equal", "w60", "opposed-pair", "2d12", "scroll-oldham"] * 4
    with ThreadPoolExecutor(12) as pool:
        together = list(pool.map(lambda name: post("/v1/optimize", load(name)).json(), chosen))
    for name, answer in zip(chosen, together, strict=True):
        alone = post("/v1/optimize", load(name)).json()
        assert answer["certificate"]["objective"] == pytest.approx(alone["certificate"]["objective"], rel=2e-6)
