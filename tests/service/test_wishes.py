"""What headers of a request say of its answer, which is read once for equal headers."""

import pytest
from starlette.requests import Request

from service.computations.table import COMPUTATIONS
from service.http.accept import NotAcceptable
from service.http.computing import _wishes, _wishes_of
from service.http.request_body import UnsupportedMedia


def request(**headers: str) -> Request:
    raw = [(name.replace("_", "-").encode(), value.encode()) for name, value in headers.items()]
    return Request({"type": "http", "headers": raw})


def test_equal_headers_are_read_once_for_each_computation() -> None:
    fields = {"content_type": "application/json", "accept_encoding": "gzip"}
    first = _wishes(request(**fields, user_agent="a"), COMPUTATIONS["optimize"])
    assert _wishes(request(**fields, user_agent="b"), COMPUTATIONS["optimize"]) is first
    assert _wishes(request(**fields, prefer="respond-async"), COMPUTATIONS["optimize"]).later
    assert not first.later
    report = _wishes(request(**fields, accept="application/pdf"), COMPUTATIONS["report"])
    assert (report.form.media_type, first.form.media_type) == ("application/pdf", "application/json")


def test_long_headers_are_not_kept() -> None:
    there = _wishes_of.cache_info().currsize
    long = request(content_type="application/json", accept="text/html, " + "a/b, " * 200)
    assert _wishes(long, COMPUTATIONS["report"]).form.media_type.startswith("text/html")
    assert _wishes_of.cache_info().currsize == there


def test_headers_that_are_refused_are_refused_each_time() -> None:
    for _ in range(2):
        with pytest.raises(UnsupportedMedia):
            _wishes(request(content_type="text/plain"), COMPUTATIONS["optimize"])
        with pytest.raises(NotAcceptable):
            _wishes(request(content_type="application/json", accept="image/png"), COMPUTATIONS["report"])
