"""The hashed lists leave out what cvxpy names and nothing asks for, and miss nothing else."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LISTS = ("requirements.txt", "requirements-dev.txt", "deploy/requirements.txt")
LEFT_OUT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["uv"]["exclude-dependencies"]


def _names(path: str) -> set[str]:
    return set(re.findall(r"^([a-z0-9-]+)==", (ROOT / path).read_text("utf-8"), re.MULTILINE))


@pytest.mark.parametrize("path", LISTS)
def test_a_list_holds_the_modelling_layer_and_none_of_the_solvers_that_are_left_out(path: str) -> None:
    names = _names(path)
    assert {"cvxpy", "clarabel", "qdldl", "scipy"} <= names
    assert names.isdisjoint(LEFT_OUT)


def test_the_installer_is_the_one_that_makes_the_lists() -> None:
    assert _names("deploy/uv.txt") == {"uv"}
    pin = re.compile(r"^uv==(\S+)", re.MULTILINE)
    assert pin.findall((ROOT / "deploy/uv.txt").read_text()) == pin.findall((ROOT / "requirements-dev.txt").read_text())


def _check(broken: str) -> subprocess.CompletedProcess[str]:
    """Of a package manager that finds so much."""
    command = [str(ROOT / "deploy/check.sh"), sys.executable, "-c", f"print({broken!r}); raise SystemExit(1)"]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_what_is_left_out_on_purpose_is_no_fault() -> None:
    lines = [f"cvxpy 1.9.3 requires {name}, which is not installed." for name in LEFT_OUT]
    assert _check("\n".join(lines)).returncode == 0


@pytest.mark.parametrize(
    "line",
    [
        "cvxpy 1.9.3 requires scipy, which is not installed.",
        "cvxpy 1.9.3 has requirement scs>=3, but you have scs 2.0.",
        "other 1.0 requires scs-python, which is not installed.",
    ],
)
def test_all_else_is_a_fault_and_is_said(line: str) -> None:
    process = _check(f"cvxpy 1.9.3 requires scs, which is not installed.\n{line}")
    assert process.returncode == 1
    assert process.stderr.strip() == line
