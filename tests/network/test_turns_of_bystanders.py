"""Who asks now and then beside owners who ask without end, over seconds of a clock: no turn of theirs waits."""

import heapq
import itertools
from collections import Counter

import pytest

from tests.network.turns import FairQueue, Queue, play


@pytest.mark.parametrize(("count", "long_s"), [(1, 0.025), (8, 0.025), (8, 0.5), (8, 2.0)])
def test_a_bystander_never_waits_for_owners_who_ask_without_end(count: int, long_s: float) -> None:
    """Whether they ask for all at once, or for the next when they have the last; or those of one of them take long."""

    async def story(rung: Queue) -> None:
        numbers, ends = itertools.count(), list[tuple[float, str]]()
        waits: list[str] = []

        async def ask(owner: str) -> str:
            name = f"{owner}{next(numbers)}"
            await rung.ask(name)
            return name

        for owner in "abcd" * count:
            await ask(owner)
        # 25 ms of every one of theirs, or longer of a, 8 ms of his, every 60 ms from when they have pressed for 2 s
        actual_count, asks, comes = 0, 0, 2.0
        while comes < 4.0:
            for name in rung.begun[actual_count:]:
                takes_s = {"a": long_s, "e": 0.008}.get(name[0], 0.025)
                heapq.heappush(ends, (rung.turns.clock() + takes_s, name))
            actual_count = len(rung.begun)
            if comes <= ends[0][0]:
                rung.turns.clock.seconds = comes
                name = await ask("e")
                waits += [] if name in rung.begun else [name]
                asks, comes = asks + 1, comes + 0.06
                continue
            at, name = heapq.heappop(ends)
            await rung.end(name, after_s=at - rung.turns.clock())
            if name[0] != "e":
                await ask(name[0])
        begun = Counter(name[0] for name in rung.begun)
        assert begun["e"] == asks == 34
        assert waits == []
        if long_s > 0.025:
            return
        # two of theirs at a time, and of each a few more in the first moments, when he has had no turn; each a quarter
        assert 0.93 <= sum(begun[owner] for owner in "abcd") / (2 * 4.0 / 0.025) <= 1.08
        assert max(begun[owner] for owner in "abcd") - min(begun[owner] for owner in "abcd") <= 8

    play(FairQueue(2, 100, 64), story)


def test_who_waited_once_does_not_wait_ever_longer() -> None:
    async def story(rung: Queue) -> None:
        # all turns are those of others who are new, for three seconds in which he waits
        for name in ("a0", "b0", "c0", "d0", "a1", "b1", "a2", "b2", "z0"):
            await rung.ask(name)
        assert rung.begun == ["a0", "b0", "c0", "d0"]
        await rung.end("c0", after_s=3.0)
        assert rung.begun[4:] == ["z0"]

    play(FairQueue(2, 100, 64), story)


@pytest.mark.parametrize(("slow", "theirs_s"), [(1.0, 0.1), (2.0, 0.1), (3.0, 0.1), (1.0, 0.004), (3.0, 0.004)])
def test_a_bystander_of_six_never_waits_on_a_machine_with_other_work(slow: float, theirs_s: float) -> None:
    """His turns last several times as long as they compute, as everybody's do: that is not what he had.

    Theirs may compute as little as his, where a lower priority gives them no more of a core.
    """

    async def story(rung: Queue) -> None:
        numbers, ends = itertools.count(), list[tuple[float, str]]()
        waits: list[str] = []

        async def ask(owner: str) -> str:
            name = f"{owner}{next(numbers)}"
            rung.computed_s[name] = {"z": 0.008}.get(owner, theirs_s)
            await rung.ask(name)
            return name

        for owner in "abcdef" * 8:
            await ask(owner)
        # 100 ms or more of every one of theirs, 8 ms of his, every 150 ms from when they have pressed for 2 s
        count, comes = 0, 2.0
        while comes < 8.0:
            for name in rung.begun[count:]:
                lasts_s = slow * {"z": 0.008}.get(name[0], 0.1)
                heapq.heappush(ends, (rung.turns.clock() + lasts_s, name))
            count = len(rung.begun)
            if comes <= ends[0][0]:
                rung.turns.clock.seconds = comes
                name = await ask("z")
                waits += [] if name in rung.begun else [name]
                comes += 0.15
                continue
            at, name = heapq.heappop(ends)
            await rung.end(name, after_s=at - rung.turns.clock())
            if name[0] != "z":
                await ask(name[0])
        assert waits == []
        begun = Counter(name[0] for name in rung.begun)
        assert begun["z"] == 40
        assert max(begun[owner] for owner in "abcdef") - min(begun[owner] for owner in "abcdef") <= 3

    play(FairQueue(2, 100, 64), story)
