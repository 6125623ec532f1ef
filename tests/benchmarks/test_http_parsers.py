"""The measurement of HTTP parsers: it runs, and gives a figure for each protocol."""

from tests.benchmarks.http_parsers import measure


def test_every_protocol_has_a_figure() -> None:
    names = ("uvicorn, h11", "ours", "ours, h11 alone")
    found = measure(names, clients=2, count=20, turns=1)
    assert tuple(found) == names
    # a request costs tens of microseconds; the first ones some milliseconds on a busy machine
    assert all(5 < each < 1e5 for each in found.values())
