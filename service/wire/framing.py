"""Requests whose end two readers could see at two places, which h11 lets pass."""

from typing import Any

import h11

_LENGTHS = frozenset({b"content-length", b"transfer-encoding"})


class TwoLengths(h11.RemoteProtocolError):
    """A request has a Content-Length, and its body comes in chunks."""


class Framing(h11.Connection):
    """As h11 reads requests, but each has one end only.

    A proxy that believes the length sees another request where this one ends (RFC 9112, 6.1): what came after it would
    count as a request of somebody else.
    """

    def next_event(self) -> Any:
        """As h11 does.

        Raises
        ------
        TwoLengths
            after which the connection has to end.
        """
        event = super().next_event()
        if isinstance(event, h11.Request) and {name for name, _ in event.headers} >= _LENGTHS:
            raise TwoLengths("A request has either Content-Length or Transfer-Encoding, not both.")
        return event
