"""Pages of the kinds of problems: causes and remedies."""

from functools import cache
from html import escape

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

from service.documents.problem_kinds import ProblemKind, kind_of
from service.http.accept import negotiate
from service.http.cached_document import CachedDocument
from service.http.operations import TEXT, accept, parameters, problems, unchanged

router = APIRouter(tags=["problems"])

_JSON, _HTML, _PLAIN = "application/json", "text/html", "text/plain"
_FORMS = {media_type: media_type for media_type in (_JSON, _HTML, _PLAIN)}
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'"


@router.get(
    "/problems/{kind}",
    operation_id="read_problem",
    summary="Cause and remedy of a kind of problem",
    response_model=ProblemKind,
    responses={**unchanged({_HTML: TEXT, _PLAIN: TEXT}), **problems(404)},
    openapi_extra={"parameters": [*parameters("If-None-Match"), accept(*_FORMS)]},
)
async def read_problem(request: Request, kind: str) -> Response:
    """The address of a kind is `type` of a problem; the page needs no key."""
    # who likes none of them is not refused: it is a page of explanations
    form = negotiate(request, _FORMS) or _JSON
    more = {"Content-Security-Policy": _POLICY} if form == _HTML else {}
    return _page(kind_of(kind), form).answer(request, Vary="Accept, Accept-Encoding", **more)


@cache
def _page(kind: ProblemKind, form: str) -> CachedDocument:
    if form == _JSON:
        return CachedDocument(kind.model_dump_json().encode(), form)
    return CachedDocument((_html(kind) if form == _HTML else _plain(kind)).encode(), form)


def _plain(kind: ProblemKind) -> str:
    return f"{kind.title} ({kind.status})\n\nCause: {kind.cause}\nRemedy: {kind.remedy}\n"


def _html(kind: ProblemKind) -> str:
    title = escape(f"{kind.title} ({kind.status})")
    parts = "".join(
        f"<h2>{heading}</h2><p>{_code(text)}</p>" for heading, text in (("Cause", kind.cause), ("Remedy", kind.remedy))
    )
    style = "body{font:1rem/1.5 system-ui,sans-serif;max-width:40rem;margin:3rem auto;padding:0 1rem}h2{font-size:1rem}"
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
        f'<meta name="viewport" content="width=device-width"><style>{style}</style></head>'
        f"<body><h1>{title}</h1>{parts}</body></html>\n"
    )


def _code(text: str) -> str:
    """Text with what stands between backquotes as code."""
    plain = escape(text).split("`")
    return "".join(f"<code>{part}</code>" if index % 2 else part for index, part in enumerate(plain))
