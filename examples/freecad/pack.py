"""Pack the workbench, the client of the service built in: ``python examples/freecad/pack.py Counterweight.zip``."""

import sys
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

HERE = Path(__file__).resolve().parent
WORKBENCH = HERE / "Counterweight"
CLIENT = HERE.parent / "client" / "counterweight.py"


def pack(archive: Path) -> None:
    """Write an archive of the folder as it belongs into `Mod`; equal files give equal bytes."""
    files = {path: path.relative_to(HERE) for path in sorted(WORKBENCH.rglob("*")) if path.is_file()}
    files[CLIENT] = Path(WORKBENCH.name, "freecad", "counterweight", CLIENT.name)
    with ZipFile(archive, "w") as target:
        for path, place in files.items():
            if path.suffix != ".pyc":
                # a file of no date
                target.writestr(ZipInfo(place.as_posix()), path.read_bytes(), ZIP_DEFLATED)


if __name__ == "__main__":
    pack(Path(sys.argv[1]))
