"""A client of the service, with nothing but the standard library: copy this file beside your own.

    from counterweight import Service

    service = Service("http://127.0.0.1:8000")
    answer = service.optimize({"machine": machine})
    print(answer["status"], answer["total_mass_kg"])

Requests and answers are the JSON documents of the service as dictionaries; ``/docs`` of the running service describes
every field. What the service refuses is raised as :class:`Refused`, with the fields that are wrong. It runs on Python
3.8 and newer.
"""

from __future__ import annotations

import json
import time
import uuid
from datetime import datetime, timezone
from email.utils import parsedate_to_datetime
from http.client import HTTPResponse
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, Mapping
from urllib.error import HTTPError
from urllib.parse import urlencode, urlsplit
from urllib.request import Request, urlopen

Document = Dict[str, Any]

#: busy or not ready: the header Retry-After says when to try again
_LATER = (429, 503)
_ACTIVE = ("queued", "running")
_REPORTS = {".html": "text/html", ".pdf": "application/pdf"}
_WORKBOOK = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"
_TABLES = {".ndjson": "ndjson", ".csv": "csv", ".parquet": "parquet", ".arrow": "arrow"}


class Refused(Exception):
    """The service answered with an error.

    Attributes
    ----------
    status : HTTP status.
    problem : the answer, problem details of RFC 9457.
    fields : message by JSON pointer of every field that is wrong.
    """

    def __init__(self, status: int, problem: Document) -> None:
        self.status = status
        self.problem = problem
        self.fields: dict[str, str] = {one["pointer"]: one["message"] for one in problem.get("errors", ())}
        lines = [f"{status} {problem.get('title', 'error')}: {problem.get('detail', '')}"]
        super().__init__("\n  ".join(lines + [f"{pointer or '/'}: {said}" for pointer, said in self.fields.items()]))


class Service:
    """A running service.

    Parameters
    ----------
    url : where it is.
    key : API key, where it asks for one.
    timeout_s : how long to wait for one answer [s].
    patience_s : how long to try again while the service is busy or not ready, all waits of a call together [s].

    A service that cannot be reached raises ``OSError``.
    """

    def __init__(
        self,
        url: str = "http://127.0.0.1:8000",
        key: str | None = None,
        timeout_s: float = 60.0,
        patience_s: float = 60.0,
    ) -> None:
        self._url = url.rstrip("/") + "/"
        self._key = key
        self._timeout_s = timeout_s
        self._patience_s = patience_s

    def version(self) -> Document:
        """Which version answers."""
        return self._json("GET", "v1/version")

    def effects(self) -> Document:
        """What outputs there are, and what each of them needs."""
        return self._json("GET", "v1/effects")

    def examples(self) -> Document:
        """The list of example machines."""
        return self._json("GET", "v1/examples")

    def example(self, name: str) -> Document:
        """A request that can be sent as it is."""
        return self._json("GET", f"v1/examples/{name}")

    def optimize(self, request: Mapping[str, Any]) -> Document:
        """The best counterweights, with their certificate; ``status`` may be infeasible, which is an answer."""
        return self.post("v1/optimize", request)

    def analyze(self, request: Mapping[str, Any]) -> Document:
        """What a machine does as it stands, or with given counterweights."""
        return self.post("v1/analyze", request)

    def pareto(self, request: Mapping[str, Any]) -> Document:
        """The trade-off of peak force, peak moment and total mass."""
        return self.post("v1/pareto", request)

    def match(self, request: Mapping[str, Any]) -> Document:
        """Which weighed part goes on which row."""
        return self.post("v1/match", request)

    def rating(self, request: Mapping[str, Any]) -> Document:
        """The thermal design of a compressor."""
        return self.post("v1/rating", request)

    def pin_loads(self, request: Mapping[str, Any]) -> Document:
        """Loads of the anti-rotation pins of a scroll."""
        return self.post("v1/scroll/pin-loads", request)

    def accuracy(self, request: Mapping[str, Any]) -> Document:
        """What accuracy costs in time on a machine."""
        return self.post("v1/accuracy", request)

    def verify(self, request: Mapping[str, Any], answer: Mapping[str, Any]) -> Document:
        """Whether the claims of an answer to a request hold."""
        return self.post("v1/verify", {"request": request, "answer": answer})

    def post(self, path: str, request: Mapping[str, Any]) -> Document:
        """The answer of any other route."""
        return self._json("POST", path, request)

    def report(self, request: Mapping[str, Any], path: str | Path) -> Path:
        """Write the report on a machine to a file, .html or .pdf."""
        target = Path(path)
        accept = {"Accept": _known(_REPORTS, target)}
        with self._send("POST", "v1/report", request, accept) as answer:
            target.write_bytes(answer.read())
        return target

    def drawings(self, request: Mapping[str, Any], path: str | Path) -> Path:
        """Write the drawings of counterweights to a zip file: those of the request, or else the best ones."""
        target = Path(path)
        with self._send("POST", "v1/drawings", request) as answer:
            target.write_bytes(answer.read())
        return target

    def picture(self, name: str, request: Mapping[str, Any]) -> str:
        """A drawing of the answer as SVG: front, side, force, moment, bearings, indicator, stages or orders."""
        with self._send("POST", f"v1/pictures/{name}", request) as answer:
            found: str = answer.read().decode()
        return found

    def template(self, path: str | Path, example: str = "single-horizontal") -> Path:
        """Write an example to a workbook, .xlsx, to be changed into a machine of one's own."""
        target = Path(path)
        with self._send("GET", f"v1/template.xlsx?{urlencode({'example': example})}") as answer:
            target.write_bytes(answer.read())
        return target

    def optimize_workbook(self, machine: str | Path, path: str | Path) -> Path:
        """Write the answer to a workbook to another one; what is refused names the cells."""
        target = Path(path)
        headers = {"Content-Type": _WORKBOOK, "Accept": _WORKBOOK}
        with self._send("POST", "v1/optimize", Path(machine).read_bytes(), headers) as answer:
            target.write_bytes(answer.read())
        return target

    def request_of(self, machine: str | Path) -> Document:
        """The request that a workbook holds; what is refused names the cells."""
        headers = {"Content-Type": _WORKBOOK, "Accept": "application/json"}
        with self._send("POST", "v1/convert", Path(machine).read_bytes(), headers) as answer:
            found: Document = json.load(answer)
        return found

    def sweep(self, request: Mapping[str, Any]) -> Document:
        """Start a sweep, exactly once however often this has to be tried; its state, with its ``id``."""
        return self._json("POST", "v1/sweeps", request, {"Idempotency-Key": str(uuid.uuid4())})

    def later(self, path: str, request: Mapping[str, Any]) -> Document:
        """Have ``v1/optimize``, ``v1/pareto``, ``v1/accuracy`` or ``v1/match`` answered later; the job's state."""
        headers = {"Prefer": "respond-async", "Idempotency-Key": str(uuid.uuid4())}
        return self._json("POST", path, request, headers)

    def result(self, job: Mapping[str, Any]) -> Document:
        """The answer of a job that is done."""
        return self._json("GET", job["links"]["results"])

    def sweeps(self, limit: int = 50) -> Iterator[Document]:
        """The states of all sweeps, newest first; so many are asked for at a time."""
        path = f"v1/sweeps?limit={limit}"
        while path:
            page = self._json("GET", path)
            yield from page["sweeps"]
            path = page["next"]

    def state(self, sweep: Mapping[str, Any]) -> Document:
        """How far a sweep is."""
        return self._json("GET", sweep["links"]["self"])

    def metadata(self, sweep: Mapping[str, Any]) -> Document:
        """Request, versions, seed and columns of a sweep."""
        return self._json("GET", sweep["links"]["self"] + "/metadata")

    def resume(self, sweep: Mapping[str, Any]) -> Document:
        """Go on with a sweep that was cancelled or has failed."""
        return self._json("POST", sweep["links"]["self"] + "/resume")

    def end(self, sweep: Mapping[str, Any]) -> Document | None:
        """Cancel a sweep that runs; remove one that has ended, of which nothing is left to tell."""
        with self._send("DELETE", sweep["links"]["self"]) as answer:
            content = answer.read()
        return json.loads(content) if content else None

    def events(self, sweep: Mapping[str, Any]) -> Iterator[Document]:
        """The states of a sweep as they change, up to its end."""
        with self._send("GET", sweep["links"]["self"] + "/events") as answer:
            for line in answer:
                if line.startswith(b"data:"):
                    yield json.loads(line[len(b"data:") :])

    def finished(self, sweep: Mapping[str, Any], told: Callable[[Document], None] = lambda state: None) -> Document:
        """Wait until a sweep has ended; every state on the way is told."""
        pause_s = 0.1
        while (state := self.state(sweep))["state"] in _ACTIVE:
            told(state)
            time.sleep(pause_s)
            pause_s = min(2.0, 1.5 * pause_s)
        told(state)
        return state

    def rows(self, sweep: Mapping[str, Any], **query: Any) -> Iterator[Document]:
        """The rows of a sweep, one after the other, as they arrive; ``offset``, ``limit``, ``columns`` choose."""
        path = f"{sweep['links']['results']}?{urlencode({'format': 'ndjson', **query})}"
        with self._send("GET", path) as answer:
            for line in answer:
                yield json.loads(line)

    def download(self, sweep: Mapping[str, Any], path: str | Path) -> Path:
        """Write the rows of a sweep to a file, .ndjson, .csv, .parquet or .arrow."""
        target = Path(path)
        query = urlencode({"format": _known(_TABLES, target)})
        with self._send("GET", f"{sweep['links']['results']}?{query}") as answer, target.open("wb") as file:
            while piece := answer.read(1 << 20):
                file.write(piece)
        return target

    def _json(
        self, method: str, path: str, body: Mapping[str, Any] | None = None, headers: Mapping[str, str] | None = None
    ) -> Document:
        with self._send(method, path, body, headers) as answer:
            found: Document = json.load(answer)
        return found

    def _send(
        self,
        method: str,
        path: str,
        body: Mapping[str, Any] | bytes | None = None,
        headers: Mapping[str, str] | None = None,
    ) -> HTTPResponse:
        content = body if body is None or isinstance(body, bytes) else json.dumps(body, allow_nan=False).encode()
        kind = {} if body is None else {"Content-Type": "application/json"}
        request = Request(self._where(path), content, {**kind, **(headers or {})}, method=method)
        if self._key is not None:
            # not sent on to wherever an answer redirects
            request.add_unredirected_header("Authorization", f"Bearer {self._key}")
        until = time.monotonic() + self._patience_s
        answer = None
        while answer is None:
            answer = self._tried(request, until)
        return answer

    def _tried(self, request: Request, until: float) -> HTTPResponse | None:
        """The answer; None, once it was waited as long as the service asked for, if it was busy."""
        try:
            answer: HTTPResponse = urlopen(request, timeout=self._timeout_s)
        except HTTPError as error:
            with error:
                wait_s = _retry_after_s(error)
                if error.code not in _LATER or wait_s is None or time.monotonic() + wait_s > until:
                    raise Refused(error.code, _problem(error)) from None
            time.sleep(wait_s)
            return None
        return answer

    def _where(self, path: str) -> str:
        """Links of an answer begin at the root of the host, paths given here where the service is."""
        host = urlsplit(self._url)
        return f"{host.scheme}://{host.netloc}{path}" if path.startswith("/") else self._url + path


def _retry_after_s(error: HTTPError) -> float | None:
    """Seconds until the next try; the header holds seconds or a date."""
    said = error.headers.get("Retry-After")
    if said is None:
        return None
    if said.isdecimal():
        return float(said)
    try:
        return max(0.0, (parsedate_to_datetime(said) - datetime.now(timezone.utc)).total_seconds())
    except (TypeError, ValueError):
        return None


def _problem(error: HTTPError) -> Document:
    """The problem details; a proxy in front may answer in its own way."""
    try:
        found = json.loads(error.read())
    except ValueError:
        found = None
    return found if isinstance(found, dict) else {"title": error.reason, "detail": ""}


def _known(kinds: Mapping[str, str], path: Path) -> str:
    try:
        return kinds[path.suffix.lower()]
    except KeyError:
        raise ValueError(f"{path}: the name must end in {', '.join(kinds)}") from None
