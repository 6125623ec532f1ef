"""FreeCAD: where it is, and how it is installed where that may be done (``python -m tests.freecad.freecad``)."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

from tests.debian import install, say_missing

ROOT = Path(__file__).parents[2]
WORKBENCH = ROOT / "examples" / "freecad" / "Counterweight"
CLIENT = ROOT / "examples" / "client" / "counterweight.py"
MISSING = (
    "FreeCAD is missing: the workbench of examples/freecad was NOT TESTED. "
    "Install it (Debian: apt-get install freecad xvfb)."
)
_NAMES = ("freecadcmd", "FreeCADCmd")
#: all packages together, downloading and unpacking
_INSTALL_WITHIN_S = 300.0
#: from the environment of whoever runs the tests
_FOREIGN = ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV", "COUNTERWEIGHT_KEY")


def find() -> str | None:
    """Path of an installed FreeCAD without a window; the variable FREECADCMD names another one."""
    return os.environ.get("FREECADCMD") or next(filter(None, map(shutil.which, _NAMES)), None)


def packed(folder: Path) -> Path:
    """The workbench as it is packed, unpacked in a folder."""
    archive = folder / "Counterweight.zip"
    subprocess.run([sys.executable, WORKBENCH.parent / "pack.py", archive], check=True, timeout=60)
    with ZipFile(archive) as files:
        files.extractall(folder)
    return folder / "Counterweight"


def environment_for(home: Path, workbench: Path = WORKBENCH, **settings: str) -> dict[str, str]:
    """An environment with a home of its own, where the workbench is installed and nobody's settings are."""
    mods = home / ".local" / "share" / "FreeCAD" / "Mod"
    mods.mkdir(parents=True, exist_ok=True)
    if not (mods / "Counterweight").exists():
        (mods / "Counterweight").symlink_to(workbench)
    fields = {name: value for name, value in os.environ.items() if name not in _FOREIGN and not name.startswith("XDG_")}
    # what it compiles stays out of the repository
    return {**fields, "HOME": str(home), "PYTHONDONTWRITEBYTECODE": "1", **settings}


def main() -> None:
    if find() is None:
        install("freecad", "xvfb", "xauth", within_s=_INSTALL_WITHIN_S)
    if find() is None:
        say_missing(MISSING)


if __name__ == "__main__":
    main()
