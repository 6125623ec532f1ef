"""What others make of the schema: types for TypeScript that compile, and a form without needless choosers."""

import json
import os
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from schemas.request.requests import OptimizeRequest
from service.app import create_app
from service.documents.examples import bodies
from service.settings import Settings
from tests.clients.conftest import ROOT

FORMS = ROOT / "tests/clients/forms"
#: of the packages that run the tests, which are not in a copy of the tree
DENO = shutil.which("deno", path=f"{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}")


def deno(*arguments: str | Path, stdin: str | None = None) -> subprocess.CompletedProcess[str]:
    assert DENO is not None
    quiet = {**os.environ, "NO_COLOR": "1", "DENO_NO_UPDATE_CHECK": "1"}
    command = [DENO, *map(str, arguments)]
    return subprocess.run(
        command, cwd=FORMS, env=quiet, input=stdin, capture_output=True, text=True, timeout=300, check=False
    )


@pytest.fixture(scope="module", autouse=True)
def packages() -> None:
    """Of the locked versions, with their hashes; downloaded once."""
    for _ in range(2):
        fetched = deno("install", "--quiet", "--frozen", "--entrypoint", "types.ts", "form.ts")
        if fetched.returncode == 0:
            return
        assert "lockfile" not in fetched.stderr, fetched.stderr
    pytest.skip("packages of JavaScript cannot be had: types and forms of the schema were NOT made")


def test_types_of_the_document_compile(tmp_path: Path) -> None:
    document = tmp_path / "openapi.json"
    document.write_text(json.dumps(create_app(Settings()).openapi()))
    process = deno("run", "--frozen", "--no-check", "--allow-all", "types.ts", document, tmp_path / "service.ts")
    assert process.returncode == 0, process.stderr
    shutil.copy(FORMS / "pattern.ts", tmp_path)
    compiled = deno("check", "--quiet", "--no-config", "--no-lock", "--no-remote", tmp_path / "pattern.ts")
    assert compiled.returncode == 0, compiled.stderr
    # what is an alternative of nothing but required fields has no type
    assert "| unknown" not in (tmp_path / "service.ts").read_text().replace("| unknown[]", "")


class _Inputs(HTMLParser):
    """Labels, and names of inputs and choosers."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.labels: dict[str, str] = {}
        self.inputs: dict[str, dict[str, Any]] = {}
        self.choosers: list[str] = []
        self._label = ""
        self.feed(html)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        about = dict(attrs)
        if tag == "label":
            self._label = about.get("for") or ""
        elif tag == "input":
            self.inputs[about.get("id") or ""] = about
        elif tag == "select":
            self.choosers.append(about.get("id") or "")

    def handle_endtag(self, tag: str) -> None:
        if tag == "label":
            self._label = ""

    def handle_data(self, data: str) -> None:
        if self._label:
            self.labels[self._label] = self.labels.get(self._label, "") + data


def test_a_generated_form_has_one_input_for_a_quantity() -> None:
    request = {"machine": bodies("")["2d12"]["machine"]}
    request["machine"]["throws"][0]["crank_radius_m"] = "140 mm"
    text = json.dumps({"schema": OptimizeRequest.model_json_schema(), "formData": request})
    process = deno("run", "--frozen", "--no-check", "--allow-env", "form.ts", stdin=text)
    assert process.returncode == 0, process.stderr
    document = json.loads(process.stdout)
    assert document["errors"] == []
    form = _Inputs(document["html"])
    radius = "root_machine_throws_0_crank_radius_m"
    assert form.labels[radius].rstrip("*") == "Crank radius"
    assert (form.inputs[radius]["value"], form.inputs[radius]["type"]) == ("140 mm", "text")
    # a quantity that may be null has one input as well
    assert form.inputs["root_machine_overspeed_rpm"]["type"] == "text"
    # what is left to choose: a kind, one of some words, whether there is something or nothing
    choosers = [chooser for chooser in form.choosers if re.search(r"__(any|one)of_select$", chooser)]
    assert choosers
    schemas = OptimizeRequest.model_json_schema()["$defs"]
    numbers = {name for schema in schemas.values() for name, field in schema["properties"].items() if "x-unit" in field}
    assert [
        chooser for chooser in choosers if chooser.rsplit("__", 1)[0].endswith(tuple(f"_{name}" for name in numbers))
    ] == []
