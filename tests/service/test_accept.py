"""What a client accepts."""

import pytest
from starlette.requests import Request

from service.http.accept import coding_of, negotiate, preferred
from service.jobs.formats import FORMATS

_FORMS = ("text/html", "application/pdf")


@pytest.mark.parametrize(
    ("header", "chosen"),
    [
        ("", "text/html"),
        ("*/*", "text/html"),
        ("text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8", "text/html"),
        ("application/pdf, text/html", "text/html"),
        ("application/pdf, */*;q=0.1", "application/pdf"),
        ("APPLICATION/PDF ; Q=0.5", "application/pdf"),
        ("text/html;q=0.3, application/pdf;q=0.7", "application/pdf"),
        ("text/html;q=0, */*", "application/pdf"),
        ("application/*;q=0.9, text/html;q=0.1", "application/pdf"),
        ("text/html;q=often, application/pdf;q=0.1", "application/pdf"),
        *(
            (header, None)
            for header in ("image/png", "text/html;q=0", "text/plain, application/json", "*/*;q=0", ";;,;")
        ),
        ("text/html;q=nan, application/pdf;q=-1", None),
    ],
)
def test_what_a_client_likes_best(header: str, chosen: str | None) -> None:
    assert preferred(header, _FORMS) == chosen


@pytest.mark.parametrize(
    ("header", "taken"),
    [("gzip, br", True), ("br;q=1, *;q=0.1", True), ("gzip;q=0", False), ("gzip;q=0, *", False), ("identity", False)],
)
def test_codings(header: str, taken: bool) -> None:
    """RFC 9110, section 12.5.3: the same lists, with a wildcard of its own."""
    assert (preferred(header, ("gzip",)) == "gzip") is taken


@pytest.mark.parametrize(
    ("accepted", "coding"),
    [
        ([], None),
        ([""], None),
        (["identity"], None),
        (["br"], None),
        (["gzip, deflate, br, zstd"], "gzip"),
        (["br, zstd"], "zstd"),
        (["gzip;q=0.5", "zstd"], "zstd"),
        (["gzip;q=0, *"], "zstd"),
    ],
)
def test_the_coding_of_an_answer(accepted: list[str], coding: str | None) -> None:
    request = Request({"type": "http", "headers": [(b"accept-encoding", text.encode()) for text in accepted]})
    assert coding_of(request) == coding


@pytest.mark.parametrize(
    ("accept", "name"),
    [
        ([], "ndjson"),
        (["*/*"], "ndjson"),
        (["text/csv"], "csv"),
        (["text/html, application/vnd.apache.parquet;q=0.5", "text/csv;q=0.4"], "parquet"),
        (["application/vnd.apache.arrow.stream;q=0"], None),
        (["text/csv;q=nonsense, application/vnd.apache.arrow.stream"], "arrow"),
        ([",;;=,"], None),
    ],
)
def test_the_format_of_rows(accept: list[str], name: str | None) -> None:
    request = Request({"type": "http", "headers": [(b"accept", text.encode()) for text in accept]})
    assert negotiate(request, {form.media_type.split(";")[0]: key for key, form in FORMATS.items()}) == name
