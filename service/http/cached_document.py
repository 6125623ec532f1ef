"""Answers that stay as they are while the service runs: each has a tag, and is compressed once."""

import gzip
import hashlib
from collections.abc import Callable, Hashable
from dataclasses import dataclass
from functools import cached_property, partial
from threading import Lock
from typing import Generic, TypeVar

from starlette.requests import Request
from starlette.responses import Response

from service.common.coding import SMALL_BYTES
from service.fairness.quotas import holding
from service.fairness.threads import threads_of
from service.http.accept import preferred

#: kept by who has it, who asks each time whether it is still the same
ASKS_AGAIN = "no-cache"
#: what has its release in its address
FOR_EVER = "public, max-age=31536000, immutable"


@dataclass(frozen=True)
class CachedDocument:
    """A document, plain and compressed with gzip."""

    content: bytes
    media_type: str

    @cached_property
    def tag(self) -> str:
        """The same whatever the coding, therefore weak (RFC 9110, 8.8.1)."""
        return f'W/"{hashlib.sha256(self.content).hexdigest()[:16]}"'

    @cached_property
    def compressed(self) -> bytes:
        return gzip.compress(self.content, mtime=0)

    def answer(self, request: Request, cache: str = ASKS_AGAIN, **headers: str) -> Response:
        """The document, or that the client has it already."""
        fields = {"Cache-Control": cache, "ETag": self.tag, "Vary": "Accept-Encoding", **headers}
        if self._has_it(request):
            return Response(status_code=304, headers=fields)
        content = self.content
        # a client that says nothing takes the document as it is
        accepted = request.headers.get("accept-encoding") or "identity"
        if len(content) > SMALL_BYTES and preferred(accepted, ("gzip",)):
            content, fields["Content-Encoding"] = self.compressed, "gzip"
        return Response(content, media_type=self.media_type, headers=fields)

    def _has_it(self, request: Request) -> bool:
        """Whether a client has it; of two tags only the text counts (RFC 9110, 13.1.2)."""
        tags = [tag.strip().removeprefix("W/") for tag in request.headers.get("if-none-match", "").split(",")]
        return "*" in tags or self.tag.removeprefix("W/") in tags


Name = TypeVar("Name", bound=Hashable)


class Shelf(Generic[Name]):
    """Documents that take a tenth of a second or more to make: made in a thread at the first request for them.

    Parameters
    ----------
    make : the document of a name.
    """

    def __init__(self, make: Callable[[Name], CachedDocument]) -> None:
        self._make = make
        self._making = Lock()
        self._there: dict[Name, CachedDocument] = {}

    async def take(self, request: Request, name: Name) -> CachedDocument:
        """A document, for the answer to a request; the event loop does not wait until it is made."""
        if name in self._there:
            return self._there[name]
        return await threads_of(request).run(holding(request).who, partial(self.document, name))

    def document(self, name: Name) -> CachedDocument:
        """A document with all that is sent of it; who asks while it is made waits for the same."""
        with self._making:
            if name not in self._there:
                document = self._make(name)
                # most ask for it compressed
                if len(document.content) > SMALL_BYTES:
                    document.compressed  # noqa: B018
                self._there[name] = document
        return self._there[name]
