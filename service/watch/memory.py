"""Memory that nobody uses any more goes back to the system, which the libraries would not do by themselves."""

import ctypes
import gc
import os
import resource
import time
from collections.abc import Callable
from pathlib import Path

from anyio import CapacityLimiter, sleep, to_thread

#: of the GNU C library
_MMAP_THRESHOLD, _ARENA_MAX = -3, -8
#: what is larger is a mapping of its own, which ends when it is freed; the library would raise this by itself [bytes]
_LARGE_BYTES = 131_072
#: heaps that threads share, so that what one of them has freed is there for the others
_HEAPS = 2
#: between two times [s]: the longer, the less there was to give back [bytes]
_SHORT_S, _LONG_S = 10.0, 30.0
#: each stops the service for a tenth of a second, and so waits for a time [s] in which it computes for a share at most.
#: It waits no longer than that [s]
_LOOK_S, _CALM, _PATIENCE_S = 1.0, 0.2, 300.0
_MUCH_BYTES = 4_000_000
_PAGE_BYTES = resource.getpagesize()


def keep_little() -> None:
    """Have all memory come from the C library, which has a setting to return it; before Arrow is imported.

    Arrow has an allocator of its own otherwise, which keeps what rows took for good.
    """
    os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")
    tell = getattr(ctypes.CDLL(None), "mallopt", None)
    # other C libraries have no such setting
    if tell is not None:
        tell(_MMAP_THRESHOLD, _LARGE_BYTES)
        tell(_ARENA_MAX, _HEAPS)


async def give_back() -> None:
    """Give back what is not used, again and again, until cancelled."""
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
    pause, own = _SHORT_S, CapacityLimiter(1)
    while trim is not None:
        await sleep(pause)
        await _calm()
        before = _resident()
        await to_thread.run_sync(_give_back, trim, limiter=own)
        pause = _SHORT_S if before - _resident() > _MUCH_BYTES else min(2 * pause, _LONG_S)


async def _calm() -> None:
    """Wait until little is computed here."""
    end = time.monotonic() + _PATIENCE_S
    while time.monotonic() < end:
        computed, at = time.process_time(), time.monotonic()
        await sleep(_LOOK_S)
        if time.process_time() - computed < _CALM * (time.monotonic() - at):
            return


def _give_back(trim: Callable[[int], int]) -> None:
    # streams that were cut are garbage with all that they held; without requests nothing else collects it
    gc.collect()
    trim(0)


def _resident() -> int:
    """Memory of this process [bytes]."""
    return int(Path("/proc/self/statm").read_bytes().split()[1]) * _PAGE_BYTES
