"""A worker that has answered gets its next question before the answer is written."""

import asyncio
from typing import Any, cast

import pytest
from starlette.requests import Request

from service.computations.table import COMPUTATIONS
from service.fairness.quotas import Holding, quotas
from service.fairness.table import shares
from service.fairness.threads import Threads
from service.http.computing import Computing
from service.settings import Settings
from service.watch.metrics import Metrics
from service.watch.readiness import Readiness
from service.watch.tracing import Tracing
from service.workers.pool import Pool
from service.workers.worker import Answer


class Answered:
    """A pool whose answer is there, and in which others may wait for the worker that gave it."""

    def __init__(self, queued: int) -> None:
        self.queued = queued
        self.done: list[str] = []

    async def run(self, *_: object) -> Answer:
        if self.queued:
            asyncio.get_running_loop().call_soon(self.done.append, "the next is asked")
        return Answer(b"{}", None, 2, 0.0, None, 0)


@pytest.mark.parametrize(
    ("queued", "texts"), [(1, ["the next is asked", "the answer is written"]), (0, ["the answer is written"])]
)
def test_who_waits_is_asked_before_the_answer_is_written(queued: int, texts: list[str]) -> None:
    settings, pool = Settings(), Answered(queued)
    metrics = Metrics(cast(Pool, pool), lambda: None, lambda: 0)
    computing = Computing(settings, Readiness({}, Threads(), "ready"), cast(Pool, pool), metrics, Tracing())
    headers = [(b"content-type", b"application/json")]
    state = {"holding": Holding(quotas(shares(settings)), "somebody")}
    scope = {"type": "http", "method": "POST", "path": "/v1/optimize", "headers": headers, "state": state}
    values = iter([{"type": "http.request", "body": b"{}", "more_body": False}])

    async def receive() -> dict[str, Any]:
        # then it waits for the answer
        return next(values, None) or await asyncio.Future()

    async def answered() -> None:
        await computing.answer(Request(scope, cast(Any, receive)), COMPUTATIONS["optimize"])
        pool.done.append("the answer is written")

    asyncio.run(answered())
    assert pool.done == texts
