"""What leaves FreeCAD: STEP read back, the service's drawings and bill; the same without a window in one command."""

import csv
import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ezdxf
import pytest

from tests.freecad.conftest import Run
from tests.freecad.freecad import WORKBENCH, environment_for, packed


def test_what_is_exported_is_what_was_drawn(run: Run, tmp_path: Path) -> None:
    process = run("files")
    # read back by FreeCAD: every mass, and where all of it is
    assert sorted(process["masses read back"]) == pytest.approx(sorted(process["masses"]), rel=1e-9)
    assert process["centre apart mm"] < 1e-6
    # drawn twice, by the service and here: mass, static and axial moment
    scale = max(map(abs, process["weights"]))
    assert process["of the service"] == pytest.approx(process["weights"], rel=1e-9, abs=1e-9 * scale)

    folder = tmp_path / "out"
    outlines = sorted(folder.glob("*.dxf"))
    assert outlines
    for path in outlines:
        drawing = ezdxf.readfile(path)
        assert not drawing.audit().has_errors
    assert len(list(folder.glob("counterweight-*.svg"))) == len(outlines)
    with (folder / "bill-of-material.csv").open(newline="") as file:
        bill = list(csv.DictReader(file))
    assert sum(float(line["mass, kg"]) for line in bill) == pytest.approx(process["weights"][0], rel=1e-9)
    assert (folder / "bill-of-material.xlsx").exists()
    assert not (folder / "counterweights.zip").exists()

    # what is not the answer's is not sent to a workshop
    assert "REFUSED" in process["refused"][0]
    assert process["nothing written"]


DESCRIBED: dict[str, Any] = {
    "density_kg_m3": 7850,
    "machine": {
        "name": "batch",
        "speed_rpm": 500,
        "throws": [{"rows": [{"axis_deg": axis, "reciprocating_mass_kg": 250}]} for axis in (0, 90)],
        "webs": [{"envelope": {"outer_radius_m": 0.36, "max_half_angle_deg": 80}} for _ in range(4)],
    },
    "objective": {"combine": "max"},
}


def batch(freecadcmd: str, workbench: Path, folder: Path, **settings: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [freecadcmd, str(workbench / "balance.py")],
        env=environment_for(folder / "home", workbench, **settings),
        cwd=folder,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


@pytest.mark.parametrize("function", [lambda _: WORKBENCH, packed], ids=["of a checkout", "packed"])
def test_a_shaft_in_and_a_balanced_shaft_out(
    run: Run, freecadcmd: str, url: str, tmp_path: Path, function: Callable[[Path], Path]
) -> None:
    workbench = function(tmp_path)
    run("step")
    described = tmp_path / "machine.json"
    described.write_text(json.dumps(DESCRIBED))
    settings = {
        "COUNTERWEIGHT_SHAFT": str(tmp_path / "imported.step"),
        "COUNTERWEIGHT_MACHINE": str(described),
        "COUNTERWEIGHT_FOLDER": str(tmp_path / "out"),
        "COUNTERWEIGHT_URL": url,
    }
    process = batch(freecadcmd, workbench, tmp_path, **settings)
    assert process.returncode == 0, process.stdout[-3000:]
    assert "HELD: the solids leave what the service says: peak force " in process.stdout
    assert "nothing of the shaft is in the way" in process.stdout
    assert {"balanced.step", "balanced.FCStd"} <= {path.name for path in (tmp_path / "out").iterdir()}

    described.write_text(json.dumps({**DESCRIBED, "machine": {**DESCRIBED["machine"], "throws": [{}]}}))
    command = batch(freecadcmd, workbench, tmp_path, **settings)
    assert (command.returncode, "throws: the faces show 2, 1 are described" in command.stdout) == (1, True)
    assert "Traceback" not in command.stdout
