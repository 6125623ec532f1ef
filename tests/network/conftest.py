"""A service as a process, for all tests that need no settings of their own."""

from collections.abc import Iterator

import pytest

from tests.network.serving import Service, service


@pytest.fixture(scope="session")
def target() -> Iterator[Service]:
    with service() as made:
        yield made
