"""Every example of docs/clients.md runs, and prints what stands below it."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.clients.conftest import CLIENT, ROOT

_EXAMPLE = re.compile(r"```(sh|python|javascript)\n(.*?)```\n(?:\n```text\n(.*?)```)?", re.DOTALL)
_WRITTEN = "http://127.0.0.1:8000"
_RUN = {
    "sh": ("examples.sh", ["bash", "-euo", "pipefail"]),
    "python": ("examples.py", [sys.executable]),
    "javascript": ("examples.mjs", ["node"]),
}


@pytest.mark.parametrize("language", _RUN)
def test_the_examples_print_what_stands_below_them(language: str, url: str, tmp_path: Path) -> None:
    name, command = _RUN[language]
    if shutil.which(command[0]) is None:
        pytest.skip(f"{command[0]} is not installed: the examples in {language} were NOT run")
    values = [match for match in _EXAMPLE.findall((ROOT / "docs/clients.md").read_text()) if match[0] == language]
    (tmp_path / name).write_text("".join(code.replace(_WRITTEN, url) for _, code, _ in values))
    for file in (CLIENT, *CLIENT.parent.glob("verify*.py")):
        shutil.copy(file, tmp_path)
    environment = {**os.environ, "PYTHONPATH": ""}
    ran = subprocess.run(
        [*command, name], cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=180, check=False
    )
    assert ran.returncode == 0, ran.stderr
    # what head -c leaves without an end of line is no difference
    assert ran.stdout.split() == "".join(output for _, _, output in values).replace("%PDF-\n", "%PDF-").split()


def test_every_language_has_an_example_of_every_route() -> None:
    text = (ROOT / "docs/clients.md").read_text()
    # tests/clients/test_typed.py runs those
    typed = ("TypeScript\n", "C#\n")
    for section in (part for part in text.split("\n## ")[1:] if not part.startswith(typed)):
        assert {language for language, _, _ in _EXAMPLE.findall(section)} == set(_RUN), section.splitlines()[0]
