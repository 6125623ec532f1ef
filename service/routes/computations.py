"""The computing routes, one for each entry of the table of computations."""

from collections.abc import Awaitable, Callable
from typing import Any

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from service.computations import COMPUTATIONS, Computation
from service.guard.access import needs
from service.http.computing import Computes
from service.http.openapi import COMPUTE_PROBLEMS, problems, request_body


def router() -> APIRouter:
    """The routes of all computations."""
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
            dependencies=[needs(one.scope)],
            response_model=one.answers,
            response_class=Response if one.answers is None else JSONResponse,
            responses=_responses(one),
            openapi_extra=request_body(one.asks, one.examples),
        )
    return made


def _endpoint(one: Computation) -> Callable[[Request, Computes], Awaitable[Response]]:
    async def endpoint(request: Request, computing: Computes) -> Response:
        return await computing.answer(request, one)

    return endpoint


def _responses(one: Computation) -> dict[int | str, dict[str, Any]]:
    if len(one.forms) == 1:
        return problems(*COMPUTE_PROBLEMS)
    content = {form.media_type: {"schema": {"type": "string"}} for form in one.forms}
    return {200: {"description": "the document", "content": content}, **problems(*COMPUTE_PROBLEMS, 406)}
