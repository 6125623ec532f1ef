"""The package as others install it: what it is called, and that it answers outside of the tree."""

import re
import subprocess
import tomllib
from pathlib import Path

import pytest
import yaml

from tests.deploy.files import DEPLOY, ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
VERSION = PROJECT["version"]
#: programs that fetch packages by their names, and what follows in the line, as far as a quote of code goes
_INSTALLS = re.compile(
    r"\b(?:pip3? (?:install|download)|pipx (?:install|run)|uv (?:add|tool install)|uvx|conda install|poetry add)\s+"
    r"([^`#|&;]*)"
)
#: options of pip whose value is no package
_WITH_VALUE = {"--requirement", "-r", "--only-binary", "--target", "--python"}


def packages(line: str) -> list[str]:
    """What a line of a document or message installs, as pip is told it."""
    actual_words = []
    for arguments in _INSTALLS.findall(line):
        words = iter(re.sub(r"[\"']", " ", arguments).split())
        for word in words:
            if word in _WITH_VALUE:
                next(words, None)
            elif word == "beside":
                # a message goes on
                break
            elif not word.startswith(("-", "$@")):
                # what a script was handed stands where it is called
                actual_words.append(word.rstrip(".,") or ".")
    return actual_words


def is_ours(package: str) -> bool:
    """Whether it is this folder, with extras that there are."""
    match = re.fullmatch(r"\.(?:\[([a-z,]+)\])?", package)
    return match is not None and set((match[1] or "").split(",")) - {""} <= PROJECT["optional-dependencies"].keys()


@pytest.mark.parametrize(
    ("line", "ours"),
    [
        ("pip install '.[dask]'   # beside", True),
        ("bin/pip install --no-deps --requirement deploy/requirements.txt", True),
        ("Install it with `pip install .`, then", True),
        ("pip install 'counterweight[dask]'", False),
        ("needs an extra: pip install counterweight-optimizer[dask] beside it", False),
        ("pip install '.[cluster]'", False),
        ("uv add counterweight", False),
    ],
)
def test_an_installation_by_name_is_seen(line: str, ours: bool) -> None:
    assert all(map(is_ours, packages(line))) is ours


def test_nothing_that_is_read_installs_a_package_by_its_name() -> None:
    """The public index has packages of others: `counterweight` is one of them, and whoever follows us would run it."""
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    ends = (".md", ".py", ".sh", ".yaml", ".yml", ".js", ".html", ".toml", ".json", ".service", "Dockerfile")
    installs = dict[str, list[str]]()
    for name in listed.splitlines():
        if name.endswith(ends) and not name.startswith("tests/") and (ROOT / name).is_file():
            for line in (ROOT / name).read_text("utf-8").splitlines():
                if actual_packages := packages(line):
                    installs.setdefault(name, []).extend(actual_packages)
    # of documents and messages
    assert {"docs/sweeps.md", "service/jobs/engines.py", "service/jobs/database.py"} <= installs.keys()
    assert {name: texts for name, texts in installs.items() if not all(map(is_ours, texts))} == {}


def test_the_distribution_is_not_called_as_the_one_of_another() -> None:
    # a terminal framework on the public index
    assert PROJECT["name"] not in ("counterweight", "optimizer", "service", "schemas")


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
