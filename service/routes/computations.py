"""The computing routes, one for each entry of the table of computations."""

from typing import Any

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from service.computations import COMPUTATIONS, Computation
from service.guard.access import require
from service.http.computing import computing_of
from service.http.direct import Endpoint
from service.http.openapi import BINARY, COMPUTE_PROBLEMS, example_body, problems, request_body


def endpoints() -> dict[str, Endpoint]:
    """What answers all computations, by path."""
    return {one.path: _endpoint(one) for one in COMPUTATIONS.values()}


def router() -> APIRouter:
    """The routes of all computations, as they are documented; requests come to them by :mod:`service.http.direct`."""
    made = APIRouter()
    for one in COMPUTATIONS.values():
        made.add_api_route(
            one.path,
            _endpoint(one),
            methods=["POST"],
            operation_id=one.name,
            summary=one.summary,
            description=one.remark,
            tags=[one.tag],
            response_model=one.answers,
            response_class=Response if one.answers is None else JSONResponse,
            responses=_responses(one),
            openapi_extra=request_body(one.asks, one.examples, one.workbook is not None),
        )
    return made


def _endpoint(one: Computation) -> Endpoint:
    async def endpoint(request: Request) -> Response:
        require(request, one.scope)
        return await computing_of(request).answer(request, one)

    return endpoint


def _responses(one: Computation) -> dict[int | str, dict[str, Any]]:
    if one.answer is not None:
        others = {form.media_type: BINARY for form in one.forms[1:]}
        told: dict[int | str, dict[str, Any]] = {200: {"content": others}} if others else {}
        return {**told, **problems(*COMPUTE_PROBLEMS)}
    content = {form.media_type: {"schema": {"type": "string"}} for form in one.forms}
    # no answer but JSON: the request itself
    content |= example_body(one.asks)[200]["content"] if "application/json" in content else {}
    # what there is in one form only is answered in that
    more = (406,) if len(one.forms) > 1 else ()
    return {200: {"description": "the document", "content": content}, **problems(*COMPUTE_PROBLEMS, *more)}
