"""The benchmark on the wire runs once every night; times are for `make bench`."""

import pytest

from tests.benchmarks.wire import Timings, measure


@pytest.mark.nightly
def test_every_kind_of_connection_is_measured() -> None:
    timings = {
        (target.name, count, lasting): measure_timings for target, count, lasting, measure_timings in measure((2,), 0.1)
    }
    assert set(timings) == {(name, 2, lasting) for name in ("service", "echo") for lasting in (True, False)}
    for (name, _, _), timing in timings.items():
        assert len(timing.seconds) >= 2
        assert len(timing.optima_ms) == (len(timing.seconds) if name == "service" else 0)


def test_quantiles() -> None:
    # analytic: of 1 to 100 ms
    timings = Timings([k / 1e3 for k in range(100, 0, -1)], wall_s=2.0, front_s=0.2)
    assert (timings.quantile_ms(0.5), timings.quantile_ms(0.99), timings.quantile_ms(1.0)) == (51, 100, 100)
    assert (timings.per_second, timings.answer_ms(timings.front_s)) == (50, 2)
