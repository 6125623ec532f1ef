"""Measure what accuracy costs in time."""

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from optimizer.accuracy.measure import accuracy
from schemas.accuracy import AccuracyAnswer, AccuracyRequest
from service.http.computing import Computes
from service.http.openapi import COMPUTE_PROBLEMS, problems, request_body

router = APIRouter(tags=["counterweights"])


@router.post(
    "/v1/accuracy",
    operation_id="accuracy",
    summary="What accuracy costs in time on a machine: a ladder of methods and settings",
    response_model=AccuracyAnswer,
    responses=problems(*COMPUTE_PROBLEMS),
    openapi_extra=request_body(AccuracyRequest),
)
async def post_accuracy(request: Request, computing: Computes) -> Response:
    """Times are those of this machine at this moment; errors and gaps do not depend on it."""
    return await computing.answer(request, AccuracyRequest, accuracy)
