"""Schemathesis on the operations with small bodies or none; ``python -m tests.network.schema`` runs it on all."""

import re

import pytest

from tests.network.schema import run
from tests.network.serving import Service

PATHS = (
    *("/healthz", "/readyz", "/v1/version", "/v1/effects", "/v1/examples", "/v1/examples/{name}", "/problems/{kind}"),
    *("/v1/scroll/pin-loads", "/v1/sweeps/{id}", "/v1/sweeps/{id}/resume", "/v1/sweeps/{id}/metadata"),
)


@pytest.mark.nightly
def test_operations_answer_as_the_document_says(target: Service) -> None:
    phases = ("examples", "fuzzing", "stateful")
    code, count, text = run(target.url, phases, 2, *(f"--include-path={path}" for path in PATHS))
    assert code == 0, text
    selected = re.search(r"Selected: (\d+)/(\d+)", text)
    assert selected is not None, text
    # of one path two methods
    assert int(selected[1]) == len(PATHS) + 1
    assert int(selected[2]) >= 40
    assert count >= 30, text
    assert target.faults() == []
