"""What can be asked for, and what it takes."""

from fastapi import APIRouter

from optimizer.catalogue import catalogue
from schemas.effects import EffectCatalogue
from service.http.openapi import problems

router = APIRouter(tags=["counterweights"])


@router.get(
    "/v1/effects", operation_id="list_effects", summary="All outputs and the effects behind them", responses=problems()
)
async def list_effects() -> EffectCatalogue:
    """Only the effects that the outputs of a request need are simulated, and only their inputs are asked for."""
    return catalogue()
