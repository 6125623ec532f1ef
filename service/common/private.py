"""Folders and files that nobody else on the machine reads: machines of customers and what was computed of them."""

import os
import stat
from collections.abc import Container
from contextlib import suppress
from pathlib import Path

_FOLDER = 0o700
#: rights of a file
FILE = 0o600


def make_folder(folder: Path) -> None:
    """Make a folder and what is above it, if they are missing; those above it are as the umask says.

    Raises
    ------
    OSError
    """
    folder.mkdir(mode=_FOLDER, parents=True, exist_ok=True)


def make_file(file: Path) -> None:
    """Make an empty file, or close the one that is there.

    Raises
    ------
    OSError
        if there is none and it cannot be made.
    """
    if not file.exists():
        os.close(os.open(file, os.O_CREAT | os.O_WRONLY | os.O_CLOEXEC, FILE))
    close(file)


def close(path: Path) -> None:
    """Take the rights of others to a folder or file of this user, if it is there."""
    with suppress(OSError):
        about = path.stat()
        rights = stat.S_IMODE(about.st_mode)
        least = rights & (_FOLDER if stat.S_ISDIR(about.st_mode) else FILE)
        # a folder of another user was mounted, and a sticky one is there for everybody
        if rights != least and about.st_uid == os.geteuid() and not rights & stat.S_ISVTX:
            path.chmod(least)


def close_unless_shared(folder: Path, inside: Container[str]) -> None:
    """Close a folder that holds no folders but those named: others serve something else too, as a home or ``/srv``."""
    with suppress(OSError), os.scandir(folder) as entries:
        if all(entry.name in inside or not entry.is_dir() for entry in entries):
            close(folder)
