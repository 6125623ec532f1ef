"""The benchmark of requests that wait runs, and tells what a batch cannot share from the whole."""

from tests.benchmarks import batched_queue


def test_rows_and_answers() -> None:
    whole, own = batched_queue.answer_ms(2)
    assert 0 < own < whole
    assert batched_queue.row_ms(16, 1) > 0
