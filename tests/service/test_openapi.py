"""The published document: pinned names, described fields, units, examples that are valid."""

import json
import re
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from starlette.testclient import TestClient

from service.app import CORS, create_app
from service.computations.table import COMPUTATIONS
from service.guard.keys import make, write
from service.http.openapi import Documented
from service.settings import Settings

OPERATIONS = {
    ("post", "/v1/optimize"): "optimize",
    ("post", "/v1/analyze"): "analyze",
    ("post", "/v1/accuracy"): "accuracy",
    ("post", "/v1/pareto"): "pareto",
    ("post", "/v1/rating"): "rating",
    ("post", "/v1/match"): "match",
    ("post", "/v1/round"): "round",
    ("post", "/v1/shaft"): "shaft",
    ("post", "/v1/layout"): "layout",
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
    ("get", "/problems/{kind}"): "read_problem",
    ("get", "/v1/examples"): "list_examples",
    ("get", "/v1/examples/{name}"): "read_example",
    ("get", "/v1/template.xlsx"): "read_template",
    ("get", "/healthz"): "healthz",
    ("get", "/v1/version"): "read_version",
    ("get", "/readyz"): "readyz",
    ("get", "/metrics"): "metrics",
}
#: components that operations refer to
PARTS = ("schemas", "headers", "parameters")
KEYED = {"200", "401", "403", "429", "default"}
COMPUTED = KEYED | {"400", "408", "413", "415", "422", "503"}
#: may be answered later, as a job
LATER = COMPUTED | {"202", "409"}
#: documents that are sent once
UNCHANGED = KEYED | {"304"}
PHYSICAL = re.compile(r"_(m|m2|m3|m3_per_min|m_s|m_s2|kg|kg_m|kg_m2|deg|rpm|N|Nm|Pa|K|W|J|ms)$")


@pytest.fixture(scope="module")
def document() -> dict[str, Any]:
    # without the lifespan: the document needs no solver
    record: dict[str, Any] = TestClient(create_app(Settings())).get("/openapi.json").json()
    return record


def operations(document: dict[str, Any]) -> list[dict[str, Any]]:
    return [operation for methods in document["paths"].values() for operation in methods.values()]


def test_sources_are_named_in_words(document: dict[str, Any]) -> None:
    # comments count them: docs/mathematics.md, section 12
    assert not re.findall(r"seed \d+", json.dumps(document), re.IGNORECASE)


def test_names_that_clients_depend_on(document: dict[str, Any]) -> None:
    operation_Ids = {
        (method, path): operation["operationId"]
        for path, methods in document["paths"].items()
        for method, operation in methods.items()
    }
    # a computation that is added is called as its entry is
    assert (
        operation_Ids
        == {("post", computation.path): computation.name for computation in COMPUTATIONS.values()} | OPERATIONS
    )
    assert document["openapi"].startswith("3.1")
    assert all(operation["summary"] and operation["tags"] for operation in operations(document))
    described = [tag["name"] for tag in document["tags"] if tag["description"]]
    assert len(set(described)) == len(described)
    assert {tag for operation in operations(document) for tag in operation["tags"]} == set(described)
    assert document["servers"] == [{"url": "/"}]
    assert document["info"]["contact"]["name"]


def test_it_is_the_same_every_time(document: dict[str, Any]) -> None:
    # past the copies that tests share
    anew = Documented.openapi.__wrapped__  # type: ignore[attr-defined]
    assert anew(create_app(Settings())) == document


@pytest.mark.parametrize(
    ("path", "statuses"),
    [
        ("/v1/optimize", LATER),
        ("/v1/analyze", COMPUTED),
        ("/v1/accuracy", LATER),
        ("/v1/pareto", LATER),
        ("/v1/rating", COMPUTED),
        ("/v1/match", LATER),
        ("/v1/round", LATER),
        ("/v1/shaft", COMPUTED),
        ("/v1/layout", COMPUTED),
        ("/v1/verify", COMPUTED),
        ("/v1/convert", COMPUTED | {"406"}),
        ("/v1/scroll/pin-loads", COMPUTED),
        ("/v1/sweeps/{id}/metadata", KEYED | {"404", "503"}),
        ("/v1/effects", UNCHANGED),
        ("/v1/examples", UNCHANGED),
        ("/v1/examples/{name}", UNCHANGED | {"404"}),
        ("/metrics", KEYED),
        ("/healthz", {"200", "default"}),
        ("/readyz", {"200", "503", "default"}),
    ],
)
def test_errors_are_problems(document: dict[str, Any], path: str, statuses: set[str]) -> None:
    for operation in document["paths"][path].values():
        assert set(operation["responses"]) == statuses
        for status, response in operation["responses"].items():
            if status not in ("200", "202", "304"):
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
        ("/v1/shaft", "Shaft"),
        ("/v1/layout", "Layout"),
        ("/v1/verify", "Verify"),
        ("/v1/scroll/pin-loads", "PinLoads"),
    ):
        operation = document["paths"][path]["post"]
        body = operation["requestBody"]["content"]["application/json"]
        assert operation["requestBody"]["required"]
        assert body["schema"] == {"$ref": f"#/components/schemas/{name}Request"}
        answer = operation["responses"]["200"]["content"]["application/json"]
        assert answer["schema"] == {"$ref": f"#/components/schemas/{name}Answer"}
    for post in (document["paths"]["/v1/examples/{name}"]["get"], document["paths"]["/v1/convert"]["post"]):
        schema = post["responses"]["200"]["content"]["application/json"]["schema"]
        assert schema == {"$ref": "#/components/schemas/OptimizeRequest"}


def test_every_reference_leads_somewhere(document: dict[str, Any]) -> None:
    schemas = document["components"]["schemas"]

    def references(node: Any) -> set[str]:
        if isinstance(node, dict):
            own = {node["$ref"]} if isinstance(node.get("$ref"), str) else set()
            return own.union(*map(references, node.values()))
        return set().union(*map(references, node)) if isinstance(node, list) else set()

    expected = {f"#/components/{kind}/{name}" for kind in PARTS for name in document["components"][kind]}
    assert references(document) == expected
    assert not {"HTTPValidationError", "ValidationError"} & set(schemas)


def test_every_field_is_described_with_examples_and_its_unit(document: dict[str, Any]) -> None:
    for model, schema in document["components"]["schemas"].items():
        assert schema["description"], model
        for name, field in schema.get("properties", {}).items():
            assert field["description"], (model, name)
            assert field["examples"], (model, name)
            assert PHYSICAL.search(name) is None or "x-unit" in str(field), (model, name)


def test_errors_of_sweeps_are_problems(document: dict[str, Any]) -> None:
    expected = {"start_sweep": LATER}
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
        ("/v1/shaft", 2),
        ("/v1/layout", 11),
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


def names(listed: list[dict[str, Any]]) -> set[str]:
    """Parameters by name, their own or that of a reference."""
    return {fields.get("name") or fields["$ref"].rpartition("/")[2] for fields in listed}


def test_jobs_are_described_where_they_can_be_asked_for(document: dict[str, Any]) -> None:
    for computation in COMPUTATIONS.values():
        operation = document["paths"][computation.path]["post"]
        listed = names(operation.get("parameters", []))
        assert ({"Prefer", "Idempotency-Key"} <= listed) is computation.later, computation.name
        assert ({"202", "409"} <= set(operation["responses"])) is computation.later, computation.name
        assert ("Accept" in listed) is (len(computation.forms) > 1), computation.name
        content = operation["responses"]["200"]["content"]
        assert {form.media_type for form in computation.forms} == set(content), computation.name
    for path in ("/v1/optimize", "/v1/sweeps"):
        response = document["paths"][path]["post"]["responses"]["202"]
        assert {"Location", "Preference-Applied", "Idempotency-Replayed"} <= set(response["headers"])


def test_headers_of_answers_are_described(document: dict[str, Any], client: TestClient) -> None:
    """All that pages of other origins may read, and what comes with every answer."""
    shared = set(CORS["expose_headers"])
    assert shared | {"WWW-Authenticate"} == set(document["components"]["headers"])
    answers = [answer for single_operation in operations(document) for answer in single_operation["responses"].values()]
    assert {name for answer in answers for name in answer["headers"]} == set(document["components"]["headers"])
    for path, methods in document["paths"].items():
        if "get" not in methods or "{" in path:
            continue
        answer = client.get(path)
        operation = methods["get"]
        headers = operation["responses"][str(answer.status_code)]["headers"]
        labels = {name for name in document["components"]["headers"] if name in answer.headers}
        assert labels <= set(headers), path
        required = {name for name in headers if document["components"]["headers"][name].get("required")}
        assert required <= labels, path
        # what has a tag is answered once
        again = client.get(path, headers={"If-None-Match": answer.headers.get("ETag", "none")})
        assert (again.status_code == 304) is ("304" in operation["responses"]), path
        assert ("If-None-Match" in names(operation.get("parameters", []))) is (again.status_code == 304), path


def test_a_key_is_optional_where_nobody_needs_one(document: dict[str, Any], tmp_path: Path) -> None:
    file = tmp_path / "keys.jsonl"
    write(file, [make("portal", ("compute",))[1]])
    keyed = create_app(Settings(keys_file=file)).openapi()
    assert document["paths"]["/v1/optimize"]["post"]["security"] == [{"bearer": []}, {"key": []}, {}]
    assert keyed["paths"]["/v1/optimize"]["post"]["security"] == [{"bearer": []}, {"key": []}]
    assert document["paths"]["/healthz"]["get"]["security"] == keyed["paths"]["/healthz"]["get"]["security"] == []
