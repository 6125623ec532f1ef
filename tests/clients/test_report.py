"""The report over REST: which form it takes, and what is said about it."""

import json
from http.client import HTTPConnection
from typing import Any
from urllib.parse import urlsplit

import pytest

from service.documents.examples import load

_HTML, _PDF = "text/html; charset=utf-8", "application/pdf"


def post(url: str, body: Any, **headers: str) -> tuple[int, dict[str, str], bytes]:
    where = urlsplit(url)
    connection = HTTPConnection(where.hostname or "", where.port, timeout=180)
    connection.request("POST", "/v1/report", json.dumps(body), {"Content-Type": "application/json", **headers})
    answer = connection.getresponse()
    content = answer.read()
    connection.close()
    return answer.status, {name.lower(): value for name, value in answer.getheaders()}, content


@pytest.fixture(scope="module")
def body() -> Any:
    return json.loads(load("v60"))


@pytest.mark.parametrize(
    ("accept", "media_type", "begins"),
    [
        (None, _HTML, b"<!DOCTYPE html>"),
        ("application/pdf", _PDF, b"%PDF-"),
        ("text/*;q=0.2, application/*", _PDF, b""),
    ],
)
def test_the_document_that_was_asked_for(
    url: str, body: Any, accept: str | None, media_type: str, begins: bytes
) -> None:
    status, headers, content = post(url, body, **({} if accept is None else {"Accept": accept}))
    assert status == 200
    assert headers["content-type"] == media_type
    assert content.startswith(begins)
    assert int(headers["content-length"]) == len(content)
    assert "Accept" in headers["vary"]
    assert headers["cache-control"] == "no-store"


def test_a_browser_lets_the_page_have_its_styles_and_nothing_else(url: str, body: Any) -> None:
    _, headers, _ = post(url, body)
    assert headers["content-security-policy"] == (
        # the logo of the title block is a picture within the page
        "default-src 'none'; img-src data:; style-src 'unsafe-inline'; frame-ancestors 'none'"
    )
    assert headers["content-disposition"] == 'inline; filename="V 60 degrees, equal rows, clockwise.html"'


def test_other_forms_there_are_none(url: str, body: Any) -> None:
    status, headers, content = post(url, body, Accept="application/json")
    assert (status, headers["content-type"]) == (406, "application/problem+json")
    assert json.loads(content)["type"] == "/problems/not-acceptable"


def test_an_infeasible_machine_has_its_report_too(url: str, body: Any) -> None:
    status, _, content = post(url, {**body, "objective": {"force_ceiling_N": 1e-3}})
    assert status == 200
    assert b"Proven infeasible" in content


def test_what_an_output_needs_is_asked_for_by_its_field(url: str, body: Any) -> None:
    status, _, content = post(url, {**body, "outputs": ["flywheel"]}, Accept="application/pdf")
    assert status == 422
    assert "/machine/flywheel" in [error["pointer"] for error in json.loads(content)["errors"]]


def test_to_be_answered_later_is_no_way_to_get_a_document(url: str, body: Any) -> None:
    status, headers, _ = post(url, body, Prefer="respond-async")
    assert (status, headers["content-type"]) == (200, _HTML)
