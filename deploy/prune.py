"""Take out of an environment what unused.txt names, and out of the packages' own lists of files as well. Take out of
its shared libraries what only debuggers and linkers read.

    /opt/counterweight/bin/python deploy/prune.py deploy/unused.txt

Of the environment whose interpreter runs it. A line that finds nothing is an error: the list is of what there is.
"""

import csv
import io
import struct
import sys
import sysconfig
from importlib.metadata import distributions
from pathlib import Path

#: how a file of the Executable and Linkable Format begins that is of 64 bits, the lowest first
_ELF = b"\x7fELF\x02\x01"
#: places in its header (System V ABI, chapter 4): of the table of segments, of that of sections; numbers of both
_SEGMENTS, _SECTIONS, _SIZE_OF_SEGMENT, _NUMBER_OF_SECTIONS = 32, 40, 54, 60


def entries(text: str) -> dict[str, str]:
    """What the lines of a list name, a package or with a slash a pattern of files, and the reason of each."""
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return {name: reason.strip() for name, _, reason in (line.partition(" ") for line in lines)}


def find(name: str, site: Path) -> list[Path]:
    """The files of a package, or those that a pattern finds and those in the folders that it finds."""
    if "/" in name:
        paths = list(site.glob(name))
        return [file for path in paths for file in (path.rglob("*") if path.is_dir() else [path]) if not file.is_dir()]
    of_package = (distribution.files or [] for distribution in distributions(name=name, path=[str(site)]))
    return [path for files in of_package for file in files if (path := site / file).exists()]


def prune(site: Path, names: list[str]) -> dict[str, int]:
    """Remove what each name finds in a folder of packages, and say how many bytes that were.

    Raises
    ------
    FileNotFoundError
        if a name finds nothing; nothing is removed then.
    """
    inventory = {name: find(name, site) for name in names}
    if nothing := [name for name, files in inventory.items() if not files]:
        raise FileNotFoundError(f"nothing is found by {', '.join(nothing)}")
    freed = dict.fromkeys(inventory, 0)
    for name, files in inventory.items():
        # some may be in what an earlier name removed
        for file in filter(Path.exists, set(files)):
            freed[name] += file.lstat().st_size
            file.unlink()
    # the innermost first
    for folder in sorted((path for path in site.rglob("*") if path.is_dir()), reverse=True):
        if not any(folder.iterdir()):
            folder.rmdir()
    for record in site.glob("*.dist-info/RECORD"):
        shorten(record, site)
    return freed


def shorten(record: Path, site: Path) -> None:
    """Leave in a package's list of files those that there are."""
    rows = list(csv.reader(io.StringIO(record.read_text("utf-8"))))
    remainder = [row for row in rows if (site / row[0]).exists()]
    if len(remainder) < len(rows):
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(remainder)
        record.write_text(text.getvalue(), "utf-8")


def strip(library: Path) -> int:
    """Leave of a shared library what is loaded, and say by how many bytes it is smaller.

    What stands behind the last segment is names and lines for debuggers, and the table of sections, which only linkers
    read. A file of another format stays as it is.
    """
    content = library.read_bytes()
    if not content.startswith(_ELF):
        return 0
    (table,) = struct.unpack_from("<Q", content, _SEGMENTS)
    size, number = struct.unpack_from("<HH", content, _SIZE_OF_SEGMENT)
    end = table + size * number
    for k in range(number):
        offset, length = (struct.unpack_from("<Q", content, table + size * k + place)[0] for place in (8, 32))
        end = max(end, offset + length)
    if end >= len(content):
        return 0
    bare = bytearray(content[:end])
    struct.pack_into("<Q", bare, _SECTIONS, 0)
    struct.pack_into("<HH", bare, _NUMBER_OF_SECTIONS, 0, 0)
    # never in place: the file may be linked to where packages are kept
    new = library.with_name(f"{library.name}.new")
    new.write_bytes(bare)
    new.chmod(library.stat().st_mode)
    new.replace(library)
    return len(content) - end


if __name__ == "__main__":
    unused = entries(Path(sys.argv[1]).read_text("utf-8"))
    site = Path(sysconfig.get_path("purelib"))
    freed = prune(site, list(unused))
    freed["symbols"] = sum(strip(path) for path in site.rglob("*.so*") if path.is_file() and not path.is_symlink())
    for name, size in sorted(freed.items(), key=lambda pair: -pair[1]):
        sys.stdout.write(f"{size / 1e6:7.1f} MB  {name}\n")
    sys.stdout.write(f"{sum(freed.values()) / 1e6:7.1f} MB  removed\n")
