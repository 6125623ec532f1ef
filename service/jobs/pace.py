"""How often a coordinator looks, how long it waits, and how often it tries."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Pace:
    """How often and how long; seconds."""

    #: looks for work and for cancelled jobs this often
    poll_s: float = 0.5
    #: a lease that is not renewed for this long is free
    lease_s: float = 10.0
    #: looks for expired jobs and leftovers this often
    tidy_s: float = 60.0
    #: waits for a database or an engine that is away for this long at most before it asks again
    longest_pause_s: float = 5.0
    #: a chunk is tried this often before it is halved, a single row before it is recorded as failed
    tries: int = 3
    #: a job with more faults than this is failed
    max_faults: int = 300
