"""The report on a machine, as a document."""

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from schemas.requests import OptimizeRequest
from service.http.computing import Computes
from service.http.openapi import COMPUTE_PROBLEMS, problems, request_body
from service.report.formats import FORMATS, negotiated, report_html, report_pdf

router = APIRouter(tags=["counterweights"])

_WRITERS = {"html": report_html, "pdf": report_pdf}
_DOCUMENT = {known.media_type: {"schema": {"type": "string"}} for known in FORMATS.values()}


@router.post(
    "/v1/report",
    operation_id="report",
    summary="A document on a machine and its counterweights, as HTML or PDF",
    response_class=Response,
    responses={200: {"description": "the document", "content": _DOCUMENT}, **problems(*COMPUTE_PROBLEMS, 406)},
    openapi_extra=request_body(OptimizeRequest),
)
async def post_report(request: Request, computing: Computes) -> Response:
    """The header `Accept` chooses; the eight stages are in it where the machine allows, other outputs as asked for."""
    name = negotiated(",".join(request.headers.getlist("accept")))
    body = await computing.body(request)
    content = await computing.content(request, OptimizeRequest, _WRITERS[name], body)
    headers = {
        "Cache-Control": "no-store",
        "Content-Disposition": f'inline; filename="counterweights.{name}"',
        "Content-Security-Policy": FORMATS[name].policy,
        "Vary": "Accept",
    }
    return Response(content, media_type=FORMATS[name].media_type, headers=headers)
