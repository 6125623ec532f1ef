"""Machines to start from."""

from functools import cache

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from schemas.requests import OptimizeRequest
from service.documents.examples import Examples, catalogue, load
from service.http.kept import Kept
from service.http.openapi import example_body, problems

router = APIRouter(tags=["examples"])


@router.get(
    "/v1/examples",
    operation_id="list_examples",
    summary="All examples",
    response_model=Examples,
    responses=problems(),
)
async def list_examples(request: Request) -> Response:
    return _listed(request.scope.get("root_path", "")).answer(request)


@router.get(
    "/v1/examples/{name}",
    operation_id="read_example",
    summary="An example, ready to be posted",
    response_class=Response,
    responses={**example_body(OptimizeRequest), **problems(404)},
)
async def read_example(request: Request, name: str) -> Response:
    """The very body one can post to `/v1/optimize`."""
    return _example(name).answer(request)


@cache
def _listed(prefix: str) -> Kept:
    return Kept(catalogue(prefix).model_dump_json().encode(), "application/json")


@cache
def _example(name: str) -> Kept:
    return Kept(load(name), "application/json")
