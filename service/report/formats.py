"""The forms of the report: HTML to be read, PDF to be filed; and which of them a client accepts."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from schemas.requests import OptimizeRequest
from service.report.blocks import Document
from service.report.document import report
from service.report.html import html
from service.report.pdf import pdf

Name = Literal["html", "pdf"]


class NotAcceptable(ValueError):
    """The client accepts none of the forms that there are."""


@dataclass(frozen=True)
class Format:
    """A form of the report."""

    media_type: str
    #: what a browser may do while it shows the document: nothing but styles of its own
    policy: str
    write: Callable[[Document], bytes]


#: by the suffix of their files; the first one is the one for those who accept everything
FORMATS: Mapping[Name, Format] = {
    "html": Format("text/html", "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'", html),
    "pdf": Format("application/pdf", "default-src 'none'; frame-ancestors 'none'", pdf),
}


def report_html(request: OptimizeRequest) -> bytes:
    """The report on a machine as one HTML page.

    Raises
    ------
    MissingInput
        if the machine lacks what a requested output needs.
    """
    return html(report(request))


def report_pdf(request: OptimizeRequest) -> bytes:
    """The report on a machine as PDF, the request attached.

    Raises
    ------
    MissingInput
        if the machine lacks what a requested output needs.
    """
    return pdf(report(request))


def negotiated(accept: str) -> Name:
    """The form that an Accept header (RFC 9110, section 12.5.1) likes best.

    Raises
    ------
    NotAcceptable
        if it likes none.
    """
    ranges = [_range(part) for part in accept.split(",") if part.strip()] or [("*/*", 1.0)]
    liked = {name: _quality(known.media_type, ranges) for name, known in FORMATS.items()}
    best = max(FORMATS, key=lambda name: liked[name])
    if liked[best] <= 0:
        offered = " and ".join(known.media_type for known in FORMATS.values())
        raise NotAcceptable(f"The report is there as {offered}; say so in the header Accept.")
    return best


def _quality(media_type: str, ranges: Iterable[tuple[str, float]]) -> float:
    """How much a media type is liked: the most specific range that holds it says so."""
    of_media_type = dict(ranges)
    kind = media_type.split("/")[0]
    return next((of_media_type[each] for each in (media_type, f"{kind}/*", "*/*") if each in of_media_type), 0.0)


def _range(part: str) -> tuple[str, float]:
    media_type, *parameters = (piece.strip().lower() for piece in part.split(";"))
    given = dict(parameter.replace(" ", "").partition("=")[::2] for parameter in parameters)
    try:
        return media_type, float(given.get("q", "1"))
    except ValueError:
        return media_type, 0.0
