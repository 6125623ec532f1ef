"""The benchmark on the wire runs once every night; times are for `make bench`."""

import pytest

from tests.benchmarks.wire import Seen, measure


@pytest.mark.nightly
def test_every_kind_of_connection_is_measured() -> None:
    seen = {(target.name, count, kept): found for target, count, kept, found in measure((2,), 0.1)}
    assert set(seen) == {(name, 2, kept) for name in ("service", "echo") for kept in (True, False)}
    for (name, _, _), found in seen.items():
        assert len(found.seconds) >= 2
        assert len(found.optima_ms) == (len(found.seconds) if name == "service" else 0)


def test_quantiles() -> None:
    # analytic: of 1 to 100 ms
    seen = Seen([k / 1e3 for k in range(100, 0, -1)], wall_s=2.0, front_s=0.2)
    assert (seen.quantile_ms(0.5), seen.quantile_ms(0.99), seen.quantile_ms(1.0)) == (51, 100, 100)
    assert (seen.per_second, seen.each_ms(seen.front_s)) == (50, 2)
