"""What CONTRIBUTING tells a newcomer to write, written into a copy of the packages and asked for in every way."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.commands import run
from tests.docs.reading import ROOT, section

_STEP = re.compile(
    r"`(?P<file>[\w./]+)`,\s(?:new|above\sthe\sline\s(?P<tick>`+)(?P<line>.+?)(?P=tick)):\n\n"
    r"```\w+\n(?P<block>.*?)```\n",
    re.DOTALL,
)
_NUMBERS = ("One", "Two", "Three", "Four", "Five", "Six", "Seven")
#: what is asked of a copy, a file for each of the recipes
RECIPES = ROOT / "tests" / "docs" / "recipes"
#: tests that read what the entries say
_OTHERS = ("schemas", "effects", "service", "clients", "studies/sweep", "docs", "verification")
_PACKAGES = ("schemas", "optimizer", "service")
_ADDED = ("An effect", "An output", "A computation", "A limit", "A response", "A case", "A kind of choice")


@pytest.fixture(scope="module")
def steps() -> list[re.Match[str]]:
    text = "".join(section("CONTRIBUTING.md", heading) for heading in _ADDED)
    matches = list(_STEP.finditer(text))
    # none of the blocks is passed over
    assert len(matches) == len(re.findall(r"^```\w+$", text, re.MULTILINE))
    return matches


@pytest.fixture(scope="module")
def copy(steps: list[re.Match[str]], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All that is in the folder of the project, with its compiled kernels, after every step."""
    place = tmp_path_factory.mktemp("copy")
    # what other tests are writing at this moment has a name that is gone in the next
    passing = shutil.ignore_patterns("*.pyc.*", "*.tmp*")
    for path in ROOT.iterdir():
        if path.is_dir() and (not path.name.startswith(".") or path.name == ".ci"):
            shutil.copytree(path, place / path.name, ignore=passing)
        elif path.is_file():
            shutil.copy(path, place)
    for step in steps:
        file, line, block = place / step["file"], step["line"], step["block"]
        if line is None:
            assert not file.exists()
            file.write_text(block)
            continue
        lines = file.read_text().splitlines(keepends=True)
        (above,) = (number for number, text in enumerate(lines) if text.startswith(line))
        apart = "\n\n" if block.startswith(("class ", "def ")) else ""
        file.write_text("".join([*lines[:above], block + apart, *lines[above:]]))
    # else each process reads from source what is no longer that of the bytecode
    _run(place, "-m", "compileall", "-q", *_PACKAGES)
    return place


def _recipe(name: str) -> str:
    return (RECIPES / f"{name}.py").read_text()


def _require_success(copy: Path, script: str, *arguments: str) -> None:
    """A script runs without a fault, in a process of its own that has the packages of the copy."""
    file = copy / "script.py"
    file.write_text(script)
    ran = run("tests.docs.recipes", str(file), *arguments, root=copy)
    assert ran.returncode == 0, ran.stdout + ran.stderr


def _run(copy: Path, *arguments: str, timeout_s: float = 900.0) -> str:
    environment = {**os.environ, "PYTHONPATH": str(copy)}
    ran = subprocess.run(
        [sys.executable, *arguments],
        cwd=copy,
        env=environment,
        capture_output=True,
        text=True,
        timeout=timeout_s,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    return ran.stdout


@pytest.mark.parametrize("heading", _ADDED)
def test_it_takes_as_many_files_as_it_says(heading: str) -> None:
    actual_section = section("CONTRIBUTING.md", heading)
    files = {step["file"] for step in _STEP.finditer(actual_section)}
    assert actual_section.lstrip().startswith(f"{_NUMBERS[len(files) - 1]} files")


def test_effect_output_computation_and_limit_are_answered_swept_and_reported(copy: Path, tmp_path: Path) -> None:
    # one process for all
    _require_success(copy, "".join(map(_recipe, ("effect", "computation", "limit"))), str(tmp_path))


def test_response_is_weighed_limited_traded_swept_reported_and_checked(copy: Path) -> None:
    _require_success(copy, _recipe("response"))


def test_case_is_solved_chosen_limited_reported_refused_and_checked(copy: Path) -> None:
    _require_success(copy, _recipe("case"))


def test_kind_of_choice_goes_with_goals_limits_groups_and_studies(copy: Path) -> None:
    _require_success(copy, _recipe("choice"))


def test_the_output_is_shown_by_a_terminal(copy: Path) -> None:
    stdout = run("service", "analyze", "examples/2d12.json", "--output", "obliquity", root=copy).stdout
    assert "Lean of the rods" in stdout
    assert re.search(r"largest angle of any rod, deg\W+\d", stdout)


def test_the_computation_is_a_command(copy: Path, tmp_path: Path) -> None:
    body = tmp_path / "body.json"
    body.write_text('{"stroke_m": "280 mm", "speed_rpm": 500}')
    stdout = run("service", "piston-speed", str(body), root=copy).stdout
    # analytic: two strokes in a turn
    assert re.search(r"mean, m/s\W+4\.6", stdout)


def test_all_is_written_as_the_linter_wants_it(copy: Path) -> None:
    for check in (("check",), ("format", "--check")):
        _run(copy, "-m", "ruff", *check, "--no-cache", *_PACKAGES)


def test_all_keeps_to_the_layers(copy: Path) -> None:
    _run(copy, "-c", "from importlinter.cli import lint_imports_command; lint_imports_command()", "--no-cache")


@pytest.mark.nightly
def test_all_is_typed(copy: Path) -> None:
    # half a minute of CPU where nothing is known of the packages yet: pytest tests/docs/test_contributing.py -m nightly
    root = ROOT / ".mypy_cache"
    if root.exists():
        shutil.copytree(root, copy / ".mypy_cache")
    _run(copy, "-m", "mypy", *_PACKAGES)


@pytest.mark.nightly
@pytest.mark.parametrize("folder", _OTHERS)
def test_the_other_tests_pass_on_the_copy(copy: Path, folder: str) -> None:
    # pytest tests/docs/test_contributing.py -m nightly; this file and the history of commits are not asked of the copy
    itself = ("--ignore", "tests/docs/test_contributing.py", "--ignore", "tests/docs/test_commits.py")
    options = ("-p", "no:cacheprovider", "-n", "0", "-m", "not nightly", *itself)
    _run(copy, "-m", "pytest", *options, f"tests/{folder}", timeout_s=3600.0)


def test_the_documents_have_a_row_for_it(copy: Path) -> None:
    rows = re.findall(r"^\| `(\w+)` \| .* \|$", (copy / "docs" / "api" / "analyze.md").read_text(), re.MULTILINE)
    assert rows.index("obliquity") + 1 == rows.index("pin_loads")
    assert "| `largest_obliquity_deg` |" in (copy / "docs" / "sweeps.md").read_text()
