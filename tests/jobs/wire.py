"""A network that fails: between a client and a service it delays, drops and duplicates requests and answers.

What it did to a request it notes by the request's ``X-Request-ID``, so that a history can be judged. A request that was
dropped may have had its effect or not, one that was duplicated had it twice.
"""

import random
import socket
import socketserver
import threading
import time
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from typing import Literal

Where = tuple[str, int]
Fault = Literal["none", "slow", "lost request", "lost answer", "cut answer", "twice"]
#: how often, of so many requests
_CHANCES: dict[Fault, int] = {
    "none": 50, "slow": 7, "lost request": 7, "lost answer": 7, "cut answer": 7, "twice": 7,
}  # fmt: skip
#: the longest delay [s]
_SLOW_S = 1.0
_PATIENCE_S = 300.0


class Wire:
    """A port on loopback behind which a service is reached; it stays while services come and go.

    Parameters
    ----------
    service : where the service listens now; None while it does not.
    """

    def __init__(self, service: Callable[[], Where | None], seed: float) -> None:
        #: ids of requests whose answer the client was not to get, and of those that were sent twice
        self.cut: set[str] = set()
        self.doubled: set[str] = set()
        self.counts: Counter[str] = Counter()
        self._service, self._chance, self._lock = service, random.Random(seed), threading.Lock()
        self._chances: dict[Fault, int] = dict(_CHANCES)
        wire = self

        class _Handler(socketserver.BaseRequestHandler):
            def handle(self) -> None:
                # a client or a service that has gone ends it
                with suppress(OSError):
                    wire._carry(self.request)

        self._server = socketserver.ThreadingTCPServer(("127.0.0.1", 0), _Handler)
        self._server.daemon_threads = True
        self._thread = threading.Thread(target=self._server.serve_forever, args=(0.05,), daemon=True)
        self._thread.start()

    @property
    def where(self) -> Where:
        """Where clients connect to."""
        host, port = self._server.server_address[:2]
        return str(host), int(port)

    def calm(self) -> None:
        """From now on carry everything as it comes."""
        self._chances = {"none": 1}

    def close(self) -> None:
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()

    def _carry(self, client: socket.socket) -> None:
        """One request, and its answer."""
        client.settimeout(_PATIENCE_S)
        head, body = _request(client)
        if not head:
            return
        identity = head.lower().partition(b"x-request-id:")[2].partition(b"\r\n")[0].strip().decode()
        with self._lock:
            (fault,) = self._chance.choices(list(self._chances), list(self._chances.values()))
            share, delay_s = self._chance.random(), self._chance.uniform(0.0, _SLOW_S)
            if fault in ("lost request", "lost answer", "cut answer"):
                self.cut.add(identity)
            if fault == "twice":
                self.doubled.add(identity)
            if fault != "none":
                self.counts[fault] += 1
        if fault == "lost request":
            return
        if fault == "slow":
            time.sleep(delay_s)
        answer = self._exchange(head, body)
        if fault == "twice":
            # either of the two answers comes back
            again = self._exchange(head, body)
            answer = again if share < 0.5 and again else answer
        if fault == "lost answer":
            return
        head_bytes = answer.find(b"\r\n\r\n") + 4
        # half a head is taken for a whole one by the client of the standard library
        if head_bytes >= 4:
            last = head_bytes + int(share * (len(answer) - head_bytes))
            client.sendall(answer[:last] if fault == "cut answer" else answer)

    def _exchange(self, head: bytes, body: bytes) -> bytes:
        """The whole answer of the service; nothing where it ends before."""
        where = self._service()
        if where is None:
            return b""
        pieces = []
        with socket.create_connection(where, _PATIENCE_S) as connection:
            connection.sendall(head[:-2] + b"Connection: close\r\n\r\n" + body)
            while piece := connection.recv(65_536):
                pieces.append(piece)
        return b"".join(pieces)


def _request(client: socket.socket) -> tuple[bytes, bytes]:
    """Head and body of the one request of a connection; empty where there is none."""
    content = b""
    while b"\r\n\r\n" not in content:
        piece = client.recv(65_536)
        if not piece:
            return b"", b""
        content += piece
    head, _, body = content.partition(b"\r\n\r\n")
    length = head.lower().partition(b"content-length:")[2].partition(b"\r\n")[0].strip()
    while len(body) < int(length or 0):
        piece = client.recv(65_536)
        if not piece:
            return b"", b""
        body += piece
    return head + b"\r\n\r\n", body
