"""The same rows from a real cluster of two workers on loopback."""

import gc
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

distributed = pytest.importorskip("distributed", reason="the extra dask is not installed")

import dask  # noqa: E402

from optimizer.studies.sweep import run_chunk  # noqa: E402
from schemas.sweep.request import SweepRequest  # noqa: E402
from service.jobs import engines, worker  # noqa: E402
from service.jobs.engines import engine  # noqa: E402
from service.jobs.job import Order  # noqa: E402
from tests.jobs import synthetic  # noqa: E402
from tests.jobs.house import House  # noqa: E402
from tests.jobs.sweeps import analyses, optimisations  # noqa: E402
from tests.night import every  # noqa: E402

pytestmark = pytest.mark.filterwarnings("default::ResourceWarning", "default::DeprecationWarning")


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    patient = {"distributed.comm.timeouts.connect": "300s", "distributed.comm.timeouts.tcp": "300s"}
    with (
        dask.config.set(patient),
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None
        ) as cluster,
    ):
        yield cluster.scheduler_address
    # what it leaves to the collection of garbage is found here, not in the tests that follow
    gc.collect()


def test_a_cluster(house: House, address: str) -> None:
    job = house.submit(total=200, chunk_rows=7)
    with house.coordinator(engine(f"dask:{address}", 1)):
        outcome = house.wait(job)
    assert (outcome.state, outcome.done) == ("done", 200)
    assert house.rows(job).equals(synthetic.rows(0, 200))


def test_a_killed_worker_of_the_cluster_costs_a_retry(house: House, address: str, tmp_path: Path) -> None:
    job = house.submit(total=60, chunk_rows=5, kill_at=31, kill_once=str(tmp_path / "killed"))
    with house.coordinator(engine(f"dask:{address}", 1)):
        outcome = house.wait(job)
    assert (tmp_path / "killed").exists()
    assert (outcome.state, outcome.failed) == ("done", 0)
    assert house.rows(job).equals(synthetic.rows(0, 60))


@pytest.mark.parametrize("body", every(2, [optimisations(90), analyses(10, 30)]), ids=["optimize", "analyze"])
def test_a_real_sweep_on_the_cluster(house: House, address: str, body: dict[str, Any]) -> None:
    request = SweepRequest.model_validate(body)
    data = request.model_dump_json().encode()
    job, _ = house.store.submit(Order("sweep", data, "digest", request.total, 37))
    coordinator = house.coordinator_on(engine(f"dask:{address}", 1), run=worker.run)
    coordinator.start()
    try:
        assert house.wait(job.id).state == "done"
    finally:
        coordinator.stop()
    assert house.rows(job.id).equals(run_chunk(data, 0, request.total))


def test_a_cluster_that_is_not_there_is_waited_for(house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engines, "_CONNECT_S", 0.5)
    job = house.submit()
    with house.coordinator(engine("dask:tcp://127.0.0.1:1", 1)) as coordinator:
        assert coordinator.verdict(job) is None
    assert house.store.get(job).state == "queued"
