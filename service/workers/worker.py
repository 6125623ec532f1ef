"""What runs in a worker: bytes of a request in, bytes of an answer out, one after the other."""

import errno
import gc
import math
import os
import pickle
import resource
import signal
import socket
import sys
import time
import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path
from tempfile import TemporaryFile
from threading import Thread
from typing import Any, BinaryIO

from optimizer.errors import NotComputable
from optimizer.numerics.records import record
from schemas.base.model import Model
from service.common.coding import SMALL_BYTES, Coding, coded
from service.common.faults import error_log
from service.common.private import make_folder
from service.common.time_slices import SHORT_S, set_slice
from service.common.validation import InvalidRequest, UnreadableBody, check, read_request
from service.fairness.length import long_by_size
from service.workers import lanes
from service.workers.messages import say
from service.workers.task import Task

#: below the event loop, above the workers of sweeps; tasks that are behind others are nicer
_NICENESS = 2
#: an answer that is larger goes to the service in a file
LARGE_BYTES = 262_144
#: memory is looked at once in so long [s]: to look takes as long as to read a small request
_LOOK_S = 0.02
#: objects made and not freed, after which those that hold one another are looked for: a refusal leaves some
_COLLECT_AFTER = 5_000
#: faults of the request; anything else is a fault of the service
REFUSALS = (UnreadableBody, InvalidRequest, NotComputable)


class OutOfMemory(Exception):
    """The computation needs more memory than its limit."""


class NoRoom(Exception):
    """There is no room on disk for a large answer; a retry may help."""


@record(frozen=True)
class Certified:
    """The proof of an optimum: method, seconds, certified relative gap."""

    method: str
    solve_s: float
    relative_gap: float


@record(frozen=True)
class Answer:
    """What a task came to.

    content : JSON, or a document as it is; empty if it is in a file.
    coding : by which the content is compressed; what is small is not.
    size : of the content, wherever it is [bytes].
    seconds : time of the whole computation.
    resident : memory that the worker holds, seen a moment ago at most [bytes].
    file : of a large content, without a name: it is gone when nobody reads it any more.
    faults : number of own answers that the service has reported as wrong, in the answer too.
    stem : what a file of the answer is called, without the ending; None where it has no name of its own.
    """

    content: bytes
    coding: Coding | None
    size: int
    seconds: float
    certified: Certified | None
    resident: int
    file: BinaryIO | None = None
    faults: tuple[str, ...] = ()
    stem: str | None = None


@dataclass(frozen=True)
class Refused:
    """The request is at fault: an exception, in parts, as many an exception cannot be made from its message alone."""

    kind: type[Exception]
    args: tuple[object, ...]
    fields: Mapping[str, object]

    @classmethod
    def because(cls, error: Exception) -> "Refused":
        return cls(type(error), error.args, vars(error))

    @property
    def error(self) -> Exception:
        error = self.kind.__new__(self.kind, *self.args)
        vars(error).update(self.fields)
        return error


@dataclass(frozen=True)
class Crashed:
    """The service is at fault; the traceback without messages, which may quote the request, and the messages."""

    trace: str
    message: str


@dataclass(frozen=True)
class Long:
    """The request is long, and nothing of it was computed: it has to wait for a turn of the long ones."""


Outcome = Answer | Refused | Crashed


@record(frozen=True)
class Reply:
    """What a worker says: the outcome of a task, for how long cores have computed it, and all its tasks so far [s]."""

    outcome: Outcome | Long
    computed_s: float
    altogether_s: float

    @property
    def parts(self) -> "Reply | Parts":
        """What is pickled of it: of an answer plain values, for pickle takes longer to find the classes of both."""
        outcome = self.outcome
        if not isinstance(outcome, Answer):
            return self
        proof = None if outcome.certified is None else tuple(vars(outcome.certified).values())
        return vars(outcome) | {"certified": None}, proof, self.computed_s, self.altogether_s

    @classmethod
    def of(cls, parts: "Reply | Parts") -> "Reply":
        """One of its parts."""
        if isinstance(parts, Reply):
            return parts
        fields, proof, computed_s, altogether_s = parts
        fields["certified"] = None if proof is None else Certified(*proof)
        return cls(Answer(**fields), computed_s, altogether_s)


#: fields of an answer, those of its proof, and both times of the reply
Parts = tuple[dict[str, Any], tuple[Any, ...] | None, float, float]


def serve(
    answers: socket.socket, first: socket.socket, further: socket.socket, memory_bytes: int, folder: Path | None
) -> None:
    """Answer tasks until the service ends; large answers go into files of a folder.

    First tasks come on one connection, others on another one. Answers go out on a third, which nobody reads here: who
    waits to read a connection is woken whenever something was taken from its other end.

    What went wrong at the start, if anything did, is said before the first answer.
    """
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(_NICENESS)
    # where the system has none, the service has said so
    with suppress(OSError):
        set_slice(SHORT_S)
    # private writable memory: what is shared with the process this was forked from does not move
    resource.setrlimit(resource.RLIMIT_DATA, (memory_bytes, memory_bytes))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    # collecting would touch, and so copy, everything that is shared
    gc.freeze()
    # what an answer holds goes with it: to look through it meanwhile for what does not takes 5 % of a large one
    gc.set_threshold(_COLLECT_AFTER)
    preload = sys.modules.get("service.workers.preload")
    answer = partial(_answer, answers, folder)
    try:
        answers.sendall(pickle.dumps(getattr(preload, "failure", None)))
        Thread(target=_compute_further, args=(first, further, answer), daemon=True).start()
        lanes.compute(lanes.FIRST, first, answer)
    except (BrokenPipeError, ConnectionResetError):
        return
    finally:
        _leave(further)


def _compute_further(first: socket.socket, further: socket.socket, answer: Callable[[Task], None]) -> None:
    try:
        lanes.compute(lanes.FURTHER, further, answer)
    finally:
        # whatever ended it, the process ends with it
        _leave(first)


def _leave(connection: socket.socket) -> None:
    """Have whoever reads a connection here read its end."""
    with suppress(OSError):
        connection.shutdown(socket.SHUT_RDWR)


def _answer(answers: socket.socket, folder: Path | None, task: Task) -> None:
    before_s = time.process_time()
    outcome = perform(task)
    now_s = time.process_time()
    _send(answers, Reply(outcome, now_s - before_s, now_s), folder)


def _send(connection: socket.socket, reply: Reply, folder: Path | None) -> None:
    """Hand over an outcome; of a large answer an open file, which the service need not hold in memory."""
    outcome = reply.outcome
    if not (isinstance(outcome, Answer) and len(outcome.content) > LARGE_BYTES):
        say(connection, reply.parts)
        return
    try:
        if folder is not None:
            make_folder(folder)
        with TemporaryFile(dir=folder) as file:
            file.write(outcome.content)
            file.seek(0)
            say(connection, replace(reply, outcome=replace(outcome, content=b"")).parts, file)
    except OSError as error:
        if error.errno not in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.ENOTDIR, errno.EACCES):
            raise
        full = NoRoom("There is no room on disk for so large an answer; try again later.")
        say(connection, replace(reply, outcome=Refused.because(full)))


def perform(task: Task) -> Outcome | Long:
    """The outcome of a task; nothing escapes."""
    begun = time.perf_counter()
    try:
        with ExitStack() as places:
            request = _request(task, places)
            task.limits.require(request)
            if not task.long and long_by_size(request, task.computation.answer is None):
                return Long()
            with error_log() as faults:
                answer = task.computation.function(request)
        content = task.form.content(request, answer)
        coding = None if task.form.compressed or len(content) <= SMALL_BYTES else task.coding
        if coding is not None:
            content = coded(content, coding)
        seconds = time.perf_counter() - begun
        # a model takes long to say that it has none
        stem = getattr(answer, "file_stem", None) if task.computation.answer is None else None
        return Answer(
            content, coding, len(content), seconds, _certified(answer), _memory(), faults=tuple(faults), stem=stem
        )
    except REFUSALS as error:
        return Refused.because(error)
    except MemoryError:
        return Refused.because(OutOfMemory("The computation needs more memory than one request is given."))
    except Exception as error:
        return Crashed("\n".join(_frames(error)), str(error))


def _request(task: Task, places: ExitStack) -> Model:
    """The request of a task; until the stack ends problems of a workbook are said to be in its cells."""
    if not task.workbook:
        return read_request(task.computation.request_model, task.body)
    # only who sends workbooks pays for the library
    from service.workbook.body import cell_places, read_workbook

    cells = read_workbook(task.body)
    places.enter_context(cell_places(cells))
    return check(task.computation.request_model, cells.body)


def _frames(error: BaseException) -> Iterator[str]:
    for frame in traceback.extract_tb(error.__traceback__):
        yield f"{frame.filename}:{frame.lineno} in {frame.name}"
    yield type(error).__qualname__


def _certified(answer: object) -> Certified | None:
    proof = getattr(answer, "certificate", None)
    timing = getattr(answer, "timing", None)
    if proof is None or timing is None:
        return None
    gap = math.inf if proof.relative_gap is None else proof.relative_gap
    return Certified(proof.method, timing.solve_ms / 1000, gap)


class _Memory:
    """Resident memory of this process [bytes], 0 where the system does not tell it."""

    def __init__(self) -> None:
        self._resident, self._until = 0, -math.inf

    def __call__(self) -> int:
        now = time.perf_counter()
        if now >= self._until:
            self._resident, self._until = _resident(), now + _LOOK_S
        return self._resident


_memory = _Memory()


def _resident() -> int:
    try:
        pages = int(os.pread(_statm(os.getpid()), 256, 0).split()[1])
    except OSError:
        return 0
    return pages * resource.getpagesize()


# to open it takes as long as to check a small request
@cache
def _statm(pid: int) -> int:
    return os.open(f"/proc/{pid}/statm", os.O_RDONLY | os.O_CLOEXEC)
