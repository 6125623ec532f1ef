"""Outputs and effects, and their inputs."""

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from schemas.answer.effects import EffectCatalogue
from service.http.cached_document import CachedDocument, Shelf
from service.http.operations import parameters, problems, unchanged

router = APIRouter(tags=["counterweights"])


@router.get(
    "/v1/effects",
    operation_id="list_effects",
    summary="All outputs and the effects behind them",
    response_model=EffectCatalogue,
    responses={**unchanged(), **problems()},
    openapi_extra={"parameters": parameters("If-None-Match")},
)
async def list_effects(request: Request) -> Response:
    """Only the effects that the outputs of a request need are simulated, and only their inputs are asked for."""
    document = await _LISTS.take(request, "effects")
    return document.answer(request)


def _catalogue(_: str) -> CachedDocument:
    # the optimiser, which the process of the service needs for nothing else: it would be ready later
    from optimizer.outputs.descriptions import catalogue

    return CachedDocument(catalogue().model_dump_json().encode(), "application/json")


_LISTS = Shelf(_catalogue)
