"""The package as others install it: what it is called, and that it answers outside of the tree."""

import re
import subprocess
import tomllib
from pathlib import Path

import pytest
import yaml

from tests.deploy.files import DEPLOY, ROOT

VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]


def test_changes_and_citation_name_the_version() -> None:
    newest = re.findall(
        r"^## (\d+\.\d+\.\d+) \((\d{4}-\d{2}-\d{2})\)$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE
    )
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert newest[0] == (VERSION, str(citation["date-released"]))
    assert citation["version"] == VERSION
    assert f"image: counterweight:{VERSION}\n" in (DEPLOY / "kubernetes" / "deployment.yaml").read_text()


def test_the_citation_holds_what_the_format_asks() -> None:
    """Published: Citation File Format 1.2.0, required keys."""
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert citation["cff-version"] == "1.2.0"
    assert citation.keys() >= {"message", "title", "authors"}
    assert all(author.keys() & {"name", "family-names"} for author in citation["authors"])


@pytest.mark.nightly
def test_the_package_answers_in_an_empty_environment(tmp_path: Path) -> None:
    ran = subprocess.run(
        [DEPLOY / "package.sh", tmp_path / "package"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=900,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert f"{VERSION}: optimal, 232.7 kg" in ran.stdout
    assert sorted(path.suffix for path in (tmp_path / "package").iterdir()) == [".gz", ".whl"]
