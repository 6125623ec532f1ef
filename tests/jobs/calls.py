"""What clients asked services and were answered, with times, so that it can be judged afterwards."""

import http.client
import io
import json
import random
import time
import uuid
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from tests.jobs.process import Service, send
from tests.jobs.sweeps import analyses
from tests.jobs.wire import Wire

Action = Literal["submit", "state", "rows", "kept", "list", "end", "resume"]


@dataclass(frozen=True)
class Call:
    """A call and its answer; times are monotonic seconds.

    service : who was asked.
    subject : the id of a sweep, of a submission its key.
    status : None if no whole answer came.
    document : the state of a sweep.
    ids : of the sweeps that were listed, or whose state was said.
    rows : indices that were read.
    whole : whether all rows were asked for that there are.
    wrong : what cannot be right in this answer, whatever else was answered.
    cut : whether the network kept its answer from the client, or is who asked a second time.
    """

    service: str
    action: Action
    subject: str
    began: float
    ended: float
    status: int | None = None
    document: dict[str, Any] | None = None
    ids: frozenset[str] = frozenset()
    rows: frozenset[int] = frozenset()
    whole: bool = False
    wrong: str = ""
    cut: bool = False


@dataclass(frozen=True)
class Sweep:
    """A sweep to ask for, and its rows as they are computed here (independent)."""

    body: dict[str, Any]

    @cached_property
    def rows(self) -> pa.Table:
        request = SweepRequest.model_validate(self.body)
        return run_chunk(request.model_dump_json().encode(), 0, request.total)

    @cached_property
    def best(self) -> list[int]:
        """The indices that are kept: those of the least forces, by sorting all of them; or all."""
        if "top" not in self.body:
            return list(self.all)
        by = [("force_peak_N", "ascending"), ("index", "ascending")]
        return sorted(pc.sort_indices(self.rows, by).to_pylist()[: self.body["top"]["count"]])

    @property
    def all(self) -> range:
        """Every index."""
        return range(self.rows.num_rows)

    @cached_property
    def invalid(self) -> int:
        """How many rows are invalid; no other is without an answer."""
        return self.rows["status"].to_pylist().count("invalid")


#: one whose rows are all kept, and one that selects some; a speed of 0 is invalid
SWEEPS = (Sweep(analyses(30, 50)), Sweep(analyses(40, 40, top={"by": "force_peak_N", "count": 5})))


@dataclass
class Client:
    """Calls services and writes down what it was answered.

    Parameters
    ----------
    services : by name, those that live now.
    wires : by name, the network before each service.
    calls, sweeps, gone : shared with other clients: all calls; the sweeps that were accepted, by id; those of them that
        were said to be gone.
    """

    name: str
    services: Callable[[], dict[str, Service]]
    wires: Mapping[str, Wire]
    chance: random.Random
    calls: list[Call]
    sweeps: dict[str, Sweep]
    gone: set[str]
    #: sweeps that it wants there to be at most
    most: int
    #: submissions that were not answered yet
    open: dict[str, Sweep] = field(default_factory=dict)
    _submitted: int = 0

    def submit(self) -> None:
        """Submit a new sweep, or one again that was not answered."""
        if not self.open:
            self._submitted += 1
            self.open[f"{self.name}-{self._submitted}"] = self.chance.choice(SWEEPS)
        key, sweep = next(iter(self.open.items()))
        call = self._call("submit", key, "POST", "/v1/sweeps", sweep.body, sweep)
        if call.document is not None:
            self.sweeps[call.document["id"]] = sweep
            del self.open[key]

    def state(self, job: str) -> Call:
        return self._call("state", job, "GET", f"/v1/sweeps/{job}")

    def resume(self, job: str) -> Call:
        return self._call("resume", job, "POST", f"/v1/sweeps/{job}/resume")

    def end(self, job: str) -> Call:
        """Cancel it if it runs, remove it if it has ended."""
        return self._call("end", job, "DELETE", f"/v1/sweeps/{job}")

    def rows(self, job: str, first: int = 0, count: int | None = None) -> Call:
        limit = "" if count is None else f"&limit={count}"
        path = f"/v1/sweeps/{job}/results?format=parquet&select=all&offset={first}{limit}"
        span = self.sweeps[job].all[first : None if count is None else first + count]
        return self._call("rows", job, "GET", path, span=span)

    def table(self, job: str) -> Call:
        return self._call("kept", job, "GET", f"/v1/sweeps/{job}/results?format=parquet")

    def all(self) -> Call:
        """All sweeps, as far as they fit on a page."""
        return self._call("list", "", "GET", "/v1/sweeps?limit=200")

    def something(self) -> None:
        """Whatever clients do."""
        there = [job for job in list(self.sweeps) if job not in self.gone]
        if self.open or not there or (len(there) < self.most and self.chance.random() < 0.1):
            return self.submit()
        job = self.chance.choice(there)
        first, count = self.chance.randrange(1000), self.chance.randrange(1, 1000)
        does: dict[Callable[[], object], int] = {
            lambda: self.state(job): 30,
            lambda: self.rows(job): 15,
            lambda: self.rows(job, first, count): 10,
            lambda: self.table(job): 10,
            self.all: 10,
            lambda: self.end(job): 4,
            lambda: self.resume(job): 6,
        }
        self.chance.choices(list(does), list(does.values()))[0]()
        return None

    def _call(
        self,
        action: Action,
        subject: str,
        method: str,
        path: str,
        body: object = None,
        sweep: Sweep | None = None,
        span: range = range(0),
    ) -> Call:
        while not (services := self.services()):
            time.sleep(0.05)
        service = self.chance.choice(sorted(services))
        wire, identity = self.wires[service], uuid.uuid4().hex
        headers = {"X-Request-ID": identity, **({"Idempotency-Key": subject} if action == "submit" else {})}
        began = time.monotonic()
        try:
            status, fields, content = send(wire.where, method, path, body, **headers)
        except (OSError, http.client.HTTPException):
            call = Call(service, action, subject, began, time.monotonic(), cut=identity in wire.cut)
        else:
            ended = time.monotonic()
            about = _understood(action, status, fields, content, sweep or self.sweeps.get(subject), span)
            call = Call(service, action, subject, began, ended, status, **about)
        self.calls.append(call)
        if identity in wire.doubled:
            self.calls.append(Call(service, action, subject, began, call.ended, cut=True))
        if action != "submit" and call.status in (204, 404):
            self.gone.add(subject)
        return call


def _understood(
    action: Action, status: int, headers: dict[str, str], content: bytes, sweep: Sweep | None, span: range
) -> dict[str, Any]:
    if status >= 400:
        return {"wrong": _wrong_problem(status, headers, content)}
    if status == 204:
        return {}
    if action == "list":
        page = json.loads(content)
        wrong = "" if page["next"] is None else "more sweeps than fit on a page"
        return {"ids": frozenset(survey["id"] for survey in page["sweeps"]), "wrong": wrong}
    assert sweep is not None
    if action in ("rows", "kept"):
        rows = pq.ParquetFile(io.BytesIO(content)).read(use_threads=False)
        index = rows["index"].to_pylist()
        complete = headers["sweep-complete"] == "true"
        right = list(span) if action == "rows" else sweep.best
        wrong = _wrong_rows(rows, index, right if complete else None, sweep)
        return {"rows": frozenset(index), "whole": span == sweep.all, "wrong": wrong}
    document = json.loads(content)
    return {"document": document, "ids": frozenset([document["id"]]), "wrong": _wrong_state(document, sweep)}


def _wrong_problem(status: int, headers: dict[str, str], content: bytes) -> str:
    """Problem details say what is wrong, and when to ask again where that helps."""
    if headers.get("content-type") != "application/problem+json":
        return f"{status} is no problem+json"
    error = json.loads(content)
    if error["status"] != status or not error["title"] or not error["detail"]:
        return f"a problem that says nothing: {error}"
    if status == 503 and "retry-after" not in headers:
        return "503 without Retry-After"
    if "127.0.0.1" in error["detail"]:
        return f"a problem that tells where the database is: {error['detail']}"
    if status >= 500 and error["title"] != "Database unavailable":
        return f"{status} {error['title']}: {error['detail']}"
    return ""


def _wrong_rows(rows: pa.Table, index: list[int], complete: list[int] | None, sweep: Sweep) -> str:
    if index != sorted(set(index)):
        return "rows are doubled, or not in order"
    if not rows.equals(sweep.rows.take(pa.array(index, pa.int64()))):
        return "rows differ from those that are computed here"
    if complete is not None and index != complete:
        return f"{len(index)} rows are said to be complete, which are {len(complete)} others"
    return ""


def _wrong_state(fields: dict[str, Any], sweep: Sweep) -> str:
    if fields["total"] != sweep.rows.num_rows:
        return f"a sweep of {fields['total']} rows"
    if fields["repaired"] or fields["state"] == "failed":
        return f"a sweep that is {fields['state']}, with {fields['repaired']} damaged files: {fields['message']}"
    counted = fields["done"], fields["failed"], fields["invalid"]
    if fields["state"] == "done" and counted != (fields["total"], 0, sweep.invalid):
        return (
            f"done, with {fields['done']} rows, of which {fields['failed']} failed and {fields['invalid']} are invalid"
        )
    return ""
