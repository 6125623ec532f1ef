"""A service as a process, for all tests that need no settings of their own, and a pool of two short computations."""

from collections.abc import Iterator

import pytest

from service.workers.pool import Pool
from tests.network.pools import pool_of
from tests.network.serving import Service, service


@pytest.fixture(scope="session")
def target() -> Iterator[Service]:
    with service() as server:
        yield server


@pytest.fixture
def pool() -> Iterator[Pool]:
    actual_pool = pool_of(2, 2)
    yield actual_pool
    actual_pool.close()
