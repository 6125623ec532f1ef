"""The workbench in a window that nobody sees."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.freecad.conftest import INSIDE
from tests.freecad.freecad import MISSING, environment_for

#: generous: a window of 24 workbenches on a busy machine
_WITHIN_S = 600.0
#: without it Qt's browser of the start page refuses to run as root
_QT = {"QTWEBENGINE_DISABLE_SANDBOX": "1"}


def test_the_commands_of_the_menu(url: str, tmp_path: Path) -> None:
    if shutil.which("xvfb-run") is None or shutil.which("freecad") is None:
        pytest.skip(MISSING)
    path = tmp_path / "found.json"
    settings = {"URL": url, "FOLDER": str(tmp_path), "FOUND": str(path), "INSIDE": str(INSIDE), "SCRIPT": "window"}
    process = subprocess.run(
        ["xvfb-run", "-a", "-s", "-screen 0 1600x1000x24", "freecad", str(INSIDE / "run.py")],
        env=environment_for(tmp_path / "home", **settings, **_QT),
        cwd=tmp_path,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=_WITHIN_S,
        check=False,
    )
    assert process.returncode == 0, process.stdout[-4000:] + process.stderr[-2000:]
    assert "Traceback" not in process.stdout + process.stderr
    claim = json.loads(path.read_text())

    assert claim["workbench"] == "CounterweightWorkbench"
    assert len(claim["commands"]) == 6
    # eccentric round webs were found too, and are no pins
    assert claim["ticked"] == [True, True]
    assert sum("taken for a round web" in line for line in claim["shaft"]) == 4
    # mass and sizes are confirmed before anything is asked
    assert "confirm first: The shaft weighs " in claim["without a confirmation"]
    assert claim["shaft"][0] == f"<b>{claim['confirmed']}</b>"
    assert claim["confirmed"].endswith("(1 body of 7,850 kg/m3) and is 970 mm long; crank radius 140 mm.")
    assert len(set(claim["icons"])) == 6
    # what is missing is said at its cell, what was drawn in words
    assert "rows!2 (/machine/throws/0/rows/0/reciprocating_mass_kg): this field is required" in claim["without a speed"]
    assert claim["status"] == "balanced"
    assert "HELD: the solids leave what the service says" in claim["report"]
    assert claim["verdict"][0].startswith("<b>HELD: the solids leave what the service says: peak force ")
    assert "nothing is in the way of the counterweights" in claim["report"]
    for name in ("shaft.png", "view.png", "window.png"):
        assert (tmp_path / name).read_bytes().startswith(b"\x89PNG")
