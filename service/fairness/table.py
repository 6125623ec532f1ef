"""What clients share: one table. Whatever lends, counts or refuses reads its row, and docs/operation.md shows it."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf
from typing import Literal, NamedTuple

from service.settings import Settings

Resource = Literal[
    "connections", "probes", "short", "long", "waiting", "threads", "looks", "events", "rows", "bodies", "answers",
    "files",
]  # fmt: skip
_MB = 1_000_000
#: every so many-th connection is kept for clients who have at most so many
_RESERVE_SHARE, _FEW = 10, 8


class Refusal(NamedTuple):
    """Status and title of what is answered to one unit more."""

    status: int
    title: str


NO_ROOM = Refusal(503, "Too many connections")
BUSY = Refusal(429, "Busy")
OVER_SHARE = Refusal(429, "Over share")
WAITS = "waits"


@dataclass(frozen=True)
class Share:
    """What clients may have of a resource at a time.

    per_client, altogether : units of one client, and of all.
    assured : units that a client may have also of the reserve.
    reserve : units above ``altogether`` for clients who have no more than what is assured.
    answer : to one unit more.
    """

    unit: str
    per_client: float
    altogether: float
    assured: int = 0
    reserve: float = 0
    answer: Refusal | str = WAITS


#: they may ask for health and nothing else
PROBES = Share("connections that ask for health alone", 4, 32, answer="the oldest ends")
#: for what takes time though it computes nothing; more would do no more, as they compute one at a time
THREADS = Share("threads that read and write jobs", 2, 24)
#: the event loop waits for each of them. What is kept of them is for clients who look now and then
LOOKS = Share("threads that look at jobs for all who wait", 1, 1, 1, 1)
#: of what each client waits for once at most
ANY = Share("places to wait", inf, inf)


def connections(altogether: int, per_client: int) -> Share:
    """Open connections, some of which are kept for clients who have few."""
    reserve = altogether // _RESERVE_SHARE
    return Share("open connections", per_client, altogether - reserve, min(_FEW, per_client), reserve, NO_ROOM)


def shares(settings: Settings) -> Mapping[Resource, Share]:
    """The table, as an operator has set it."""
    solves = settings.concurrent_solves
    megabytes = settings.held_mb_each * _MB, settings.held_mb * _MB
    return {
        "connections": connections(settings.max_connections, settings.max_connections_each),
        "probes": PROBES,
        # what is kept of them is for clients who have none, and had little lately
        "short": Share("processes of short computations", inf, solves, 1, 2),
        "long": Share("processes of long computations", inf, max(1, solves // 2)),
        "waiting": Share("requests that wait for one", settings.queue_length_each, settings.queue_length, answer=BUSY),
        "threads": THREADS,
        "looks": LOOKS,
        "events": Share("streams of events", settings.event_streams_each, settings.event_streams, 1, inf, OVER_SHARE),
        "rows": Share("streams of rows", settings.row_streams_each, settings.row_streams, 1, inf, OVER_SHARE),
        # a body is as good as computed, an answer is: one of each is always taken
        "bodies": Share("bytes of requests", *megabytes, settings.max_body_bytes, inf, OVER_SHARE),
        "answers": Share("bytes of answers", *megabytes, _MB, inf, OVER_SHARE),
        "files": Share("bytes of large answers", 8 * megabytes[0], 8 * megabytes[1], 8 * _MB, inf, OVER_SHARE),
    }
