"""One entry in the table is all that it takes: routes, scopes, OpenAPI, metrics, documents and commands read it."""

import json
import tomllib
from collections.abc import Iterator
from pathlib import Path
from pkgutil import resolve_name

import pytest
from starlette.testclient import TestClient
from typer.testing import CliRunner

from schemas.base.model import Answer
from schemas.base.version import package_version
from schemas.sweep.answers import SweepEstimate, SweepState
from service.app import create_app
from service.cli import command_line
from service.computations.computation import Computation
from service.computations.table import COMPUTATIONS
from service.documents.catalogue import documents
from service.guard import keys
from service.settings import Settings
from tests.service.toy import TOY, ToyAnswer, ToyRequest

_BODY = {"one": 2.0, "other": 0.5}


@pytest.fixture(autouse=True)
def added(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(COMPUTATIONS, TOY.name, TOY)


@pytest.fixture
def keyring() -> dict[str, tuple[str, keys.KeyRecord]]:
    return {"may": keys.make("a", ("sweeps", "metrics")), "may not": keys.make("a", ("compute",))}


@pytest.fixture
def client(tmp_path: Path, keyring: dict[str, tuple[str, keys.KeyRecord]]) -> Iterator[TestClient]:
    file = tmp_path / "keys"
    keys.write(file, [record for _, record in keyring.values()])
    settings = Settings(keys_file=file, data_dir=tmp_path / "data")
    with TestClient(create_app(settings, warm=False)) as client:
        yield client


def test_it_is_a_route_with_its_scope_its_metric_and_its_description(
    client: TestClient, keyring: dict[str, tuple[str, keys.KeyRecord]]
) -> None:
    allowed, refused = ({"X-API-Key": keyring[name][0]} for name in ("may", "may not"))
    assert client.post(TOY.path, json=_BODY, headers=allowed).json() == {"total": 2.5}
    wrong = client.post(TOY.path, json={"one": "x"}, headers=allowed)
    assert (wrong.status_code, wrong.json()["errors"][0]["pointer"]) == (422, "/one")
    assert client.post(TOY.path, json=_BODY, headers=refused).status_code == 403
    text = client.get("/metrics", headers=allowed).text
    assert 'counterweight_computation_seconds_count{computation="toy_sum"} 1.0' in text
    document = client.get("/openapi.json").json()
    operation = document["paths"][TOY.path]["post"]
    assert (operation["operationId"], operation["summary"]) == ("toy_sum", "A sum")
    content = operation["requestBody"]["content"]["application/json"]
    assert content["schema"] == {"$ref": "#/components/schemas/ToyRequest"}
    assert {"ToyRequest", "ToyAnswer"} <= set(document["components"]["schemas"])


def test_its_request_and_answer_are_documents() -> None:
    actual_documents = documents()
    assert (actual_documents["toy-sum"].model, actual_documents["toy-sum-answer"].model) == (ToyRequest, ToyAnswer)


def test_it_is_a_command() -> None:
    run, app = CliRunner(), command_line()
    exact = run.invoke(app, ["toy-sum", "-", "--json"], input=json.dumps(_BODY))
    assert (exact.exit_code, exact.stdout) == (0, '{"total":2.5}\n')
    process = run.invoke(app, ["toy-sum", "-"], input=json.dumps(_BODY))
    assert (process.exit_code, "│ the sum │ 2.5 │" in process.stdout) == (0, True)
    assert run.invoke(app, ["toy-sum", "-"], input='{"one": "x"}').exit_code == 2
    assert "Add two numbers." in run.invoke(app, ["--help"]).stdout
    assert json.loads(run.invoke(app, ["schema", "toy-sum"]).stdout)["title"] == "Toy request"


@pytest.mark.parametrize("computation", COMPUTATIONS.values(), ids=lambda subject: subject.name)
def test_everything_an_entry_names_is_there(computation: Computation) -> None:
    assert computation.request_model.model_json_schema()
    assert callable(computation.function)
    assert set(computation.options) <= set(computation.request_model.model_fields)
    for reference in (computation.chapters, computation.picture, *(form.write for form in computation.forms)):
        assert reference is None or callable(resolve_name(reference))


def test_every_answer_and_the_state_of_a_sweep_say_which_version_answered() -> None:
    """Independent: the version of the project's file."""
    project = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text())["project"]
    assert package_version() == project["version"]
    computed = [
        computation.answer_model
        for computation in COMPUTATIONS.values()
        if computation.answer is not None and computation is not TOY
    ]
    for model in (*computed, SweepState, SweepEstimate):
        assert issubclass(model, Answer), model
        assert model.model_construct().version == package_version()
        # said once: an answer within an answer does not repeat it
        written = model.model_json_schema(mode="serialization")
        names = [name for name, entry in written.get("$defs", {}).items() if "version" in entry.get("properties", {})]
        assert names == [], model
