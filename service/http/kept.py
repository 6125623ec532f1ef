"""Answers that stay as they are while the service runs: each has a tag, and is compressed once."""

import gzip
import hashlib
from dataclasses import dataclass
from functools import cached_property

from starlette.requests import Request
from starlette.responses import Response

from service.common.coding import SMALL_BYTES
from service.http.accept import preferred

#: kept by who has it, who asks each time whether it is still the same
ASKS_AGAIN = "no-cache"
#: what has its release in its address
FOR_EVER = "public, max-age=31536000, immutable"


@dataclass(frozen=True)
class Kept:
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
        told = {"Cache-Control": cache, "ETag": self.tag, "Vary": "Accept-Encoding", **headers}
        if self._known(request):
            return Response(status_code=304, headers=told)
        content = self.content
        # a client that says nothing takes the document as it is
        accepted = request.headers.get("accept-encoding") or "identity"
        if len(content) > SMALL_BYTES and preferred(accepted, ("gzip",)):
            content, told["Content-Encoding"] = self.compressed, "gzip"
        return Response(content, media_type=self.media_type, headers=told)

    def _known(self, request: Request) -> bool:
        """Whether a client has it; of two tags only the text counts (RFC 9110, 13.1.2)."""
        given = [each.strip().removeprefix("W/") for each in request.headers.get("if-none-match", "").split(",")]
        return "*" in given or self.tag.removeprefix("W/") in given
