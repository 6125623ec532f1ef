"""Turns: nobody waits behind all that another one asks, and nobody's place is lost."""

import heapq
import itertools
from collections import Counter

import anyio
import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.fairness.queue import FairQueue as _Turns
from service.fairness.queue import Full
from service.fairness.table import Share, shares
from service.settings import Settings

ABOVE = int(shares(Settings())["short"].reserve)


class Clock:
    """Time that goes by when it is told to."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def __call__(self) -> float:
        return self.seconds


class FairQueue(_Turns):
    """With a clock of its own, which stands."""

    def __init__(self, size: int, waiting: int, count: int, above: int = ABOVE) -> None:
        self.clock = Clock()
        super().__init__(Share("turn", size, size, 1, above), Share("place", count, waiting), self.clock)


async def settled() -> None:
    """Whoever can go on has gone on: rounds of the loop; anyio's own waiting sleeps for a tenth of a second."""
    for _ in range(10):
        await anyio.lowlevel.checkpoint()


class Queue:
    """Turns that are asked for in order, each ended by hand."""

    def __init__(self, turns: FairQueue, group: anyio.abc.TaskGroup) -> None:
        self.turns = turns
        self.begun: list[str] = []
        self.refused: list[str] = []
        #: of turns, where it is not all the time that they last
        self.computed_s: dict[str, float] = {}
        self._group = group
        self._ends: dict[str, anyio.Event] = {}

    async def ask(self, name: str) -> None:
        """Ask for a turn of the owner that the first letter of a name names."""
        self._ends[name] = anyio.Event()

        async def have() -> None:
            try:
                turn = self.turns.turn(name[0])
                async with turn:
                    self.begun.append(name)
                    await self._ends[name].wait()
                    turn.computed_s = self.computed_s.get(name)
            except Full:
                self.refused.append(name)

        self._group.start_soon(have)
        await settled()

    async def end(self, *names: str, after_s: float = 0.0) -> None:
        """End turns, each when so much time has gone by."""
        for name in names:
            self.turns.clock.seconds += after_s
            self._ends[name].set()
            await settled()


def play(turns: FairQueue, story: object) -> Queue:
    rungs: list[Queue] = []

    async def tell() -> None:
        async with anyio.create_task_group() as group:
            rungs.append(Queue(turns, group))
            await story(rungs[0])  # type: ignore[operator]
            group.cancel_scope.cancel()

    anyio.run(tell)
    assert turns.waiting == 0
    return rungs[0]


def test_owners_take_turns() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a1", "b1", "a2", "a3", "a4", "b2", "b3"):
            await rung.ask(name)
        # b1 is above the size, as b has none
        assert rung.begun == ["a1", "b1"]
        await rung.end("a1", "b1", "a2", "b2", "a3", "b3")
        assert rung.begun[2:] == ["a2", "b2", "a3", "b3", "a4"]

    play(FairQueue(1, 10, 10), story)


def test_who_has_nothing_begins_at_once_though_another_one_has_everything() -> None:
    async def story(rung: Queue) -> None:
        for k in range(10):
            await rung.ask(f"a{k}")
        await rung.ask("b0")
        assert rung.begun == ["a0", "a1", "b0"]
        await rung.ask("b1")
        # b has one
        assert rung.begun == ["a0", "a1", "b0"]
        await rung.end("a0", after_s=1.0)
        # a has had twice as much
        assert rung.begun[3:] == ["b1"]
        await rung.end("a1", after_s=1.0)
        assert rung.begun[4:] == ["a2"]

    play(FairQueue(2, 20, 20), story)


def test_who_asks_without_end_gives_way_as_long_as_another_computes() -> None:
    turns = FairQueue(2, 20, 20)

    async def story(_: Queue) -> None:
        busy, later, turn = turns.turn("a"), turns.turn("a"), turns.turn("b")
        turns.ask(busy)
        turns.clock.seconds += 5.0
        busy.end()
        turns.ask(later)
        assert (later.seldom, turns.gives_way(later)) == (False, False)
        turns.ask(turn)
        assert (turn.seldom, turns.gives_way(turn), turns.gives_way(later)) == (True, False, True)
        turn.end()
        assert not turns.gives_way(later)
        later.end()

    play(turns, story)


def test_owners_who_ask_without_end_leave_two_to_who_asks_now_and_then() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "b0", "c0", "a1", "b1", "c1", "a2", "b2", "c2"):
            await rung.ask(name)
        # nobody has had more than c
        assert rung.begun == ["a0", "b0", "c0"]
        await rung.end("c0", after_s=10.0)
        # c has none now, but has had as much as a and b
        assert rung.begun[3:] == []
        for name in ("d0", "e0", "f0"):
            await rung.ask(name)
        assert rung.begun[3:] == ["d0", "e0"]
        await rung.end("d0", after_s=0.1)
        assert rung.begun[5:] == ["f0"]
        await rung.end("a0", after_s=0.1)
        # what a had is none of the two, which e and f have
        assert rung.begun[6:] == ["c1"]
        await rung.end("e0", "f0", after_s=0.1)
        # a has none now, and had none for a moment
        assert rung.begun[7:] == []

    play(FairQueue(2, 20, 20), story)


def test_who_wants_several_in_its_first_moments_has_none_of_those_turns() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "b0", "c0", "d0", "c1", "c2", "d1"):
            await rung.ask(name)
        assert rung.begun == ["a0", "b0", "c0", "d0"]
        await rung.end("c0", "d0", after_s=0.01)
        # c and d are as new, but c wants two
        assert rung.begun[4:] == ["d1"]
        await rung.ask("e0")
        assert rung.begun[5:] == ["e0"]

    play(FairQueue(2, 20, 20), story)


def test_who_has_had_least_is_next() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "b0", "a1", "a2", "b1", "b2"):
            await rung.ask(name)
        await rung.end("a0", after_s=0.2)
        await rung.end("b0", after_s=0.4)
        assert rung.begun == ["a0", "b0", "a1"]
        await rung.end("a1", after_s=0.5)
        # a has had 0.7 s, b 0.5 s with its next one: it is before a, though it began last
        await rung.end("b1", after_s=0.1)
        assert rung.begun[3:] == ["b1", "b2"]
        await rung.end("b2", after_s=0.1)
        assert rung.begun[5:] == ["a2"]

    play(FairQueue(1, 10, 10, above=0), story)


def test_nobody_waits_for_ever_however_many_come() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "b0", "c0", "a1"):
            await rung.ask(name)
        # somebody who has had nothing comes before every end
        for ends, comes in zip("bacde", "defgh", strict=True):
            await rung.ask(f"{comes}0")
            await rung.end(f"{ends}0", after_s=0.5)
        # after two seconds without any a is before h
        assert rung.begun == ["a0", "b0", "c0", "d0", "e0", "f0", "g0", "a1"]

    play(FairQueue(1, 20, 20), story)


def test_a_place_that_was_given_up_leaves_nothing_behind() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "a1", "a2", "b0", "b1", "c0", "c1"):
            await rung.ask(name)
        for name in ("a0", "b0", "c0", "a1", "b1", "c1"):
            if name in rung.begun:
                await rung.end(name, after_s=1.0)

    turns = FairQueue(1, 2, 2)
    play(turns, story)
    assert not [owner for owner in "abc" if owner in turns._accounts]


def test_an_owner_has_its_share_of_the_places_and_gives_up_the_last_to_others() -> None:
    async def story(rung: Queue) -> None:
        for k in range(6):
            await rung.ask(f"a{k}")
        assert rung.refused == ["a5"]
        for name in ("b0", "b1", "c0", "c1", "c2"):
            await rung.ask(name)
        # b0 and c0 begin, as b and c have none; b1 and c1 take the places that a has last; c2 would be as many as a has
        assert rung.refused == ["a5", "a4", "a3", "c2"]

    play(FairQueue(1, 4, 4), story)


def test_none_above_the_size_where_there_are_none() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "b0", "b1", "c0"):
            await rung.ask(name)
        assert rung.begun == ["a0"]
        await rung.end("a0", "b0", after_s=1.0)
        assert rung.begun[1:] == ["b0", "c0"]

    play(FairQueue(1, 4, 4, above=0), story)


async def _step_by_step(turns: FairQueue) -> None:
    first, second = turns.turn("a"), turns.turn("b")
    await first.granted()
    assert not turns.crowded.is_set()
    with anyio.move_on_after(0.01):
        await second.granted()
    # who has stopped waiting keeps the place, and waits for it again
    assert (turns.waiting, turns.crowded.is_set()) == (1, True)
    first.end()
    await second.granted()
    # what has ended ends once
    first.end()
    assert (second.begun, turns.waiting, turns.crowded.is_set()) == (True, 0, False)
    second.end()
    turns.turn("c").end()
    async with turns.turn("d"):
        pass


def test_a_turn_is_had_step_by_step() -> None:
    anyio.run(_step_by_step, FairQueue(1, 4, 4, above=0))


def test_nobody_waits_where_nobody_may() -> None:
    async def story(rung: Queue) -> None:
        await rung.ask("a0")
        await rung.ask("a1")
        assert rung.refused == ["a1"]

    play(FairQueue(1, 0, 0), story)


async def _leave(turns: FairQueue) -> None:
    async with turns.turn("a"):
        with anyio.move_on_after(0.01):
            async with turns.turn("a"):
                pytest.fail("there is one turn")
        assert turns.waiting == 0
    async with turns.turn("a"):
        pass


def test_who_goes_away_leaves_no_place_taken() -> None:
    anyio.run(_leave, FairQueue(1, 4, 4))


@given(st.lists(st.tuples(st.sampled_from("abc"), st.booleans()), max_size=40), st.integers(1, 3))
def test_everybody_is_served_or_refused_and_never_more_than_there_are(steps: list[tuple[str, bool]], size: int) -> None:
    turns = FairQueue(size, 6, 4)

    async def story(rung: Queue) -> None:
        open_turns: list[str] = []
        for index, (owner, end) in enumerate(steps):
            await rung.ask(f"{owner}{index}")
            open_turns = [name for name in rung.begun if not rung._ends[name].is_set()]
            assert len(open_turns) <= size + ABOVE
            assert turns.waiting <= 6
            if end and open_turns:
                await rung.end(open_turns[0])
        while left := [name for name in rung.begun if not rung._ends[name].is_set()]:
            await rung.end(left[0])
        assert Counter([*rung.begun, *rung.refused]) == Counter(f"{o}{k}" for k, (o, _) in enumerate(steps))

    play(turns, story)


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
