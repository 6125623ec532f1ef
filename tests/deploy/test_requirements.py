"""What the image holds is locked: versions and hashes only, the same versions as everywhere else."""

import re
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.deploy.files import DEPLOY, ROOT

LISTS = [ROOT / "requirements.txt", ROOT / "requirements-dev.txt", DEPLOY / "requirements.txt"]


def locked(file: Path) -> dict[str, str]:
    pinned = re.findall(r"^([\w.-]+)(?:\[[\w,-]+\])?==(\S+)", file.read_text("utf-8"), re.MULTILINE)
    return {canonicalize_name(name): version for name, version in pinned}


def named(*requirements: str) -> set[str]:
    return {canonicalize_name(Requirement(requirement).name) for requirement in requirements}


@pytest.mark.parametrize("file", LISTS, ids=lambda file: str(file.relative_to(ROOT)))
def test_a_list_holds_versions_and_hashes_alone(file: Path) -> None:
    """No address of an index, no path of a machine, nothing without a hash."""
    text = file.read_text("utf-8")
    assert "://" not in text
    for requirement in re.split(r"\n(?=\S)", text.strip()):
        assert re.match(r"[\w.-]+(\[[\w,-]+\])?==[^\s;]+", requirement), requirement
        assert re.search(r"--hash=sha256:[0-9a-f]{64}", requirement), requirement


def test_the_image_holds_every_extra() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    texts = named(*project["dependencies"])
    for extra in project["optional-dependencies"].values():
        texts |= named(*extra)
    assert texts <= set(locked(DEPLOY / "requirements.txt")), "lock anew: make lock"


def test_the_lists_hold_what_the_project_names() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    groups = project["dependency-groups"]
    run = named(*project["project"]["dependencies"], *groups["runtime-build"])
    assert run <= set(locked(ROOT / "requirements.txt")), "lock anew: make lock"
    assert named(*groups["dev"]) <= set(locked(ROOT / "requirements-dev.txt")), "lock anew: make lock"


def test_one_version_of_each_package_everywhere() -> None:
    tested, shipped = locked(ROOT / "requirements-dev.txt"), locked(DEPLOY / "requirements.txt")
    run = locked(ROOT / "requirements.txt")
    assert {name: version for name, version in run.items() if shipped.get(name) != version} == {}
    assert {name: version for name, version in shipped.items() if tested.get(name, version) != version} == {}


def test_the_licences_are_a_list_of_names() -> None:
    lines = [line for line in (DEPLOY / "licences.txt").read_text("utf-8").splitlines() if not line.startswith("#")]
    assert lines == sorted(set(lines))
    assert all(line and ";" not in line for line in lines)
