"""Machines to start from."""

from functools import cache
from typing import Annotated

from fastapi import APIRouter, Query
from starlette.requests import Request
from starlette.responses import Response

from schemas.request.requests import OptimizeRequest
from service.computations.computation import XLSX
from service.documents.examples import Examples, catalogue, load
from service.documents.template import template
from service.fairness.threads import in_threads
from service.http.cached_document import CachedDocument
from service.http.operations import BINARY, parameters, problems, ref, unchanged

router = APIRouter(tags=["examples"])
_REVALIDATION = {"parameters": parameters("If-None-Match")}


@router.get(
    "/v1/examples",
    operation_id="list_examples",
    summary="All examples",
    response_model=Examples,
    responses={**unchanged(), **problems()},
    openapi_extra=_REVALIDATION,
)
async def list_examples(request: Request) -> Response:
    return _catalogue(request.scope.get("root_path", "")).answer(request)


@router.get(
    "/v1/examples/{name}",
    operation_id="read_example",
    summary="An example, ready to be posted",
    response_class=Response,
    responses={**unchanged({"application/json": {"schema": ref(OptimizeRequest)}}), **problems(404)},
    openapi_extra=_REVALIDATION,
)
async def read_example(request: Request, name: str) -> Response:
    """The very body one can post to `/v1/optimize`."""
    return _example(name).answer(request)


@router.get(
    "/v1/template.xlsx",
    operation_id="read_template",
    summary="An example as a workbook, to be changed into one's own and posted",
    response_class=Response,
    responses={**unchanged({XLSX: BINARY}, "Content-Disposition"), **problems(404, 422)},
    openapi_extra=_REVALIDATION,
)
@in_threads
def read_template(
    request: Request,
    example: Annotated[
        str, Query(description="name of the example; `empty` has the heads of all tables alone", max_length=64)
    ] = "single-horizontal",
) -> Response:
    """`POST /v1/optimize` takes it with its media type, and answers with one to who accepts that."""
    return _template(example).answer(request, **{"Content-Disposition": 'attachment; filename="machine.xlsx"'})


@cache
def _template(name: str) -> CachedDocument:
    return CachedDocument(template(name), XLSX)


@cache
def _catalogue(prefix: str) -> CachedDocument:
    return CachedDocument(catalogue(prefix).model_dump_json().encode(), "application/json")


@cache
def _example(name: str) -> CachedDocument:
    return CachedDocument(load(name), "application/json")
