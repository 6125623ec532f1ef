"""Machines to start from."""

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from schemas.requests import OptimizeRequest
from service.documents.examples import Examples, catalogue, load
from service.http.openapi import example_body, problems

router = APIRouter(tags=["examples"])


@router.get("/v1/examples", operation_id="list_examples", summary="All examples", responses=problems())
async def list_examples(request: Request) -> Examples:
    return catalogue(request.scope.get("root_path", ""))


@router.get(
    "/v1/examples/{name}",
    operation_id="read_example",
    summary="An example, ready to be posted",
    response_class=Response,
    responses={**example_body(OptimizeRequest), **problems(404)},
)
async def read_example(name: str) -> Response:
    """The very body one can post to `/v1/optimize`."""
    return Response(load(name), media_type="application/json")
