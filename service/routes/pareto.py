"""Trade peak force against peak moment."""

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from optimizer.pareto.pareto import pareto
from schemas.pareto import ParetoAnswer, ParetoRequest
from service.http.computing import Computes
from service.http.openapi import COMPUTE_PROBLEMS, problems, request_body

router = APIRouter(tags=["counterweights"])


@router.post(
    "/v1/pareto",
    operation_id="pareto",
    summary="The certified trade-off of peak force, peak moment and total mass",
    response_model=ParetoAnswer,
    responses=problems(*COMPUTE_PROBLEMS),
    openapi_extra=request_body(ParetoRequest),
)
async def post_pareto(request: Request, computing: Computes) -> Response:
    """Every point is the lightest set of counterweights that no other set beats in both peaks, with a proof."""
    return await computing.answer(request, ParetoRequest, pareto)
