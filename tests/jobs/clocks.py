"""Services whose clock jumps by a day and by a month, forth and back, while sweeps run: libfaketime tells the time.

Debian's package ``libfaketime``. What a service measures by clocks that never jump is left alone, as the jump of a real
clock leaves it alone.

``python -m tests.jobs.clocks`` does all of it, for the night; the tests jump with clocks that are handed in.
"""

import argparse
import email.utils
import json
import sys
import tempfile
import time
from collections.abc import Mapping
from contextlib import AbstractContextManager
from pathlib import Path

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from tests.jobs.process import Service, service
from tests.jobs.serving import TIDY
from tests.jobs.sweeps import analyses

DAY_S = 86_400
JUMPS_S = (DAY_S, -DAY_S, 31 * DAY_S, -31 * DAY_S)
#: what waits for a clock that jumped waits for a day at least. All that is done before did not, however long a machine
#: without a free core has taken [s]
PATIENCE_S = DAY_S / 4
SWEEP = analyses(5, 10)


class Missing(Exception):
    """There is no libfaketime here."""


def library() -> Path:
    """
    Raises
    ------
    Missing
    """
    # the one for threads: Debian keeps it in a folder named for the machine
    paths = sorted(Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"))
    if not paths:
        raise Missing("libfaketime is not installed (Debian: libfaketime)")
    return paths[0]


class Clock:
    """The clock of some services, in a file: how far it is from the real one."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self.jump(0)

    def jump(self, to_s: int) -> None:
        """Be so far from the real one."""
        temporary = self._path.with_suffix(".new")
        temporary.write_text(f"{to_s:+d}s\n")
        temporary.replace(self._path)

    @property
    def environment(self) -> Mapping[str, str]:
        return {
            "LD_PRELOAD": str(library()),
            "FAKETIME_TIMESTAMP_FILE": str(self._path),
            "FAKETIME_CACHE_DURATION": "1",
            "FAKETIME_DONT_FAKE_MONOTONIC": "1",
            # files keep the times that they were given, as when a clock jumps
            "NO_FAKE_STAT": "1",
        }


def by(clock: Clock, folder: Path) -> AbstractContextManager[Service]:
    """A service that goes by a clock."""
    return service(folder, delay_s=0.1, more={**clock.environment, TIDY: "0.5"}, results_keep_days="30")


def off(running: Service) -> float:
    """How far the clock of a service is from ours, as its answers say [s]."""
    date = running.send("GET", "/healthz")[1]["date"]
    return email.utils.parsedate_to_datetime(date).timestamp() - time.time()


def wait_for(running: Service, off_s: int) -> None:
    """Until a service lives in another time."""
    until = time.monotonic() + PATIENCE_S
    while abs(off(running) - off_s) > 60:
        assert time.monotonic() < until, f"its clock is off by {off(running):.0f} s, not {off_s} s"
        time.sleep(0.2)


def submit(running: Service) -> str:
    return running.send("POST", "/v1/sweeps", SWEEP)[1]["location"]


def wait_for_rows(running: Service, sweep: str, least: int) -> None:
    until = time.monotonic() + PATIENCE_S
    while running.read(sweep)["done"] < least:
        assert time.monotonic() < until, running.read(sweep)
        time.sleep(0.1)


def require(running: Service, sweep: str) -> None:
    """A sweep is whole, soon for a clock, and right: its rows are those that are computed here (independent)."""
    request = SweepRequest.model_validate(SWEEP)
    state = running.ended(sweep, PATIENCE_S)
    assert (state["state"], state["done"], state["repaired"]) == ("done", request.total, 0), state
    assert running.rows(sweep).equals(run_chunk(request.model_dump_json().encode(), 0, request.total))


def jump(folder: Path, jump_s: int) -> None:
    """A sweep is done, one runs while the clock jumps, one starts in the other time and is killed there; then back."""
    clock = Clock(folder / "clock")
    with by(clock, folder) as running:
        future = submit(running)
        require(running, future)
        forth = submit(running)
        wait_for_rows(running, forth, 1)
        clock.jump(jump_s)
        wait_for(running, jump_s)
        require(running, forth)
        back = submit(running)
        wait_for_rows(running, back, 1)
        running.kill()
    clock.jump(0)
    with by(clock, folder) as running:
        wait_for(running, 0)
        for sweep in (back, future, forth):
            require(running, sweep)


def apart(folder: Path, apart_s: int) -> None:
    """Two services that live in different times share a sweep."""
    here, there = Clock(folder / "here"), Clock(folder / "there")
    there.jump(apart_s)
    with by(here, folder) as server, by(there, folder) as two:
        wait_for(two, apart_s)
        sweep = submit(server)
        require(two, sweep)
        require(server, sweep)


def main() -> None:
    argparse.ArgumentParser(description=__doc__).parse_args()
    began = time.monotonic()
    try:
        library()
    except Missing as missing:
        print(missing, file=sys.stderr)
        sys.exit(2)
    for jump_s in JUMPS_S:
        for does in (jump, apart):
            with tempfile.TemporaryDirectory() as folder:
                does(Path(folder), jump_s)
    days = [jump_s // DAY_S for jump_s in JUMPS_S]
    print(json.dumps({"jumps_d": days, "lost": 0, "expired": 0, "s": round(time.monotonic() - began)}))


if __name__ == "__main__":
    main()
