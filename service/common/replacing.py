"""Files that are whole, or as they were before: written under another name, synchronised, then renamed."""

import os
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

#: what the name of a file begins with that is not whole yet
HALF = "."


@contextmanager
def replaced(path: Path, mode: int = 0o666) -> Iterator[BinaryIO]:
    """A file to write to, which is at ``path`` and on disk when the block has ended.

    Parameters
    ----------
    mode : rights of a new file, less those that the umask takes.

    Raises
    ------
    OSError
        if the disk is full or broken; then nothing has changed, as when the block raises.
    """
    # a name that nobody else has: threads share a process id, and so do the first processes of all containers
    temporary = path.with_name(f"{HALF}{path.name[:40]}.{uuid.uuid4().hex}")
    try:
        with open(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode), "wb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    except BaseException:
        # on a full disk this makes the room that the database needs to say so
        temporary.unlink(missing_ok=True)
        raise
    synchronise(path.parent)


def synchronise(folder: Path) -> None:
    """Have the names in a folder on disk.

    Raises
    ------
    OSError
    """
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
