"""The measurement of HTTP parsers: it runs, and gives a figure for each protocol."""

from tests.benchmarks.http_parsers import measure


def test_every_protocol_has_a_figure() -> None:
    names = ("uvicorn, h11", "ours", "ours, h11 alone")
    measurement = measure(names, clients=2, count=20, turns=1)
    assert tuple(measurement) == names
    # a request costs tens of microseconds; the first ones some milliseconds on a busy machine
    assert all(5 < single_measurement < 1e5 for single_measurement in measurement.values())
