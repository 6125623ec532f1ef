"""Choose the counterweights of a machine."""

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from optimizer.optimize import optimize
from schemas.answers import OptimizeAnswer
from schemas.requests import OptimizeRequest
from service.http.computing import Computes
from service.http.openapi import COMPUTE_PROBLEMS, problems, request_body

router = APIRouter(tags=["counterweights"])


@router.post(
    "/v1/optimize",
    operation_id="optimize",
    summary="Counterweights that minimise the first-order peaks, with a certificate",
    response_model=OptimizeAnswer,
    responses=problems(*COMPUTE_PROBLEMS),
    openapi_extra=request_body(OptimizeRequest),
)
async def post_optimize(request: Request, computing: Computes) -> Response:
    """An infeasible machine is answered with 200 too: `status` says so, `infeasibility` says why."""
    return await computing.answer(request, OptimizeRequest, optimize)
