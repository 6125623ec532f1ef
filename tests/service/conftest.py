"""A ready service, and bodies to send to it."""

import json
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from starlette.testclient import TestClient

from service.app import create_app
from service.documents.examples import load
from service.settings import Settings

MAX_BODY_BYTES = 1_000_000


@pytest.fixture(scope="session")
def client() -> Iterator[TestClient]:
    """A client of a service that is ready; an exception that escapes the service fails the test."""
    with TestClient(create_app(Settings(max_body_bytes=MAX_BODY_BYTES)), follow_redirects=False) as client:
        deadline = time.monotonic() + 240
        while client.get("/readyz").status_code != 200:
            assert time.monotonic() < deadline
            time.sleep(0.05)
        yield client


@pytest.fixture
def post(client: TestClient) -> Callable[..., Any]:
    """Post raw bytes as JSON."""

    def send(path: str, content: Any, **headers: str) -> Any:
        fields = {
            "Content-Type": "application/json",
            **{key.replace("_", "-"): value for key, value in headers.items()},
        }
        return client.post(path, content=content, headers=fields)

    return send


@pytest.fixture
def body() -> dict[str, Any]:
    """A valid request."""
    request: dict[str, Any] = json.loads(load("2d12"))
    return request
