"""Answers that have begun and cannot go on: a last line reports the fault, and the end of the connection shows it."""

import logging

from starlette.types import ASGIApp, Receive, Scope, Send

from service.http.errors import ErrorAnswers

_LOG = logging.getLogger(__name__)


class AnswerCut(Exception):
    """An answer ends here though its client was promised more; the log has said why."""


class Cut:
    """Says why an answer was cut where the reason is a foreseen one: rows that are damaged, a sweep that was removed.

    What nobody has foreseen goes on to the server, whose log says where it comes from.
    """

    def __init__(self, app: ASGIApp, errors: ErrorAnswers) -> None:
        self._app = app
        self._errors = errors
        # the server closes the connection of a cut answer, as it does, and says nothing more about it
        logging.getLogger("uvicorn.error").addFilter(_news)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            await self._app(scope, receive, send)
        except Exception as error:
            # before its first part it would have been answered; the framework hides what comes after that
            reason = error if self._errors.foreseen(error) else error.__cause__
            if not isinstance(reason, Exception) or not self._errors.foreseen(reason):
                raise
            fault = self._errors.fault(reason)
            _LOG.warning("an answer was cut: %s: %s", fault.title, fault.detail)
            raise AnswerCut from None


def _news(record: logging.LogRecord) -> bool:
    return record.exc_info is None or not isinstance(record.exc_info[1], AnswerCut)
