"""What runs in a worker: one chunk of one job. Imported by workers before numpy, so it imports nothing heavy."""

import os
import signal
import threading
from contextlib import suppress
from dataclasses import replace
from multiprocessing import parent_process

from service.common.faults import error_log
from service.common.time_slices import set_slice
from service.jobs.kinds import KINDS
from service.jobs.piece import ChunkResult, Stopped

#: one thread each: as many workers as cores share the work already
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


def run(kind: str, request: bytes, start: int, stop: int, flag: str) -> ChunkResult:
    """Compute rows [start, stop) of a job.

    Raises
    ------
    Stopped
        if there is a file at ``flag``; looked for between blocks of rows.
    Unanswerable
    """

    def proceed() -> None:
        # on a cluster without the service's folder, or without the right to look into it, there is no flag, and the
        # chunk runs to its end
        if os.path.exists(flag):
            raise Stopped

    proceed()
    with error_log() as faults:
        piece = KINDS[kind].compute(request, start, stop, proceed)
    return replace(piece, faults=tuple(faults))


def prepare(niceness: int) -> None:
    """Make a fresh process a worker: one thread, low priority, and no life without the service."""
    for name in THREADS:
        os.environ[name] = "1"
    # Ctrl-C is for the service, which ends its workers
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(niceness)
    # that of the service is short
    with suppress(OSError):
        set_slice(None)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    # a worker waits for work on a pipe that it holds open itself, so it would not notice the end of the service
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
