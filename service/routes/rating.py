"""Size the cylinders of a compressor."""

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from optimizer.rating.rate import rate
from schemas.rating import RatingRequest
from schemas.rating_answer import RatingAnswer
from service.http.computing import Computes
from service.http.openapi import COMPUTE_PROBLEMS, problems, request_body

router = APIRouter(tags=["rating"])


@router.post(
    "/v1/rating",
    operation_id="rating",
    summary="Thermal design of a compressor: sizes, pressures, loads and powers",
    response_model=RatingAnswer,
    responses=problems(*COMPUTE_PROBLEMS),
    openapi_extra=request_body(RatingRequest, "rating"),
)
async def post_rating(request: Request, computing: Computes) -> Response:
    """Figures out of their customary range are answered with 200 too; `warnings` names them."""
    return await computing.answer(request, RatingRequest, rate)
