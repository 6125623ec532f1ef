"""Databases for the jobs."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from service.jobs.kinds import KINDS
from tests.jobs import postgres, synthetic
from tests.jobs.house import House


@pytest.fixture(autouse=True)
def synthetic_kind(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(KINDS, "synthetic", synthetic.KIND)  # type: ignore[arg-type]


@pytest.fixture
def house(tmp_path: Path) -> Iterator[House]:
    found = House(tmp_path)
    yield found
    found.database.close()


@pytest.fixture(scope="session")
def postgres_url() -> Iterator[str]:
    try:
        with postgres.server() as running:
            yield running.url
    except postgres.Missing as missing:
        pytest.skip(str(missing))


@pytest.fixture(params=["sqlite", "postgresql"])
def any_house(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[House]:
    url = None
    if request.param == "postgresql":
        url = request.getfixturevalue("postgres_url")
    found = House(tmp_path, url)
    yield found
    if url is not None:
        from service.jobs.tables import metadata

        with found.database.write() as connection:
            metadata.drop_all(connection)
    found.database.close()
