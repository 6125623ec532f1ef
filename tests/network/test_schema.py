"""Requests made up from the published document, in short; ``python -m tests.network.schema`` is the whole of it."""

from collections import Counter

import pytest

from tests.network.schema import GenerationMode, modes, operations, send
from tests.network.serving import Service


@pytest.mark.parametrize("mode", list(GenerationMode), ids=lambda mode: mode.value)
@pytest.mark.parametrize("examples", [1, pytest.param(20, marks=pytest.mark.nightly)])
def test_every_operation_answers_as_it_says(target: Service, mode: GenerationMode, examples: int) -> None:
    found = operations(target.url)
    assert len(found) >= 20
    for operation in found:
        if mode in modes(operation):
            statuses = Counter[int]()
            send(operation.as_strategy(generation_mode=mode), examples, statuses)
            assert statuses.total() >= 1
            assert max(statuses) < 500
