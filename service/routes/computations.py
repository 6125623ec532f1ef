"""The computing routes, one for each entry of the table of computations."""

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from service.computations import COMPUTATIONS, Computation
from service.guard.access import require
from service.http.computing import computing_of
from service.http.direct import Endpoint
from service.http.operations import of_computation
from service.http.parameters import require_parameters


def endpoints() -> dict[str, Endpoint]:
    """What answers all computations, by path."""
    return {one.path: _endpoint(one) for one in COMPUTATIONS.values()}


def router() -> APIRouter:
    """The routes of all computations, as they are documented; requests come to them by :mod:`service.http.direct`."""
    made = APIRouter()
    for one in COMPUTATIONS.values():
        answers, about = of_computation(one)
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
            responses=answers,
            openapi_extra=about,
        )
    return made


def _endpoint(computation: Computation) -> Endpoint:
    async def endpoint(request: Request) -> Response:
        require(request, computation.scope)
        require_parameters(request)
        return await computing_of(request).answer(request, computation)

    return endpoint
