"""Loads of the anti-rotation pins of a scroll."""

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from optimizer.pins.answer import pin_loads
from schemas.scroll import PinLoadsAnswer, PinLoadsRequest
from service.http.computing import Computes
from service.http.openapi import COMPUTE_PROBLEMS, problems, request_body

router = APIRouter(tags=["scroll"])


@router.post(
    "/v1/scroll/pin-loads",
    operation_id="pin_loads",
    summary="Loads of the anti-rotation pins of a scroll over a turn",
    response_model=PinLoadsAnswer,
    responses=problems(*COMPUTE_PROBLEMS),
    openapi_extra=request_body(PinLoadsRequest, "pin-loads"),
)
async def post_pin_loads(request: Request, computing: Computes) -> Response:
    """Where the pins cannot hold the scroll at some angle, `equilibrium` and `dead_points_deg` say so."""
    return await computing.answer(request, PinLoadsRequest, pin_loads)
