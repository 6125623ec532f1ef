"""What owners had lately."""

import math

import pytest

from service.fairness.loads import LATELY_S, Loads


class Played(Loads):
    """Told the time."""

    def __init__(self) -> None:
        self.seconds = 0.0
        super().__init__(lambda: self.seconds)


def test_turns_count_for_less_the_longer_ago_they_were() -> None:
    loads = Played()
    assert loads.of("a") == 0.0
    loads.take("a", 2)
    loads.seconds = LATELY_S
    # analytic: of a mean of exponential weights over the time since it came
    assert loads.of("a") == pytest.approx(2)
    loads.take("a", -1)
    loads.seconds = 2 * LATELY_S
    decay = math.exp(-1)
    average = 2 * (1 - decay) * decay + (1 - decay)
    assert loads.of("a") == pytest.approx(average / (1 - decay**2))
    loads.take("a", -1)
    loads.seconds = 3 * LATELY_S
    assert loads.of("a") == pytest.approx(average * decay / (1 - decay**3))


def test_who_asks_without_end_is_known_soon_and_a_first_request_is_little() -> None:
    loads = Played()
    loads.take("without end", 1)
    loads.take("first", 1)
    loads.seconds = 0.01
    loads.take("first", -1)
    assert loads.of("first") < 0.02
    loads.seconds = 1.0
    assert loads.of("without end") == pytest.approx(1.0)


def test_those_who_had_nothing_lately_are_forgotten() -> None:
    loads = Played()
    for number in range(10_000):
        loads.take(str(number), 1)
        loads.seconds += 0.1
        loads.take(str(number), -1)
    # analytic: a turn of 0.1 s is forgotten after ln(20) times 5 s
    assert len(loads._loads) < 300
