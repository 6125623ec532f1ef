"""Legal traffic that costs much harms no bystander; ``python -m tests.network.bystander`` is the long form."""

import asyncio
import json
from collections.abc import Iterator

import pytest

from schemas.base.model import Model
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.common.validation import check
from service.guard.sizes import SizeLimits
from service.settings import Settings
from tests.network.bystander import CEILING_MB, PRESSES, TORQUE, beside, largest, mixed, search
from tests.network.load import start_sweep
from tests.network.serving import Service, service


@pytest.fixture(scope="module")
def pressed() -> Iterator[Service]:
    # so few connections that they run out
    with service(
        max_connections=120, max_connections_each=100, event_streams_each=20, queue_length=16, queue_length_each=8,
        held_mb=16, held_mb_each=8, sweep_workers=1, rate_limit="", log_level="warning",
    ) as server:  # fmt: skip
        server.sweep = asyncio.run(start_sweep(server))  # type: ignore[attr-defined]
        yield server
        asyncio.run(server.ask("DELETE", server.sweep))  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("model", "body"), [(OptimizeRequest, largest(500)), (AnalyzeRequest, TORQUE), (OptimizeRequest, search())]
)
def test_what_presses_is_legal(model: type[Model], body: bytes) -> None:
    # a refusal costs next to nothing
    SizeLimits.of(Settings()).require(check(model, json.loads(body)))


@pytest.mark.nightly
@pytest.mark.parametrize("press", [PRESSES["stalled bodies"], PRESSES["streams of events"], mixed])
def test_a_bystander_is_answered(pressed: Service, press: object) -> None:
    outcome = asyncio.run(beside(pressed, press, 150, 2.0))  # type: ignore[arg-type]
    assert outcome.refused == 0, outcome.statuses
    assert outcome.held_mb < CEILING_MB
    assert pressed.faults() == []
