"""Kill the service with SIGKILL at random moments, and see that no row is lost, doubled or wrong.

``python -m tests.jobs.kills --kills 100`` runs as many as wanted; the tests run a few.
"""

import argparse
import json
import random
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path

from optimizer.studies.sweep import run_chunk
from schemas.sweep.request import SweepRequest
from tests.jobs.process import Service, service
from tests.jobs.sweeps import analyses

ROUND = analyses(200, 400)
#: how long a chunk takes at least [s]: a sweep has to outlive the kills
CHUNK_S = 0.4


def kill(
    folder: Path,
    kills: int,
    seed: int,
    longest_s: float = 2.5,
    kills_per_process: int = 10,
    body: Mapping[str, object] = ROUND,
) -> tuple[int, int]:
    """Kill a service so often, starting another sweep after every few kills.

    Every other kill waits for a chunk to be finished, so that it hits in the middle of work.

    Returns
    -------
    number of sweeps that were checked, each of them row by row against the rows computed here (independent), and
    number of kills that hit a sweep with some rows but not all.
    """
    moments = random.Random(seed)
    accepted: dict[str, str] = {}
    midway = 0
    for number in range(kills):
        server = Service(folder, delay_s=CHUNK_S)
        server.wait()
        # asked again after each kill with the same key: one sweep, whether the answer got through or not
        key = f"round-{number // kills_per_process}"
        _, headers, _ = server.send("POST", "/v1/sweeps", body, **{"Idempotency-Key": key})
        assert accepted.setdefault(key, headers["location"]) == headers["location"]
        if number % 2:
            path = headers["location"]
            before = state = server.read(path)
            while state["done"] == before["done"] and state["state"] != "done":
                time.sleep(0.02)
                state = server.read(path)
            midway += 0 < state["done"] < state["total"]
            time.sleep(moments.uniform(0, 0.3))
        else:
            time.sleep(moments.uniform(0, longest_s))
        server.kill()
    request = SweepRequest.model_validate(body)
    expected = run_chunk(request.model_dump_json().encode(), 0, request.total)
    with service(folder, delay_s=0) as last:
        for path in accepted.values():
            state = last.ended(path)
            assert (state["state"], state["done"], state["total"]) == ("done", request.total, request.total), state
            # at speed 0 a design is invalid, and nothing else is wrong with any
            assert (state["failed"], state["invalid"]) == (0, expected["status"].to_pylist().count("invalid"))
            assert last.rows(path).equals(expected)
        listed = last.read("/v1/sweeps")["sweeps"]
        assert sorted(state["links"]["self"] for state in listed) == sorted(accepted.values())
    return len(accepted), midway


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        began = time.monotonic()
        sweeps, midway = kill(Path(folder), arguments.kills, arguments.seed)
    fields = {
        "kills": arguments.kills,
        "midway": midway,
        "sweeps": sweeps,
        "rows_each": SweepRequest.model_validate(ROUND).total,
        "wrong": 0,
        "s": time.monotonic() - began,
    }
    print(json.dumps(fields))


if __name__ == "__main__":
    main()
