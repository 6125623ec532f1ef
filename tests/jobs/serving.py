"""The real service as a process, on chunks that are small and slow enough to be killed in.

Run as ``python -m tests.jobs.serving``; the settings come from the environment.
"""

import os
import threading
from typing import Any

import schemas.base.version
from service.jobs import worker
from service.jobs.piece import ChunkResult

#: seconds that a chunk takes on top of its work
DELAY = "TESTS_DELAY_S"
#: seconds between two looks for leftovers
TIDY = "TESTS_TIDY_S"
#: the version that this service has
VERSION = "TESTS_VERSION"


def slow(kind: str, request: bytes, start: int, stop: int, flag: str) -> ChunkResult:
    # libfaketime knows no sleep until a monotonic time, which is how Python sleeps
    threading.Event().wait(float(os.environ.get(DELAY, "0")))
    return worker.run(kind, request, start, stop, flag)


def serve(**options: Any) -> None:
    if VERSION in os.environ:
        # answers of what it was forked from have read the other one
        schemas.base.version.version = lambda _: os.environ[VERSION]
        schemas.base.version.package_version.cache_clear()
    # workers import this module as well, and need none of these
    from optimizer.studies.sweep import plan
    from service.app import create_app
    from service.jobs.desk import JobService
    from service.jobs.pace import Pace
    from service.settings import Settings
    from service.wire.server import listen, run, url

    # a sweep of some thousand designs in hundreds of chunks instead of 16
    plan._FEWEST_CHUNKS = 400
    settings = Settings(port=0, **options)
    jobs = JobService(
        settings, Pace(poll_s=0.05, lease_s=settings.lease_s, tidy_s=float(os.environ.get(TIDY, "60"))), slow
    )
    socket = listen(settings)
    print(url(socket), flush=True)
    run(create_app(settings, warm=False, jobs=jobs), settings, socket)


if __name__ == "__main__":
    serve()
