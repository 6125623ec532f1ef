"""Faults of the service that the optimiser finds in its own answers and logs, wherever it computes.

A worker hands them over with its answer; the service logs them with the request or the job, and counts them.
"""

import logging
from collections.abc import Iterator
from contextlib import contextmanager

_SOURCE = logging.getLogger("optimizer")


class _Recorder(logging.Handler):
    """Hands every message to all who listen."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.listeners: list[list[str]] = []

    def emit(self, record: logging.LogRecord) -> None:
        for messages in self.listeners:
            messages.append(record.getMessage())


#: one that stays: to make one and to add it takes as long as to read a small request
_RECORDER = _Recorder()


@contextmanager
def error_log() -> Iterator[list[str]]:
    """What the optimiser logs as an error meanwhile, message by message."""
    if _RECORDER not in _SOURCE.handlers:
        _SOURCE.addHandler(_RECORDER)
    messages: list[str] = []
    listeners = _RECORDER.listeners
    listeners.append(messages)
    try:
        yield messages
    finally:
        # equal ones of others may be among them
        listeners[:] = [listener for listener in listeners if listener is not messages]
