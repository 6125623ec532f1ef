"""Answers that are compressed, and documents that are kept."""

import gzip
import json
from typing import Any

import pyarrow as pa
import pytest
from starlette.requests import Request
from starlette.testclient import TestClient

from service.common.coding import Coding, coded
from service.computations.computation import Computation
from service.computations.table import COMPUTATIONS
from service.guard.sizes import SizeLimits
from service.http.cached_document import CachedDocument
from service.settings import Settings
from service.workers.task import Task
from service.workers.worker import Answer, perform
from tests.service.toy import TOY


def decoded(content: bytes, coding: Coding) -> bytes:
    if coding == "gzip":
        return gzip.decompress(content)
    data: bytes = pa.CompressedInputStream(pa.BufferReader(content), coding).read()
    return data


@pytest.mark.parametrize("coding", ["gzip", "zstd"])
def test_a_coded_answer_is_the_answer(coding: Coding, body: dict[str, Any]) -> None:
    content = json.dumps(body).encode() * 100
    assert len(coded(content, coding)) < len(content) / 10
    assert decoded(coded(content, coding), coding) == content


def performed(computation: Computation, body: dict[str, Any], coding: Coding | None, form: int = 0) -> Answer:
    content = json.dumps(body).encode()
    answer = perform(Task(computation, computation.forms[form], content, SizeLimits.of(Settings()), coding))
    assert isinstance(answer, Answer), answer
    return answer


@pytest.mark.parametrize("coding", ["gzip", "zstd"])
def test_a_worker_compresses_what_is_worth_it(coding: Coding, body: dict[str, Any]) -> None:
    optimize = COMPUTATIONS["optimize"]
    plain, packed = (performed(optimize, body, encoding) for encoding in (None, coding))
    assert (plain.coding, packed.coding) == (None, coding)
    assert packed.size == len(packed.content) < plain.size
    answer = json.loads(decoded(packed.content, coding))
    assert answer["counterweights"] == json.loads(plain.content)["counterweights"]


def test_what_is_small_or_compressed_already_goes_as_it_is(body: dict[str, Any]) -> None:
    small = performed(TOY, {"one": 1.0}, "gzip")
    assert (small.coding, json.loads(small.content)["total"]) == (None, 2.0)
    document = performed(COMPUTATIONS["report"], body, "gzip", form=1)
    assert document.coding is None
    assert document.content.startswith(b"%PDF")


def test_answers_say_their_coding(client: TestClient, body: dict[str, Any]) -> None:
    for accepted, coding in (("gzip", "gzip"), ("zstd;q=0.1, br", "zstd"), ("br", None), ("identity", None)):
        with client.stream(
            "POST",
            "/v1/optimize",
            content=json.dumps(body),
            headers={"Content-Type": "application/json", "Accept-Encoding": accepted},
        ) as answer:
            raw = b"".join(answer.iter_raw())
        assert answer.headers.get("content-encoding") == coding
        assert "Accept-Encoding" in answer.headers["vary"]
        assert int(answer.headers["content-length"]) == len(raw)
        content = raw if coding is None else decoded(raw, coding)
        assert json.loads(content)["status"] == "optimal"


@pytest.mark.parametrize(
    "path", ["/", "/openapi.json", "/v1/examples", "/v1/examples/2d12", "/v1/effects", "/docs/assets/swagger-ui.css"]
)
def test_documents_are_kept_by_who_has_them(client: TestClient, path: str) -> None:
    first = client.get(path, headers={"Accept-Encoding": "gzip"})
    assert first.status_code == 200
    assert first.headers["cache-control"] == "no-cache"
    assert first.headers["content-encoding"] == "gzip"
    plain = client.get(path, headers={"Accept-Encoding": "identity"})
    assert "content-encoding" not in plain.headers
    assert plain.content == first.content
    assert plain.headers["etag"] == first.headers["etag"]
    etag = first.headers["etag"]
    for tags in (etag, f'"other", {etag}', etag.removeprefix("W/"), "*"):
        again = client.get(path, headers={"If-None-Match": tags})
        assert (again.status_code, again.content, again.headers["etag"]) == (304, b"", etag)
    assert client.get(path, headers={"If-None-Match": '"other"'}).status_code == 200


def test_a_document_has_another_tag_when_it_changes() -> None:
    request = Request({"type": "http", "headers": []})
    tags = {CachedDocument(content, "text/plain").answer(request).headers["etag"] for content in (b"one", b"two")}
    assert len(tags) == 2
