"""A bound that contradicts its answer: the answer says so, the log says so, and it is counted."""

import json
import logging
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from optimizer.program.verdict import CONTRADICTED, Claim
from optimizer.solve import answer_fields
from optimizer.solve import certify as certified
from service.common.faults import error_log
from service.computations.table import COMPUTATIONS
from service.documents.examples import bodies
from service.guard.sizes import SizeLimits
from service.jobs import worker as jobs
from service.settings import Settings
from service.watch.metrics import Metrics
from service.workers.task import Task
from service.workers.worker import Answer, perform

BODY = bodies("")["v90-equal"]


def _false(claim: Callable[..., Claim]) -> Callable[..., Claim]:
    """The same claims with a bound of twice the objective without counterweights."""

    def broken(*arguments: Any) -> Claim:
        right = claim(*arguments)
        return replace(right, lower_bound=2.0 * right.yardstick)

    return broken


@pytest.fixture
def outcome(monkeypatch: pytest.MonkeyPatch) -> Answer:
    monkeypatch.setattr(answer_fields, "_claim", _false(answer_fields._claim))
    optimize = COMPUTATIONS["optimize"]
    answer = perform(Task(optimize, optimize.forms[0], json.dumps(BODY).encode(), SizeLimits.of(Settings())))
    assert isinstance(answer, Answer), answer
    return answer


def test_the_answer_proves_nothing_and_the_worker_tells(outcome: Answer) -> None:
    answer = json.loads(outcome.content)
    assert (answer["status"], answer["status_reason"]) == ("inaccurate", CONTRADICTED)
    proof = answer["certificate"]
    assert proof["lower_bound"] is proof["gap"] is proof["relative_gap"] is None
    assert answer["shadow_prices"] == []
    assert outcome.faults == ("a lower bound is above the value of an answer: 1 of 1",)


def test_it_is_counted(outcome: Answer, client: TestClient) -> None:
    metrics: Metrics = client.app.state.metrics  # type: ignore[attr-defined]
    before = client.get("/metrics").text
    assert 'counterweight_faults_total{asked_as="request"} 0.0' in before
    assert 'counterweight_faults_total{asked_as="job"} 0.0' in before
    metrics.computed("optimize", outcome)
    assert 'counterweight_faults_total{asked_as="request"} 1.0' in client.get("/metrics").text


def test_a_chunk_of_a_sweep_tells_too(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(certified, "claim", _false(certified.claim))
    sweep = {"base": BODY, "axes": [{"path": "/machine/speed_rpm", "values": [600, 700, 800]}]}
    piece = jobs.run("sweep", json.dumps(sweep).encode(), 0, 3, str(tmp_path / "stop"))
    assert piece.failed == 3
    assert piece.faults == ("a lower bound is above the value of an answer: 3 of 3",)


def test_whoever_listens_hears_every_error_of_its_time() -> None:
    """Analytic: lists that are equal are told apart, and nobody hears what comes later."""
    log = logging.getLogger("optimizer.program.verdict")
    with error_log() as outer:
        with error_log() as inner, error_log() as beside:
            pass
        log.error("one")
        with error_log() as later:
            log.warning("no error")
            log.error("%s and %s", "two", "three")
    log.error("four")
    assert (inner, beside, outer, later) == ([], [], ["one", "two and three"], ["two and three"])
