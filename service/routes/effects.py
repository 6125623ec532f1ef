"""What can be asked for, and what it takes."""

from functools import cache

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from optimizer.outputs.descriptions import catalogue
from schemas.answer.effects import EffectCatalogue
from service.http.kept import Kept
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
    return _listed().answer(request)


@cache
def _listed() -> Kept:
    return Kept(catalogue().model_dump_json().encode(), "application/json")
