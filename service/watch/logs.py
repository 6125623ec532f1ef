"""The log: a JSON object a line on standard error, each with the request that it belongs to.

Everything in the package and in its libraries logs with :mod:`logging`; python-json-logger formats its records, so one
formatter covers them all and nothing has to be logged in another way.
"""

import json
import logging
import re
import sys
import traceback
from contextvars import ContextVar
from types import TracebackType
from typing import Any

from pythonjsonlogger.core import RESERVED_ATTRS
from pythonjsonlogger.json import JsonFormatter

from service.settings import Settings

#: request_id, trace_id and span_id of the request that is being answered
REQUEST: ContextVar[dict[str, str]] = ContextVar("request", default={})  # noqa: B039 - never changed in place

_ExcInfo = tuple[type[BaseException], BaseException, TracebackType | None] | tuple[None, None, None]


class _WithRequest(logging.Filter):
    def filter(self, record: logging.LogRecord) -> bool:
        for name, value in REQUEST.get().items():
            setattr(record, name, value)
        return True


def _frames(exc_info: _ExcInfo) -> str:
    """Where an exception was raised, and its kind; its message may quote what a client sent."""
    kind, error, trace = exc_info
    lines = [f"{frame.filename}:{frame.lineno} in {frame.name}" for frame in traceback.extract_tb(trace)]
    if isinstance(error, BaseExceptionGroup):
        lines += [_frames((type(exception), exception, exception.__traceback__)) for exception in error.exceptions]
    return "\n".join([*lines, "" if kind is None else kind.__qualname__])


class _Json(JsonFormatter):
    def __init__(self, quotes: bool) -> None:
        super().__init__(
            "%(asctime)s %(levelname)s %(name)s %(message)s",
            rename_fields={"asctime": "time", "levelname": "level", "name": "logger"},
            datefmt="%Y-%m-%dT%H:%M:%S%z",
            json_ensure_ascii=True,
            # what it holds is in the record field by field as well
            reserved_attrs=[*RESERVED_ATTRS, "about"],
        )
        self._quotes = quotes

    def formatException(self, ei: _ExcInfo) -> str:
        return logging.Formatter.formatException(self, ei) if self._quotes else _frames(ei)


#: characters that end a line or move a cursor, but for the end of a line itself
_CONTROLS = {code: f"\\x{code:02x}" for code in (*range(10), *range(11, 32), *range(127, 160), 0x2028, 0x2029)}
_PLAIN = re.compile(r"[!#-~]+")


def _field(value: Any) -> str:
    """A value as it is, or quoted where it might be taken for something else."""
    return str(value) if _PLAIN.fullmatch(str(value)) else json.dumps(str(value))


class _Text(logging.Formatter):
    """A line begins with its time; what goes on is indented, so that nobody who is quoted begins a line."""

    def __init__(self, quotes: bool) -> None:
        super().__init__("%(asctime)s %(levelname)-7s %(message)s")
        self._quotes = quotes

    def format(self, record: logging.LogRecord) -> str:
        about: dict[str, Any] = getattr(record, "about", {})
        text = " ".join([super().format(record), *(f"{name}={_field(value)}" for name, value in about.items())])
        return "\n    ".join(text.translate(_CONTROLS).split("\n"))

    def formatException(self, ei: _ExcInfo) -> str:
        return super().formatException(ei) if self._quotes else _frames(ei)


def configure(settings: Settings) -> None:
    """Have every logger of the process write to standard error, as the settings say."""
    handler = logging.StreamHandler(sys.stderr)
    formatter = _Json if settings.log_format == "json" else _Text
    handler.setFormatter(formatter(settings.log_machines))
    handler.addFilter(_WithRequest())
    root = logging.getLogger()
    root.handlers[:] = [handler]
    root.setLevel(settings.log_level.upper())
    # it tells of every start and stop, which the address on standard output does already
    logging.getLogger("uvicorn.error").setLevel(max(logging.WARNING, root.level))
