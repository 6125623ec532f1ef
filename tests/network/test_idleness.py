"""When a kept connection has been idle for too long, on a clock that stands."""

from collections.abc import Callable
from typing import Any, cast

import pytest

from service.wire.idleness import Idleness


class Timer:
    def __init__(self, at: float, ring: Callable[[], None]) -> None:
        self.at, self.ring = at, ring
        self.cancelled = False

    def cancel(self) -> None:
        self.cancelled = True


class Loop:
    """An event loop that has timers alone."""

    def __init__(self) -> None:
        self.now = 0.0
        self.timers: list[Timer] = []

    def time(self) -> float:
        return self.now

    def call_at(self, at: float, ring: Callable[[], None]) -> Timer:
        self.timers.append(Timer(at, ring))
        return self.timers[-1]

    def until(self, now: float) -> None:
        while due := [timer for timer in self.timers if timer.at <= now and not timer.cancelled]:
            self.timers.remove(due[0])
            self.now = due[0].at
            due[0].ring()
        self.now = now


@pytest.fixture
def watched() -> tuple[Loop, Idleness, list[float]]:
    loop, late = Loop(), list[float]()
    return loop, Idleness(cast(Any, loop), 5.0, lambda: late.append(loop.now)), late


def test_a_connection_is_idle_since_its_last_answer(watched: tuple[Loop, Idleness, list[float]]) -> None:
    loop, idleness, late = watched
    for index in range(40):
        loop.until(0.5 * index)
        idleness.end()
        idleness.begin()
        assert len(loop.timers) == 1
    loop.until(100.0)
    # analytic: 5 s after 0.5 * 39
    assert late == [24.5]


def test_while_an_answer_is_made_it_is_not_idle(watched: tuple[Loop, Idleness, list[float]]) -> None:
    loop, idleness, late = watched
    idleness.begin()
    loop.until(1.0)
    idleness.end()
    loop.until(60.0)
    assert not late
    idleness.begin()
    loop.until(100.0)
    assert late == [65.0]


def test_what_has_ended_is_not_called(watched: tuple[Loop, Idleness, list[float]]) -> None:
    loop, idleness, late = watched
    idleness.begin()
    idleness.stop()
    loop.until(100.0)
    assert not late
