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
    # analytic: of a mean of exponential weights
    assert loads.of("a") == pytest.approx(2 * (1 - math.exp(-1)))
    loads.take("a", -1)
    loads.seconds = 2 * LATELY_S
    assert loads.of("a") == pytest.approx(1 + (1 - 2 * math.exp(-1)) * math.exp(-1))
    loads.take("a", -1)
    before = loads.of("a")
    loads.seconds = 3 * LATELY_S
    assert loads.of("a") == pytest.approx(before * math.exp(-1))


def test_those_who_had_nothing_lately_are_forgotten() -> None:
    loads = Played()
    for number in range(10_000):
        loads.take(str(number), 1)
        loads.seconds += 0.1
        loads.take(str(number), -1)
    # analytic: a turn of 0.1 s is forgotten after ln(20) times 5 s
    assert len(loads._loads) < 300
