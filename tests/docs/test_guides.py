"""Tutorials and how-to pages, followed command by command: each prints the lines that stand below it."""

import os
import re
import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path

import pytest

from schemas.request.requests import OptimizeRequest
from service.cli import main
from service.documents.examples import bodies
from service.report import pictures
from tests.docs.reading import ROOT
from tests.docs.shell import program

GUIDES = sorted(path for folder in ("tutorial", "how-to") for path in (ROOT / "docs" / folder).glob("*.md"))
_STEP = re.compile(r"```sh\n(.*?)```\n(?:\n```text\n(.*?)```)?", re.DOTALL)
_SERVICE = "http://127.0.0.1:8000"
_MARK = "=== end of step"
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
#: shown digits are those of one machine; another one rounds otherwise
_CLOSE = 1e-3


def steps(path: Path) -> list[tuple[str, str]]:
    """Commands of a page, each with the lines below it."""
    return _STEP.findall(path.read_text())


def says(line: str, text: str) -> bool:
    """Whether a line of output holds what is shown, word by word, but for borders of tables and last digits."""
    parts, actual_parts = (re.sub(r"[│┃|]", " ", text).split() for text in (line, text))
    return any(all(map(_same, parts[start:], actual_parts)) for start in range(len(parts) - len(actual_parts) + 1))


def _same(first: str, second: str) -> bool:
    if _NUMBER.fullmatch(first) and _NUMBER.fullmatch(second):
        return float(first) == pytest.approx(float(second), rel=_CLOSE)
    return second in first


@pytest.mark.parametrize("path", GUIDES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_a_guide_is_followed(path: Path, url: str, tmp_path: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    followed = steps(path)
    script = "".join(f"{code}\necho '{_MARK}'\n" for code, _ in followed).replace(_SERVICE, url)
    programs = tmp_path_factory.mktemp("programs")
    path = f"{programs}:{Path(sys.executable).parent}:{os.environ['PATH']}"
    with program(programs):
        ran = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", script],
            cwd=tmp_path,
            env={**os.environ, "COLUMNS": "200", "PATH": path},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=300,
            check=False,
        )
    assert ran.returncode == 0, ran.stdout
    for (code, text), output in zip(followed, ran.stdout.split(_MARK), strict=False):
        lines = iter(output.splitlines())
        for text_line in text.splitlines():
            assert any(says(line, text_line) for line in lines), (
                f"{text_line}\nis not in order in what came of\n{code}{output}"
            )


def test_the_program_runs_what_is_forked_here() -> None:
    [program] = entry_points(group="console_scripts", name="counterweight")
    assert program.load() is main


def test_every_kind_of_page_is_there() -> None:
    assert {path.parent.name for path in GUIDES} == {"tutorial", "how-to"}
    assert len(GUIDES) >= 8
    # pages without commands that can be run here are the exception
    assert [path.stem for path in GUIDES if not steps(path)] == ["postgresql"]


@pytest.mark.parametrize("name", ["2d12", "inline-four-engine", "scroll-three-pins"])
def test_the_pictures_show_the_machines_of_today(name: str) -> None:
    """Names and planes; positions are those of one machine to its last digits."""
    request = OptimizeRequest.model_validate(bodies("")[name])
    matches, drawn = (
        re.findall(r"<text[^>]*>([^<]*)", text)
        for text in ((ROOT / "docs" / f"{name}-side.svg").read_text(), pictures.svg(pictures.side(request)).decode())
    )
    assert matches == drawn
    assert any(f"({name}-side.svg)".replace("(", "(../") in path.read_text() for path in GUIDES)


def test_lines_are_compared_by_words_and_figures() -> None:
    assert says("│ peak force, N │ 10006.1 │ 5003.07 │", "│ peak force, N │ 10006.2 │")
    assert not says("│ peak force, N │ 10006.1 │", "│ peak force, N │ 10106.1 │")
    assert not says("│ peak force, N │", "│ peak moment, N m │")
