"""The compose file: its parts fit each other, the image and the settings."""

import re
from collections.abc import Mapping
from typing import Any

import pytest

from service.fairness.table import shares
from service.jobs.engines import engine
from service.settings import Settings
from tests.deploy.files import compose, dockerfile_environment, settings_variables

SERVICES: Mapping[str, Any] = compose()["services"]
OURS = ("service", "scheduler", "worker")


def test_it_holds_the_service_a_database_and_a_cluster() -> None:
    assert set(SERVICES) == {*OURS, "postgres"}


def test_the_settings_are_ones_of_the_service(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in {**dockerfile_environment(), **SERVICES["service"]["environment"]}.items():
        if name.startswith("COUNTERWEIGHT_"):
            assert name in settings_variables()
            # as compose reads ${NAME:-default}
            monkeypatch.setenv(name, re.sub(r"\$\{\w+:-(\w*)\}", r"\1", value))
    settings = Settings()
    assert settings.database_url is not None
    assert settings.concurrent_solves == 2
    assert re.fullmatch(r"postgresql://\w+@postgres/\w+", settings.database_url)
    assert settings.engine == "dask:tcp://scheduler:8786"
    assert engine(settings.engine, 1) is not None
    assert not settings.allow_without_keys


@pytest.mark.parametrize("name", OURS)
def test_ours_run_with_a_read_only_root_and_no_rights(name: str) -> None:
    service = SERVICES[name]
    assert service["read_only"] is True
    assert service["cap_drop"] == ["ALL"]
    assert any(line.startswith("/tmp:") for line in service["tmpfs"])


def test_the_service_is_published_on_this_machine_alone_unless_asked() -> None:
    assert SERVICES["service"]["ports"] == ["${COUNTERWEIGHT_PUBLISH:-127.0.0.1:8000}:8000"]
    assert all("ports" not in SERVICES[name] for name in SERVICES if name != "service")


def test_the_network_of_the_database_and_of_dask_has_no_way_out() -> None:
    """Analytic: dask has no authentication, whoever reaches the scheduler runs code in the workers."""
    assert compose()["networks"]["back"] == {"internal": True}
    for name in ("scheduler", "worker", "postgres"):
        assert SERVICES[name]["networks"] == ["back"]


def test_the_scheduler_listens_where_the_service_and_the_workers_look() -> None:
    command = SERVICES["scheduler"]["command"]
    assert command[command.index("--port") + 1] == "8786"
    assert "tcp://scheduler:8786" in SERVICES["worker"]["command"]


def test_workers_read_the_folder_at_the_same_path() -> None:
    """The flag that ends a cancelled sweep is a file, named by its path in the service."""
    assert SERVICES["service"]["volumes"] == ["data:/data"]
    assert SERVICES["worker"]["volumes"] == ["data:/data:ro"]
    assert dockerfile_environment()["COUNTERWEIGHT_DATA_DIR"] == "/data"


@pytest.mark.parametrize("name", SERVICES)
def test_memory_processors_and_disk_are_limited(name: str) -> None:
    service = SERVICES[name]
    assert {"mem_limit", "cpus", "pids_limit"} <= service.keys()
    assert service["logging"]["options"].keys() == {"max-size", "max-file"}
    assert name not in OURS or any("size=1g" in mount for mount in service["tmpfs"])


def test_what_others_made_is_named_by_digest() -> None:
    assert re.fullmatch(r"postgres:17-bookworm@sha256:[0-9a-f]{64}", SERVICES["postgres"]["image"])


def test_memory_suffices_for_the_computations_that_it_allows() -> None:
    """As by default; dask sweeps, so there are no sweep workers beside the service."""
    limit, solves = (
        int(re.fullmatch(r"\$\{COUNTERWEIGHT_\w+:-(\d+)g?\}", value)[1])  # type: ignore[index]
        for value in (
            SERVICES["service"]["mem_limit"],
            SERVICES["service"]["environment"]["COUNTERWEIGHT_CONCURRENT_SOLVES"],
        )
    )
    # two above them, for clients that had little lately
    assert (
        (solves + shares(Settings())["short"].reserve) * Settings().solve_memory_mb + 300
    ) * 1_000_000 < limit * 2**30


def test_it_waits_longer_for_the_end_than_the_service_needs() -> None:
    assert int(SERVICES["service"]["stop_grace_period"].removesuffix("s")) > 2 * Settings().graceful_shutdown_s
