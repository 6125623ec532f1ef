"""Headers of a request as its scope has them (ASGI): names in small letters, values as bytes."""

from collections.abc import MutableMapping
from typing import Any


def header(scope: MutableMapping[str, Any], name: bytes) -> str | None:
    """The first of a name; None if there is none."""
    for key, value in scope["headers"]:
        if key == name:
            text: str = value.decode("latin-1")
            return text
    return None


def header_list(scope: MutableMapping[str, Any], name: bytes) -> str:
    """All of a name as one list (RFC 9110, 5.3); empty if there is none."""
    return b",".join([value for key, value in scope["headers"] if key == name]).decode("latin-1")
