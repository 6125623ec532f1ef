"""Two versions of the service side by side: jobs of the later one are left to it."""

import json
from dataclasses import replace
from typing import Any

import pytest

from schemas.sweep.request import SweepRequest
from service.jobs.fingerprints import fingerprint
from service.jobs.job import Order
from service.jobs.kinds import KINDS
from tests.jobs import synthetic
from tests.jobs.house import House
from tests.jobs.sweeps import MACHINE, analyses
from tests.jobs.threads import threads


def _of_a_later_version(**more: Any) -> bytes:
    """A sweep as a version stores it that has a field more, with all of its defaults."""
    body = json.loads(SweepRequest.model_validate(analyses(4, 5)).model_dump_json())
    return json.dumps({**body, "newest": 7, **more}).encode()


def test_a_job_of_a_later_version_is_left_to_it(
    house: House, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    request, columns = _of_a_later_version(), synthetic.SCHEMA.serialize().to_pybytes()
    order = Order("sweep", request, fingerprint("sweep", request), 20, 5, columns)
    job, _ = house.store.submit(order)
    own = house.submit(total=20, chunk_rows=5)
    with house.coordinator(threads(1)):
        assert house.wait(own).state == "done"
    state = house.store.get(job.id)
    # before, each of its rows was tried alone, and the job failed
    assert (state.active, state.done, state.failed, state.error) == (True, 0, 0, None)
    assert sum("does not know" in record.getMessage() for record in caplog.records) == 1
    # a service of that version, beside this one or after a step back and forth
    monkeypatch.setitem(KINDS, "sweep", replace(KINDS["sweep"], later=lambda _: False))  # type: ignore[arg-type]
    with house.coordinator(threads(1)):
        assert house.wait(job.id).state == "done"
    assert house.rows(job.id).equals(synthetic.rows(0, 20))


def test_a_kind_of_a_later_version_is_left_to_it(house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    columns = synthetic.SCHEMA.serialize().to_pybytes()
    job, _ = house.store.submit(Order("newest", b"{}", fingerprint("newest", b"{}"), 20, 5, columns))
    own = house.submit(total=20, chunk_rows=5)
    with house.coordinator(threads(1)):
        assert house.wait(own).state == "done"
    record = house.store.get(job.id)
    assert (record.active, record.done, record.failed, record.error) == (True, 0, 0, None)
    monkeypatch.setitem(KINDS, "newest", synthetic.KIND)  # type: ignore[arg-type]
    with house.coordinator(threads(1)):
        assert house.wait(job.id).state == "done"


def test_what_a_version_does_not_know_is_told_from_what_is_wrong() -> None:
    sweep, front = KINDS["sweep"].later, KINDS["pareto"].later
    today = SweepRequest.model_validate(analyses(4, 5)).model_dump_json()
    base = json.loads(today)["base"]
    assert not sweep(today.encode())
    assert sweep(_of_a_later_version())
    assert sweep(today.replace('"grid"', '"sobol"').encode())
    assert sweep(json.dumps({**json.loads(today), "base": {**base, "machine": {**base["machine"], "new": 1}}}).encode())
    assert not sweep(json.dumps({**json.loads(today), "axes": []}).encode())
    points = {"machine": MACHINE, "points": 3}
    assert (front(json.dumps(points).encode()), front(json.dumps({**points, "new": 1}).encode())) == (False, True)
