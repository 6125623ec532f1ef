"""The files of the jobs: one for each chunk, complete or absent, with a digest that the database knows."""

import hashlib
import logging
import os
import shutil
import threading
import uuid
from collections.abc import Container, Iterable
from contextlib import ExitStack, suppress
from errno import EACCES, EIO, EISDIR, ELOOP, ENOENT, ENOTDIR, ENXIO
from io import BufferedReader
from pathlib import Path
from stat import S_ISREG
from typing import BinaryIO

from service.common.private import FILE, make_folder
from service.common.replacing import HALF, replaced, synchronise
from service.jobs.job import Record

_LOG = logging.getLogger(__name__)
_FLAG = "stop"
_MARK = ".database"
#: what is wrong with a file for good, by the error of opening or reading it; others may pass
_DAMAGES = {ENOENT: "missing", ENOTDIR: "missing", EISDIR: "no file", ELOOP: "no file", ENXIO: "no file"}
_DAMAGES[EIO] = "unreadable"
#: of two threads that find the same, one sets it aside
_ASIDE = threading.Lock()


class Damaged(Exception):
    """A file is missing, or is not what was written."""

    def __init__(self, record: Record, reason: str) -> None:
        # both, so that it can be handed over between processes
        super().__init__(record, reason)
        self.record, self.reason = record, reason


class FilesUnavailable(Exception):
    """The folder of the jobs cannot be read now; a retry may help."""


def digest(content: bytes) -> str:
    """The digest of a file."""
    return hashlib.sha256(content).hexdigest()


def verified(path: Path, record: Record) -> BinaryIO:
    """A file from its beginning, if it is what was written; it need not be held in memory whole.

    Raises
    ------
    Damaged, FilesUnavailable
    """
    with ExitStack() as refused:
        try:
            file = refused.enter_context(_open(path))
            if not S_ISREG(os.fstat(file.fileno()).st_mode):
                raise Damaged(record, "no file")
            checksum = hashlib.file_digest(file, "sha256").hexdigest()
            file.seek(0)
        except OSError as error:
            damage = _damage(path, error)
            if damage is not None:
                raise Damaged(record, damage) from None
            raise FilesUnavailable(f"the files of the sweeps cannot be read: {error.strerror}") from error
        if record.digest is not None and checksum != record.digest:
            raise Damaged(record, "damaged")
        refused.pop_all()
    return file


def _open(path: Path) -> BufferedReader:
    # a named pipe would be waited for until somebody writes to it
    return open(os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK), "rb")


def _damage(path: Path, error: OSError) -> str | None:
    """What is wrong with a file for good; None where it may be read later."""
    if error.errno == EACCES:
        # that of another user is whole, and this one lacks the right to it
        with suppress(OSError):
            if path.lstat().st_uid == os.geteuid():
                return "unreadable"
    return _DAMAGES.get(error.errno or 0)


class JobFiles:
    """A folder with a folder for each job. Ids come from the database, never from a client.

    Files are named for what they hold, so that none is ever replaced by another one while it is read.

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

    def piece(self, job: str, record: Record) -> Path:
        """The file of some rows, or of the rows that were selected."""
        name = _rows(record)
        return self.folder(job) / (name if record.digest is None else f"{name}-{record.digest[:16]}")

    def opened(self, job: str, record: Record) -> BinaryIO:
        """A file, verified.

        Raises
        ------
        Damaged, FilesUnavailable
        """
        return verified(self.piece(job, record), record)

    def absent(self, job: str, records: Iterable[Record]) -> list[Record]:
        """Those of some files that are not there, or are no files."""
        names = self._file_names(job)
        there = {*names, *(_rows_of(name) for name in names)}
        return [record for record in records if self.piece(job, record).name not in there]

    def _file_names(self, job: str) -> list[str]:
        with suppress(FileNotFoundError, NotADirectoryError), os.scandir(self.folder(job)) as entries:
            return [entry.name for entry in entries if _is_file(entry)]
        return []

    def keep(self, job: str, start: int, stop: int, content: bytes) -> Record:
        """Write the file of some rows, in one step and on disk when this returns.

        Raises
        ------
        OSError
            if the disk is full or broken; then nothing has changed.
        """
        record = Record(start, stop, digest(content), len(content))
        self._write(self.piece(job, record), content)
        return record

    def renamed_file(self, job: str, record: Record) -> Record:
        """Write a file that is older than digests once more, under the name that its content gives it.

        The older one stays until the database knows the digest, so that a crash in between loses nothing.

        Raises
        ------
        Damaged, FilesUnavailable, OSError
        """
        with self.opened(job, record) as file:
            content = file.read()
        return self.keep(job, record.start, record.stop, content)

    def drop(self, job: str, record: Record) -> None:
        """Remove the file of some rows."""
        # what stays is removed when the job has ended
        with suppress(OSError):
            self.piece(job, record).unlink()

    def _write(self, path: Path, content: bytes) -> None:
        with _ASIDE:
            if os.path.lexists(path.parent) and not path.parent.is_dir():
                _set_file_aside(path.parent)
        _make(path.parent)
        if path.is_dir() and not path.is_symlink():
            # all else is replaced as a file is
            _set_folder_aside(path)
        with replaced(path, FILE) as file:
            file.write(content)

    def stop(self, job: str) -> None:
        """Tell the workers of a job to stop."""
        # without the flag they stop at the end of their chunks
        with suppress(OSError):
            _make(self.folder(job))
            self.flag(job).touch()

    def go(self, job: str) -> None:
        """Take the flag away."""
        try:
            self.flag(job).unlink(missing_ok=True)
        except IsADirectoryError:
            _set_folder_aside(self.flag(job))

    def remove(self, job: str) -> None:
        """Remove every file of a job."""
        with suppress(FileNotFoundError):
            try:
                shutil.rmtree(self.folder(job))
            except NotADirectoryError:
                self.folder(job).unlink()

    # ---- what crashes leave behind

    def names(self, job: str) -> list[str]:
        """Everything that is in the folder of a job."""
        with suppress(FileNotFoundError, NotADirectoryError):
            return os.listdir(self.folder(job))
        return []

    def tidy(self, job: str, names: Iterable[str], records: Iterable[Record]) -> int:
        """Remove those of some names that are no file of the job; how many that were."""
        files = list(records)
        names_of_files = {_FLAG, *(self.piece(job, record).name for record in files)}
        # a reader may be writing them once more, or about to tell the database their digests
        older = {_rows(record) for record in files if record.digest is None}
        gone = 0
        for name in set(names) - names_of_files:
            if _rows_of(name.removeprefix(HALF)) in older:
                continue
            with suppress(OSError):
                (self.folder(job) / name).unlink()
                gone += 1
        return gone

    def belongs_to(self, identity: str) -> bool:
        """Whether the jobs in this folder are those of a database; a folder of nobody becomes its own."""
        mark = self._root / _MARK
        with suppress(OSError):
            if not mark.exists():
                self._write(mark, identity.encode())
            # of a service that was killed while it wrote the mark; one that still writes it tries again
            for half in self._root.glob(f".{_MARK}.*"):
                half.unlink(missing_ok=True)
            return mark.read_bytes() == identity.encode()
        return False

    def folders(self) -> list[str]:
        """The jobs that have a folder."""
        with suppress(FileNotFoundError):
            return [entry.name for entry in os.scandir(self._root) if entry.is_dir(follow_symlinks=False)]
        return []

    def remove_unknown(self, folders: Iterable[str], jobs: Container[str]) -> int:
        """Remove those of some folders that belong to no job; how many that were."""
        gone = 0
        for job in folders:
            if job not in jobs:
                with suppress(OSError):
                    shutil.rmtree(self.folder(job))
                    gone += 1
        return gone


def _rows(record: Record) -> str:
    return f"{record.start:09d}-{record.stop:09d}"


def _rows_of(name: str) -> str:
    return "-".join(name.split("-")[:2])


def _is_file(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_file()
    except OSError:
        # a link that leads to itself
        return False


# what somebody has put in place of a file or folder of a job is kept: nobody knows what it holds. Another service may
# do the same, and what belongs there may have come meanwhile: neither of these calls takes that


def _set_folder_aside(path: Path) -> None:
    aside = _aside(path)
    with suppress(FileNotFoundError, NotADirectoryError):
        # with a slash it is renamed only if it is a folder
        os.rename(f"{path}/", aside)
        _LOG.error("%s was a folder; it is set aside as %s", path, aside.name)


def _set_file_aside(path: Path) -> None:
    aside = _aside(path)
    with suppress(FileNotFoundError, IsADirectoryError, PermissionError):
        os.link(path, aside, follow_symlinks=False)
        path.unlink()
        _LOG.error("%s was no folder; it is set aside as %s", path, aside.name)


def _aside(path: Path) -> Path:
    return path.with_name(f"{path.name}.aside-{uuid.uuid4().hex[:8]}")


def _make(folder: Path) -> None:
    if not folder.exists():
        _make(folder.parent)
        make_folder(folder)
        synchronise(folder.parent)
