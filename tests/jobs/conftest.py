"""Databases for the jobs."""

from collections.abc import Iterator
from pathlib import Path

import psycopg
import pytest

from service.jobs.kinds import KINDS
from tests.jobs import postgres, synthetic
from tests.jobs.house import House


@pytest.fixture(autouse=True)
def synthetic_kind(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(KINDS, "synthetic", synthetic.KIND)  # type: ignore[arg-type]


@pytest.fixture
def house(tmp_path: Path) -> Iterator[House]:
    jobs_house = House(tmp_path)
    yield jobs_house
    jobs_house.database.close()


@pytest.fixture(scope="session")
def postgres_server() -> Iterator[str]:
    try:
        with postgres.server() as running:
            yield running.url
    except postgres.Missing as missing:
        pytest.skip(str(missing))


@pytest.fixture
def postgres_url(postgres_server: str) -> Iterator[str]:
    """A database that is empty, whichever tests came before."""
    yield postgres_server
    with psycopg.connect(postgres_server, autocommit=True) as connection:
        connection.execute("DROP SCHEMA public CASCADE")
        connection.execute("CREATE SCHEMA public")


@pytest.fixture(params=["sqlite", "postgresql"])
def any_house(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[House]:
    url = None
    if request.param == "postgresql":
        url = request.getfixturevalue("postgres_url")
    jobs_house = House(tmp_path, url)
    yield jobs_house
    jobs_house.database.close()
