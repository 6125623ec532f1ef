"""Attacks on a service: what became of each.

``python -m tests.network.attacks`` sends those written by hand to a service of its own, more than 10,000 requests, and
then others by chance up to ``--count``, of which some are workbooks; it prints, for each attack, the answers, the
slowest of them and the memory that the service took; at the end the answers by status and the memory after idling.
"""

import argparse
import asyncio
import json
import sys
import time
from collections import Counter
from dataclasses import dataclass, field
from itertools import islice
from random import Random

from tests.network import chance
from tests.network.hostile import ATTACKS, Attack
from tests.network.serving import Reply, Service, service

#: most that the service, and one of its workers, may hold [MB]
CEILING_MB = (400.0, 500.0)
_AT_ONCE = 16
#: with a computation [s]
_PATIENCE_S = 900
_MEMORY_S = 0.1
#: so long nobody asks, and so much more than at the start the service may hold then [s, MB]
_IDLE_S, _GROWTH_MB = 20.0, 60.0
_BATCH = 50
#: any answer but that of a fault
_CHANCE = Attack("by chance", lambda: iter(()), frozenset({0, *range(200, 500)}))


@dataclass
class Outcome:
    """What became of an attack; times [s], memory of the service and of its largest worker [MB]."""

    statuses: Counter[int] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)
    slowest_s: float = 0.0
    memory_mb: tuple[float, float] = (0.0, 0.0)


def wrong(attack: Attack, reply: Reply) -> str | None:
    """What is wrong with an answer, if anything is."""
    if reply.status not in attack.statuses:
        return f"{reply.status}: {reply.body[:300]!r}"
    if reply.status >= 400 and reply.headers.get("content-type") != "application/problem+json":
        return f"{reply.status} as {reply.headers.get('content-type')}"
    if reply.status >= 400 and reply.body and json.loads(reply.body)["status"] != reply.status:
        return f"{reply.status} says otherwise"
    return None


async def run(target: Service, attack: Attack, most: int | None = None, every: int = 1) -> Outcome:
    """Send ``most`` of the requests of an attack, each so many, some at a time."""
    outcome = Outcome()
    pending = islice(attack.requests(), 0, None if most is None else most * every, every)

    async def client() -> None:
        for raw in pending:
            begun = time.perf_counter()
            reply = await target.send(raw, timeout=2 * _PATIENCE_S)
            outcome.slowest_s = max(outcome.slowest_s, time.perf_counter() - begun)
            outcome.statuses[reply.status] += 1
            faults = wrong(attack, reply)
            if faults is not None:
                text = raw[:200] if isinstance(raw, bytes) else "..."
                outcome.wrong.append(f"{faults} to {text!r}")

    async def watch() -> None:
        while True:
            pair = await asyncio.to_thread(target.memory_mb)
            outcome.memory_mb = (max(outcome.memory_mb[0], pair[0]), max(outcome.memory_mb[1], pair[1]))
            await asyncio.sleep(_MEMORY_S)

    watching = asyncio.create_task(watch())
    try:
        await asyncio.gather(*(client() for _ in range(_AT_ONCE)))
    finally:
        watching.cancel()
    return outcome


async def by_chance(target: Service, count: int, seed: int) -> Outcome:
    """What becomes of so many requests by chance, some at a time."""
    outcome = Outcome()

    async def client(number: int) -> None:
        random = Random(f"{seed} {number}")
        for _ in range(-(-count // (_AT_ONCE * _BATCH))):
            for message, reply, seconds in await chance.send(target, random, _BATCH):
                if reply.status >= 400:
                    outcome.slowest_s = max(outcome.slowest_s, seconds)
                outcome.statuses[reply.status] += 1
                faults = wrong(_CHANCE, reply)
                if faults is not None:
                    outcome.wrong.append(f"{faults} to {message.raw[:200]!r}")

    await asyncio.gather(*(client(number) for number in range(_AT_ONCE)))
    outcome.memory_mb = target.memory_mb()
    return outcome


def main() -> int:
    """Every request of every attack."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="an attack, or those by chance")
    arguments = parser.parse_args()
    total, failures = 0, 0
    statuses: Counter[int] = Counter()
    # however slow the machine is: what takes too long is answered 503, and that is not what is looked for
    with service(fresh=True, log_level="warning", request_timeout_s=_PATIENCE_S) as target:
        before, worker = target.memory_mb()
        print(f"before: {before:.0f} MB and {worker:.0f} MB a worker")
        print(f"{'attack':<24}{'requests':>9}{'slowest s':>11}{'service MB':>12}{'worker MB':>11}  answers")
        for attack in (*ATTACKS, _CHANCE):
            if arguments.only not in (None, attack.name):
                continue
            if attack is _CHANCE:
                outcome = asyncio.run(by_chance(target, max(0, arguments.count - total), arguments.seed))
            else:
                outcome = asyncio.run(run(target, attack))
            count = outcome.statuses.total()
            own, worker = outcome.memory_mb
            answers = ", ".join(f"{status}: {n}" for status, n in sorted(outcome.statuses.items()))
            print(
                f"{attack.name:<24}{count:>9}{outcome.slowest_s:>11.2f}{own:>12.0f}{worker:>11.0f}  {answers}",
                flush=True,
            )
            for text in outcome.wrong[:5]:
                print(f"    {text}")
            over = own > CEILING_MB[0] or worker > CEILING_MB[1]
            failures += len(outcome.wrong) + over
            total += count
            statuses += outcome.statuses
        time.sleep(_IDLE_S)
        after, worker = target.memory_mb()
        print(f"after {_IDLE_S:.0f} s without a request: {after:.0f} MB and {worker:.0f} MB a worker")
        failures += after - before > _GROWTH_MB
        faults = target.faults()
    print("by status:", ", ".join(f"{status}: {n}" for status, n in sorted(statuses.items())))
    print(f"{total} requests, {failures} answered wrong or over the ceiling of {CEILING_MB} MB")
    print(f"{len(faults)} faults logged", *faults, sep="\n")
    return 1 if failures or faults else 0


if __name__ == "__main__":
    sys.exit(main())
