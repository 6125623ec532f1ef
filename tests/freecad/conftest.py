"""FreeCAD in a process of its own, and a real service on loopback."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.clients.conftest import url
from tests.freecad.freecad import MISSING, environment_for, find

__all__ = ["url"]

INSIDE = Path(__file__).parent / "inside"
#: generous: other tests run beside it
_WITHIN_S = 300.0

Run = Callable[..., dict[str, Any]]


@pytest.fixture(scope="session")
def freecadcmd() -> str:
    command = find()
    if command is None:
        pytest.skip(MISSING)
    return command


@pytest.fixture
def run(freecadcmd: str, url: str, tmp_path: Path) -> Run:
    """Run a script of `inside` in FreeCAD; what it found out."""

    def ran(script: str, **settings: str) -> dict[str, Any]:
        path = tmp_path / "found.json"
        path.unlink(missing_ok=True)
        settings = {"URL": url, "FOLDER": str(tmp_path), "FOUND": str(path), **settings}
        process = subprocess.run(
            [freecadcmd, str(INSIDE / "run.py")],
            env=environment_for(tmp_path / "home", INSIDE=str(INSIDE), SCRIPT=script, **settings),
            cwd=tmp_path,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=_WITHIN_S,
            check=False,
        )
        assert process.returncode == 0, process.stdout[-4000:] + process.stderr[-2000:]
        document: dict[str, Any] = json.loads(path.read_text())
        return document

    return ran
