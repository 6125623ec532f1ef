"""The files of the jobs: one for each chunk, complete or absent."""

import os
import shutil
from contextlib import suppress
from pathlib import Path

_FLAG = "stop"


class JobFiles:
    """A folder with a folder for each job. Ids come from the database, never from a client.

    Parameters
    ----------
    root : made when the first file is written.
    """

    def __init__(self, root: Path) -> None:
        self._root = root

    def folder(self, job: str) -> Path:
        return self._root / job

    def flag(self, job: str) -> Path:
        """The file whose presence tells workers to stop."""
        return self.folder(job) / _FLAG

    def piece(self, job: str, start: int, stop: int) -> Path:
        """The file of rows [start, stop)."""
        return self.folder(job) / f"{start:09d}-{stop:09d}"

    def kept(self, job: str) -> Path:
        """The file of the rows that the request keeps."""
        return self.folder(job) / "kept"

    def write(self, path: Path, content: bytes) -> None:
        """Put a file in place of what is there, in one step and on disk when this returns.

        Raises
        ------
        OSError
            if the disk is full or broken; then nothing has changed.
        """
        _make(path.parent)
        # a name of its own: two services may write the same chunk, with the same content
        temporary = path.with_name(f".{path.name}.{os.getpid()}")
        try:
            with temporary.open("wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            temporary.replace(path)
        except BaseException:
            # on a full disk this makes the room that the database needs to say so
            temporary.unlink(missing_ok=True)
            raise
        _sync(path.parent)

    def stop(self, job: str) -> None:
        """Tell the workers of a job to stop."""
        # without the flag they stop at the end of their chunks
        with suppress(OSError):
            self.flag(job).parent.mkdir(parents=True, exist_ok=True)
            self.flag(job).touch()

    def go(self, job: str) -> None:
        """Take the flag away."""
        self.flag(job).unlink(missing_ok=True)

    def remove(self, job: str) -> None:
        """Remove every file of a job."""
        folder = self.folder(job)
        if folder.exists():
            shutil.rmtree(folder)


def _make(folder: Path) -> None:
    if not folder.exists():
        _make(folder.parent)
        folder.mkdir(exist_ok=True)
        _sync(folder.parent)


def _sync(folder: Path) -> None:
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
