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
    loads.take("a")
    loads.take("a")
    loads.seconds = LATELY_S
    # analytic: of a mean of exponential weights over the time since it came
    assert loads.of("a") == pytest.approx(2)
    loads.end("a", LATELY_S, LATELY_S)
    loads.seconds = 2 * LATELY_S
    decay = math.exp(-1)
    average = 2 * (1 - decay) * decay + (1 - decay)
    assert loads.of("a") == pytest.approx(average / (1 - decay**2))
    loads.end("a", 2 * LATELY_S, 2 * LATELY_S)
    loads.seconds = 3 * LATELY_S
    assert loads.of("a") == pytest.approx(average * decay / (1 - decay**3))


def test_a_turn_that_has_ended_counts_for_what_was_computed_in_it() -> None:
    loads = Played()
    loads.take("a")
    loads.take("whole")
    loads.seconds = 2.0
    assert loads.of("a") == pytest.approx(1)
    loads.end("a", 2.0, 0.5)
    # cores may have been more than one, and clocks differ
    loads.end("whole", 2.0, 2.1)
    # analytic: a quarter of what a core would have computed
    assert (loads.of("a"), loads.of("whole")) == (pytest.approx(0.25), pytest.approx(1))
    loads.seconds = 7.0
    decay = math.exp(-1)
    assert loads.of("a") == pytest.approx(0.25 * (1 - math.exp(-0.4)) * decay / -math.expm1(-1.4))
    # a turn without any time counts for nothing
    loads.take("b")
    loads.end("b", 0.0, 0.0)
    assert loads.of("b") == 0.0


def test_who_asks_without_end_is_known_soon_and_a_first_request_is_little() -> None:
    loads = Played()
    loads.take("without end")
    loads.take("first")
    loads.seconds = 0.01
    loads.end("first", 0.01, 0.01)
    assert loads.of("first") < 0.02
    loads.seconds = 1.0
    assert loads.of("without end") == pytest.approx(1.0)


@pytest.mark.parametrize("count", [0, 3])
def test_many_short_turns_add_up(count: int) -> None:
    loads = Played()
    for _ in range(2000):
        for owner in ("without end", *map(str, range(count))):
            loads.take(owner)
        loads.seconds += 0.003
        for owner in ("without end", *map(str, range(count))):
            loads.end(owner, 0.003, 0.002)
        loads.seconds += 0.001
    # analytic: half of the time a core computes
    assert loads.of("without end") == pytest.approx(0.5, rel=1e-3)


def test_those_who_had_nothing_lately_are_forgotten() -> None:
    loads = Played()
    for number in range(10_000):
        loads.take(str(number))
        loads.seconds += 0.1
        loads.end(str(number), 0.1, 0.1)
    # analytic: a turn of 0.1 s is forgotten after ln(20) times 5 s
    assert len(loads._loads) < 300
