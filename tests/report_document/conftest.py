"""Requests, and the documents that are made of them."""

import json
from collections.abc import Callable
from datetime import UTC, datetime
from typing import Any

import pytest

from schemas.request.report import ReportRequest
from service.documents.examples import load
from service.report.blocks import Document
from service.report.document import report

AT = datetime(2026, 2, 3, 4, 5, 6, tzinfo=UTC)

#: a name that is markup to everything that the document goes through: HTML, SVG, typst, the templates
MARKUP = "<script>x</script><b>\"'&amp; #panic() $x$ *y* _z_ {{ 7*7 }}"


def request_of(example: str, **changes: Any) -> ReportRequest:
    """The request of an example, with other fields."""
    return ReportRequest.model_validate({**json.loads(load(example)), **changes})


@pytest.fixture(scope="session")
def composer() -> Callable[..., Document]:
    """The document on an example, at a fixed time."""

    def make(example: str, **changes: Any) -> Document:
        return report(request_of(example, **changes), AT)

    return make


@pytest.fixture(scope="session")
def hostile() -> Document:
    """A document in which every name is markup."""
    body = json.loads(load("2d12"))
    machine = body["machine"]
    machine["name"] = machine["description"] = MARKUP
    machine["throws"][0]["name"] = machine["throws"][0]["rows"][0]["name"] = MARKUP
    machine["webs"][0]["name"] = machine["bearings"][0]["name"] = MARKUP
    body["outputs"] = ["kinematics", "main_bearings"]
    return report(ReportRequest.model_validate(body), AT)
