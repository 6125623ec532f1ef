"""What is called when something takes too long, on a clock that stands; and what is ended then."""

import asyncio
from functools import partial

import pytest

from service.workers.alarms import Alarms
from tests.network.still_loop import Loop


@pytest.fixture
def loop(monkeypatch: pytest.MonkeyPatch) -> Loop:
    found = Loop()
    monkeypatch.setattr(asyncio, "get_running_loop", lambda: found)
    return found


def test_who_is_late_is_called_once_in_time(loop: Loop) -> None:
    alarms, late = Alarms(), list[tuple[str, float]]()

    def called(name: str) -> None:
        late.append((name, loop.now))

    for name, begun in (("first", 0.0), ("second", 1.5), ("third", 4.0)):
        loop.until(begun)
        stop = alarms.set(5.0, partial(called, name))
        if name == "second":
            stop()
    loop.until(100.0)
    # analytic: 5 s after each
    assert late == [("first", 5.0), ("third", 9.0)]
    assert not loop.timers


def test_one_timer_goes_on_over_many(loop: Loop) -> None:
    alarms = Alarms()
    for number in range(400):
        loop.until(0.1 * number)
        alarms.set(5.0, lambda: pytest.fail("it ended in time"))()
        assert len(loop.timers) == 1
    # and ends when nothing has begun since
    loop.until(100.0)
    assert not loop.timers


def test_what_is_set_later_may_come_first(loop: Loop) -> None:
    alarms, late = Alarms(), list[float]()
    for seconds in (60.0, 0.1, 2.0):
        alarms.set(seconds, lambda: late.append(loop.now))
    loop.until(100.0)
    assert late == [0.1, 2.0, 60.0]


def test_who_is_late_may_set_another(loop: Loop) -> None:
    alarms, late = Alarms(), list[float]()
    alarms.set(1.0, lambda: alarms.set(2.0, lambda: late.append(loop.now)))
    alarms.set(5.0, lambda: late.append(loop.now))
    loop.until(100.0)
    assert late == [3.0, 5.0]


def test_who_is_late_may_end_others(loop: Loop) -> None:
    alarms, stops = Alarms(), list[object]()
    alarms.set(5.0, lambda: stops.append(stop()))
    stop = alarms.set(5.0, lambda: pytest.fail("it was ended"))
    loop.until(100.0)
    assert len(stops) == 1


def test_another_loop_has_timers_of_its_own(loop: Loop, monkeypatch: pytest.MonkeyPatch) -> None:
    alarms, late, other = Alarms(), list[float](), Loop()
    alarms.set(5.0, lambda: pytest.fail("its loop has ended"))
    monkeypatch.setattr(asyncio, "get_running_loop", lambda: other)
    alarms.set(5.0, lambda: late.append(other.now))
    other.until(100.0)
    assert late == [5.0]


async def _forever() -> None:
    await asyncio.get_running_loop().create_future()


def test_what_takes_longer_is_ended() -> None:
    async def limited() -> None:
        with Alarms().limit(0.0):
            await _forever()

    with pytest.raises(TimeoutError):
        asyncio.run(limited())


def test_what_ends_in_time_goes_on() -> None:
    async def limited() -> int:
        with Alarms().limit(60.0):
            await asyncio.sleep(0)
        return 1

    assert asyncio.run(limited()) == 1


def test_of_two_limits_the_outer_one_ends_both() -> None:
    async def limited() -> str:
        try:
            with Alarms().limit(0.0):
                with Alarms().limit(60.0):
                    await _forever()
                return "the inner one has taken it for its own"
        except TimeoutError:
            return "outer"

    assert asyncio.run(limited()) == "outer"


def test_who_is_cancelled_by_others_is_not_late() -> None:
    async def limited() -> None:
        with Alarms().limit(60.0):
            await _forever()

    async def cancelled() -> None:
        task = asyncio.ensure_future(limited())
        await asyncio.sleep(0)
        task.cancel()
        await task

    with pytest.raises(asyncio.CancelledError):
        asyncio.run(cancelled())
