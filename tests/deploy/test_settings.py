"""Operators read of every setting, and of none that there is not."""

import re
from pathlib import Path
from typing import Any

import pytest

from service.settings import Settings
from tests.deploy.files import DEPLOY, ROOT, module, settings_variables

written = module(ROOT / "docs" / "settings.py")


def test_the_table_and_the_example_are_those_of_today() -> None:
    guide = (ROOT / "docs" / "operation.md").read_text("utf-8")
    assert guide == written.guide(guide), "write it anew: make settings"
    assert (DEPLOY / ".env.example").read_text("utf-8") == written.environment(), "write it anew: make settings"


def test_every_setting_is_in_both() -> None:
    variables = settings_variables()
    guide = (ROOT / "docs" / "operation.md").read_text("utf-8")
    table = set(re.findall(r"^\| `(COUNTERWEIGHT_\w+)` \|", guide, re.MULTILINE))
    example = set(re.findall(r"^#(COUNTERWEIGHT_\w+)=", (DEPLOY / ".env.example").read_text("utf-8"), re.MULTILINE))
    assert table == variables
    assert example >= variables


def test_the_example_sets_the_defaults(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """What is written there, with the # taken away, is what holds without it."""
    for name in settings_variables() | {"PORT"}:
        monkeypatch.delenv(name, raising=False)
    lines = (DEPLOY / ".env.example").read_text("utf-8").splitlines()
    file: Any = tmp_path / "environment"
    file.write_text("\n".join(line[1:] for line in lines if re.match(r"#COUNTERWEIGHT_\w+=", line)))
    assert Settings(_env_file=file) == Settings()


def test_no_document_names_a_setting_that_there_is_not() -> None:
    compose = {"IMAGE", "PUBLISH", "DASK_WORKERS", "MEMORY", "CPUS"}
    # of the workbench's script without a window
    script = {"SHAFT", "MACHINE", "FOLDER", "URL", "FORCE"}
    texts = {
        "COUNTERWEIGHT_KEY",
        *(f"COUNTERWEIGHT_{name}" for name in script),
        *(f"COUNTERWEIGHT_{name}" for name in compose),
    }
    for file in [*DEPLOY.rglob("*"), *(ROOT / "docs").rglob("*.md"), ROOT / "README.md"]:
        if file.is_file() and file.suffix != ".pyc":
            named = set(re.findall(r"\bCOUNTERWEIGHT_[A-Z_]+[A-Z]\b", file.read_text("utf-8")))
            assert named <= settings_variables() | texts, file
