"""Metrics for Prometheus."""

from fastapi import APIRouter
from prometheus_client import CONTENT_TYPE_LATEST
from starlette.requests import Request
from starlette.responses import Response

from service.fairness.quotas import holding
from service.fairness.threads import threads_of
from service.guard.access import needs
from service.http.operations import TEXT, problems

router = APIRouter(tags=["health"])


@router.get(
    "/metrics",
    operation_id="metrics",
    summary="Metrics for Prometheus",
    dependencies=[needs("metrics")],
    response_class=Response,
    responses={200: {"description": "text format of Prometheus", "content": {"text/plain": TEXT}}, **problems()},
)
async def metrics(request: Request) -> Response:
    """Requests, times of computations by method, certified gaps, queue, workers, jobs and their rows."""
    content = await threads_of(request).run(holding(request).who, request.app.state.metrics.exposition)
    return Response(content, media_type=CONTENT_TYPE_LATEST)
