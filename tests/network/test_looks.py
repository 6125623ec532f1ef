"""Looks: one answers all who ask meanwhile, and none is older than the question."""

import asyncio
import threading
import time
from collections.abc import Callable, Coroutine
from typing import Any

from service.fairness.scheduler import FairScheduler
from service.fairness.single_flight import SingleFlight
from service.fairness.table import LOOKS


class Slow:
    """A look that takes until it is let go."""

    def __init__(self) -> None:
        self.taken = 0
        self.begun, self.go = threading.Event(), threading.Event()

    def __call__(self) -> int:
        self.taken += 1
        count = self.taken
        self.begun.set()
        assert self.go.wait(180)
        return count


def run(work: Callable[[], Coroutine[Any, Any, Any]]) -> Any:
    async def timed() -> Any:
        async with asyncio.timeout(180):
            return await work()

    return asyncio.run(timed())


async def waiting(looks: SingleFlight, look: Slow, count: int) -> list[asyncio.Task[int]]:
    """So many who ask for the same, all of them waiting."""
    asking = [asyncio.create_task(looks.at("me", "state", look)) for _ in range(count)]
    await asyncio.sleep(0)
    return asking


def test_those_who_ask_while_one_is_taken_share_the_next() -> None:
    async def story() -> list[int]:
        looks, look = SingleFlight(FairScheduler().turn), Slow()
        first = await waiting(looks, look, 1)
        await asyncio.to_thread(look.begun.wait, 180)
        later = await waiting(looks, look, 300)
        look.go.set()
        return await asyncio.gather(*first, *later)

    # nobody is told what was found before he asked
    assert run(story) == [1, *[2] * 300]


def test_a_client_looks_at_one_thing_at_a_time_and_keeps_nobody_else_waiting() -> None:
    async def story() -> tuple[int, str, bool]:
        looks, look = SingleFlight(FairScheduler().turn), Slow()
        many = [asyncio.create_task(looks.at("many", k, look)) for k in range(100)]
        await asyncio.to_thread(look.begun.wait, 180)
        text = await looks.at("other", 0, lambda: "seen")
        taken, waits = look.taken, not any(task.done() for task in many)
        look.go.set()
        assert sorted(await asyncio.gather(*many)) == list(range(1, 101))
        return taken, text, waits

    assert run(story) == (1, "seen", True)


def test_who_looks_now_and_then_does_not_wait_for_others_whose_looks_take_long() -> None:
    async def story() -> tuple[str, bool]:
        looks, slow = SingleFlight(FairScheduler().turn), [Slow() for _ in range(int(LOOKS.altogether))]
        tasks = [asyncio.create_task(looks.at(f"client {k}", 0, look)) for k, look in enumerate(slow)]
        for look in slow:
            await asyncio.to_thread(look.begun.wait, 180)
        text = await looks.at("other", 0, lambda: "seen")
        waits = not any(task.done() for task in tasks)
        for look in slow:
            look.go.set()
        await asyncio.gather(*tasks)
        return text, waits

    assert run(story) == ("seen", True)


def test_who_leaves_takes_nothing_from_the_others() -> None:
    async def story() -> int:
        looks, look = SingleFlight(FairScheduler().turn), Slow()
        gone, stays = await waiting(looks, look, 2)
        gone.cancel()
        look.go.set()
        return await stays

    assert run(story) == 1


def test_what_goes_wrong_is_told_to_all_and_the_next_look_is_another() -> None:
    def fails() -> int:
        raise KeyError("gone")

    async def story() -> list[object]:
        looks = SingleFlight(FairScheduler().turn)
        values: list[object] = list(
            await asyncio.gather(*(looks.at("me", "state", fails) for _ in range(3)), return_exceptions=True)
        )
        return [*map(repr, values), await looks.at("me", "state", lambda: 1)]

    assert run(story) == ["KeyError('gone')"] * 3 + [1]


def test_after_its_looks_a_client_is_forgotten() -> None:
    async def left() -> tuple[int, int]:
        looks = SingleFlight(FairScheduler().turn)
        for k in range(5):
            await asyncio.gather(*(looks.at(f"client {k}", 0, lambda: None) for _ in range(3)))
        while looks._own:
            await asyncio.sleep(0.01)
        return len(looks._own), len(looks._tasks)

    assert run(left) == (0, 0)


def test_many_who_look_without_end_leave_the_process_most_of_its_time() -> None:
    """Looks compute beside the event loop: those of eight clients take no more of it than those of one."""

    def look() -> float:
        begun = time.thread_time()
        while (took := time.thread_time() - begun) < 0.002:
            pass
        return took

    async def share(clients: int) -> float:
        looks, end = SingleFlight(FairScheduler().turn), time.monotonic() + 0.4
        taken: dict[str, list[float]] = {f"client {k}": [] for k in range(clients)}

        async def ask(who: str, place: int) -> None:
            while time.monotonic() < end:
                taken[who].append(await looks.at(who, place, look))

        # two of each, so that one waits while the other is answered
        begun = time.monotonic()
        await asyncio.gather(*(ask(who, place) for who in taken for place in range(2)))
        return sum(map(sum, taken.values())) / (time.monotonic() - begun)

    # analytic: a look of c and a rest of 3 c for each that waits; a busy machine makes it less
    assert run(lambda: share(8)) < 0.4


def test_the_looks_of_a_loop_that_has_ended_are_gone_with_it() -> None:
    looks = SingleFlight(FairScheduler().turn)
    assert [run(lambda: looks.at("me", "state", lambda: 1)) for _ in range(3)] == [1, 1, 1]


def test_those_who_shared_a_look_go_on_one_after_the_other() -> None:
    """In turns of the event loop: 300 answers at once would keep everybody else waiting."""

    async def gone_on() -> tuple[int, int]:
        turns: asyncio.Queue[None] = asyncio.Queue()

        async def turn(_: str) -> None:
            await turns.get()

        looks = SingleFlight(turn)
        asking = [asyncio.create_task(looks.at("me", "state", lambda: 1)) for _ in range(300)]
        turns.put_nowait(None)
        await asyncio.wait(asking, return_when=asyncio.FIRST_COMPLETED)
        first = sum(task.done() for task in asking)
        for _ in range(299):
            turns.put_nowait(None)
        return first, sum(await asyncio.gather(*asking))

    assert run(gone_on) == (1, 300)
