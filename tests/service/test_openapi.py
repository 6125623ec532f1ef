"""The published document: pinned names, described fields, units, examples that are valid."""

import json
import re
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from starlette.testclient import TestClient

from service.app import create_app
from service.settings import Settings

OPERATIONS = {
    ("post", "/v1/optimize"): "optimize",
    ("post", "/v1/analyze"): "analyze",
    ("post", "/v1/accuracy"): "accuracy",
    ("post", "/v1/pareto"): "pareto",
    ("post", "/v1/rating"): "rating",
    ("post", "/v1/match"): "match",
    ("post", "/v1/round"): "round",
    ("post", "/v1/report"): "report",
    ("post", "/v1/drawings"): "drawings",
    ("post", "/v1/tables/pin_loads"): "table_pin_loads",
    ("post", "/v1/pictures/pin_loads"): "picture_pin_loads",
    ("post", "/v1/tables/built"): "table_built",
    ("post", "/v1/tables/order"): "table_order",
    ("post", "/v1/tables/foundation_loads"): "table_foundation_loads",
    ("post", "/v1/pictures/front"): "picture_front",
    ("post", "/v1/pictures/side"): "picture_side",
    ("post", "/v1/pictures/force"): "picture_force",
    ("post", "/v1/pictures/indicator"): "picture_indicator",
    ("post", "/v1/pictures/stages"): "picture_stages",
    ("post", "/v1/pictures/orders"): "picture_orders",
    ("post", "/v1/pictures/moment"): "picture_moment",
    ("post", "/v1/pictures/bearings"): "picture_bearings",
    ("post", "/v1/verify"): "verify",
    ("post", "/v1/convert"): "convert",
    ("post", "/v1/scroll/pin-loads"): "pin_loads",
    ("post", "/v1/sweeps"): "start_sweep",
    ("get", "/v1/sweeps"): "list_sweeps",
    ("get", "/v1/sweeps/{id}"): "read_sweep",
    ("delete", "/v1/sweeps/{id}"): "end_sweep",
    ("post", "/v1/sweeps/{id}/resume"): "resume_sweep",
    ("get", "/v1/sweeps/{id}/metadata"): "describe_sweep",
    ("get", "/v1/sweeps/{id}/results"): "read_sweep_results",
    ("get", "/v1/sweeps/{id}/events"): "watch_sweep",
    ("get", "/v1/effects"): "list_effects",
    ("get", "/v1/examples"): "list_examples",
    ("get", "/v1/examples/{name}"): "read_example",
    ("get", "/v1/template.xlsx"): "read_template",
    ("get", "/healthz"): "healthz",
    ("get", "/v1/version"): "read_version",
    ("get", "/readyz"): "readyz",
    ("get", "/metrics"): "metrics",
}
KEYED = {"200", "401", "403", "429", "default"}
COMPUTED = KEYED | {"400", "408", "413", "415", "422", "503"}
PHYSICAL = re.compile(r"_(m|m2|m3|m3_per_min|m_s|m_s2|kg|kg_m|kg_m2|deg|rpm|N|Nm|Pa|K|W|J|ms)$")


@pytest.fixture(scope="module")
def document() -> dict[str, Any]:
    # without the lifespan: the document needs no solver
    found: dict[str, Any] = TestClient(create_app(Settings())).get("/openapi.json").json()
    return found


def operations(document: dict[str, Any]) -> list[dict[str, Any]]:
    return [operation for methods in document["paths"].values() for operation in methods.values()]


def test_sources_are_named_in_words(document: dict[str, Any]) -> None:
    # comments count them: docs/mathematics.md, section 12
    assert not re.findall(r"seed \d+", json.dumps(document), re.IGNORECASE)


def test_names_that_clients_depend_on(document: dict[str, Any]) -> None:
    found = {
        (method, path): operation["operationId"]
        for path, methods in document["paths"].items()
        for method, operation in methods.items()
    }
    assert found == OPERATIONS
    assert document["openapi"].startswith("3.1")
    assert all(operation["summary"] and operation["tags"] for operation in operations(document))


def test_it_is_the_same_every_time(document: dict[str, Any]) -> None:
    assert create_app(Settings()).openapi() == document


@pytest.mark.parametrize(
    ("path", "statuses"),
    [
        ("/v1/optimize", COMPUTED),
        ("/v1/analyze", COMPUTED),
        ("/v1/accuracy", COMPUTED),
        ("/v1/pareto", COMPUTED),
        ("/v1/rating", COMPUTED),
        ("/v1/match", COMPUTED),
        ("/v1/round", COMPUTED),
        ("/v1/verify", COMPUTED),
        ("/v1/convert", COMPUTED | {"406"}),
        ("/v1/scroll/pin-loads", COMPUTED),
        ("/v1/sweeps/{id}/metadata", KEYED | {"404", "503"}),
        ("/v1/effects", KEYED),
        ("/v1/examples", KEYED),
        ("/v1/examples/{name}", KEYED | {"404"}),
        ("/metrics", KEYED),
        ("/healthz", {"200", "default"}),
        ("/readyz", {"200", "503", "default"}),
    ],
)
def test_errors_are_problems(document: dict[str, Any], path: str, statuses: set[str]) -> None:
    for operation in document["paths"][path].values():
        assert set(operation["responses"]) == statuses
        for status, response in operation["responses"].items():
            if status != "200":
                schema = response["content"]["application/problem+json"]["schema"]
                assert schema == {"$ref": "#/components/schemas/Problem"}
                assert response["description"]


def test_answers_and_bodies_have_schemas(document: dict[str, Any]) -> None:
    for path, name in (
        ("/v1/optimize", "Optimize"),
        ("/v1/analyze", "Analyze"),
        ("/v1/pareto", "Pareto"),
        ("/v1/rating", "Rating"),
        ("/v1/match", "Match"),
        ("/v1/round", "Round"),
        ("/v1/verify", "Verify"),
        ("/v1/scroll/pin-loads", "PinLoads"),
    ):
        operation = document["paths"][path]["post"]
        body = operation["requestBody"]["content"]["application/json"]
        assert operation["requestBody"]["required"]
        assert body["schema"] == {"$ref": f"#/components/schemas/{name}Request"}
        answer = operation["responses"]["200"]["content"]["application/json"]
        assert answer["schema"] == {"$ref": f"#/components/schemas/{name}Answer"}
    for one in (document["paths"]["/v1/examples/{name}"]["get"], document["paths"]["/v1/convert"]["post"]):
        schema = one["responses"]["200"]["content"]["application/json"]["schema"]
        assert schema == {"$ref": "#/components/schemas/OptimizeRequest"}


def test_every_reference_leads_somewhere(document: dict[str, Any]) -> None:
    known = document["components"]["schemas"]

    def references(node: Any) -> set[str]:
        if isinstance(node, dict):
            own = {node["$ref"]} if isinstance(node.get("$ref"), str) else set()
            return own.union(*map(references, node.values()))
        return set().union(*map(references, node)) if isinstance(node, list) else set()

    assert references(document) == {f"#/components/schemas/{name}" for name in known}
    assert not {"HTTPValidationError", "ValidationError"} & set(known)


def test_every_field_is_described_with_examples_and_its_unit(document: dict[str, Any]) -> None:
    for model, schema in document["components"]["schemas"].items():
        assert schema["description"], model
        for name, field in schema.get("properties", {}).items():
            assert field["description"], (model, name)
            assert field["examples"], (model, name)
            assert PHYSICAL.search(name) is None or "x-unit" in str(field), (model, name)


def test_errors_of_sweeps_are_problems(document: dict[str, Any]) -> None:
    expected = {"start_sweep": COMPUTED | {"202", "409"}}
    for path, methods in document["paths"].items():
        for operation in methods.values() if path.startswith("/v1/sweeps") else ():
            statuses = set(operation["responses"])
            assert statuses >= {"503", "default"}
            assert statuses == expected.get(operation["operationId"], statuses)
            for status in statuses - {"200", "202", "204"}:
                schema = operation["responses"][status]["content"]["application/problem+json"]["schema"]
                assert schema == {"$ref": "#/components/schemas/Problem"}


@pytest.mark.parametrize(
    ("path", "least"),
    [
        ("/v1/optimize", 11),
        ("/v1/analyze", 11),
        ("/v1/rating", 2),
        ("/v1/match", 2),
        ("/v1/round", 1),
        ("/v1/scroll/pin-loads", 2),
        ("/v1/sweeps", 2),
    ],
)
def test_the_examples_of_bodies_are_valid(document: dict[str, Any], path: str, least: int) -> None:
    body = document["paths"][path]["post"]["requestBody"]["content"]["application/json"]
    validator = Draft202012Validator({**body["schema"], "components": document["components"]})
    assert len(body["examples"]) >= least
    for example in body["examples"].values():
        assert example["summary"]
        validator.validate(example["value"])


@pytest.mark.parametrize(
    ("path", "more"),
    [("/v1/rating", {}), ("/v1/analyze", {"outputs": ["gas", "torque", "flywheel", "main_bearings"]})],
)
def test_an_answer_is_as_the_document_says(
    document: dict[str, Any], client: TestClient, path: str, more: dict[str, Any]
) -> None:
    operation = document["paths"][path]["post"]
    body = operation["requestBody"]["content"]["application/json"]["examples"]["2d12"]["value"] | more
    schema = operation["responses"]["200"]["content"]["application/json"]["schema"]
    validator = Draft202012Validator({**schema, "components": document["components"]})
    validator.validate(client.post(path, json=body).json())


def test_the_prefix_of_a_proxy_is_told() -> None:
    client = TestClient(create_app(Settings()), root_path="/cw")
    assert client.get("/openapi.json").json()["servers"] == [{"url": "/cw"}]
    links = client.get("/v1/examples").json()["examples"][0]["links"]
    assert links["self"].startswith("/cw/v1/examples/")
