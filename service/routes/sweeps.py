"""Sweeps, and the other jobs that are answered later."""

import json
from collections.abc import Callable, Generator, Mapping
from itertools import chain
from typing import Annotated, BinaryIO, Literal

from fastapi import APIRouter, Depends, Query
from starlette.requests import Request
from starlette.responses import JSONResponse, Response, StreamingResponse

from schemas.sweep.answers import SweepEstimate, SweepState
from schemas.sweep.request import SweepRequest
from service.fairness.quotas import holding
from service.fairness.single_flight import shared_look
from service.fairness.threads import in_threads, threads_of
from service.guard.access import needs
from service.guard.keys import still_admitted
from service.http.accept import negotiate
from service.http.computing import Computes
from service.http.operations import (
    COMPUTE_PROBLEMS,
    accept,
    content_of,
    headers,
    links,
    on_disk,
    parameters,
    problems,
    request_body,
)
from service.http.stream import Stream
from service.jobs.accepting import accepted, desk_of, idempotency_key, prefix
from service.jobs.events import News, Watch, events, news
from service.jobs.formats import FORMATS, Name
from service.jobs.job import Job
from service.jobs.owner_jobs import OwnerJobs, Rows
from service.jobs.page import SweepPage
from service.jobs.results import description, schema_of
from service.jobs.worksheet import require_fits

Pieces = Generator[bytes, None, None]

router = APIRouter(tags=["sweeps"])


async def _jobs(request: Request) -> OwnerJobs:
    # not a thread for that
    return desk_of(request)


Jobs = Annotated[OwnerJobs, Depends(_jobs)]
#: a job may also come from a computing route, with Prefer: respond-async
_SEES = [needs("sweeps", "read", "compute")]
_ENDS = [needs("sweeps", "compute")]
_STARTS = [needs("sweeps")]
_BLOCK_BYTES = 262_144
_NO_STORE = {"Cache-Control": "no-store"}
_BY_MEDIA_TYPE: Mapping[str, Name] = {format_.media_type.split(";")[0]: name for name, format_ in FORMATS.items()}
_ROWS = {
    **{media_type: content_of(media_type) for media_type in _BY_MEDIA_TYPE},
    "application/json": {"schema": {"type": "object"}},
}


@router.post(
    "/v1/sweeps",
    operation_id="start_sweep",
    dependencies=_STARTS,
    summary="Thousands to millions of designs of one machine",
    status_code=202,
    response_model=SweepState,
    responses={
        200: {"description": "with `dry_run`: what the sweep would be", "model": SweepEstimate},
        **on_disk("the sweep is on disk and goes on by itself"),
        **problems(*COMPUTE_PROBLEMS, 409, 429),
    },
    openapi_extra={
        **request_body(SweepRequest, "sweeps"),
        "parameters": parameters("Idempotency-Key", "Prefer"),
    },
)
async def post_sweep(request: Request, computing: Computes, desk: Jobs) -> Response:
    """With the header `Idempotency-Key`, the same body sent again is the same sweep; another body is refused."""
    key = idempotency_key(request)
    body = await computing.body(request)
    workers: int = request.app.state.sweep_workers

    def work() -> Response:
        sweep = computing.question(SweepRequest, body)
        if sweep.dry_run:
            from optimizer.studies.sweep.plan import plan

            return Response(plan(sweep).estimate_for(workers).model_dump_json(), 200, _NO_STORE, "application/json")
        return accepted(request, *desk.sweep(sweep, key, body))

    return await threads_of(request).run(holding(request).who, work)


@router.get(
    "/v1/sweeps",
    operation_id="list_sweeps",
    dependencies=_SEES,
    summary="All sweeps, newest first",
    response_model=SweepPage,
    responses={200: {"links": links("$response.body#/sweeps/0/id")}, **problems(404, 422, 503)},
)
async def list_sweeps(
    request: Request,
    desk: Jobs,
    limit: Annotated[int, Query(ge=1, le=200, description="how many at most")] = 50,
    before: Annotated[str | None, Query(description="id of the sweep after which to go on", max_length=64)] = None,
) -> Response:
    where = prefix(request)

    def page() -> str:
        jobs = desk.page(limit + 1, before)
        more = f"{where}/v1/sweeps?limit={limit}&before={jobs[limit - 1].id}" if len(jobs) > limit else None
        return SweepPage(sweeps=tuple(desk.state(job, where) for job in jobs[:limit]), next=more).model_dump_json()

    return _json(await shared_look(request, (page.__qualname__, desk.view, where, limit, before), page))


@router.get(
    "/v1/sweeps/{id}",
    operation_id="read_sweep",
    dependencies=_SEES,
    summary="How far a sweep is",
    response_model=SweepState,
    responses=problems(404, 503),
)
async def read_sweep(request: Request, desk: Jobs, id: str) -> Response:  # noqa: A002
    where = prefix(request)

    def state() -> str:
        return desk.state(desk.get(id), where).model_dump_json()

    return _json(await shared_look(request, (state.__qualname__, desk.view, where, id), state))


@router.delete(
    "/v1/sweeps/{id}",
    operation_id="end_sweep",
    dependencies=_ENDS,
    summary="Cancel a sweep that runs, remove one that has ended",
    response_model=SweepState,
    responses={204: {"description": "removed, with its results"}, **problems(404, 503)},
)
@in_threads
def delete_sweep(request: Request, desk: Jobs, id: str) -> Response:  # noqa: A002
    """A cancelled sweep keeps the rows that are finished; delete it once more to remove them."""
    cancelled = desk.end(id)
    if cancelled is None:
        return Response(status_code=204)
    return _json(desk.state(cancelled, prefix(request)).model_dump_json())


@router.post(
    "/v1/sweeps/{id}/resume",
    operation_id="resume_sweep",
    dependencies=_STARTS,
    summary="Go on with a sweep that was cancelled or has failed",
    status_code=202,
    response_model=SweepState,
    responses={**on_disk("the sweep or job goes on by itself"), **problems(404, 503)},
)
@in_threads
def resume_sweep(request: Request, desk: Jobs, id: str) -> Response:  # noqa: A002
    """Finished rows are kept; a sweep that runs or is done stays as it is."""
    return accepted(request, desk.resume(id), new=True)


@router.get(
    "/v1/sweeps/{id}/metadata",
    operation_id="describe_sweep",
    dependencies=_SEES,
    summary="Request, versions, seed and columns of a sweep",
    response_class=JSONResponse,
    responses=problems(404, 503),
)
async def describe_sweep(request: Request, desk: Jobs, id: str) -> Response:  # noqa: A002
    """What a file of Parquet or Arrow holds itself, for CSV and NDJSON."""

    def described() -> str:
        job = desk.get(id)
        about = description(desk.schema(job)) if job.kind == "sweep" else {"kind": job.kind}
        return json.dumps(about, ensure_ascii=False, allow_nan=False, separators=(",", ":"))

    return _json(await shared_look(request, (described.__qualname__, desk.view, id), described))


@router.get(
    "/v1/sweeps/{id}/results",
    operation_id="read_sweep_results",
    dependencies=_SEES,
    summary="The rows of a sweep, in the order of their index",
    response_class=Response,
    responses={
        200: {
            "description": "rows, or the answer of another job",
            "content": _ROWS,
            "headers": headers("Content-Disposition", "Link", "Sweep-Complete", "Sweep-State"),
        },
        **problems(404, 409, 422, 503),
    },
    openapi_extra={"parameters": [accept(*_BY_MEDIA_TYPE)]},
)
@in_threads
def read_results(
    request: Request,
    desk: Jobs,
    id: str,  # noqa: A002
    format: Annotated[Name | None, Query(description="format; by default as `Accept` asks, or NDJSON")] = None,  # noqa: A002
    offset: Annotated[int, Query(ge=0, le=2**62, description="index of the first row")] = 0,
    limit: Annotated[int | None, Query(ge=1, le=2**62, description="how many indices at most")] = None,
    columns: Annotated[list[str] | None, Query(description="columns, with commas between them or repeated")] = None,
    select: Annotated[
        Literal["kept", "all"], Query(description="the rows that `top` or `pareto` of the request keep, or all")
    ] = "kept",
) -> Response:
    """Of a sweep that runs, the rows that are finished so far: `Sweep-Complete` says whether these are all."""
    job = desk.get(id)
    if job.kind != "sweep":
        return _streamed(request, _blocks(desk.answer(job)), "application/json", _NO_STORE)
    # who likes none of them is not refused
    name = format or negotiate(request, _BY_MEDIA_TYPE) or "ndjson"
    schema = schema_of(desk.schema(job), columns or ())
    last = None if limit is None else offset + limit
    rows = (desk.selection if select == "kept" and job.selects else desk.rows)(job, schema, offset, last)
    if name == "xlsx":
        require_fits(max(0, (rows.count if last is None else min(last, rows.count)) - offset), len(schema))
    more = last if last is not None and last < rows.count else None
    return _stream(request, job, name, rows, FORMATS[name].encode(schema, rows.batches), more)


def _stream(request: Request, job: Job, name: Name, rows: Rows, content: Pieces, more: int | None) -> Response:
    here = f"{prefix(request)}/v1/sweeps/{job.id}"
    links = [f'<{here}/metadata>; rel="describedby"; type="application/json"']
    if more is not None:
        following = request.url.include_query_params(offset=more).query
        links.append(f'<{here}/results?{following}>; rel="next"')
    headers: Mapping[str, str] = {
        **_NO_STORE,
        "Content-Disposition": f'attachment; filename="sweep-{job.id[:8]}.{name}"',
        "Link": ", ".join(links),
        "Sweep-Complete": "true" if rows.complete else "false",
        "Sweep-State": job.state,
        "Vary": "Accept",
    }
    return _streamed(request, content, FORMATS[name].media_type, headers)


def _streamed(request: Request, content: Pieces, media_type: str, headers: Mapping[str, str]) -> Response:
    """What is read as fast as its client reads it."""
    if request.scope.get("head"):
        return _head(headers, media_type)
    holding(request).take("rows")
    # what goes wrong at once is answered with a status
    first = next(content, b"")
    pieces = threads_of(request).pieces(holding(request).who, chain((first,), content))
    return Stream(pieces, content, media_type, headers)


def _blocks(opened: Callable[[], BinaryIO]) -> Pieces:
    with opened() as file:
        while block := file.read(_BLOCK_BYTES):
            yield block


@router.get(
    "/v1/sweeps/{id}/events",
    operation_id="watch_sweep",
    dependencies=_SEES,
    summary="Progress as server-sent events, from the last state to the end",
    response_class=Response,
    responses={
        200: {"description": "events `progress` and `end`", "content": {"text/event-stream": {}}},
        204: {"description": "nothing is newer than `Last-Event-ID`, and nothing will be"},
        **problems(404, 503),
    },
    openapi_extra={"parameters": parameters("Last-Event-ID")},
)
async def watch_sweep(request: Request, desk: Jobs, id: str) -> Response:  # noqa: A002
    """The data of an event is the state of the sweep; after `Last-Event-ID` only what is new is told."""
    where = prefix(request)

    def look() -> News:
        return news(desk, desk.get(id), where)

    first = await shared_look(request, (look.__qualname__, desk.view, where, id), look)
    job = first.job
    last_id = request.headers.get("last-event-id", "")
    last = int(last_id) if last_id.isascii() and last_id.isdecimal() and len(last_id) < 19 else None
    if not job.active and last == job.version:
        # to an event source this says: do not come back
        return Response(status_code=204)
    # proxies must not hold events back
    headers = {**_NO_STORE, "X-Accel-Buffering": "no"}
    if request.scope.get("head"):
        return _head(headers, "text/event-stream")
    holding(request).take("events")
    watch: Watch = request.app.state.watch

    def ending() -> bool:
        return desk.closing.is_set() or not still_admitted(request)

    stream = events(first, lambda: watch.next(job.id, where), last, ending)
    return StreamingResponse(stream, headers=headers, media_type="text/event-stream")


def _json(content: str) -> Response:
    return Response(content, media_type="application/json", headers=_NO_STORE)


def _head(headers: Mapping[str, str], media_type: str) -> Response:
    """What HEAD says of a stream: everything but its length."""
    response = Response(headers=headers, media_type=media_type)
    del response.headers["content-length"]
    return response
