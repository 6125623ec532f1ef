"""The command line, whose workers stop at the second chunk of a sweep: nothing depends on when it is interrupted.

Run as ``python -m tests.jobs.held sweep ...``.
"""

import threading
from functools import partial
from pathlib import Path

from service.jobs import worker
from service.jobs.piece import ChunkResult


def held(kind: str, request: bytes, start: int, stop: int, flag: str) -> ChunkResult:
    while start > 0 and not Path(flag).exists():
        threading.Event().wait(0.05)
    return worker.run(kind, request, start, stop, flag)


if __name__ == "__main__":
    # workers import this module as well, and need none of these; under its own name they find what to run
    from service.cli import main
    from service.jobs import desk
    from tests.jobs import held as importable

    desk.JobService = partial(desk.JobService, run=importable.held)  # type: ignore[assignment,misc]
    main()
