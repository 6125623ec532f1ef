"""Faults of the service that the optimiser finds in its own answers and logs, wherever it computes.

A worker hands them over with its answer; the service logs them with the request or the job, and counts them.
"""

import logging
from collections.abc import Iterator
from contextlib import contextmanager

_SOURCE = logging.getLogger("optimizer")


class _Recorder(logging.Handler):
    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.messages.append(record.getMessage())


@contextmanager
def error_log() -> Iterator[list[str]]:
    """What the optimiser logs as an error meanwhile, message by message."""
    handler = _Recorder()
    _SOURCE.addHandler(handler)
    try:
        yield handler.messages
    finally:
        _SOURCE.removeHandler(handler)
