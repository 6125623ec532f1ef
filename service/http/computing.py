"""A computation behind a route: bytes in, bytes out, in a worker process and only so many at a time."""

import asyncio
import logging
from collections.abc import AsyncIterator
from contextlib import ExitStack
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, BinaryIO, TypeVar

from anyio import CapacityLimiter, to_thread
from fastapi import Depends
from starlette.requests import Request
from starlette.responses import Response, StreamingResponse

from schemas.base.model import Model
from service.common.coding import Coding
from service.common.validation import read_request
from service.computations.computation import XLSX, Computation, Form
from service.fairness.quotas import holding
from service.fairness.threads import threads_of
from service.guard.sizes import SizeLimits
from service.http.accept import NotAcceptable, coding_of, negotiate
from service.http.file_names import file_name
from service.http.request_body import announced, read_body
from service.jobs.accepting import accepted, desk_of, idempotency_key, prefers_later
from service.settings import Settings
from service.watch.metrics import Metrics
from service.watch.readiness import Readiness
from service.watch.tracing import Tracing
from service.wire.leaving import Waited
from service.workers.pool import Pool
from service.workers.task import Task
from service.workers.worker import Answer, Crashed, Outcome, Refused

Header = tuple[bytes, bytes]
Question = TypeVar("Question", bound=Model)

_LOG = logging.getLogger(__name__)
#: headers of a request that its answer depends on; what they say is kept up to so many bytes
_OF_ANSWERS = frozenset({b"accept", b"accept-encoding", b"content-encoding", b"content-type", b"prefer"})
_SHORT = 512
#: of a large answer that is in a file, read at a time [bytes], by so many threads
_PIECE_BYTES = 65_536
_READERS = 4


class ComputationFailed(Exception):
    """The service is at fault; its log says where."""


class Computing:
    """Computes answers, once the service is ready."""

    def __init__(
        self, settings: Settings, readiness: Readiness, pool: Pool, metrics: Metrics, tracing: Tracing
    ) -> None:
        self._max_body_bytes = settings.max_body_bytes
        self._body_timeout_s = settings.body_timeout_s
        self._quotes = settings.log_machines
        self._readiness = readiness
        self._pool = pool
        self._metrics = metrics
        self._tracing = tracing
        self._readers = CapacityLimiter(_READERS)
        self.limits = SizeLimits.of(settings)

    async def body(self, request: Request) -> bytes:
        """The JSON body of a request that needs the solver.

        Raises
        ------
        NotReady, UnsupportedMedia, BodyTooLarge, BodyTooSlow, OverShare
        """
        self._readiness.require()
        announced(request)
        return await self._body(request)

    async def _body(self, request: Request) -> bytes:
        body = await read_body(request, self._max_body_bytes, self._body_timeout_s, holding(request))
        if self._quotes:
            request.state.body = body
        return body

    def question(self, model: type[Question], body: bytes) -> Question:
        """The request in a body; one that is too large for this service is refused.

        Raises
        ------
        UnreadableJson, InvalidRequest
        """
        question = read_request(model, body)
        self.limits.require(question)
        return question

    async def answer(self, request: Request, computation: Computation) -> Response:
        """The answer to the question in the body, or a job if the client prefers to be answered later.

        Raises
        ------
        NotAcceptable, BadHeader, NotReady, UnsupportedMedia, BodyTooLarge, BodyTooSlow, UnreadableBody, InvalidRequest,
        OverShare, MissingInput, OutOfRange, OutOfMemory, Busy, TooSlow, WorkerDied, WorkersFailed, ClientGone
            all of which have a row in the tables that :mod:`service.app` joins, as those of jobs have.
        """
        self._readiness.require()
        # a key that is none is refused whether it counts here or not
        key = idempotency_key(request) if computation.later else None
        wishes = _wishes(request, computation)
        form, workbook = wishes.form, wishes.workbook
        body = await self._body(request)

        def accept() -> Response:
            question = self.question(computation.request_model, body).model_dump_json().encode()
            return accepted(request, *desk_of(request).later(computation.name, question, key, body))

        # a job is in JSON; other forms are answered at once, as RFC 7240 allows
        if computation.later and wishes.later and not workbook and form is computation.forms[0]:
            return await threads_of(request).run(holding(request).who, accept)

        long = computation.long_by_kind(form, workbook)
        task = Task(computation, form, body, self.limits, wishes.coding, workbook, long)
        with self._tracing.span(computation.name), Waited(request):
            outcome = await self._pool.run(task, holding(request).who)
        if self._pool.queued:
            # whose turn it is now is handed to the worker before this answer is written: it would wait for that
            await asyncio.sleep(0)
        reply = self._judged(outcome, computation.name)
        headers = [*wishes.headers, (b"content-length", b"%d" % reply.size)]
        if reply.stem is not None:
            disposition = f"inline; {file_name(reply.stem, form.suffix)}"
            headers.append((b"content-disposition", disposition.encode("latin-1")))
        if reply.coding is not None:
            headers.append((b"content-encoding", reply.coding.encode()))
        if reply.file is None:
            return _RawResponse(reply.content, headers)
        with ExitStack() as refused:
            refused.enter_context(reply.file)
            holding(request).take("files", reply.size)
            refused.pop_all()
        stream = StreamingResponse(self._read(reply.file))
        stream.raw_headers = headers
        return stream

    async def _read(self, file: BinaryIO) -> AsyncIterator[bytes]:
        """What is in a file, as far as the client has read what was before."""
        with file:
            while piece := await to_thread.run_sync(file.read, _PIECE_BYTES, limiter=self._readers):
                yield piece

    def _judged(self, outcome: Outcome, name: str) -> Answer:
        if isinstance(outcome, Refused):
            raise outcome.error
        if isinstance(outcome, Crashed):
            # the message of an exception may quote the request
            _LOG.error("%s failed\n%s%s", name, outcome.trace, f": {outcome.message}" if self._quotes else "")
            raise ComputationFailed(name)
        for fault in outcome.faults:
            _LOG.error("%s: %s", name, fault)
        self._metrics.computed(name, outcome)
        return outcome


@dataclass(frozen=True)
class _Wishes:
    """What the headers of a request say of its answer, and what those of an answer say in any case.

    workbook : whether the body is one.
    later : whether it may be a job.
    """

    form: Form
    workbook: bool
    later: bool
    coding: Coding | None
    headers: tuple[Header, ...]

    @classmethod
    def of(cls, request: Request, computation: Computation) -> "_Wishes":
        form = _form(request, computation)
        workbook = announced(request, XLSX if computation.workbook else None) == XLSX
        varies = "Accept, Accept-Encoding" if len(computation.forms) > 1 else "Accept-Encoding"
        fields = {"Cache-Control": "no-store", **dict(form.headers), "Vary": varies}
        headers = Response(media_type=form.media_type, headers=fields).raw_headers
        always = tuple(header for header in headers if header[0] != b"content-length")
        return cls(form, workbook, prefers_later(request), coding_of(request), always)


def _wishes(request: Request, computation: Computation) -> _Wishes:
    """What the headers of a request say of its answer; they are few, and to read them takes as long as all else.

    Raises
    ------
    NotAcceptable, UnsupportedMedia
    """
    headers = tuple([header for header in request.scope["headers"] if header[0] in _OF_ANSWERS])
    read = _wishes_of if sum([len(value) for _, value in headers]) <= _SHORT else _wishes_of.__wrapped__
    return read(headers, computation)


@lru_cache(maxsize=256)
def _wishes_of(headers: tuple[Header, ...], computation: Computation) -> _Wishes:
    return _Wishes.of(Request({"type": "http", "headers": headers}), computation)


class _RawResponse(Response):
    """Bytes and headers as they go out."""

    def __init__(self, content: bytes, headers: list[Header]) -> None:
        self.status_code, self.background = 200, None
        self.body, self.raw_headers = content, headers


def _form(request: Request, computation: Computation) -> Form:
    """The form that a client accepts best; of what there is in one form only, and of answers in JSON, that one."""
    first, *rest = computation.forms
    if not rest:
        return first
    offered = {form.media_type: form for form in computation.forms}
    form = negotiate(request, offered)
    if form is None:
        if computation.answer is None:
            raise NotAcceptable(tuple(offered))
        # as it was answered before there were other forms
        return first
    return form


def computing_of(request: Request) -> Computing:
    """The application's :class:`Computing`."""
    result: Computing = request.app.state.computing
    return result


async def computing(request: Request) -> Computing:
    """The same, as routes of the framework ask for it; without a thread."""
    return computing_of(request)


Computes = Annotated[Computing, Depends(computing)]
