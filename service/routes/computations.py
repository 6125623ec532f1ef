"""The computing routes, one for each entry of the table of computations."""

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from service.computations.computation import Computation
from service.computations.table import COMPUTATIONS
from service.guard.access import require
from service.http.computing import computing_of
from service.http.direct import Endpoint
from service.http.operations import of_computation
from service.http.parameters import require_parameters


def endpoints() -> dict[str, Endpoint]:
    """What answers all computations, by path."""
    return {computation.path: _endpoint(computation) for computation in COMPUTATIONS.values()}


def router() -> APIRouter:
    """The routes of all computations, as they are documented; requests come to them by :mod:`service.http.direct`."""
    result = APIRouter()
    for computation in COMPUTATIONS.values():
        answers, about = of_computation(computation)
        result.add_api_route(
            computation.path,
            _endpoint(computation),
            methods=["POST"],
            operation_id=computation.name,
            summary=computation.summary,
            description=computation.remark,
            tags=[computation.tag],
            response_model=computation.answer_model,
            response_class=Response if computation.answer_model is None else JSONResponse,
            responses=answers,
            openapi_extra=about,
        )
    return result


def _endpoint(computation: Computation) -> Endpoint:
    async def endpoint(request: Request) -> Response:
        require(request, computation.scope)
        require_parameters(request)
        return await computing_of(request).answer(request, computation)

    return endpoint
