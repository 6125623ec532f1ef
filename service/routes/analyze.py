"""A machine as it stands, or with given counterweights."""

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from optimizer.analyze import analyze
from schemas.answers import AnalyzeAnswer
from schemas.requests import AnalyzeRequest
from service.http.computing import Computes
from service.http.openapi import COMPUTE_PROBLEMS, problems, request_body

router = APIRouter(tags=["counterweights"])


@router.post(
    "/v1/analyze",
    operation_id="analyze",
    summary="Forces and moments of a machine as it stands, or with given counterweights",
    response_model=AnalyzeAnswer,
    responses=problems(*COMPUTE_PROBLEMS),
    openapi_extra=request_body(AnalyzeRequest),
)
async def post_analyze(request: Request, computing: Computes) -> Response:
    """`outputs` says what the answer shall hold; only the effects that they need are simulated."""
    return await computing.answer(request, AnalyzeRequest, analyze)
