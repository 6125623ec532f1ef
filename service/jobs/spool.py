"""Input and results of workers, through files instead of pipes.

The pipes of a process pool hold some 64 kB. A worker that is killed in the middle of a longer message leaves half of it
there, and the pool waits for the other half for ever (CPython issue 94777). So pipes carry short messages only, which
they take whole.
"""

import fcntl
import os
import pickle
import shutil
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import Executor, Future, InvalidStateError
from contextlib import suppress
from pathlib import Path

from service.jobs.piece import ChunkResult

#: bytes; a pipe takes less than this in one step
_SHORT = 8000
_PREFIX = "counterweight-spool-"
#: locked for as long as the service lives that made the folder; the system unlocks it, however the service ends
_LOCK = "lock"
#: a folder without its lock is as young as that, or nobody's [s]
_MAKING_S = 60.0


class Spool:
    """A folder of messages, and an executor that hands them on.

    Parameters
    ----------
    executor : its workers are on this machine.
    """

    def __init__(self, executor: Executor) -> None:
        self._executor = executor
        self._folder = tempfile.mkdtemp(prefix=_PREFIX)
        self._lock = os.open(Path(self._folder, _LOCK), os.O_CREAT | os.O_RDWR | os.O_CLOEXEC, 0o600)
        fcntl.flock(self._lock, fcntl.LOCK_EX)

    def submit(self, task: Callable[..., ChunkResult], *arguments: object) -> "Future[ChunkResult]":
        """As :meth:`concurrent.futures.Executor.submit`."""
        message = _put(self._folder, pickle.dumps((task, arguments)))
        return _Unpacked(self._executor.submit(_work, self._folder, message))

    def remove(self) -> None:
        """Remove the folder; the workers are gone."""
        shutil.rmtree(self._folder, ignore_errors=True)
        with suppress(OSError):
            os.close(self._lock)


def remove_leftovers(root: Path | None = None) -> int:
    """Remove the folders of services that were killed, never that of one that lives; how many that were.

    Parameters
    ----------
    root : where the folders are; by default where temporary files go.
    """
    gone = 0
    for folder in Path(root or tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        with suppress(OSError):
            gone += _remove_if_left(folder)
    return gone


def _remove_if_left(folder: Path) -> bool:
    about = folder.lstat()
    if about.st_uid != os.getuid() or folder.is_symlink():
        return False
    try:
        lock = os.open(folder / _LOCK, os.O_RDWR | os.O_CLOEXEC | os.O_NOFOLLOW)
    except FileNotFoundError:
        if time.time() - about.st_mtime < _MAKING_S:
            return False
        shutil.rmtree(folder)
        return True
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        shutil.rmtree(folder)
        return True
    finally:
        os.close(lock)


class _Unpacked(Future[ChunkResult]):
    """The result of a message."""

    def __init__(self, source: "Future[bytes | Path]") -> None:
        super().__init__()
        self._source: Future[bytes | Path] | None = source
        source.add_done_callback(self._take)

    def cancel(self) -> bool:
        source = self._source
        if source is not None:
            source.cancel()
        return super().cancel()

    def _take(self, source: "Future[bytes | Path]") -> None:
        # each holds the other, and with it megabytes until the next collection of garbage
        self._source = None
        # the future may have been cancelled while the message was on its way
        with suppress(InvalidStateError):
            if source.cancelled():
                super().cancel()
                return
            try:
                self.set_result(pickle.loads(_get(source.result())))
            except InvalidStateError:
                raise
            except BaseException as error:
                self.set_exception(error)


def _work(folder: str, message: bytes | Path) -> bytes | Path:
    task, arguments = pickle.loads(_get(message))
    return _put(folder, pickle.dumps(task(*arguments)))


def _put(folder: str, content: bytes) -> bytes | Path:
    if len(content) < _SHORT:
        return content
    try:
        handle, name = tempfile.mkstemp(dir=folder)
        with os.fdopen(handle, "wb") as file:
            file.write(content)
    except OSError:
        # no room: the pipe is the better way after all
        return content
    return Path(name)


def _get(message: bytes | Path) -> bytes:
    if isinstance(message, bytes):
        return message
    content = message.read_bytes()
    message.unlink()
    return content
