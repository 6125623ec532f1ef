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
    optimum = OptimizeAnswer.model_validate_json(answer.content)
    assert optimum.status == "optimal"
    assert [counterweight.web for counterweight in optimum.counterweights] == ["1a", "1b", "2a", "2b"]
    after = optimum.residual.after
    assert after is not None
    # analytic: the counter-rotating phasor of 26.07 kg at 0.14 m and 500 rpm, which counterweights cannot touch
    assert optimum.floor.force_N == pytest.approx(26.07 * 0.14 * (500 * 3.141592653589793 / 30) ** 2 / 2, rel=1e-12)
    assert after.force.peak_N >= optimum.floor.force_N * (1 - 1e-12)
    assert optimum.certificate is not None
    assert optimum.certificate.relative_gap <= 1e-6


def test_optimize_says_infeasible_with_200(post: Post, body: dict[str, Any]) -> None:
    body["objective"] = {"force_ceiling_N": 1}
    answer = post("/v1/optimize", json.dumps(body))
    assert answer.status_code == 200
    optimum = OptimizeAnswer.model_validate_json(answer.content)
    assert (optimum.status, optimum.counterweights) == ("infeasible", ())
    assert optimum.infeasibility is not None
    assert optimum.infeasibility.conflict == ("force_ceiling_N",)


def test_analyze_takes_what_optimize_answers(post: Post, body: dict[str, Any]) -> None:
    best = OptimizeAnswer.model_validate_json(post("/v1/optimize", json.dumps(body)).content)
    fitted = [
        {"web": counterweight.web, "mass_kg": counterweight.mass_kg, "angle_deg": counterweight.angle_deg}
        for counterweight in best.counterweights
    ]
    outputs = ["residual", "hodograph", "orders", "stages"]
    answer = post("/v1/analyze", json.dumps({**body, "counterweights": fitted, "outputs": outputs}))
    assert answer.status_code == 200
    assert answer.headers["cache-control"] == "no-store"
    analysis = AnalyzeAnswer.model_validate_json(answer.content)
    assert analysis.residual == best.residual
    assert analysis.hodograph is not None
    assert len(analysis.hodograph.angle_deg) == 360
    assert analysis.orders is not None
    assert [order.order for order in analysis.orders.before] == [1, 2, 4, 6]
    assert analysis.stages is not None
    assert len(analysis.stages) == 8


def test_only_the_outputs_asked_for(post: Post, body: dict[str, Any]) -> None:
    answer = post("/v1/analyze", json.dumps({**body, "outputs": ["hodograph"]})).json()
    assert answer["hodograph"]
    assert (answer["residual"], answer["orders"], answer["stages"]) == (None, None, None)


@pytest.mark.parametrize("name", names())
def test_every_example_can_be_posted(client: TestClient, post: Post, name: str) -> None:
    response = client.get(f"/v1/examples/{name}")
    assert response.headers["content-type"] == "application/json"
    assert response.content == load(name)
    OptimizeRequest.model_validate_json(response.content)
    answer = post("/v1/optimize", response.content)
    assert (answer.status_code, answer.json()["status"]) == (200, "optimal")


def test_examples(client: TestClient) -> None:
    listed = client.get("/v1/examples").json()["examples"]
    assert [example["name"] for example in listed] == sorted(names())
    for entry in listed:
        assert set(entry) == {"name", "title", "description", "gas", "links"}
        assert isinstance(entry["gas"], bool)
        assert entry["title"]
        assert entry["description"]
        assert entry["links"] == {"self": f"/v1/examples/{entry['name']}", "optimize": "/v1/optimize"}
        assert client.get(entry["links"]["self"]).status_code == 200


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
